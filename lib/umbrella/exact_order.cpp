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
        once_((std::size_t{1} << (kWordBits - shift_)) / kWordBits + 1),
        twice_(once_.size()) {}

  void enter(double x) {
    const auto [low, high] = steps(x);
    enter_step(low);
    if (low != high) enter_step(high);
  }
  bool may_be_shared(double x) const {
    const auto [low, high] = steps(x);
    return is_set(twice_, place(low)) || is_set(twice_, place(high));
  }

 private:
  static constexpr int kWordBits = 64;
  /// For each number; so few of them seem to be shared that are not.
  static constexpr std::size_t kPlaces = 16;

  /// The ends of an interval of a relative width just above kNearTie, so that
  /// those of near numbers meet. A step keeps 29 bits of the fraction: it is
  /// wider than any such interval, which therefore lies on two at most.
  static std::pair<std::uint64_t, std::uint64_t> steps(double x) {
    constexpr double kHalfWidth = (1 + 0x1p-16) * kNearTie / 2;
    constexpr unsigned kDropped = 23;
    return {bits(x * (1 - kHalfWidth)) >> kDropped,
            bits(x * (1 + kHalfWidth)) >> kDropped};
  }
  std::size_t place(std::uint64_t step) const {
    return (step * 0x9e37'79b9'7f4a'7c15U) >> shift_;
  }
  void enter_step(std::uint64_t step) {
    const std::size_t p = place(step);
    std::uint64_t& once = once_[p / kWordBits];
    const std::uint64_t bit = std::uint64_t{1} << p % kWordBits;
    twice_[p / kWordBits] |= once & bit;
    once |= bit;
  }
  static bool is_set(const std::vector<std::uint64_t>& words, std::size_t p) {
    return (words[p / kWordBits] >> p % kWordBits & 1U) != 0;
  }

  int shift_;
  std::vector<std::uint64_t> once_, twice_;
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

  void order_primaries() {
    StepTable table(triangles_.size());
    for (const RankedTriangle& t : triangles_) table.enter(t.rank.primary);
    std::vector<Entry> entries;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      const double primary = triangles_[i].rank.primary;
      if (primary > 0 && table.may_be_shared(primary))
        entries.push_back({primary, i});
    }
    sort_by_value(entries);
    for_each_run(entries, [this](std::span<const Entry> run) {
      if (run.size() > 1) spread(run);
    });
  }

  void order_secondaries_at_zero() {
    std::vector<Entry> entries;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
      if (triangles_[i].rank.primary == 0)
        entries.push_back({triangles_[i].rank.secondary, i});
    sort_by_value(entries);
    double number = 0;
    for_each_run(entries, [&](std::span<const Entry> run) {
      for_each_class(run, [&](std::span<const Keyed> equal) {
        for (const Keyed& k : equal) rank(k).secondary = number;
        ++number;
      });
    });
  }

 private:
  struct Keyed {
    ExactRank exact;
    std::uint32_t position;
    bool equals_previous;
  };

  Rank& rank(const Keyed& k) { return triangles_[k.position].rank; }

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
    keyed_.clear();
    for (const Entry& e : run)
      keyed_.push_back(
          {run.size() > 1 ? exact_(triangles_[e.position].facet) : ExactRank{},
           e.position, false});
    // Estimates leave little to compare: most neighbours are equal now.
    std::sort(keyed_.begin(), keyed_.end(), [](const Keyed& a, const Keyed& b) {
      const auto x = a.exact.primary.estimate();
      const auto y = b.exact.primary.estimate();
      return x != y
                 ? x < y
                 : a.exact.secondary.estimate() < b.exact.secondary.estimate();
    });
    if (!compare_neighbors()) {
      std::stable_sort(keyed_.begin(), keyed_.end(),
                       [](const Keyed& a, const Keyed& b) {
                         return compare(a.exact, b.exact) < 0;
                       });
      compare_neighbors();
    }
    const std::span<const Keyed> keyed = keyed_;
    for (std::size_t begin = 0, end = 0; begin < keyed.size(); begin = end) {
      end = begin + 1;
      while (end < keyed.size() && keyed[end].equals_previous) ++end;
      visit(keyed.subspan(begin, end - begin));
    }
  }

  /// @return whether they ascend; if so, equals_previous is set
  bool compare_neighbors() {
    for (std::size_t i = 1; i < keyed_.size(); ++i) {
      const int order = compare(keyed_[i - 1].exact, keyed_[i].exact);
      if (order > 0) return false;
      keyed_[i].equals_previous = order == 0;
    }
    return true;
  }

  /// The exact values ascend, so the largest number computed so far is off by
  /// no more than the numbers are.
  void spread(std::span<const Entry> run) {
    double primary = 0, number = 0;
    for_each_class(run, [&](std::span<const Keyed> equal) {
      for (const Keyed& k : equal) primary = std::max(primary, rank(k).primary);
      for (const Keyed& k : equal) rank(k) = {primary, number};
      ++number;
    });
  }

  std::vector<RankedTriangle>& triangles_;
  const std::function<ExactRank(delaunay::Facet)>& exact_;
  std::vector<Keyed> keyed_;
};

}  // namespace

void order_exactly(std::vector<RankedTriangle>& triangles,
                   const std::function<ExactRank(delaunay::Facet)>& exact) {
  Orderer orderer(triangles, exact);
  orderer.order_secondaries_at_zero();
  orderer.order_primaries();
}

}  // namespace umbrella
