// Nearly all ranks stand apart from every other: to find those that do not,
// nothing is sorted. Each number is entered under the one or two steps of a
// logarithmic scale that it may lie on, errors included; only numbers that
// share a step with another (or seem to, in a table of two bits a step) go on
// to be sorted, and only runs of close ones to exact arithmetic.
#include "umbrella/exact_order.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "umbrella/buckets_internal.h"

namespace umbrella {
namespace {

/// One key of a rank, and whose it is.
struct Entry {
  double value;
  std::uint32_t position;
};

bool near(const Entry& a, const Entry& b) {
  return std::abs(a.value - b.value) <= kNearTie * b.value;
}

/// Orders doubles that are not negative as their values do.
std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

/// Which steps were met, and which more than once. Steps may share a place: so
/// it may say "more than once" for a step that was met once, never "once" for
/// one met twice.
class StepTable {
 public:
  explicit StepTable(std::size_t n_numbers)
      : shift_(kWordBits -
               static_cast<int>(std::bit_width(kPlaces * n_numbers))),
        words_((std::size_t{1} << (kWordBits - shift_)) / kPlacesOfWord + 1) {}

  void enter(double x) {
    const auto [low, high] = steps(x);
    enter_step(low);
    if (low != high) enter_step(high);
  }
  bool may_be_shared(double x) const {
    const auto [low, high] = steps(x);
    return is_shared(low) || (low != high && is_shared(high));
  }

 private:
  static constexpr int kWordBits = 64;
  static constexpr std::size_t kPlacesOfWord = kWordBits / 2;
  /// For each number; so few of them seem to be shared that are not.
  static constexpr std::size_t kPlaces = 16;

  /// The ends of an interval of a relative width just above kNearTie, so that
  /// those of near numbers meet. A step keeps 26 bits of the fraction: it is
  /// wider than any such interval, which therefore lies on two at most, and
  /// mostly on one.
  static std::pair<std::uint64_t, std::uint64_t> steps(double x) {
    constexpr double kHalfWidth = (1 + 0x1p-16) * kNearTie / 2;
    constexpr unsigned kDropped = 26;
    return {bits(x * (1 - kHalfWidth)) >> kDropped,
            bits(x * (1 + kHalfWidth)) >> kDropped};
  }
  std::size_t place(std::uint64_t step) const {
    return (step * 0x9e37'79b9'7f4a'7c15U) >> shift_;
  }
  void enter_step(std::uint64_t step) {
    const std::size_t p = place(step);
    std::uint64_t& word = words_[p / kPlacesOfWord];
    const std::size_t shift = 2 * (p % kPlacesOfWord);
    const std::uint64_t was_met = word >> shift & 1U;
    word |= (1U | was_met << 1U) << shift;
  }
  bool is_shared(std::uint64_t step) const {
    const std::size_t p = place(step);
    return (words_[p / kPlacesOfWord] >> 2 * (p % kPlacesOfWord) & 2U) != 0;
  }

  int shift_;
  std::vector<std::uint64_t> words_;  // two bits a place: met, met again
};

/// Buckets are equal steps of the bits, that is of a logarithm.
void sort_by_value(std::vector<Entry>& entries) {
  if (entries.empty()) return;
  const auto [least, most] = std::minmax_element(
      entries.begin(), entries.end(),
      [](const Entry& a, const Entry& b) { return a.value < b.value; });
  const std::uint64_t lowest = bits(least->value), highest = bits(most->value);
  const std::size_t n = entries.size();
  const double step =
      static_cast<double>(n) / (static_cast<double>(highest - lowest) + 1);
  bucket_sort(
      entries, n + 1,
      [&](const Entry& e) {
        return static_cast<std::size_t>(
            static_cast<double>(bits(e.value) - lowest) * step);
      },
      [](const Entry& a, const Entry& b) {
        return a.value != b.value ? a.value < b.value : a.position < b.position;
      });
}

/// Gives runs of near entries their exact order.
class Orderer {
 public:
  Orderer(std::vector<RankedTriangle>& triangles,
          const std::function<ExactRank(delaunay::Facet)>& exact)
      : triangles_(triangles), exact_(exact) {}

  void order() {
    StepTable table(triangles_.size());
    std::vector<Entry> entries;  // at zero, then those that may be near others
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      const Rank& rank = triangles_[i].rank;
      if (rank.primary > 0)
        table.enter(rank.primary);
      else
        entries.push_back({rank.secondary, i});
    }
    number_secondaries(entries);

    entries.clear();
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      const double primary = triangles_[i].rank.primary;
      if (primary > 0 && table.may_be_shared(primary))
        entries.push_back({primary, i});
    }
    order_primaries(entries);
  }

