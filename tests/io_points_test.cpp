#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "io/error.h"
#include "io/points.h"
#include "tests/support/temporary_folder.h"

namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

class ReadPoints : public ::testing::Test {
 protected:
  io::PointSet read(std::string_view bytes, std::string_view name = "in") {
    return io::read_points(folder_.file(name, bytes));
  }

  // The message without the folder: `in:1:2: what`.
  std::string error(std::string_view bytes, std::string_view name = "in") {
    try {
      read(bytes, name);
    } catch (const io::ParseError& e) {
      const std::string what = e.what();
      return what.substr(what.find(folder_.path(name)) +
                         folder_.path("").size());
    }
    return "no error";
  }

  void expect_two_points(std::string_view bytes) {
    const io::PointSet set = read(bytes);
    EXPECT_EQ(set.dimension, 3);
    ASSERT_EQ(set.points.size(), 2U);
    EXPECT_EQ(set.points[0], Eigen::Vector3d(1, 2.5, -3));
    EXPECT_EQ(set.points[1], Eigen::Vector3d(4, 5, 6e-3));
  }

  support::TemporaryFolder folder_;
};

TEST_F(ReadPoints, TakesEverySeparatorCommentAndLineEnd) {
  for (const std::string text :
       {"1 2.5 -3\n4 5 6e-3\n", "1\t2.5\t-3\n4\t5\t6e-3", "1,2.5,-3\n4,5,6e-3",
        "1, 2.5, -3\n4 ,5 ,6e-3\n", "1;2.5;-3;\n4;5;6e-3;\n",
        "# c\n\n  1  2.5 -3  # c\n// c\n4 5 6e-3 // c\n\n",
        "1 2.5 -3 255 0 0 name\n4 5 6e-3 1 2 nan\n", "2\n1 2.5 -3\n4 5 6e-3\n",
        "x,y,z\n1,2.5,-3\n4,5,6e-3\n",
        "\"x\" \"y\" \"z\"\n+1 +2.5 -3\n4. 5.0 .006\n",
        "\xef\xbb\xbf"
        "1 2.5 -3\n4 5 6e-3\n"}) {
    SCOPED_TRACE(text);
    expect_two_points(text);
    for (const std::string_view line_end : {"\r\n", "\r"}) {
      std::string other;
      for (const char c : text) c == '\n' ? other += line_end : other += c;
      expect_two_points(other);
    }
  }
}

