// The code of docs/own_criterion.md, compiled. Everything between a line "page"
// and the next "end" is the text of one code block there, but for indentation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "apps/shapes.h"
#include "umbrella/certificate.h"
#include "umbrella/clean_up.h"
#include "umbrella/closing.h"
#include "umbrella/criterion.h"
#include "umbrella/filter.h"
#include "umbrella/holes.h"

namespace umbrella {
namespace {

using delaunay::Triangulation3;

// page
struct RoundestFirst {
  bool admissible(const DelaunayTriangle& t) const { return t.is_gabriel(); }
  Rank rank(const DelaunayTriangle& t) const {
    const auto [a, b, c] = t.points();
    const double side =
        std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
    return {t.circumradius() / side, t.circumradius()};
  }
};
// end

static_assert(Criterion<RoundestFirst>);

TEST(OwnCriterion, ClosesATorus) {
  const auto points = shapes::sample("torus", 800);
  // page
  const Triangulation3 triangulation(points);
  const auto ranked = ranked_triangles(triangulation, RoundestFirst{});
  const auto filtered = umbrella_filter(points.size(), ranked);
  const auto clean = clean_up(points.size(), filtered.triangles);
  const auto holes = find_holes(points.size(), clean.triangles, clean.deleted,
                                clean.without_umbrella);
  const auto closed = close_holes(triangulation, clean.triangles, holes);
  // end
  std::vector<IndexedTriangle> triangles;
  for (const LocatedTriangle& t : closed.triangles)
    triangles.push_back({static_cast<std::uint32_t>(t.corners[0]),
                         static_cast<std::uint32_t>(t.corners[1]),
                         static_cast<std::uint32_t>(t.corners[2])});
  const SurfaceReport report = check_surface(triangulation.points(), triangles);
  EXPECT_TRUE(report.closed && report.manifold);
  EXPECT_TRUE(report.unused_vertices.empty());
}

/// The lines between each `begin` and the next `end`, without indentation.
std::vector<std::string> blocks(const std::string& file,
                                const std::string& begin,
                                const std::string& end) {
  std::ifstream in(file);
  std::vector<std::string> result;
  bool is_inside = false;
  for (std::string line; std::getline(in, line);) {
    const std::size_t indent = line.find_first_not_of(' ');
    const std::string text =
        indent == std::string::npos ? "" : line.substr(indent);
    if (!is_inside && text == begin) {
      is_inside = true;
      result.emplace_back();
    } else if (text == end) {
      is_inside = false;
    } else if (is_inside) {
      result.back() += text + "\n";
    }
  }
  return result;
}

TEST(OwnCriterion, IsWhatThePageShows) {
  const auto page = blocks("docs/own_criterion.md", "```cpp", "```");
  EXPECT_EQ(page.size(), 2U);
  EXPECT_EQ(page, blocks("tests/own_criterion_test.cpp", "// page", "// end"));
  EXPECT_THAT(page.front(), testing::HasSubstr("RoundestFirst"));
}

}  // namespace
}  // namespace umbrella
