/// @file
/// A point's place on the Hilbert curve is read off its quantised coordinates
/// by a table of the curve's 2^d * d states [Hamilton06]. Points that fall in
/// one cell of the curve's finest grid are sorted again within their own
/// bounding cube, so that clusters of any scale keep their locality, and at
/// last by coordinates.
#include "delaunay/spatial_sort.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

#include "delaunay/threads.h"

namespace delaunay {
namespace {

/// One step of the curve: which child a sub-cube is, and the state within it.
struct Step {
  std::uint8_t rank;
  std::uint8_t next_state;
};

/// The curve's steps, one level or several at once. States are (entry corner,
/// direction), numbered entry * d + direction.
template <int kDim>
struct HilbertTable {
  static constexpr unsigned kCorners = 1U << kDim;
  static constexpr unsigned kStates = kCorners * kDim;
  /// Levels taken in one look-up: as many as make six bits.
  static constexpr unsigned kLevels = 6 / kDim;
  static constexpr unsigned kStepBits = 6;
  std::array<std::array<Step, 1U << kStepBits>, kStates> step;

  static constexpr unsigned rotate_left(unsigned bits, unsigned by) {
    by %= kDim;
    return ((bits << by) | (bits >> (kDim - by))) & (kCorners - 1);
  }
  static constexpr unsigned gray(unsigned i) { return i ^ (i >> 1U); }
  static constexpr unsigned gray_inverse(unsigned g) {
    unsigned i = 0;
    for (; g != 0; g >>= 1U) i ^= g;
    return i;
  }
  // Entry corner and direction of the w-th child [Hamilton06, Thm 2.10, 2.9].
  static constexpr unsigned entry(unsigned w) {
    return w == 0 ? 0 : gray(2 * ((w - 1) / 2));
  }
  static constexpr unsigned direction(unsigned w) {
    if (w == 0) return 0;
    const unsigned i = w % 2 == 0 ? w - 1 : w;
    return static_cast<unsigned>(std::countr_one(i)) % kDim;
  }
  static constexpr Step one_level(unsigned state, unsigned corner) {
    const unsigned e = state / kDim;
    const unsigned d = state % kDim;
    const unsigned w =
        gray_inverse(rotate_left(corner ^ e, kDim - (d + 1) % kDim));
    const unsigned next_e = e ^ rotate_left(entry(w), d + 1);
    const unsigned next_d = (d + direction(w) + 1) % kDim;
    return {static_cast<std::uint8_t>(w),
            static_cast<std::uint8_t>(next_e * kDim + next_d)};
  }

  constexpr HilbertTable() : step() {
    for (unsigned state = 0; state < kStates; ++state)
      for (unsigned corners = 0; corners < 1U << kStepBits; ++corners) {
        unsigned rank = 0;
        unsigned at = state;
        for (unsigned level = kLevels; level-- > 0;) {
          const Step s =
              one_level(at, (corners >> (kDim * level)) & (kCorners - 1));
          rank = (rank << kDim) | s.rank;
          at = s.next_state;
        }
        step[state][corners] = {static_cast<std::uint8_t>(rank),
                                static_cast<std::uint8_t>(at)};
      }
  }
};

/// Bits of the finest grid's coordinates: ten look-ups.
template <int kDim>
inline constexpr unsigned kBits = 10 * HilbertTable<kDim>::kLevels;

// Moves bit i of the coordinate to bit d * i.
template <int kDim>
std::uint64_t spread(std::uint64_t x) {
  if constexpr (kDim == 3) {
    x = (x | x << 32U) & 0x001f'0000'0000'ffffU;
    x = (x | x << 16U) & 0x001f'0000'ff00'00ffU;
    x = (x | x << 8U) & 0x100f'00f0'0f00'f00fU;
    x = (x | x << 4U) & 0x10c3'0c30'c30c'30c3U;
    x = (x | x << 2U) & 0x1249'2492'4924'9249U;
  } else {
    x = (x | x << 16U) & 0x0000'ffff'0000'ffffU;
    x = (x | x << 8U) & 0x00ff'00ff'00ff'00ffU;
    x = (x | x << 4U) & 0x0f0f'0f0f'0f0f'0f0fU;
    x = (x | x << 2U) & 0x3333'3333'3333'3333U;
    x = (x | x << 1U) & 0x5555'5555'5555'5555U;
  }
  return x;
}

template <int kDim>
using Point = Eigen::Matrix<double, kDim, 1>;

struct Keyed {
  std::uint64_t key;
  std::uint32_t row;
};

/// Maps a bounding cube onto the curve's grid. Halving before subtracting
/// keeps the widest inputs from overflowing.
template <int kDim>
class Quantizer {
 public:
  Quantizer(const Point<kDim>& low, const Point<kDim>& high)
      : half_low_(0.5 * low), half_side_((0.5 * high - 0.5 * low).maxCoeff()) {}