TEST_F(ReadPoints, TakesTwoColumnsAsThePlane) {
  const io::PointSet set = read("1 2\n3 4\n");
  EXPECT_EQ(set.dimension, 2);
  ASSERT_EQ(set.points.size(), 2U);
  EXPECT_EQ(set.points[1], Eigen::Vector3d(3, 4, 0));
  EXPECT_EQ(read("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                 "property float y\nend_header\n1 2\n")
                .dimension,
            2);
}

TEST_F(ReadPoints, SaysWhereTextIsWrong) {
  EXPECT_EQ(error(""), "in: the file is empty");
  EXPECT_EQ(error(" \n# nothing\n"), "in: no points in the file");
  EXPECT_EQ(error("1 2 3\n7\n"),
            "in:2:1: one column where two or three are due");
  EXPECT_EQ(error("1 2 3\n7 8\n"),
            "in:2:3: a row of 2 columns after rows of 3");
  EXPECT_EQ(error("1 2\n7 8 9\n"),
            "in:2:5: a row of 3 columns after rows of 2");
  EXPECT_EQ(error("1 2 3\r\n# c\r\n4 nan 6\r\n"),
            "in:3:3: not a finite number: 'nan'");
  EXPECT_EQ(error("1 2 -inf\n"), "in:1:5: not a finite number: '-inf'");
  EXPECT_EQ(error("1 2 1e999\n"), "in:1:5: not a finite number: '1e999'");
  EXPECT_EQ(error("1 2 3x\n"), "in:1:5: not a number: '3x'");
  EXPECT_EQ(error("1 2 0x10\n"), "in:1:5: not a number: '0x10'");
  EXPECT_EQ(error("1,,3\n"), "in:1:3: a number is missing");
  EXPECT_EQ(error(",1,2\n"), "in:1:1: a number is missing");
  EXPECT_EQ(error("1 2 3\nx y z\n"), "in:2:1: not a number: 'x'");
  EXPECT_EQ(error("3\n1 2 3\n4 5 6\n"), "in:4:1: 3 points announced, 2 found");
  EXPECT_EQ(error("99999999999999999999\n1 2 3\n"),
            "in:1:1: the number of points is out of range: "
            "'99999999999999999999'");
}

TEST_F(ReadPoints, RefusesDecimalCommas) {
  EXPECT_THAT(error("1,5;2,5;3,5\n"), HasSubstr("separated in two ways"));
  EXPECT_THAT(error("1,5 2,5 3,5\n"), HasSubstr("separated in two ways"));
}

TEST_F(ReadPoints, KeepsMessagesToOnePrintableLine) {
  const std::string what = error("1 2 \x1b[31m\x01\n", "a\nb");
  EXPECT_THAT(what, EndsWith("not a number: '\\x1b[31m\\x01'"));
  EXPECT_EQ(what.find_first_of("\n\x1b\x01"), std::string::npos);
  EXPECT_LT(error("1 2 " + std::string(100'000, 'z')).size(), 200U);
}

TEST_F(ReadPoints, RefusesWhatIsNoFile) {
  EXPECT_THROW(io::read_points(folder_.path("missing")), io::ParseError);
  EXPECT_THROW(io::read_points(folder_.path("")), io::ParseError);
  EXPECT_THAT(error("\x1f\x8b\x08 and so on"), HasSubstr("compressed (gzip)"));
}

TEST_F(ReadPoints, RoundsEveryNumberCorrectly) {
  const io::PointSet set = read(
      "0.1 1e-400 5e-324\n"
      "9007199254740993 1.7976931348623157e308 2.2250738585072011e-308\n");
  EXPECT_EQ(set.points[0], Eigen::Vector3d(0.1, 0, 5e-324));
  EXPECT_EQ(set.points[1], Eigen::Vector3d(9007199254740992.0,
                                           std::numeric_limits<double>::max(),
                                           2.2250738585072011e-308));
}

TEST_F(ReadPoints, TakesVerticesOfEveryMeshFormat) {
  expect_two_points("OFF\n2 0 0\n1 2.5 -3\n4 5 6e-3\n");
  expect_two_points("COFF # c\n2 0 0\n\n1 2.5 -3 255 0 0 1\n4 5 6e-3 0 0 0 1");
  expect_two_points("OFF 2 1\n1 2.5 -3\n4 5 6e-3\n2 0 1\n");
  expect_two_points("OFF 2 1\n1 2.5 -3\n4 5 6e-3\n3 0 1 99\n");
  expect_two_points("# c\no a\nv 1 2.5 -3\nvn 0 0 1\nv 4 5 6e-3 1\nf 1 2 3\n");
  expect_two_points(
      "ply\nformat ascii 1.0\ncomment c\nobj_info i\nelement other 1\n"
      "property list uchar int many\nproperty float f\nelement vertex 2\n"
      "property double z\nproperty uchar red\nproperty list int float w\n"
      "property double x\nproperty double y\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n"
      "2 7 8 nan\n-3 9 0 1 2.5\n6e-3 9 2 5 5 4 5\n2 0 1\n");
}

TEST_F(ReadPoints, SaysWhereAPlyFileIsWrong) {
  const std::string head = "ply\nformat ascii 1.0\nelement vertex ";
  const std::string xyz =
      "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  EXPECT_THAT(error(head + "1000000000000" + xyz + "1 2 3\n"),
              HasSubstr("more than the file can hold: 1000000000000"));
  EXPECT_EQ(error(head + "-1" + xyz),
            "in:3:16: the element count is out of range: '-1'");
  EXPECT_EQ(error(head + "2" + xyz + "1.00 2.00 3.00\n"),
            "in:9:1: the file ends after 1 of 2 of element 'vertex'");
  EXPECT_EQ(error(head + "2" + xyz + "1 2 3\n4 5\n"),
            "in:9:4: a number is missing");
  EXPECT_EQ(error(head + "1" + xyz + "1 2 3 4\n"),
            "in:8:7: more values than properties");
  EXPECT_EQ(error(head + "1" + xyz + "1 2 inf\n"),
            "in:8:5: not a finite number: 'inf'");
  EXPECT_EQ(error("ply\nformat ascii 1.0\nelement vertex 1\n"),
            "in:4:1: the header has no 'end_header'");
  EXPECT_EQ(error("ply\nformat text 1.0\n"),
            "in:2:8: unknown PLY format: 'text'");
  EXPECT_EQ(error("ply\nproperty float x\n"),
            "in:2:1: a property before the first element");
  EXPECT_EQ(error(head + "1\nproperty quad x\n"),
            "in:4:10: unknown PLY type: 'quad'");
  EXPECT_EQ(error("1 2 3\n", "in.ply"),
            "in.ply:1:1: a PLY file starts with the line 'ply'");
}

TEST_F(ReadPoints, GivesBackWhatWritePointsWrote) {
  std::mt19937_64 rng(20261122);
  for (int trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(trial);
    io::PointSet set;
    set.dimension = trial % 2 == 0 ? 2 : 3;
    for (int i = 0; i < 50; ++i) {
      Eigen::Vector3d p = Eigen::Vector3d::Zero();
      for (int axis = 0; axis < set.dimension; ++axis) {
        p[axis] = std::ldexp(static_cast<double>(rng() >> 11U),
                             static_cast<int>(rng() % 1900) - 1000);
        if (trial % 4 < 2) p[axis] = static_cast<double>(rng() % 1000);
        if (rng() % 2 == 0) p[axis] = -p[axis];
      }
      set.points.push_back(p);
    }
    for (const std::string_view end : {".xyz", ".ply", ".obj", ".txt"}) {
      const std::string name = std::to_string(trial) + std::string(end);
      SCOPED_TRACE(name);
      io::write_points(folder_.path(name), set);
      const io::PointSet back = io::read_points(folder_.path(name));
      EXPECT_EQ(back.dimension, set.dimension);
      EXPECT_EQ(back.points, set.points);
    }
  }
}

// One file in every encoding: the bytes are put together here, not by io.
template <class Number>
void append(std::string& out, Number number, bool big_endian) {
  const auto* raw = reinterpret_cast<const char*>(&number);
  std::string bytes(raw, sizeof(Number));
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  out += bytes;
}

std::string binary_ply(bool big_endian) {
  std::string out = "ply\r\nformat binary_";
  out += big_endian ? "big" : "little";
  out +=
      "_endian 1.0\r\nelement extra 1\r\nproperty list ushort short l\r\n"
      "element vertex 2\r\nproperty short z\r\nproperty list uchar double w\r\n"
      "property double x\r\nproperty float y\r\nproperty char c\r\n"
      "end_header\r\n";
  append(out, std::uint16_t{3}, big_endian);
  for (int i = 0; i < 3; ++i)
    append(out, static_cast<std::int16_t>(i), big_endian);
  for (int i = 0; i < 2; ++i) {
    append(out, static_cast<std::int16_t>(i == 0 ? -3 : 6), big_endian);
    append(out, static_cast<std::uint8_t>(i), big_endian);
    if (i == 1) append(out, 1e300, big_endian);
    append(out, i == 0 ? 1.0 : 4.0, big_endian);
    append(out, i == 0 ? 2.5F : 5.0F, big_endian);
    append(out, std::int8_t{-1}, big_endian);
  }
  return out;
}

TEST_F(ReadPoints, TakesBinaryPlyInBothByteOrders) {
  for (const bool big_endian : {false, true}) {
    SCOPED_TRACE(big_endian);
    const io::PointSet set = read(binary_ply(big_endian));
    ASSERT_EQ(set.points.size(), 2U);
    EXPECT_EQ(set.points[0], Eigen::Vector3d(1, 2.5, -3));
    EXPECT_EQ(set.points[1], Eigen::Vector3d(4, 5, 6));
  }
}

TEST_F(ReadPoints, FindsEveryCutInABinaryPly) {
  const std::string whole = binary_ply(false);
  for (std::size_t n = 1; n < whole.size(); ++n) {
    SCOPED_TRACE(n);
    EXPECT_THROW(read(std::string_view(whole).substr(0, n)), io::ParseError);
  }
  EXPECT_THAT(error(std::string_view(whole).substr(0, whole.size() - 1)),
              HasSubstr("byte " + std::to_string(whole.size() - 1) +
                        ": the file is cut off"));
}

TEST_F(ReadPoints, RefusesNanInABinaryPly) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
      "property float x\nproperty float y\nend_header\n";
  append(bytes, 1.0F, false);
  append(bytes, std::numeric_limits<float>::quiet_NaN(), false);
  EXPECT_THAT(error(bytes), EndsWith("not a finite number: 'nan'"));
}

// Damaged files are read or refused, never anything else; the sanitizer build
// watches over the rest.
TEST_F(ReadPoints, SurvivesDamagedFiles) {
  const std::vector<std::string> seeds = {
      binary_ply(true),
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty "
      "list uchar int l\nproperty float y\nend_header\n1 1 5 2\n3 0 4\n",
      "OFF\n3 1 0\n1 2 3\n4 5 6\n7 8 9\n3 0 1 2\n",
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
      "vertex 0 1 0\nendloop\nendfacet\nendsolid s\n",
      "v 1 2 3\nv 4 5 6\nv 7 8 9\nf 1/1 2//2 -1\nl 1 2\n",
      "2\n1,2,3 # c\n4,5,6\n"};
  std::mt19937_64 rng(20261122);
  for (int trial = 0; trial < 3000; ++trial) {
    SCOPED_TRACE(trial);
    std::string bytes = seeds[trial % seeds.size()];
    for (std::uint64_t k = rng() % 4; k < 4; ++k) {
      const std::size_t at = rng() % bytes.size();
      switch (rng() % 3) {
        case 0:
          bytes[at] = static_cast<char>(rng());
          break;
        case 1:
          bytes.erase(at, rng() % 8);
          break;
        default:
          bytes.insert(at, std::string(1 + rng() % 3, "09-.e\n "[rng() % 7]));
      }
      if (bytes.empty()) bytes = " ";
    }
    try {
      for (const Eigen::Vector3d& p : read(bytes).points)
        EXPECT_TRUE(p.allFinite());
    } catch (const io::ParseError& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
  }
}

}  // namespace
