// The command as a user meets it: exit codes, one line of error, whole files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "command_path.h"
#include "tests/support/command_run.h"
#include "tests/support/temporary_folder.h"

namespace {

using support::Finished;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::json;

class Command : public ::testing::Test {
 protected:
  Finished run(const std::string& arguments,
               const std::string& input = "/dev/null",
               const std::string& output = "out") const {
    return support::run_command(folder_, arguments, input, output);
  }

  void expect_error(const std::string& arguments, const std::string& text) {
    SCOPED_TRACE(arguments);
    const Finished result = run(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, StartsWith("umbrella: error: "));
    EXPECT_THAT(result.err, HasSubstr(text));
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1);
  }

  support::TemporaryFolder folder_;
};

TEST_F(Command, PrintsHelpAndVersion) {
  EXPECT_THAT(run("--help").out, HasSubstr("Examples:"));
  EXPECT_EQ(run("--help").status, 0);
  EXPECT_THAT(run("--version").out, StartsWith("umbrella "));
  for (const std::string sub :
       {"reconstruct", "repair", "check", "generate", "view", "solve"}) {
    const Finished help = run(sub + " --help");
    EXPECT_EQ(help.status, 0);
    EXPECT_THAT(help.out, HasSubstr("Examples:"));
  }
}

TEST_F(Command, RefusesBadUsageInOneLine) {
  folder_.file("p.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  expect_error("", "subcommand is required");
  expect_error("reconstrukt p.xyz", "reconstrukt");
  expect_error("reconstruct", "points is required");
  expect_error("reconstruct p.xyz --frobnicate", "--frobnicate");
  expect_error("reconstruct p.xyz --stage sideways",
               "--stage: 'sideways' is none of filter, clean, closed\n");
  expect_error("reconstruct p.xyz --stage 2", "'2' is none of");
  expect_error("reconstruct p.xyz --close worst",
               "--close: 'worst' is none of best, paper\n");
  expect_error("reconstruct p.xyz --color red",
               "--color: 'red' is none of auto, always, never\n");
  expect_error("reconstruct p.xyz --criterion none",
               "--criterion: 'none' is none of paper, no-gabriel, ");
  expect_error("reconstruct p.xyz --umbrella last",
               "--umbrella: 'last' is none of first, ");
  expect_error("reconstruct p.xyz --curve round",
               "--curve: 'round' is none of auto, paper, closed, open, tsp, "
               "mutual\n");
  expect_error("reconstruct p.xyz --time-limit -1", "--time-limit");
  expect_error("reconstruct p.xyz --time-limit nan", "--time-limit");
  expect_error("reconstruct p.xyz --threads 0", "--threads");
  expect_error("reconstruct p.xyz --threads two", "--threads");
  expect_error("reconstruct p.xyz --threads", "--threads: 1 required N miss");
  expect_error("reconstruct p.xyz -o mesh.xyz", "mesh.xyz: cannot write");
  expect_error("reconstruct p.xyz -o no/mesh.ply", "no/mesh.ply: cannot write");
  expect_error("reconstruct p.xyz -o " + std::string(300, 'x') + ".ply", "xxx");
  expect_error("reconstruct p.xyz -o ''", "the name of a file is empty");
  expect_error("reconstruct p.xyz --report ''", "the name of a file is empty");
  expect_error("reconstruct p.xyz -o ./p.xyz", "would overwrite the input");
  expect_error("reconstruct p.xyz --report p.xyz", "would overwrite the input");
  expect_error("reconstruct p.xyz -o - --report -", "-: named as two outputs");
  expect_error("reconstruct p.xyz -o m.ply --report ./m.ply",
               "m.ply: named as two outputs");
  expect_error("generate", "is required");
  expect_error("generate klein-bottle -n 3", "klein-bottle");
  expect_error("generate knot -n 0", "--count");
  expect_error("generate knot -n 1e3", "--count");
  expect_error("generate knot -n 134217729", "--count");
  expect_error("generate knot -n 3 --seed -1", "--seed: Value -1 is negative");
  expect_error("generate knot -n 3 --noise -1", "noise");
  expect_error("check", "mesh is required");
  for (const std::string arguments :
       {"reconstruct ''", "repair ''", "check ''", "check p.xyz --points ''",
        "view '' -o v.html", "solve ''", "generate knot -n 3 -o ''"})
    expect_error(arguments, "the name of a file is empty");
}

TEST_F(Command, MakesPagesThatShowMeshes) {
  ASSERT_EQ(run("generate torus -n 600 -o t.ply").status, 0);
  const Finished made = run("reconstruct t.ply -o mesh.ply --view scan.html");
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(folder_.content("scan.html"), StartsWith("<!DOCTYPE html>"));
  EXPECT_THAT(folder_.content("scan.html"), HasSubstr(R"("title":"t.ply")"));

  EXPECT_EQ(run("view ./mesh.ply -o mesh.html").status, 0);
  EXPECT_THAT(folder_.content("mesh.html"), HasSubstr(R"("title":"mesh.ply")"));
  EXPECT_EQ(run("view - -o -", "mesh.ply").out.substr(0, 15),
            "<!DOCTYPE html>");

  ASSERT_EQ(run("generate star -n 100 -o s.xy").status, 0);
  EXPECT_EQ(run("reconstruct s.xy -o s.txt --view s.html").status, 0);
  EXPECT_THAT(folder_.content("s.html"), HasSubstr(R"("dimension":2)"));
  EXPECT_EQ(run("view s.txt -o e.html").status, 0);

  const Finished piped = run("reconstruct t.ply --view -");
  EXPECT_THAT(piped.out, StartsWith("<!DOCTYPE html>"));
  EXPECT_THAT(piped.err, HasSubstr("1200 triangles"));
  expect_error("view mesh.ply", "--output is required");
  expect_error("view mesh.ply -o ''", "the name of a file is empty");
  expect_error("view mesh.ply -o mesh.ply", "would overwrite the input");
  expect_error("view t.ply -o t.html", "t.ply: ");
  expect_error("view mesh.ply -o no/mesh.html", "no/mesh.html: cannot write");
  expect_error("reconstruct t.ply --view t.ply", "would overwrite the input");
  expect_error("reconstruct t.ply -o m.ply --view m.ply", "two outputs");
}

TEST_F(Command, TakesOtherCriteriaAndMethods) {
  ASSERT_EQ(run("generate torus -n 600 -o t.ply").status, 0);
  for (const std::string options :
       {"--method cocone", "--method ballmerge=1.7", "--method lambda=0.4:0.9",
        "--criterion ballmerge", "--umbrella flattest --criterion mixed"}) {
    SCOPED_TRACE(options);
    const Finished result = run("reconstruct t.ply " + options);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("1200 triangles, genus 1, closed"));
  }
  folder_.file("p.xy", "0 0\n1 0\n0 1\n1 1\n");
  expect_error("reconstruct t.ply --method crusty", "no method 'crusty'");
  expect_error("reconstruct t.ply --method beta=0.5", "beta=beta");
  expect_error("reconstruct t.ply --umbrella last", "last");
  expect_error("reconstruct t.ply --method crust --criterion area",
               "are for --method umbrella");
  expect_error("reconstruct p.xy --method crust", "is for points in space");
  expect_error("reconstruct p.xy --umbrella flattest", "is for points in");
}

