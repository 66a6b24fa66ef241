#include "umbrella/criterion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "umbrella/buckets_internal.h"

namespace umbrella {
namespace {

bool near(double a, double b) { return std::abs(a - b) <= kNearTie * b; }

/// One key of a rank, and whose it is.
struct Entry {
  double value;
  std::uint32_t position;
};

/// Orders doubles that are not negative as their values do.
std::uint64_t bits(const Entry& e) {
  return std::bit_cast<std::uint64_t>(e.value);
}

/// Buckets are equal steps of the bits, that is of a logarithm.
void sort_by_value(std::vector<Entry>& entries) {
  std::uint64_t lowest = std::numeric_limits<std::uint64_t>::max(), highest = 0;
  for (const Entry& e : entries) {
    lowest = std::min(lowest, bits(e));
    highest = std::max(highest, bits(e));
  }
  const std::size_t n = entries.size();
  const double step =
      static_cast<double>(n) / (static_cast<double>(highest - lowest) + 1);
  bucket_sort(
      entries, n + 1,
      [&](const Entry& e) {
        return static_cast<std::size_t>(static_cast<double>(bits(e) - lowest) *
                                        step);
      },
      [](const Entry& a, const Entry& b) { return a.value < b.value; });
}

/// Appends the positions of the entries that are near another one.
void add_near_ones(std::vector<Entry> entries,
                   std::vector<std::uint32_t>& positions) {
  if (entries.empty()) return;
  sort_by_value(entries);
  bool is_near_previous = false;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool is_near_next =
        i + 1 < entries.size() && near(entries[i].value, entries[i + 1].value);
    if (is_near_previous || is_near_next)
      positions.push_back(entries[i].position);
    is_near_previous = is_near_next;
  }
}

/// Gives triangles whose primaries are equal their exact order.
class TieBreaker {
 public:
  TieBreaker(std::vector<RankedTriangle>& triangles,
             const std::function<ExactRank(delaunay::Facet)>& exact)
      : triangles_(triangles), exact_(exact) {}

  /// Ranks change only now, since groups are found by them.
  void apply() {
    for (const auto& [i, number] : numbered_)
      rank(i).secondary = static_cast<double>(number);
  }

  /// @param group  equal primaries, above zero: all are in doubt
  void number_by_primary(std::span<const std::uint32_t> group) {
    next_ = 0;
    if (group.size() > 1) number_exactly(group);
  }

  /// @param group  primaries zero, by ascending secondary: only equal ones
  ///   are in doubt
  void number_by_secondary(std::span<const std::uint32_t> group) {
    next_ = 0;
    for (std::size_t begin = 0, end = 0; begin < group.size(); begin = end) {
      const double secondary = rank(group[begin]).secondary;
      while (end < group.size() && rank(group[end]).secondary == secondary)
        ++end;
      number_exactly(group.subspan(begin, end - begin));
    }
  }

 private:
  Rank& rank(std::uint32_t i) { return triangles_[i].rank; }

  void number_exactly(std::span<const std::uint32_t> group) {
    if (group.size() == 1) {
      numbered_.emplace_back(group.front(), next_++);
    } else {
      keyed_.clear();
      for (const std::uint32_t i : group)
        keyed_.push_back({exact_(triangles_[i].facet), i});
      std::sort(keyed_.begin(), keyed_.end(),
                [](const Keyed& a, const Keyed& b) {
                  return compare(a.key, b.key) < 0;
                });
      for (std::size_t k = 0; k < keyed_.size(); ++k) {
        if (k > 0 && compare(keyed_[k - 1].key, keyed_[k].key) != 0) ++next_;
        numbered_.emplace_back(keyed_[k].position, next_);
      }
      ++next_;
    }
  }

  struct Keyed {
    ExactRank key;
    std::uint32_t position;
  };

  std::vector<RankedTriangle>& triangles_;
  const std::function<ExactRank(delaunay::Facet)>& exact_;
  std::vector<Keyed> keyed_;
  std::vector<std::pair<std::uint32_t, std::uint64_t>> numbered_;
  std::uint64_t next_ = 0;
};

}  // namespace

void break_ties(std::vector<RankedTriangle>& triangles,
                std::vector<std::uint32_t> ties,
                const std::function<ExactRank(delaunay::Facet)>& exact) {
  const auto rank = [&](std::uint32_t i) { return triangles[i].rank; };
  // Numbers replace all secondaries at zero, so all of those are needed.
  std::erase_if(ties, [&](std::uint32_t i) { return rank(i).primary == 0; });
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    if (rank(i).primary == 0) ties.push_back(i);
  std::sort(ties.begin(), ties.end(), [&](std::uint32_t a, std::uint32_t b) {
    return rank(a) < rank(b);
  });

  TieBreaker breaker(triangles, exact);
  const std::span<const std::uint32_t> all = ties;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    const double primary = rank(all[begin]).primary;
    while (end < all.size() && rank(all[end]).primary == primary) ++end;
    const auto group = all.subspan(begin, end - begin);
    if (primary == 0)
      breaker.number_by_secondary(group);
    else
      breaker.number_by_primary(group);
  }
  breaker.apply();
}

std::vector<std::uint32_t> near_ties(
    std::span<const RankedTriangle> triangles) {
  // A primary of zero is exact, and only the secondary is in doubt.
  std::vector<Entry> primaries, secondaries_at_zero;
  primaries.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Rank& rank = triangles[i].rank;
    if (rank.primary == 0)
      secondaries_at_zero.push_back({rank.secondary, i});
    else
      primaries.push_back({rank.primary, i});
  }
  std::vector<std::uint32_t> ties;
  add_near_ones(std::move(primaries), ties);
  add_near_ones(std::move(secondaries_at_zero), ties);
  return ties;
}

void sort_by_corners(std::vector<RankedTriangle>& triangles) {
  std::size_t n_lowest = 0;
  for (const RankedTriangle& t : triangles)
    n_lowest = std::max(n_lowest, index(t.corners[0]) + 1);
  bucket_sort(
      triangles, n_lowest,
      [](const RankedTriangle& t) { return index(t.corners[0]); },
      [](const RankedTriangle& a, const RankedTriangle& b) {
        return a.corners < b.corners;
      });
}

}  // namespace umbrella
