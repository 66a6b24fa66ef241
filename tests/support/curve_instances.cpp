#include "tests/support/curve_instances.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "delaunay/triangulation2.h"

namespace tests {
namespace {

using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

/// Draws arguments one by one, in the order written.
class Dice {
 public:
  Dice(std::string_view group, std::uint64_t seed) {
    std::uint64_t mixed = seed;
    for (const char letter : group)
      mixed = mixed * 1099511628211U + static_cast<unsigned char>(letter);
    engine_.seed(mixed);
  }
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }
  /// low to high, each as likely.
  unsigned whole(unsigned low, unsigned high) {
    return low + static_cast<unsigned>(engine_() % (high - low + 1));
  }
  bool coin() { return whole(0, 1) == 1; }

 private:
  std::mt19937_64 engine_;
};

/// A polyline, fine where the curve is round.
struct Path {
  std::vector<Vector2d> corners;
  bool closed = true;
};

double length(const Path& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.corners.size(); ++i)
    sum += (path.corners[i] - path.corners[i - 1]).norm();
  if (path.closed) sum += (path.corners.front() - path.corners.back()).norm();
  return sum;
}

/// Points at these places along the path, ascending, in units of its length.
std::vector<Vector2d> points_at(const Path& path,
                                const std::vector<double>& places) {
  const double total = length(path);
  std::vector<Vector2d> points;
  double passed = 0;
  std::size_t k = 0;
  for (const double place : places) {
    const double at = place * total;
    for (;;) {
      const std::size_t next = (k + 1) % path.corners.size();
      const Vector2d step = path.corners[next] - path.corners[k];
      const double left = at - passed;
      if (left <= step.norm() || k + 2 > path.corners.size()) {
        points.push_back(path.corners[k] +
                         step * std::min(1.0, left / step.norm()));
        break;
      }
      passed += step.norm();
      ++k;
    }
  }
  return points;
}

struct Sampling {
  std::size_t n = 0;
  double jitter = 0;   ///< of a place, in units of the spacing, below 0.5
  double uneven = 0;   ///< relative change of the spacing along the path
  double phase = 0.5;  ///< of the first place, in units of the spacing
};

std::vector<Vector2d> sample(const Path& path, const Sampling& how,
                             Dice& dice) {
  std::vector<double> places;
  const double turn = dice.between(0, 1);
  for (std::size_t i = 0; i < how.n; ++i) {
    const double shift = how.jitter * dice.between(-1, 1);
    // An open path keeps its ends.
    const double t = path.closed
                         ? (static_cast<double>(i) + how.phase + shift) /
                               static_cast<double>(how.n)
                         : std::clamp((static_cast<double>(i) + shift) /
                                          static_cast<double>(how.n - 1),
                                      0.0, 1.0);
    const double wave =
        path.closed ? std::sin(2 * kPi * (t + turn)) - std::sin(2 * kPi * turn)
                    : -std::sin(2 * kPi * t);
    places.push_back(std::clamp(t + how.uneven * wave / (2 * kPi), 0.0, 1.0));
  }
  return points_at(path, places);
}

void add_curve(CurveInstance& instance, const std::vector<Vector2d>& points,
               bool closed) {
  const auto first = static_cast<std::uint32_t>(instance.points.size());
  const auto n = static_cast<std::uint32_t>(points.size());
  instance.points.insert(instance.points.end(), points.begin(), points.end());
  for (std::uint32_t i = 0; i + 1 < n; ++i)
    instance.truth.push_back({first + i, first + i + 1});
  if (closed) instance.truth.push_back({first, first + n - 1});
  instance.truth = in_order(std::move(instance.truth));
}

