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
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>

#include "delaunay/insertion_rounds_internal.h"
#include "delaunay/spatial_sort.h"

namespace delaunay {
namespace {

using Vertices = std::vector<VertexId>;
using Sites = std::span<const Mesh3::Site>;

constexpr unsigned kBlockBits = 4;
constexpr std::int64_t kBlockSide = 1 << kBlockBits;
constexpr std::size_t kBlockSize = 1 << (3 * kBlockBits);

/// Bit i goes to bit 3 i.
constexpr std::array<std::uint32_t, kBlockSide> kSpread = [] {
  std::array<std::uint32_t, kBlockSide> spread{};
  for (std::uint32_t x = 0; x < kBlockSide; ++x)
    for (unsigned i = 0; i < kBlockBits; ++i)
      spread[x] |= (x >> i & 1U) << (3 * i);
  return spread;
}();

/// The places of a box of a lattice, cut into blocks: those of a block have
/// consecutive numbers.
class Places {
 public:
  Places(Sites sites, double unit) : unit_(unit) {
    low_ = units(sites[0]);
    high_ = low_;
    for (const Mesh3::Site& s : sites) {
      const auto at = units(s);
      for (std::size_t k = 0; k < 3; ++k) {
        low_[k] = std::min(low_[k], at[k]);
        high_[k] = std::max(high_[k], at[k]);
      }
    }
  }

  /// How many there are, unless more than `most`.
  std::optional<std::size_t> size(std::size_t most) const {
    double n = kBlockSize;
    for (std::size_t k = 0; k < 3; ++k) n *= static_cast<double>(n_blocks(k));
    if (n > static_cast<double>(most)) return std::nullopt;
    return static_cast<std::size_t>(n);
  }

  /// Ascending along a Morton curve from block to place, but first those in a
  /// block with three odd coordinates.
  std::size_t number(const Mesh3::Site& site) const {
    const auto at = units(site);
    std::int64_t block = 0;
    std::uint32_t along_curve = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t x = at[k] - low_[k];
      block = block * n_blocks(k) + x / kBlockSide;
      along_curve = along_curve << 1U | kSpread[x % kBlockSide];
    }
    // Every eighth place along the curve, the last of its cube, is odd.
    const std::uint32_t n_odd = along_curve / 8;
    const bool is_odd = along_curve % 8 == 7;
    return static_cast<std::size_t>(block) * kBlockSize +
           (is_odd ? n_odd : kBlockSize / 8 + along_curve - n_odd);
  }

 private:
  using Units = std::array<std::int64_t, 3>;

  Units units(const Mesh3::Site& site) const {
    Units at;
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = static_cast<std::int64_t>(site.at[k] / unit_);
    return at;
  }
  std::int64_t n_blocks(std::size_t k) const {
    return (high_[k] - low_[k]) / kBlockSide + 1;
  }

  double unit_;
  Units low_, high_;
};

/// All vertices by their places; none if most places are empty.
/// @param unit  of the lattice on which the sites lie
Vertices along_lattice(Sites sites, double unit) {
  constexpr std::size_t kMostPlaces = 8;  // for each site
  const Places places(sites, unit);
  const auto n_places = places.size(kMostPlaces * sites.size());
  if (!n_places) return {};
  LazyVector<VertexId> vertex_at(*n_places);
  std::ranges::fill(vertex_at, kInfinite);
  for (std::uint32_t v = 0; v < sites.size(); ++v)
    vertex_at[places.number(sites[v])] = VertexId{v};
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
  const double unit = mesh.lattice.unit();
  const Vertices curve = unit == 0 ? Vertices{} : along_lattice(sites, unit);
  if (curve.empty())
    return cut_where_it_descends(insertion_order(sites.size()));
  auto rounds =
      cut_where_it_descends(insertion_order(sites.size(), kLog2LatticeGrowth));
  for (Vertices& round : rounds)
    for (VertexId& v : round) v = curve[index(v)];
  return rounds;
}

}  // namespace delaunay
