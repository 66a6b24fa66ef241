// The committed samples and the manifest of the real scans. Runs in the
// project's root folder.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "apps/shapes.h"
#include "io/points.h"

namespace {

namespace fs = std::filesystem;

// SHAPE_N.ply holds what `umbrella generate SHAPE -n N` writes.
TEST(Samples, AreWhatGenerateMakes) {
  std::size_t n_files = 0;
  for (const auto& entry : fs::directory_iterator("data/samples")) {
    SCOPED_TRACE(entry.path());
    const std::string stem = entry.path().stem();
    const auto bar = stem.find('_');
    ASSERT_NE(bar, std::string::npos);
    EXPECT_EQ(
        io::read_points(entry.path()).points,
        shapes::sample(stem.substr(0, bar), std::stoul(stem.substr(bar + 1))));
    ++n_files;
  }
  EXPECT_GT(n_files, 0u);
}

std::size_t count_distinct(const std::vector<Eigen::Vector3d>& points) {
  std::vector<std::array<double, 3>> keys;
  for (const auto& p : points) keys.push_back({p.x(), p.y(), p.z()});
  std::ranges::sort(keys);
  return static_cast<std::size_t>(std::unique(keys.begin(), keys.end()) -
                                  keys.begin());
}

TEST(SlowRealScans, HaveThePointsOfTheManifest) {
  std::ifstream manifest("data/manifest.tsv");
  std::string line;
  ASSERT_TRUE(std::getline(manifest, line));  // headings
  std::size_t n_read = 0;
  while (std::getline(manifest, line)) {
    std::istringstream cells(line);
    std::vector<std::string> cell;
    for (std::string text; std::getline(cells, text, '\t');)
      cell.push_back(text);
    ASSERT_EQ(cell.size(), 9u) << line;
    const fs::path path = fs::path("data/real") / cell[0];
    if (!fs::exists(path)) continue;
    SCOPED_TRACE(path);
    EXPECT_EQ(count_distinct(io::read_points(path).points),
              std::stoul(cell[4]));
    ++n_read;
  }
  if (n_read == 0) GTEST_SKIP() << "no scans: run scripts/fetch_data.sh";
}

}  // namespace