TEST_F(Command, RefusesBadInputInOneLine) {
  folder_.file("empty.xyz", "");
  folder_.file("nan.xyz", "0 0 0\n1 nan 0\n");
  folder_.file("column.xyz", "1 2 3\n4\n");
  folder_.file("three.xyz", "0 0 0\n1 0 0\n0 1 0\n1 0 0\n");
  folder_.file("flat.xyz", "0 0 0\n1 0 0\n0 1 0\n1 1 0\n5 7 0\n");
  folder_.file("two.xy", "0 0\n1 1\n0 0\n");
  folder_.file("line.xy", "0 0\n1 1\n2 2\n3 3\n");
  folder_.file("space.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  folder_.file("huge.ply",
               "ply\nformat binary_little_endian 1.0\n"
               "element vertex 1000000000000\nproperty float x\n"
               "property float y\nproperty float z\nend_header\nabcd");
  const std::string make = "reconstruct -o mesh.ply ";
  expect_error(make + "missing.xyz", "missing.xyz: cannot read: ");
  expect_error(make + ".", ".: cannot read: ");
  expect_error(make + "empty.xyz", "empty.xyz: the file is empty");
  expect_error(make + "nan.xyz", "nan.xyz:2:3: not a finite number: 'nan'");
  expect_error(make + "column.xyz", "column.xyz:2:1: one column");
  expect_error(make + "three.xyz", "three.xyz: no surface: 3 distinct points");
  expect_error(make + "flat.xyz", "flat.xyz: no surface: all points lie in");
  expect_error(make + "two.xy", "two.xy: no curve: 2 distinct points");
  expect_error(make + "line.xy", "line.xy: no curve: all points lie on");
  expect_error(make + "huge.ply", "1000000000000");
  expect_error(make + "space.xyz line.xy", "line.xy: points of dimension 2");
  expect_error("check space.xyz", "space.xyz: no PLY, OFF, OBJ or STL file");
  EXPECT_EQ(folder_.content("mesh.ply"), "");
}