  std::uint64_t key(const Point<kDim>& p) const {
    static constexpr HilbertTable<kDim> kTable;
    static constexpr double kGrid = static_cast<double>(1ULL << kBits<kDim>);
    static constexpr unsigned kStepBits = HilbertTable<kDim>::kStepBits;
    std::uint64_t corners = 0;  // of all levels, interleaved
    for (int i = 0; i < kDim; ++i) {
      const double t =
          half_side_ > 0 ? (0.5 * p[i] - half_low_[i]) / half_side_ : 0;
      const auto cell = static_cast<std::uint64_t>(
          static_cast<std::int64_t>(std::min(t * kGrid, kGrid - 1)));
      corners |= spread<kDim>(cell) << static_cast<unsigned>(i);
    }
    std::uint64_t key = 0;
    unsigned state = 0;
    for (unsigned shift = 10 * kStepBits; shift > 0;) {
      shift -= kStepBits;
      const Step s = kTable.step[state][(corners >> shift) & 63U];
      key = (key << kStepBits) | s.rank;
      state = s.next_state;
    }
    return key;
  }

 private:
  Point<kDim> half_low_;
  double half_side_;
};

template <int kDim>
void check_finite(std::span<const Point<kDim>> points) {
  if (points.size() >= index(kInfinite))
    throw std::invalid_argument("too many points: " +
                                std::to_string(points.size()));
  for (std::size_t row = 0; row < points.size(); ++row)
    if (!points[row].allFinite())
      throw std::invalid_argument("row " + std::to_string(row) +
                                  ": a coordinate is not finite");
}

/// Calls work(begin, end) on pieces of 0 .. n, on several threads if there is
/// enough to do.
template <class Work>
void for_pieces(std::size_t n, unsigned threads, const Work& work) {
  static constexpr std::size_t kWorthThreads = std::size_t{1} << 14U;
  static constexpr unsigned kPiecesPerThread = 8;
  if (threads == 1 || n < kWorthThreads) return work(0, n);
  const unsigned n_pieces = kPiecesPerThread * threads;
  run_tasks(n_pieces, threads, [&](unsigned i) {
    work(n * i / n_pieces, n * (i + 1) / n_pieces);
  });
}

/// By key, then row: into buckets by the leading bits, a dozen each if the
/// points are spread evenly, then each bucket by comparison.
void sort_by_key(std::span<Keyed> range, unsigned threads) {
  static constexpr unsigned kKeyBits = 60;
  const auto less = [](const Keyed& a, const Keyed& b) {
    return a.key != b.key ? a.key < b.key : a.row < b.row;
  };
  static constexpr unsigned kFewBits = 6;
  static constexpr unsigned kManyBits = 22;
  const auto size_bits = static_cast<unsigned>(std::bit_width(range.size()));
  const unsigned bits = std::clamp(size_bits, kFewBits + 4, kManyBits + 4) - 4;
  const unsigned shift = kKeyBits - bits;
  std::vector<std::uint32_t> end((std::size_t{1} << bits) + 1, 0);
  for (const Keyed& k : range) ++end[(k.key >> shift) + 1];
  for (std::size_t b = 1; b < end.size(); ++b) end[b] += end[b - 1];
  const LazyVector<Keyed> unsorted(range.begin(), range.end());
  for (const Keyed& k : unsorted) range[end[k.key >> shift]++] = k;
  for_pieces(end.size() - 1, threads, [&](std::size_t b, std::size_t last) {
    std::uint32_t begin = b == 0 ? 0 : end[b - 1];
    for (; b < last; begin = end[b++])
      std::sort(range.begin() + begin, range.begin() + end[b], less);
  });
}

/// Sorts one range of rows along the curve through its own bounding cube.
template <int kDim>
void sort_along_curve(std::span<const Point<kDim>> points,
                      std::span<Keyed> range, unsigned threads) {
  Point<kDim> low = points[range.front().row];
  Point<kDim> high = low;
  for (const Keyed& k : range) {
    low = low.cwiseMin(points[k.row]);
    high = high.cwiseMax(points[k.row]);
  }
  const Quantizer<kDim> quantizer(low, high);
  for_pieces(range.size(), threads, [&](std::size_t i, std::size_t end) {
    for (; i < end; ++i) range[i].key = quantizer.key(points[range[i].row]);
  });
  sort_by_key(range, threads);
}

template <int kDim>
bool lexicographically_less(const Point<kDim>& a, const Point<kDim>& b) {
  return std::lexicographical_compare(a.data(), a.data() + kDim, b.data(),
                                      b.data() + kDim);
}

/// Ranges of equal keys: small ones by coordinates, large ones (unless all
/// points are equal) along a finer curve of their own.
template <int kDim>
void refine_ties(std::span<const Point<kDim>> points, std::span<Keyed> range,
                 std::vector<std::span<Keyed>>& pending) {
  static constexpr std::size_t kSmall = 64;
  for (std::size_t begin = 0; begin < range.size();) {
    std::size_t end = begin + 1;
    while (end < range.size() && range[end].key == range[begin].key) ++end;
    const std::span<Keyed> ties = range.subspan(begin, end - begin);
    begin = end;
    if (ties.size() == 1) continue;
    const bool all_equal = std::ranges::all_of(ties, [&](const Keyed& k) {
      return points[k.row] == points[ties.front().row];
    });
    if (all_equal) continue;
    if (ties.size() > kSmall && ties.size() < range.size()) {
      pending.push_back(ties);
    } else {
      std::ranges::sort(ties, [&](const Keyed& a, const Keyed& b) {
        if (points[a.row] == points[b.row]) return a.row < b.row;
        return lexicographically_less<kDim>(points[a.row], points[b.row]);
      });
    }
  }
}

/// Points and vertices of the rows in this order. What looks up rows all over
/// memory is done in pieces; between, equal points are counted in one sweep.
template <int kDim>
void gather(std::span<const Point<kDim>> points, std::span<Keyed> sorted,
            unsigned threads, SpatialOrder<kDim>& result) {
  const std::size_t n = sorted.size();
  result.points.resize(n);
  for_pieces(n, threads, [&](std::size_t i, std::size_t end) {
    for (; i < end; ++i)  // -0 + 0 = 0
      result.points[i] = points[sorted[i].row] + Point<kDim>::Zero();
  });
  std::size_t n_distinct = 1;
  sorted[0].key = 0;
  for (std::size_t i = 1; i < n; ++i) {
    if (result.points[i] != result.points[n_distinct - 1])
      result.points[n_distinct++] = result.points[i];
    sorted[i].key = n_distinct - 1;
  }
  result.points.resize(n_distinct);
  result.vertex_of_row.resize(n);
  for_pieces(n, threads, [&](std::size_t i, std::size_t end) {
    for (; i < end; ++i)
      result.vertex_of_row[sorted[i].row] =
          VertexId{static_cast<std::uint32_t>(sorted[i].key)};
  });
}

template <int kDim>
SpatialOrder<kDim> order(std::span<const Point<kDim>> points,
                         unsigned threads) {
  check_finite<kDim>(points);
  SpatialOrder<kDim> result;
  if (points.empty()) return result;

  LazyVector<Keyed> keyed(points.size());
  for (std::size_t row = 0; row < points.size(); ++row)
    keyed[row] = {0, static_cast<std::uint32_t>(row)};
  std::vector<std::span<Keyed>> pending = {std::span<Keyed>(keyed)};
  while (!pending.empty()) {
    const std::span<Keyed> range = pending.back();
    pending.pop_back();
    sort_along_curve<kDim>(points, range, threads);
    refine_ties<kDim>(points, range, pending);
  }

  gather(points, keyed, threads, result);
  return result;
}

// The finaliser of SplitMix64 [Steele14]: mixes an index into random bits.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9e37'79b9'7f4a'7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58'476d'1ce4'e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d0'49bb'1331'11ebU;
  return x ^ (x >> 31U);
}

}  // namespace

