/// @file
/// On a lattice that is full, cubes of points share their spheres, and a new
/// point lies on most of those near it. The fewer of its neighbours are there,
/// the fewer; and of what is tied, an upper point takes less than a lower one,
/// since the larger raise keeps it outside. So the points in the middle of
/// cubes of twice the size come first, where they lie on no sphere of a cube,
/// and the others in an order that ascends in all directions. Both hold within
/// blocks small enough for a cache. Fewer points than usual precede a round:
/// they only keep the cells before the front from getting large.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/insertion_rounds_internal.h"
#include "delaunay/spatial_sort.h"

namespace delaunay {
namespace {

using Vertices = std::vector<VertexId>;
using Sites = std::span<const Mesh3::Site>;

constexpr unsigned kBlockBits = 4;
constexpr std::size_t kBlockSide = 1 << kBlockBits;
constexpr std::size_t kBlockSize = 1 << (3 * kBlockBits);

/// Bit i goes to bit 3 i.
constexpr std::array<std::size_t, kBlockSide> kSpread = [] {
  std::array<std::size_t, kBlockSide> spread{};
  for (std::size_t x = 0; x < kBlockSide; ++x)
    for (unsigned i = 0; i < kBlockBits; ++i)
      spread[x] |= (x >> i & 1U) << (3 * i);
  return spread;
}();

/// The places of a lattice along the axes, cut into blocks: those of a block
/// have consecutive numbers. Nothing depends on it but an order, so its
/// coordinates may be rounded.
class Places {
 public:
  /// On a full lattice most sites are one step from the next along the curve.
  explicit Places(Sites sites) {
    low_ = high_ = sites[0].at;
    step_.fill(std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < sites.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = sites[i].at[k];
        const double step = std::abs(x - sites[i == 0 ? 0 : i - 1].at[k]);
        low_[k] = std::min(low_[k], x);
        high_[k] = std::max(high_[k], x);
        if (step > 0) step_[k] = std::min(step_[k], step);
      }
    for (std::size_t k = 0; k < 3; ++k)
      n_blocks_[k] = std::floor(steps(high_, k) / kBlockSide) + 1;
  }

  /// How many there are, unless more than `most`.
  std::optional<std::size_t> size(std::size_t most) const {
    const double n = kBlockSize * n_blocks_[0] * n_blocks_[1] * n_blocks_[2];
    if (!(n <= static_cast<double>(most))) return std::nullopt;
    return static_cast<std::size_t>(n);
  }

  /// Ascending along a Morton curve from block to place, but first those in a
  /// block with three odd coordinates.
  /// @pre size() is a number
  std::size_t number(const Mesh3::Site& site) const {
    std::size_t block = 0;
    std::size_t along_curve = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto x = static_cast<std::uint32_t>(steps(site.at, k));
      block = block * static_cast<std::uint32_t>(n_blocks_[k]) + x / kBlockSide;
      along_curve = along_curve << 1U | kSpread[x % kBlockSide];
    }
    // Every eighth place along the curve, the last of its cube, is odd.
    const std::size_t n_odd = along_curve / 8;
    const bool is_odd = along_curve % 8 == 7;
    return block * kBlockSize +
           (is_odd ? n_odd : kBlockSize / 8 + along_curve - n_odd);
  }

 private:
  using Coordinates = std::array<double, 3>;

  /// From the lowest place, and half a step.
  double steps(const Coordinates& at, std::size_t k) const {
    return (at[k] - low_[k]) / step_[k] + 0.5;
  }

  Coordinates low_, high_, step_, n_blocks_;
};

/// All vertices by their places; none if most places are empty, or the sites
/// are too uneven to have one each.
Vertices along_lattice(Sites sites) {
  constexpr std::size_t kMostPlaces = 8;  // for each site
  const Places places(sites);
  const auto n_places = places.size(kMostPlaces * sites.size());
  if (!n_places) return {};
  LazyVector<VertexId> vertex_at(*n_places);
  std::ranges::fill(vertex_at, kInfinite);
  for (std::uint32_t v = 0; v < sites.size(); ++v) {
    VertexId& here = vertex_at[places.number(sites[v])];
    if (here != kInfinite) return {};
    here = VertexId{v};
  }
  Vertices order;
  order.reserve(sites.size());
  std::ranges::copy_if(vertex_at, std::back_inserter(order),
                       [](VertexId v) { return v != kInfinite; });
  return order;
}

std::vector<Vertices> cut_where_it_descends(const Vertices& order) {
  std::vector<Vertices> rounds;
  for (auto begin = order.begin(); begin != order.end();) {
    const auto end = std::is_sorted_until(begin, order.end());
    rounds.emplace_back(begin, end);
    begin = end;
  }
  return rounds;
}

}  // namespace

std::vector<Vertices> insertion_rounds(const Mesh3& mesh) {
  constexpr unsigned kLog2LatticeGrowth = 5;
  const Sites sites = mesh.sites;
  const Vertices curve = along_lattice(sites);
  if (curve.empty())
    return cut_where_it_descends(insertion_order(sites.size()));
  auto rounds =
      cut_where_it_descends(insertion_order(sites.size(), kLog2LatticeGrowth));
  for (Vertices& round : rounds)
    for (VertexId& v : round) v = curve[index(v)];
  return rounds;
}

}  // namespace delaunay