TEST_F(Command, ReconstructsWhatItGenerates) {
  ASSERT_EQ(run("generate sphere -n 500 -o sphere.ply").status, 0);
  const Finished made =
      run("reconstruct sphere.ply -o mesh.ply --report report.json");
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("closed, manifold"));
  EXPECT_EQ(made.err, "");  // no progress: it is no terminal
  const Json report = Json::parse(folder_.content("report.json"));
  EXPECT_EQ(report["input"]["points"], 500);
  EXPECT_EQ(report["surface"]["triangles"], 996);
  EXPECT_EQ(report["surface"]["genus"], 0);
  for (const std::string key :
       {"input", "delaunay", "filter", "clean_up", "holes", "closing",
        "surface", "seconds", "threads", "peak_memory_bytes", "version",
        "build"})
    EXPECT_TRUE(report.contains(key)) << key;

  const Finished check = run("check mesh.ply --points sphere.ply --json");
  EXPECT_EQ(check.status, 0);
  const Json certificate = Json::parse(check.out);
  // Sums depend on the order of their terms; all the rest is exact.
  for (const auto& [key, value] : report["surface"].items()) {
    if (value.is_number_float()) continue;
    EXPECT_EQ(certificate["surface"][key], value) << key;
  }
}

TEST_F(Command, ReconstructsCurves) {
  ASSERT_EQ(run("generate two-circles -n 120 -o circles.xyz").status, 0);
  const Finished made =
      run("reconstruct circles.xyz -o curve.ply --report r.json");
  EXPECT_EQ(made.status, 0) << made.err;
  const Json report = Json::parse(folder_.content("r.json"));
  EXPECT_EQ(report["input"]["dimension"], 2);
  EXPECT_EQ(report["surface"]["edges"], 120);
  EXPECT_EQ(report["surface"]["components"], 2);
  EXPECT_EQ(run("check curve.ply --points circles.xyz").status, 0);
}

TEST_F(Command, TakesModesOfCurves) {
  ASSERT_EQ(run("generate star -n 100 -o star.xyz").status, 0);
  for (const char* mode :
       {"auto", "paper", "closed", "open", "tsp", "mutual"}) {
    SCOPED_TRACE(mode);
    const Finished made = run("reconstruct star.xyz --report r.json --curve " +
                              std::string(mode));
    EXPECT_EQ(made.status, 0) << made.err;
    const Json report = Json::parse(folder_.content("r.json"));
    EXPECT_EQ(report["surface"]["edges"], 100);
    EXPECT_EQ(report["surface"]["points_used"], 100);
  }
  expect_error("reconstruct star.xyz --curve best", "--curve");
  expect_error("reconstruct star.xyz --curve tsp --stage filter", "--stage");
  folder_.file("p.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  expect_error("reconstruct p.xyz --curve auto", "plane");
}

TEST_F(Command, WritesNoMeshIfTheReportCannotBeWritten) {
  folder_.file("p.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  expect_error("reconstruct p.xyz -o mesh.ply --report no/report.json",
               "no/report.json: cannot write");
  EXPECT_FALSE(std::filesystem::exists(folder_.path("mesh.ply")));
}

TEST_F(Command, TakesFileNamesThatAreNoText) {
  folder_.file("p\xff.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  const Finished made = run("reconstruct p\xff.xyz --report -");
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(Json::parse(made.out)["input"]["points"], 4);
}

TEST_F(Command, NoticesAFullStandardOutput) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  folder_.file("closed.off",
               "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
               "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  for (const std::string arguments :
       {"check closed.off", "reconstruct closed.off",
        "reconstruct closed.off -o -", "generate sphere -n 9", "--help"}) {
    SCOPED_TRACE(arguments);
    const Finished result = run(arguments, "/dev/null", "/dev/full");
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err,
                StartsWith("umbrella: error: <stdout>: cannot write"));
  }
}

