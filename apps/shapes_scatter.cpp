// Dart throwing. Darts fall stratified over the parameter square, sweep after
// sweep; a dart stays if no earlier one is nearer than the current distance,
// and after each sweep the distance shrinks a little, until there are enough.
// The parametrisation need not preserve area: where darts are dense more of
// them are turned down.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "apps/shapes_internal.h"

namespace shapes {
namespace {

using Eigen::Vector3d;

// Fraction of the area that random discs jam at, rounded up: the start.
constexpr double kJammed = 0.56;
constexpr double kShrink = 0.97;

// Sites by cell of a hashed grid. Different cells may share a bucket: that
// costs a distance test, no more.
class SiteGrid {
 public:
  SiteGrid(double reach, std::size_t n)
      : cell_(2 * reach), heads_(std::bit_ceil(2 * n + 1), kNone) {
    sites_.reserve(n);
    next_.reserve(n);
  }

  const std::vector<Site>& sites() const { return sites_; }

  // Is some site nearer than `distance` times the mean of both spacings?
  bool crowded(const Site& site, double distance) const {
    const Vector3d corner = (site.position / cell_).array() - 0.5;
    const Cell low = cell_of(corner);
    for (unsigned k = 0; k < 8; ++k) {
      const std::size_t b = bucket(
          {low[0] + (k >> 2U), low[1] + (k >> 1U & 1U), low[2] + (k & 1U)});
      for (std::uint32_t i = heads_[b]; i != kNone; i = next_[i]) {
        const double apart =
            distance * 0.5 * (site.spacing + sites_[i].spacing);
        const Vector3d d = site.position - sites_[i].position;
        if (d.squaredNorm() < apart * apart) return true;
      }
    }
    return false;
  }

  void insert(const Site& site) {
    const std::size_t b = bucket(cell_of(site.position / cell_));
    next_.push_back(heads_[b]);
    heads_[b] = static_cast<std::uint32_t>(sites_.size());
    sites_.push_back(site);
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  static constexpr std::uint32_t kNone = 0xffff'ffffU;

  static Cell cell_of(const Vector3d& scaled) {
    return {static_cast<std::int64_t>(std::floor(scaled.x())),
            static_cast<std::int64_t>(std::floor(scaled.y())),
            static_cast<std::int64_t>(std::floor(scaled.z()))};
  }

  // Linear in the cell, so that neighbours along z share a cache line.
  std::size_t bucket(const Cell& c) const {
    const auto key = static_cast<std::uint64_t>(c[0]) * 0x9E37'79B1U +
                     static_cast<std::uint64_t>(c[1]) * 0x85EB'CA77U +
                     static_cast<std::uint64_t>(c[2]);
    return key & (heads_.size() - 1);
  }

  double cell_;
  std::vector<std::uint32_t> heads_;
  std::vector<std::uint32_t> next_;
  std::vector<Site> sites_;
};

Site throw_dart(Surface surface, Random& random) {
  Site site{Vector3d::Zero(), 0};
  while (site.spacing == 0) {
    const double u = random.unit();
    site = surface(u, random.unit());
  }
  return site;
}

// Area in units of squared spacing, from the distances of random darts to
// their nearest: E[d^2] = area / (pi m) for m darts.
double estimated_area(Surface surface, Random& random) {
  constexpr std::size_t kDarts = 256;
  std::vector<Site> darts;
  for (std::size_t i = 0; i < kDarts; ++i)
    darts.push_back(throw_dart(surface, random));
  double sum = 0;
  for (const Site& a : darts) {
    double nearest2 = std::numeric_limits<double>::infinity();
    for (const Site& b : darts)
      if (&a != &b)
        nearest2 = std::min(nearest2, (a.position - b.position).squaredNorm());
    sum += nearest2 / (a.spacing * a.spacing);
  }
  return std::numbers::pi * sum;
}

}  // namespace

std::vector<Site> scatter(Surface surface, std::size_t n, Random& random) {
  if (n == 0) return {};
  // n discs of diameter `distance` cover the fraction kJammed of the area.
  double distance = std::sqrt(4 * kJammed * estimated_area(surface, random) /
                              (std::numbers::pi * static_cast<double>(n)));
  SiteGrid grid(distance, n);
  const auto rows =
      static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
  const double row = 1 / static_cast<double>(rows);
  for (; grid.sites().size() < n; distance *= kShrink) {
    for (std::size_t k = 0; k < rows * rows && grid.sites().size() < n; ++k) {
      const std::size_t i = k / rows;
      const std::size_t j = k % rows;
      const double u = (static_cast<double>(i) + random.unit()) * row;
      const double v = (static_cast<double>(j) + random.unit()) * row;
      const Site site = surface(u, v);
      if (site.spacing > 0 && !grid.crowded(site, distance)) grid.insert(site);
    }
  }
  std::vector<Site> sites = grid.sites();
  for (Site& site : sites) site.spacing *= distance;
  return sites;
}

}  // namespace shapes
