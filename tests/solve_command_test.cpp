// umbrella solve as a user meets it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/command_run.h"
#include "tests/support/temporary_folder.h"

namespace {

using support::Finished;
using ::testing::HasSubstr;
using ::testing::Not;

class SolveCommand : public ::testing::Test {
 protected:
  Finished run(const std::string& arguments) const {
    return support::run_command(folder_, "solve " + arguments);
  }

  support::TemporaryFolder folder_;
};

constexpr const char* kKnapsack =
    "min: -10 x1 -13 x2 -7 x3 ;\n3 x1 +4 x2 +2 x3 <= 6 ;\n";
constexpr const char* kContradiction = "x1 +x2 >= 1;\nx1 +x2 <= 0;\n";

TEST_F(SolveCommand, PrintsTheOptimumAndProvesIt) {
  folder_.file("p.opb", kKnapsack);
  const Finished found = run("p.opb --proof p.log");
  EXPECT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.out, HasSubstr("\no -20\n"));
  EXPECT_THAT(found.out, HasSubstr("\ns OPTIMUM FOUND\nv -x1 x2 x3\n"));
  const Finished checked = run("p.opb --check-proof p.log");
  EXPECT_EQ(checked.status, 0);
  EXPECT_THAT(checked.out, HasSubstr("\no -20\ns VERIFIED OPTIMUM\n"));
}

TEST_F(SolveCommand, ProvesThatThereIsNoModel) {
  folder_.file("p.opb", kContradiction);
  const Finished found = run("p.opb --proof p.log");
  EXPECT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.out, HasSubstr("\ns UNSATISFIABLE\n"));
  EXPECT_THAT(run("p.opb --check-proof p.log").out,
              HasSubstr("\ns VERIFIED UNSATISFIABLE\n"));

  folder_.file("other.opb", kKnapsack);
  const Finished wrong = run("other.opb --check-proof p.log");
  EXPECT_EQ(wrong.status, 3);
  EXPECT_THAT(wrong.out, HasSubstr("\ns NOT VERIFIED\n"));
  folder_.file("empty.log", "");
  EXPECT_EQ(run("other.opb --check-proof empty.log").status, 3);
}

TEST_F(SolveCommand, SaysThatALimitCameFirst) {
  folder_.file("p.opb",
               "min: -10 x1 -13 x2 -7 x3 -8 x4 -12 x5 -4 x6 ;\n"
               "3 x1 +4 x2 +2 x3 +3 x4 +4 x5 +1 x6 <= 9 ;\n"
               "x1 +x2 +x5 <= 2 ;\nx3 +~x6 >= 1 ;\n");
  const Finished some = run("p.opb --conflicts 0");
  EXPECT_EQ(some.status, 3);
  EXPECT_THAT(some.out, HasSubstr("\ns SATISFIABLE\nv "));
  EXPECT_EQ(run("p.opb --time-limit 0").status, 3);
  EXPECT_THAT(folder_.content("out"), HasSubstr("\ns UNKNOWN\n"));
}

TEST_F(SolveCommand, WritesTheProgramInOtherFormats) {
  folder_.file("p.opb", kKnapsack);
  EXPECT_EQ(
      run("p.opb --write-opb q.opb --write-lp q.lp --write-mps q.mps").status,
      0);
  EXPECT_THAT(folder_.content("q.lp"), HasSubstr("Subject To"));
  EXPECT_THAT(folder_.content("q.mps"), HasSubstr("ENDATA"));
  EXPECT_THAT(run("q.opb").out, HasSubstr("\no -20\n"));

  folder_.file("shifted.opb", "min: 3 ~x1 ;\nx1 >= 0 ;\n");
  EXPECT_THAT(run("shifted.opb --write-opb q.opb").out,
              HasSubstr("leave out the constant 3 of the sum\n"));
  EXPECT_THAT(run("shifted.opb").out, Not(HasSubstr("constant")));
}

TEST_F(SolveCommand, RefusesBadInputInOneLine) {
  folder_.file("p.opb", "1 x1 >= ;\n");
  const Finished wrong = run("p.opb");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(wrong.err,
            "umbrella: error: p.opb:1:9: expected a number, not what stands "
            "here\n");
  EXPECT_EQ(run("missing.opb").status, 2);
  folder_.file("empty.opb", "");
  EXPECT_EQ(run("empty.opb").status, 2);
  EXPECT_THAT(folder_.content("err"), HasSubstr("the file is empty"));
  folder_.file("q.opb", kKnapsack);
  EXPECT_EQ(run("q.opb --proof missing/p.log").status, 2);
  for (const std::string wrong_options :
       {"--proof a --check-proof b", "--proof -", "--write-lp -",
        "--write-mps ''", "--time-limit nan", "--time-limit -1",
        "--conflicts -1"})
    EXPECT_EQ(run("q.opb " + wrong_options).status, 2) << wrong_options;
}

TEST_F(SolveCommand, OverwritesNothingThatItReads) {
  folder_.file("p.opb", kKnapsack);
  folder_.file("p.log", "");
  for (const std::string arguments :
       {"p.opb --proof p.opb", "p.opb --write-opb ./p.opb",
        "p.opb --check-proof p.log --write-lp p.log",
        "p.opb --proof q --write-mps q"})
    EXPECT_EQ(run(arguments).status, 2) << arguments;
  EXPECT_EQ(folder_.content("p.opb"), kKnapsack);
  EXPECT_EQ(folder_.content("p.log"), "");
}

}  // namespace