// The limit of the shell counts in blocks of 512 or 1024 bytes.
TEST_F(Command, LeavesNoHalfFileWhereFilesMayNotGrow) {
  ASSERT_EQ(run("generate sphere -n 300 -o s.ply").status, 0);
  const std::string line = "cd '" + folder_.path("") + "' && ulimit -f 4 && '" +
                           kCommandPath +
                           "' reconstruct s.ply -o mesh.ply 2>err >out";
  const int status = std::system(line.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_THAT(folder_.content("err"),
              StartsWith("umbrella: error: mesh.ply: cannot write: "));
  for (const auto& entry :
       std::filesystem::directory_iterator(folder_.path("")))
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("mesh")));
}

// Some programs of this set are given up at a limit, and solved once grown.
TEST_F(Command, CallsAClosedCurveASuccess) {
  run("generate star -n 300 --seed 2 --noise 1 -o star.xyz");
  const Finished made = run("reconstruct star.xyz --curve closed");
  EXPECT_THAT(made.out, HasSubstr("300 edges"));
  EXPECT_THAT(made.out, HasSubstr("closed, manifold"));
  EXPECT_EQ(made.status, 0);
}

TEST_F(Command, CheckFindsWhatIsWrong) {
  folder_.file("open.off",
               "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
               "3 0 2 1\n3 0 1 3\n3 1 2 3\n");
  const Finished open = run("check open.off --json");
  EXPECT_EQ(open.status, 3);
  EXPECT_EQ(Json::parse(open.out)["surface"]["boundary_edges"], 3);
  folder_.file("closed.off",
               "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
               "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  EXPECT_EQ(run("check closed.off").status, 0);
  folder_.file("more.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n5 5 5\n");
  const Finished more = run("check closed.off --points more.xyz --json");
  EXPECT_EQ(more.status, 3);
  EXPECT_EQ(Json::parse(more.out)["surface"]["unused_points"], Json({4}));
}

TEST_F(Command, RepairsATornMesh) {
  folder_.file("torn.off",
               "OFF\n6 5 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 1\n9 9 9\n"
               "3 0 1 2\n3 0 1 3\n3 1 0 4\n3 3 4 0\n3 1 2 3\n");
  const Finished made = run("repair torn.off -o closed.off --report r.json");
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(run("check closed.off --points torn.off").status, 0);
  const Json report = Json::parse(folder_.content("r.json"));
  const Json expected = {{"faces", 5},
                         {"degenerate", 1},
                         {"duplicates", 1},
                         {"not_delaunay", 0},
                         {"kept", 3}};
  EXPECT_EQ(report["repair"], expected);
  EXPECT_EQ(report["input"]["duplicates"], 1);
  expect_error("repair", "mesh is required");
  expect_error("repair no.off", "no.off");
  expect_error("repair torn.off -o torn.off", "would overwrite the input");
  folder_.file("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  expect_error("repair flat.off", "3 distinct points of 4 needed");
}

// Too small balls: what they leave has no solution until the regions grow.
TEST_F(Command, WritesEachProgramOfTheClosing) {
  ASSERT_EQ(run("generate cube -n 300 --noise 0.3 -o s.ply").status, 0);
  const Finished plain =
      run("reconstruct s.ply --method alpha=0.1 -o plain.ply");
  const Finished made =
      run("reconstruct s.ply --method alpha=0.1 -o mesh.ply --report r.json "
          "--threads 2 --write-opb p --write-lp p --write-mps p");
  EXPECT_EQ(made.status, plain.status) << made.err;
  EXPECT_EQ(folder_.content("mesh.ply"), folder_.content("plain.ply"));
  const Json answers =
      Json::parse(folder_.content("r.json"))["closing"]["programs"];
  EXPECT_EQ(std::ranges::count(answers, "limit"), 0);
  EXPECT_GT(std::ranges::count(answers, "feasible"), 0);
  EXPECT_GT(std::ranges::count(answers, "infeasible"), 0);
  for (std::size_t k = 1; k <= answers.size(); ++k) {
    const std::string file = "p-" + std::to_string(k);
    SCOPED_TRACE(file);
    const bool is_feasible = answers[k - 1] == "feasible";
    EXPECT_THAT(
        run("solve " + file + ".opb").out,
        HasSubstr(is_feasible ? "\ns SATISFIABLE\n" : "\ns UNSATISFIABLE\n"));
    EXPECT_THAT(folder_.content(file + ".lp"), HasSubstr("Subject To"));
    EXPECT_THAT(folder_.content(file + ".mps"), HasSubstr("ENDATA"));
  }
  const std::string next = "p-" + std::to_string(answers.size() + 1) + ".opb";
  EXPECT_FALSE(std::filesystem::exists(folder_.path(next)));

  folder_.file("p.xy", "0 0\n1 0\n0 1\n1 1\n");
  expect_error("reconstruct p.xy --write-lp p", "are for points in space");
  expect_error("reconstruct s.ply --stage clean --write-lp p",
               "are for --stage closed");
  expect_error("reconstruct s.ply --write-lp no/p", "no/p-1.lp: cannot write");
  std::filesystem::copy(folder_.path("s.ply"), folder_.path("q-2.lp"));
  expect_error("reconstruct q-2.lp --write-lp q", "would overwrite q-2.lp");
  expect_error("reconstruct s.ply --report q-17.opb --write-opb ./q",
               "would overwrite q-17.opb");
  expect_error("reconstruct s.ply --write-mps ''", "name of a file is empty");
  expect_error("reconstruct s.ply --write-opb -", "cannot be standard output");
}

// With noise of half a spacing the choice of triangles is wide.
TEST_F(Command, ClosesByEachWeight) {
  ASSERT_EQ(run("generate sphere -n 400 --noise 0.5 -o s.ply").status, 0);
  std::set<std::string> meshes;
  for (const std::string weight :
       {"ball-overlap", "circumradius", "lambda", "area"}) {
    SCOPED_TRACE(weight);
    const Finished made = run("reconstruct s.ply -o m.ply --weight " + weight);
    EXPECT_EQ(made.status, 0) << made.err;
    meshes.insert(folder_.content("m.ply"));
  }
  EXPECT_EQ(meshes.size(), 4U);
  ASSERT_EQ(run("reconstruct s.ply -o m.ply").status, 0);
  EXPECT_TRUE(meshes.contains(folder_.content("m.ply")));
  expect_error("reconstruct s.ply --weight length", "--weight: 'length' is");
  folder_.file("p.xy", "0 0\n1 0\n0 1\n1 1\n");
  expect_error("reconstruct p.xy --weight area", "is for points in space");
  for (const std::string use : {"reconstruct", "repair"})
    expect_error(use + " m.ply --close paper --weight area",
                 "--weight is for --close best");
}

TEST_F(Command, SaysThatTheTimeWasUp) {
  ASSERT_EQ(run("generate sphere -n 400 --noise 1 -o s.ply").status, 0);
  for (const bool is_short : {true, false}) {
    SCOPED_TRACE(is_short);
    const Finished made = run("reconstruct s.ply --report r.json" +
                              std::string(is_short ? " --time-limit 0" : ""));
    const Json report = Json::parse(folder_.content("r.json"));
    EXPECT_EQ(report["closing"]["timed_out"], is_short);
    EXPECT_EQ(report["surface"]["closed"], true);
    EXPECT_EQ(report["surface"]["manifold"], true);
    EXPECT_EQ(made.status, is_short ? 3 : 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr(is_short ? "manifold, cut short by --time"
                                             : "manifold ("));
  }
}

TEST_F(Command, StopsAfterTheStageAskedFor) {
  ASSERT_EQ(run("generate knot -n 1000 -o knot.ply").status, 0);
  EXPECT_EQ(run("reconstruct knot.ply --stage filter -o f.ply --report f.json")
                .status,
            0);
  const Json report = Json::parse(folder_.content("f.json"));
  EXPECT_EQ(report["surface"]["triangles"], report["filter"]["triangles"]);
  EXPECT_FALSE(report.contains("closing"));
}

TEST_F(Command, ReadsAndWritesStandardStreams) {
  folder_.file("sphere.xyz", run("generate sphere -n 300").out);
  const Finished made = run("reconstruct - --quiet -o -", "sphere.xyz");
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.err, "");
  folder_.file("mesh", made.out);
  EXPECT_EQ(run("check - --points sphere.xyz", "mesh").status, 0);
}

}  // namespace
