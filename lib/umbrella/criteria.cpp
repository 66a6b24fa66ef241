#include "umbrella/criteria.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace umbrella {
namespace {

using delaunay::Triangulation3;

using Ranking = RankedTriangles (*)(const Triangulation3&, const Circumspheres&,
                                    unsigned threads);

template <Criterion C>
RankedTriangles ranking(const Triangulation3& triangulation,
                        const Circumspheres& spheres, unsigned threads) {
  return ranked_triangles(triangulation, spheres, C{}, threads);
}

struct Entry {
  std::string_view name;
  Ranking rank;
};

constexpr auto kEntries = std::to_array<Entry>({
    {"paper", ranking<PaperCriterion>},
    {"no-gabriel", ranking<LambdaCriterion>},
    {"circumradius", ranking<CircumradiusCriterion>},
    {"area", ranking<AreaCriterion>},
    {"ballmerge", ranking<BallMergeCriterion>},
    {"mixed", ranking<MixedCriterion>},
});

constexpr auto kNames = [] {
  std::array<std::string_view, kEntries.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kEntries[i].name;
  return names;
}();

const Entry& find(std::string_view name) {
  const auto entry =
      std::find_if(kEntries.begin(), kEntries.end(),
                   [&](const Entry& e) { return e.name == name; });
  if (entry == kEntries.end())
    throw std::invalid_argument("there is no criterion '" + std::string(name) +
                                "'");
  return *entry;
}

double power(double base, unsigned exponent) {
  double result = 1;
  for (unsigned i = 0; i < exponent; ++i) result *= base;
  return result;
}

}  // namespace

double intersection_ratio(const std::array<double, 2>& squared_lambdas,
                          bool is_gabriel) {
  const auto [low2, high2] =
      std::minmax(squared_lambdas[0], squared_lambdas[1]);
  const double low = std::sqrt(low2), high = std::sqrt(high2);
  const double s_low = std::sqrt(1 - low2), s_high = std::sqrt(1 - high2);
  return is_gabriel ? (low / (1 + s_low) + high / (1 + s_high)) * high
                    : 1 + s_high + high * low / (1 + s_low);
}

Rank MixedCriterion::rank(const DelaunayTriangle& t) const {
  const double r2 = t.squared_circumradius();
  const double lambda2 = t.squared_lambda_lower();
  const double shape = power(lambda2, lambda_power);
  // Not 0 times a power that has overflowed: that is no number.
  return {shape == 0 ? 0 : shape * power(r2, radius_power), r2};
}

std::span<const std::string_view> criterion_names() { return kNames; }

RankedTriangles ranked_by(std::string_view criterion,
                          const Triangulation3& triangulation,
                          const Circumspheres& spheres, unsigned threads) {
  return find(criterion).rank(triangulation, spheres, threads);
}

void require_criterion(std::string_view name) { find(name); }

}  // namespace umbrella
