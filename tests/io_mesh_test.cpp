#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "io/error.h"
#include "io/file.h"
#include "io/mesh.h"
#include "tests/support/temporary_folder.h"

namespace {

using ::testing::HasSubstr;
using Triangle = std::array<std::uint32_t, 3>;

io::Mesh tetrahedron() {
  return {3,
          {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.1, 0.2, 1e-300}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
          {}};
}

class MeshFile : public ::testing::Test {
 protected:
  io::Mesh read(std::string_view bytes, std::string_view name = "in") {
    return io::read_mesh(folder_.file(name, bytes));
  }

  std::string error(std::string_view bytes, std::string_view name = "in") {
    try {
      read(bytes, name);
    } catch (const io::ParseError& e) {
      const std::string what = e.what();
      return what.substr(folder_.path("").size());
    }
    return "no error";
  }

  support::TemporaryFolder folder_;
};

TEST_F(MeshFile, ComesBackAsItWasWritten) {
  std::mt19937_64 rng(20261122);
  for (int trial = 0; trial < 30; ++trial) {
    io::Mesh mesh;
    const auto n = static_cast<std::uint32_t>(3 + rng() % 20);
    const bool floats = trial % 2 == 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      Eigen::Vector3d p;
      for (double& x : p) {
        x = std::ldexp(static_cast<double>(rng() >> 11U), -53);
        if (floats) x = static_cast<double>(static_cast<float>(x));
      }
      mesh.vertices.push_back(p);
    }
    for (int i = 0; i < 40; ++i) {
      const auto v = static_cast<std::uint32_t>(rng() % n);
      mesh.triangles.push_back({v, (v + 1) % n, (v + 2) % n});
    }
    for (const std::string_view end : {".ply", ".off", ".OBJ"}) {
      const std::string path =
          folder_.path(std::to_string(trial) + std::string(end));
      SCOPED_TRACE(path);
      io::write_mesh(path, mesh);
      const io::Mesh back = io::read_mesh(path);
      EXPECT_EQ(back.dimension, 3);
      EXPECT_EQ(back.vertices, mesh.vertices);
      EXPECT_EQ(back.triangles, mesh.triangles);
    }
  }
}

