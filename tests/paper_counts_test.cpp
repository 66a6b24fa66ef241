// The paper's Table 2 on its own point sets, where they are at hand.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/support/paper_sets.h"
#include "umbrella/reconstruct.h"

namespace umbrella {
namespace {

struct PaperSet {
  const char* object;
  const char* file;
  std::size_t points, cells, triangles, gabriel, filter, closed;
  std::int64_t genus;
};

constexpr PaperSet kPaperSets[] = {
    {"Knot", "hoppe_knot108s_10000", 10000, 91189, 183536, 37162, 20396, 20000,
     1},
    {"Mannequin", "hoppe_mannequin_12772", 12772, 83071, 167938, 29091, 25646,
     25540, 0},
    {"Oilpump", "hoppe_oilpmp_30937", 30933, 195808, 393970, 104025, 62855,
     61862, 0},
    {"Bunny", "stanford_bun_zipper", 35947, 246227, 494016, 84215, 73029, 71890,
     0},
    {"Club", "hoppe_club71_16864", 16864, 109641, 221507, 48536, 33872, 33724,
     0},
    {"Foot", "srt_Foot", 10010, 69331, 139740, 22210, 20111, 20016, 0},
    {"ThreeHoles", "libigl_3holes", 3596, 23339, 47878, 10028, 7211, 7200, 3},
    {"Dragon", "stanford_dragon_res3", 22998, 159820, 320011, 63570, 47192,
     45996, 1}};

class PaperCounts : public testing::TestWithParam<PaperSet> {};

TEST_P(PaperCounts, AreMet) {
  const PaperSet& expected = GetParam();
  const auto points = test_support::paper_set(expected.file);
  if (!points)
    GTEST_SKIP() << expected.file << ".xyz.gz is not in the folder that "
                 << "UMBRELLA_DATA names";
  const Reconstruction result = reconstruct(*points);
  EXPECT_EQ(result.counts.points - result.counts.duplicates, expected.points);
  EXPECT_EQ(result.counts.delaunay_cells, expected.cells);
  EXPECT_EQ(result.counts.delaunay_triangles, expected.triangles);
  EXPECT_EQ(result.counts.admissible_triangles, expected.gabriel);
  EXPECT_EQ(result.counts.filter_triangles, expected.filter);
  EXPECT_EQ(result.surface.triangles, expected.closed);
  EXPECT_EQ(result.surface.vertices, expected.points);
  EXPECT_EQ(result.surface.genus, expected.genus);
  EXPECT_EQ(result.surface.components, 1U);
  EXPECT_TRUE(result.surface.closed && result.surface.manifold &&
              result.surface.outward);
}

INSTANTIATE_TEST_SUITE_P(Slow, PaperCounts, testing::ValuesIn(kPaperSets),
                         [](const auto& set) {
                           return std::string(set.param.object);
                         });

}  // namespace
}  // namespace umbrella