/// r(t) = 1 + harmonics 2 to 5, stretched and turned.
Path round_path(double roughness, Dice& dice) {
  std::array<double, 8> c{};
  for (double& x : c) x = roughness * dice.between(-1, 1);
  const double stretch = dice.between(1, 3);
  const double angle = dice.between(0, kPi);
  Path path;
  constexpr int kSteps = 4000;
  for (int i = 0; i < kSteps; ++i) {
    const double t = 2 * kPi * i / kSteps;
    double r = 1;
    for (unsigned k = 0; k < 4; ++k)
      r += c[2 * k] * std::cos((k + 2) * t) +
           c[2 * k + 1] * std::sin((k + 2) * t);
    const Vector2d p(stretch * r * std::cos(t), r * std::sin(t));
    path.corners.emplace_back(
        std::cos(angle) * p.x() - std::sin(angle) * p.y(),
        std::sin(angle) * p.x() + std::cos(angle) * p.y());
  }
  return path;
}

/// Two straight sides that meet at this angle, joined by an arc that they
/// touch.
Path drop_path(double degrees) {
  const double half = degrees * kPi / 360;
  Path path;
  path.corners.emplace_back(0, 0);
  constexpr int kSteps = 2000;
  const double radius = std::tan(half);  // sides of length 1
  const double far = 1 / std::cos(half);
  for (int i = 0; i <= kSteps; ++i) {
    const double t = (kPi / 2 + half) * (2.0 * i / kSteps - 1);
    path.corners.emplace_back(far + radius * std::cos(t), radius * std::sin(t));
  }
  return path;
}

Path star_path(unsigned spikes, double inner) {
  Path path;
  for (unsigned i = 0; i < 2 * spikes; ++i) {
    const double t = kPi * i / spikes;
    const double r = i % 2 == 0 ? 1 : inner;
    path.corners.emplace_back(r * std::cos(t), r * std::sin(t));
  }
  return path;
}

Path open_path(unsigned kind, Dice& dice) {
  Path path;
  path.closed = false;
  constexpr int kSteps = 3000;
  const double turns = dice.between(1.2, 2.5);
  const double part = dice.between(0.5, 0.8);
  for (int i = 0; i <= kSteps; ++i) {
    const double s = static_cast<double>(i) / kSteps;
    const double a = 2 * kPi * s;
    if (kind == 0)  // spiral
      path.corners.emplace_back((0.3 + s) * std::cos(turns * a),
                                (0.3 + s) * std::sin(turns * a));
    else if (kind == 1)  // wave
      path.corners.emplace_back(4 * s, 0.6 * std::sin(turns * a));
    else  // part of an ellipse
      path.corners.emplace_back(1.6 * std::cos(part * a),
                                0.9 * std::sin(part * a));
  }
  return path;
}

void add_components(CurveInstance& instance, Dice& dice) {
  const unsigned n = dice.whole(2, 5);
  for (unsigned k = 0; k < n; ++k) {
    const Path path = round_path(0.06, dice);
    auto points = sample(
        path, {.n = dice.whole(40, 160), .jitter = dice.between(0, 0.2)}, dice);
    const bool nested = k > 0 && dice.coin();
    // A nested copy shrinks about the same centre.
    const double scale = nested ? 0.3 : 1;
    const Vector2d shift(7.5 * (nested ? k - 1 : k), 0);
    for (Vector2d& p : points) p = scale * p + shift;
    add_curve(instance, points, true);
    if (nested) ++k;
  }
  instance.one_closed_curve = false;
}

void add_open(CurveInstance& instance, Dice& dice) {
  const unsigned n = dice.whole(1, 3);
  for (unsigned k = 0; k < n; ++k) {
    const Path path = open_path(dice.whole(0, 2), dice);
    auto points = sample(
        path, {.n = dice.whole(40, 160), .jitter = dice.between(0, 0.2)}, dice);
    for (Vector2d& p : points) p += Vector2d(0, 4.0 * k);
    add_curve(instance, points, false);
  }
  instance.one_closed_curve = false;
}

/// A smooth curve, its points moved by up to 0.05 to 0.3 of the spacing.
void add_noisy(CurveInstance& instance, Dice& dice) {
  const Path path = round_path(0.08, dice);
  const std::size_t n = dice.whole(60, 300);
  auto points = sample(path, {.n = n}, dice);
  const double noise =
      dice.between(0.05, 0.3) * length(path) / static_cast<double>(n);
  for (Vector2d& p : points) {
    const double r = noise * std::sqrt(dice.between(0, 1));
    const double a = dice.between(0, 2 * kPi);
    p += Vector2d(r * std::cos(a), r * std::sin(a));
  }
  add_curve(instance, points, true);
}