SpatialOrder<2> spatial_order(std::span<const Eigen::Vector2d> points,
                              unsigned threads) {
  return order<2>(points, threads);
}

SpatialOrder<3> spatial_order(std::span<const Eigen::Vector3d> points,
                              unsigned threads) {
  return order<3>(points, threads);
}

std::vector<std::uint32_t> first_rows(std::size_t n_points,
                                      std::span<const VertexId> vertex_of_row) {
  std::vector<std::uint32_t> rows(n_points);
  for (std::size_t row = vertex_of_row.size(); row-- > 0;)
    rows[index(vertex_of_row[row])] = static_cast<std::uint32_t>(row);
  return rows;
}

std::vector<VertexId> insertion_order(std::size_t n, unsigned log2_growth) {
  assert(log2_growth > 0);
  static constexpr std::size_t kFirstRound = 512;
  unsigned last = 0;
  for (std::size_t m = n; m > kFirstRound; m >>= log2_growth) ++last;

  const auto round_of = [last, log2_growth](std::size_t i) {
    const auto zeros = static_cast<unsigned>(std::countr_zero(mix(i)));
    return last - std::min(zeros / log2_growth, last);
  };
  std::vector<std::size_t> begin(last + 2, 0);
  for (std::size_t i = 0; i < n; ++i) ++begin[round_of(i) + 1];
  for (unsigned r = 0; r <= last; ++r) begin[r + 1] += begin[r];
  std::vector<VertexId> order(n);
  for (std::size_t i = 0; i < n; ++i)
    order[begin[round_of(i)]++] = VertexId{static_cast<std::uint32_t>(i)};
  return order;
}

}  // namespace delaunay
