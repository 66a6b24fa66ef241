#include "bench/coastlines.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <numbers>
#include <sstream>

namespace bench {
namespace {

bool before(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
}

bool has_twins(std::vector<Eigen::Vector2d> points) {
  std::ranges::sort(points, before);
  return std::ranges::adjacent_find(points) != points.end();
}

void project(std::vector<Eigen::Vector2d>& points) {
  double latitude = 0;
  for (const Eigen::Vector2d& p : points) latitude += p.y();
  latitude /= static_cast<double>(points.size());
  const double scale = std::cos(latitude * std::numbers::pi / 180);
  for (Eigen::Vector2d& p : points) p.x() *= scale;
}

}  // namespace

std::vector<tests::CurveInstance> coastlines(const std::string& path,
                                             std::size_t least,
                                             std::size_t most) {
  std::vector<tests::CurveInstance> rings;
  tests::CurveInstance ring;
  const auto finish = [&] {
    const std::size_t n = ring.points.size();
    if (n >= least && n <= most && !has_twins(ring.points)) {
      project(ring.points);
      for (std::uint32_t i = 0; i < n; ++i)
        ring.truth.push_back({i, static_cast<std::uint32_t>((i + 1) % n)});
      ring.truth = tests::in_order(std::move(ring.truth));
      rings.push_back(std::move(ring));
    }
    ring = {};
  };
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) {
      finish();
      ring.name = path + line.substr(1);
      continue;
    }
    std::istringstream columns(line);
    Eigen::Vector2d p;
    if (columns >> p.x() >> p.y()) ring.points.push_back(p);
  }
  finish();
  return rings;
}

}  // namespace bench
