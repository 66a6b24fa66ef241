#include "apps/viewer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Le;
using ::testing::Not;

// What stands between two texts, of which the first is there once.
std::string between(const std::string& page, std::string_view before,
                    std::string_view after) {
  const std::size_t begin = page.find(before);
  EXPECT_EQ(page.find(before, begin + 1), std::string::npos);
  const std::size_t from = begin + before.size();
  return page.substr(from, page.find(after, from) - from);
}

nlohmann::json data_of(const std::string& page) {
  return nlohmann::json::parse(between(
      page, R"(<script id="mesh" type="application/json">)", "</script>"));
}

// The 32-bit words of base64 text; an independent reading of RFC 4648.
std::vector<std::uint32_t> words(const std::string& text) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  EXPECT_EQ(text.size() % 4, 0U);
  std::vector<std::uint32_t> result;
  std::uint64_t bits = 0;
  int n_bits = 0;
  std::vector<std::uint8_t> bytes;
  for (const char c : text) {
    if (c == '=') break;
    const std::size_t digit = kDigits.find(c);
    EXPECT_NE(digit, std::string_view::npos);
    bits = bits << 6U | digit;
    n_bits += 6;
    if (n_bits < 8) continue;
    n_bits -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> n_bits));
  }
  EXPECT_EQ(bytes.size() % 4, 0U);
  for (std::size_t i = 0; i + 3 < bytes.size(); i += 4)
    result.push_back(bytes[i] | bytes[i + 1] << 8U | bytes[i + 2] << 16U |
                     static_cast<std::uint32_t>(bytes[i + 3]) << 24U);
  return result;
}

std::vector<float> floats(const std::string& text) {
  std::vector<float> result;
  for (const std::uint32_t word : words(text))
    result.push_back(std::bit_cast<float>(word));
  return result;
}

io::Mesh tetrahedron() {
  io::Mesh mesh;
  mesh.vertices = {{10, 20, 30}, {14, 20, 30}, {10, 22, 30}, {10, 20, 31}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return mesh;
}

TEST(Viewer, HoldsTheMeshInACubeOfSideTwo) {
  const std::vector<double> lambda = {0, 0.25, 0.5, 1};
  const auto data =
      data_of(command::viewer_page("corner", tetrahedron(), lambda));
  EXPECT_EQ(data["title"], "corner");
  EXPECT_EQ(data["dimension"], 3);
  EXPECT_THAT(floats(data["positions"]),
              ElementsAre(-1, -0.5F, -0.25F, 1, -0.5F, -0.25F,  //
                          -1, 0.5F, -0.25F, -1, -0.5F, 0.25F));
  EXPECT_THAT(words(data["triangles"]),
              ElementsAre(0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3));
  EXPECT_THAT(words(data["edges"]), IsEmpty());
  EXPECT_THAT(floats(data["lambda"]), ElementsAreArray(lambda));
}

TEST(Viewer, HoldsCurvesOfThePlane) {
  io::Mesh mesh;
  mesh.dimension = 2;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 3, 0}};
  mesh.edges = {{0, 1}, {1, 2}, {2, 0}};
  const auto data = data_of(command::viewer_page("", mesh));
  EXPECT_EQ(data["dimension"], 2);
  EXPECT_THAT(words(data["edges"]), ElementsAre(0, 1, 1, 2, 2, 0));
  EXPECT_THAT(words(data["triangles"]), IsEmpty());
  EXPECT_THAT(floats(data["lambda"]), IsEmpty());
}

TEST(Viewer, BearsEveryExtent) {
  constexpr double kMax = std::numeric_limits<double>::max();
  constexpr double kMin = std::numeric_limits<double>::denorm_min();
  for (const double size : {kMax, 1e300, 1e-300, kMin, 0.0}) {
    SCOPED_TRACE(size);
    io::Mesh mesh = tetrahedron();
    for (std::size_t v = 0; v < 4; ++v)
      mesh.vertices[v] = {v == 1 ? size : -size, v == 2 ? size : 0, 0};
    EXPECT_THAT(floats(data_of(command::viewer_page("", mesh))["positions"]),
                Each(AllOf(Ge(-1), Le(1))));
  }
  EXPECT_THAT(words(data_of(command::viewer_page("", {}))["positions"]),
              IsEmpty());
}

TEST(Viewer, TakesAnyTitle) {
  const std::string title = "</script><script>alert(1)</script> & \"x\"";
  EXPECT_EQ(data_of(command::viewer_page(title, tetrahedron()))["title"],
            title);
  // No UTF-8: shown by a sign, and no reason to fail.
  EXPECT_EQ(data_of(command::viewer_page("a\xff", tetrahedron()))["title"],
            "a\uFFFD");
}

TEST(Viewer, NeedsNoOtherFile) {
  const std::string page = command::viewer_page("mesh", tetrahedron());
  for (const std::string other :
       {"http:", "https:", " src=", "import ", "url(", "fetch(", "@MESH@"})
    EXPECT_THAT(page, Not(HasSubstr(other)));
}

TEST(Viewer, HasAScriptThatParses) {
  if (std::system("node --version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "node is not installed";
  const support::TemporaryFolder folder;
  const std::string script = between(
      command::viewer_page("mesh", tetrahedron()), "<script>", "</script>");
  ASSERT_THAT(script, HasSubstr("webgl2"));
  const std::string path = folder.file("viewer.js", script);
  EXPECT_EQ(std::system(("node --check '" + path + "'").c_str()), 0);
}

}  // namespace