TEST_F(MeshFile, KeepsTrianglesAndRoundsCornersAsStl) {
  const io::Mesh mesh = tetrahedron();
  io::write_mesh(folder_.path("a.stl"), mesh);
  const io::Mesh back = io::read_mesh(folder_.path("a.stl"));
  ASSERT_EQ(back.vertices.size(), 4U);
  ASSERT_EQ(back.triangles.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(back.vertices[back.triangles[i][k]].cast<float>(),
                mesh.vertices[mesh.triangles[i][k]].cast<float>());
  io::Mesh huge = mesh;
  huge.vertices[0].x() = 1e39;
  EXPECT_THROW(io::write_mesh(folder_.path("b.stl"), huge), io::WriteError);
}

TEST_F(MeshFile, ReadsStlText) {
  const io::Mesh mesh = read(
      "solid name\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n"
      "   vertex 1 0 0\n   VERTEX 0 1 0\n  endloop\n endfacet\n"
      " facet normal 0 0 1\n  outer loop\n   vertex 1 0 0\n   vertex 1 1 0\n"
      "   vertex -0 1 0\n  endloop\n endfacet\nendsolid name\n");
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
}

TEST_F(MeshFile, HoldsLambdaAsAFaceProperty) {
  const std::vector<double> lambda = {0.25, 0.5, 0.75, 1};
  io::write_mesh(folder_.path("a.ply"), tetrahedron(), lambda);
  const std::string bytes = folder_.content("a.ply");
  EXPECT_THAT(bytes, HasSubstr("property double lambda\n"));
  double last = 0;
  std::memcpy(&last, bytes.data() + bytes.size() - 8, 8);
  EXPECT_EQ(last, 1.0);
  EXPECT_EQ(io::read_mesh(folder_.path("a.ply")).triangles,
            tetrahedron().triangles);
}

TEST_F(MeshFile, CutsPolygonsIntoFans) {
  const std::vector<Triangle> fan = {{0, 1, 2}, {0, 2, 3}};
  const std::string rows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  EXPECT_EQ(read("OFF\n4 1 0\n" + rows + "4 0 1 2 3 255 0 0\n").triangles, fan);
  EXPECT_EQ(read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1 2/2/2 3//3 -1\n")
                .triangles,
            fan);
  EXPECT_EQ(read("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                 "property float y\nproperty float z\nelement face 1\n"
                 "property uchar q\nproperty list uchar uint vertex_index\n"
                 "end_header\n" +
                 rows + "9 4 0 1 2 3\n")
                .triangles,
            fan);
}

TEST_F(MeshFile, RefusesIndicesOutOfRange) {
  const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n";
  EXPECT_EQ(error(off + "3 0 1 3\n"),
            "in:6:7: the vertex index is out of range: '3'");
  EXPECT_EQ(error(off + "3 0 1 -1\n"),
            "in:6:7: the vertex index is out of range: '-1'");
  EXPECT_EQ(error(off + "2 0 1\n"), "in:6:1: a face of 2 corners");
  EXPECT_EQ(error(off), "in:6:1: the file ends after 0 of 1 faces");
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  EXPECT_EQ(error(obj + "f 1 2 4\n"),
            "in:4:7: the vertex index is out of range (3 vertices so far): "
            "'4'");
  EXPECT_THAT(error(obj + "f 1 2 0\n"), HasSubstr("out of range"));
  EXPECT_THAT(error(obj + "f 1 2 -4\n"), HasSubstr("out of range"));
  EXPECT_THAT(error(obj + "f 1 2 x\n"), HasSubstr("is no integer: 'x'"));
  EXPECT_THAT(error(obj + "f 1 2\n"), HasSubstr("2 corners where 3 are due"));
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nelement face 1\n"
      "property list char int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n1 1 0\n";
  EXPECT_EQ(error(ply + "3 0 1 3\n"), "in:13:7: no vertex index below 3: '3'");
  EXPECT_EQ(error(ply + "3 0 1 1.5\n"),
            "in:13:7: no vertex index below 3: '1.5'");
  EXPECT_THAT(error(ply + "-3 0 1 2\n"), HasSubstr("not a list length: '-3'"));
}

TEST_F(MeshFile, RefusesFilesWithoutAMesh) {
  EXPECT_EQ(error("1 2 3\n4 5 6\n"),
            "in: no PLY, OFF, OBJ or STL file, nor edges in a .txt file");
  EXPECT_EQ(error("v 1 2 3\n"), "in: neither triangles nor edges in the file");
  EXPECT_THAT(error("OFF\n1000000000 1000000000000 0\n"),
              HasSubstr("more vertices than the file can hold: 1000000000"));
  std::string stl(84, ' ');
  stl[80] = '\x7f';
  EXPECT_THAT(error(stl, "a.stl"), HasSubstr("byte 84: "));
}

TEST_F(MeshFile, HoldsCurvesOfThePlane) {
  const io::Mesh curve = {
      2, {{0, 0, 0}, {1, 0, 0}, {0.3, 1, 0}}, {}, {{0, 1}, {1, 2}, {2, 0}}};
  for (const std::string_view name : {"a.ply", "a.obj"}) {
    SCOPED_TRACE(name);
    io::write_mesh(folder_.path(name), curve,
                   std::vector<double>{0.1, 0.2, 0.3});
    const io::Mesh back = io::read_mesh(folder_.path(name));
    EXPECT_EQ(back.dimension, 2);
    EXPECT_EQ(back.vertices, curve.vertices);
    EXPECT_EQ(back.edges, curve.edges);
  }
  io::write_mesh(folder_.path("a.txt"), curve);
  EXPECT_EQ(folder_.content("a.txt"), "0 0 1 0\n1 0 0.3 1\n0.3 1 0 0\n");
  const io::Mesh back = io::read_mesh(folder_.path("a.txt"));
  EXPECT_EQ(back.dimension, 2);
  EXPECT_EQ(back.vertices, curve.vertices);
  EXPECT_EQ(back.edges, curve.edges);
}

TEST_F(MeshFile, RefusesTextThatIsNoEdges) {
  EXPECT_EQ(error("0 0 1 0\n1 0 2\n", "a.txt"),
            "a.txt:2:5: an edge is four columns: x y x y");
  EXPECT_EQ(error("0 0 1 0 7\n", "a.txt"),
            "a.txt:1:9: an edge is four columns: x y x y");
  EXPECT_THAT(error("0 0 1 x\n", "a.txt"), HasSubstr("a.txt:1:7: "));
}

TEST_F(MeshFile, DrawsCurves) {
  const io::Mesh curve = {
      2, {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {}, {{0, 1}, {1, 2}, {2, 0}}};
  io::write_mesh(folder_.path("a.svg"), curve);
  const std::string svg = folder_.content("a.svg");
  EXPECT_THAT(svg, HasSubstr("viewBox=\"-20 -20 1040 540\""));
  EXPECT_THAT(svg, HasSubstr("M0 500L1000 500L500 0Z"));
  io::Mesh surface = {3, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  EXPECT_THROW(io::write_mesh(folder_.path("b.svg"), surface), io::WriteError);
}

TEST_F(MeshFile, RefusesUnknownExtensionsBeforeWriting) {
  for (const std::string_view name : {"a.xyz", "a", "a.txt"}) {
    SCOPED_TRACE(name);
    EXPECT_THROW(io::require_mesh_format(folder_.path(name), 3),
                 io::WriteError);
    EXPECT_THROW(io::write_mesh(folder_.path(name), tetrahedron()),
                 io::WriteError);
  }
  EXPECT_THROW(io::require_mesh_format("a.stl", 2), io::WriteError);
  EXPECT_NO_THROW(io::require_mesh_format("-", 3));
  EXPECT_EQ(folder_.n_files(), 0U);
}

TEST_F(MeshFile, LeavesNothingBehindWhenWritingFails) {
  const std::string missing = folder_.path("missing/out.ply");
  try {
    io::write_mesh(missing, tetrahedron());
    ADD_FAILURE() << "wrote into a folder that is not there";
  } catch (const io::WriteError& e) {
    EXPECT_EQ(std::string(e.what()),
              missing + ": cannot write: No such file or directory");
  }
  // A folder in the place of the target: everything but the name is possible.
  std::filesystem::create_directory(folder_.path("out.ply"));
  EXPECT_THROW(io::write_file(folder_.path("out.ply"), "x"), io::WriteError);
  EXPECT_EQ(folder_.n_files(), 1U);
  // A full disk.
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_THROW(io::write_file("/dev/full", "x"), io::WriteError);
  }
}

TEST_F(MeshFile, ReplacesATargetAndFollowsALink) {
  folder_.file("old", "old");
  std::filesystem::create_symlink("old", folder_.path("link"));
  io::write_file(folder_.path("link"), "new");
  EXPECT_EQ(folder_.content("old"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder_.path("link")));
  EXPECT_EQ(folder_.n_files(), 2U);
  std::filesystem::create_symlink("new", folder_.path("ahead"));
  io::write_file(folder_.path("ahead"), "first");  // of a link to no file yet
  EXPECT_EQ(folder_.content("new"), "first");
  EXPECT_TRUE(std::filesystem::is_symlink(folder_.path("ahead")));
  std::filesystem::create_symlink("ring", folder_.path("ring"));
  EXPECT_THROW(io::write_file(folder_.path("ring"), "x"), io::WriteError);
  EXPECT_EQ(folder_.n_files(), 5U);
  io::write_file("/dev/null", "x");
  EXPECT_FALSE(std::filesystem::is_regular_file("/dev/null"));
}

}  // namespace