/// A smooth curve and 2 to 5 % more points anywhere in its box.
void add_spoilt(CurveInstance& instance, Dice& dice) {
  const Path path = round_path(0.08, dice);
  const std::size_t n = dice.whole(60, 300);
  add_curve(instance, sample(path, {.n = n, .jitter = 0.1}, dice), true);
  const auto more = static_cast<std::size_t>(
      std::ceil(dice.between(0.02, 0.05) * static_cast<double>(n)));
  for (std::size_t i = 0; i < more; ++i) {
    const double x = dice.between(-3.5, 3.5);
    instance.points.emplace_back(x, dice.between(-3.5, 3.5));
  }
  instance.one_closed_curve = false;
}

constexpr std::array<std::string_view, 6> kClean = {
    "smooth", "corner", "star", "jitter", "components", "open"};
constexpr std::array<std::string_view, 2> kSpoilt = {"noise", "outliers"};

}  // namespace

std::span<const std::string_view> clean_curve_groups() { return kClean; }
std::span<const std::string_view> spoilt_curve_groups() { return kSpoilt; }

CurveInstance make_curve_instance(std::string_view group, std::uint64_t seed) {
  Dice dice(group, seed);
  CurveInstance instance;
  instance.name = std::string(group) + " " + std::to_string(seed);
  const auto add = [&](const Path& path, const Sampling& how) {
    add_curve(instance, sample(path, how, dice), true);
  };
  if (group == "smooth") {
    const Path path = round_path(0.08, dice);
    add(path, {.n = dice.whole(40, 400), .phase = dice.between(0, 1)});
  } else if (group == "corner") {
    const Path path = drop_path(dice.between(15, 150));
    const std::size_t n = dice.whole(40, 300);
    const double phase = dice.coin() ? 0 : dice.between(0.05, 0.95);
    add(path, {.n = n, .phase = phase});
  } else if (group == "star") {
    const unsigned spikes = dice.whole(3, 10);
    const Path path = star_path(spikes, 0.3);
    const std::size_t n = 2 * spikes * dice.whole(5, 30);
    add(path, {.n = n, .jitter = dice.between(0, 0.3)});
  } else if (group == "jitter") {
    const Path path = round_path(0.08, dice);
    const std::size_t n = dice.whole(60, 400);
    const double uneven = dice.between(0, 0.6);
    add(path, {.n = n, .jitter = dice.between(0.1, 0.45), .uneven = uneven});
  } else if (group == "components") {
    add_components(instance, dice);
  } else if (group == "open") {
    add_open(instance, dice);
  } else if (group == "noise") {
    add_noisy(instance, dice);
  } else if (group == "outliers") {
    add_spoilt(instance, dice);
  } else {
    throw std::invalid_argument("no group of curves: " + std::string(group));
  }
  return instance;
}

bool truth_is_delaunay(const CurveInstance& instance) {
  const delaunay::Triangulation2 t(instance.points);
  std::vector<CurveEdge> sides;
  for (const delaunay::Cell2& cell : t.cells()) {
    for (const auto& [i, j] : delaunay::kSideCorners)
      sides.push_back({static_cast<std::uint32_t>(cell.vertex[i]),
                       static_cast<std::uint32_t>(cell.vertex[j])});
  }
  sides = in_order(std::move(sides));
  return std::ranges::all_of(instance.truth, [&](const CurveEdge& edge) {
    CurveEdge ends = {static_cast<std::uint32_t>(t.vertex_of_row()[edge[0]]),
                      static_cast<std::uint32_t>(t.vertex_of_row()[edge[1]])};
    std::ranges::sort(ends);
    return std::ranges::binary_search(sides, ends);
  });
}

std::vector<CurveEdge> in_order(std::vector<CurveEdge> edges) {
  for (CurveEdge& edge : edges) std::ranges::sort(edge);
  std::ranges::sort(edges);
  return edges;
}

}  // namespace tests