 private:
  /// One of a run, and which of the classes of equal ones it is in.
  struct Member {
    std::uint32_t position;
    std::uint32_t in_class;
  };
  struct Class {
    ExactRank exact;
    std::uint32_t name;
    bool equals_previous;
  };

  Rank& rank(const Member& m) { return triangles_[m.position].rank; }

  /// Of triangles whose primaries are equal.
  void number_secondaries(std::vector<Entry>& entries) {
    sort_by_value(entries);
    double number = 0;
    for_each_run(entries, [&](std::span<const Entry> run) {
      for_each_class(run, [&](std::span<const Member> equal) {
        for (const Member& m : equal) rank(m).secondary = number;
        ++number;
      });
    });
  }

  void order_primaries(std::vector<Entry>& entries) {
    sort_by_value(entries);
    for_each_run(entries, [this](std::span<const Entry> run) {
      if (run.size() > 1) spread(run);
    });
  }

  /// Calls visit(span of entries each of which is near the one before).
  template <class Visit>
  static void for_each_run(std::span<const Entry> entries, Visit visit) {
    for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
      end = begin + 1;
      while (end < entries.size() && near(entries[end - 1], entries[end]))
        ++end;
      visit(entries.subspan(begin, end - begin));
    }
  }

  /// Calls visit(span of equal ones), in exact order.
  template <class Visit>
  void for_each_class(std::span<const Entry> run, Visit visit) {
    members_.clear();
    classes_.clear();
    for (const Entry& e : run)
      members_.push_back({e.position, run.size() > 1 ? class_of(e) : 0});
    if (classes_.size() > 1) order_classes();
    const std::span<const Member> members = members_;
    for (std::size_t begin = 0, end = 0; begin < members.size(); begin = end) {
      end = begin + 1;
      while (end < members.size() &&
             members[end].in_class == members[begin].in_class)
        ++end;
      visit(members.subspan(begin, end - begin));
    }
  }

  /// Most of a run are plainly equal to one that came before.
  std::uint32_t class_of(const Entry& e) {
    constexpr std::size_t kMostTried = 8;
    ExactRank exact = exact_(triangles_[e.position].facet);
    const std::size_t n_tried = std::min(classes_.size(), kMostTried);
    for (const Class& c : std::span(classes_).last(n_tried))
      if (plainly_equal(c.exact, exact)) return c.name;
    const auto name = static_cast<std::uint32_t>(classes_.size());
    classes_.push_back({std::move(exact), name, false});
    return name;
  }

  /// Sorts the members by the exact order of their classes, and gives classes
  /// that prove equal one name.
  void order_classes() {
    // Estimates leave little to compare.
    std::sort(classes_.begin(), classes_.end(),
              [](const Class& a, const Class& b) {
                const auto x = a.exact.primary.estimate();
                const auto y = b.exact.primary.estimate();
                return x != y ? x < y
                              : a.exact.secondary.estimate() <
                                    b.exact.secondary.estimate();
              });
    if (!compare_neighbors()) {
      std::stable_sort(classes_.begin(), classes_.end(),
                       [](const Class& a, const Class& b) {
                         return compare(a.exact, b.exact) < 0;
                       });
      compare_neighbors();
    }
    places_.resize(classes_.size());
    std::uint32_t place = 0;
    for (const Class& c : classes_)
      places_[c.name] = place += c.equals_previous ? 0 : 1;
    for (Member& m : members_) m.in_class = places_[m.in_class];
    std::sort(members_.begin(), members_.end(),
              [](const Member& a, const Member& b) {
                return a.in_class < b.in_class;
              });
  }

  /// @return whether they ascend; if so, equals_previous is set
  bool compare_neighbors() {
    for (std::size_t i = 1; i < classes_.size(); ++i) {
      const int order = compare(classes_[i - 1].exact, classes_[i].exact);
      if (order > 0) return false;
      classes_[i].equals_previous = order == 0;
    }
    classes_.front().equals_previous = false;
    return true;
  }

  /// The exact values ascend, so the largest number computed so far is off by
  /// no more than the numbers are.
  void spread(std::span<const Entry> run) {
    double primary = 0, number = 0;
    for_each_class(run, [&](std::span<const Member> equal) {
      for (const Member& m : equal)
        primary = std::max(primary, rank(m).primary);
      for (const Member& m : equal) rank(m) = {primary, number};
      ++number;
    });
  }

  std::vector<RankedTriangle>& triangles_;
  const std::function<ExactRank(delaunay::Facet)>& exact_;
  std::vector<Member> members_;
  std::vector<Class> classes_;
  std::vector<std::uint32_t> places_;
};

}  // namespace

void order_exactly(std::vector<RankedTriangle>& triangles,
                   const std::function<ExactRank(delaunay::Facet)>& exact) {
  Orderer(triangles, exact).order();
}

}  // namespace umbrella
