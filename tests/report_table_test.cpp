#include "apps/report_table.h"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace report_table {
namespace {

using nlohmann::json;

Row knot() {
  return {"KNOT",
          "knot of 10000",
          {"10000", "20396", "33", "20000", "42"},
          {{"input", {{"points", 10001}}},
           {"filter", {{"triangles", 20397}}},
           {"surface",
            {{"triangles", 20002},
             {"genus", 1},
             {"closed", true},
             {"manifold", true},
             {"unused_points", json::array()}}},
           {"seconds", {{"delaunay", 0.0614}, {"total", 1.25}}}}};
}

// Cells of line `index` of a table, without the blanks around them.
std::vector<std::string> cells(const std::string& table, int index) {
  std::istringstream lines(table);
  std::string line;
  for (int i = 0; i <= index; ++i) std::getline(lines, line);
  std::vector<std::string> cells;
  std::istringstream text(line.substr(1));
  for (std::string cell; std::getline(text, cell, '|');) {
    const auto begin = cell.find_first_not_of(' ');
    cells.push_back(cell.substr(begin, cell.find_last_not_of(' ') - begin + 1));
  }
  return cells;
}

using Cells = std::vector<std::string>;

TEST(ReportTable, PutsThePaperBesideOurs) {
  const std::string table = counts_table({knot()});
  EXPECT_EQ(cells(table, 0),
            (Cells{"object", "set", "points, paper", "points, ours",
                   "filter, paper", "filter, ours", "closed, paper",
                   "closed, ours", "genus", "surface"}));
  EXPECT_EQ(cells(table, 2),
            (Cells{"KNOT", "knot of 10000", "10000", "10001", "20396", "20397",
                   "20000", "20002", "1", "closed"}));
}

TEST(ReportTable, ShowsNoGenusOfAnOpenSurface) {
  Row open = knot();
  open.report["surface"]["genus"] = nullptr;
  EXPECT_EQ(cells(counts_table({knot(), open}), 3)[8], "-");
}

TEST(ReportTable, LeavesOutTheColumnsThatNobodyFills) {
  const std::string table = seconds_table({knot()});
  EXPECT_EQ(cells(table, 0), (Cells{"object", "filter, paper", "total, paper",
                                    "delaunay", "total"}));
  EXPECT_EQ(cells(table, 2), (Cells{"KNOT", "33", "42", "0.061", "1.250"}));
}

TEST(ReportTable, PrintsADashForARunThatIsMissing) {
  Row missing = knot();
  missing.report = nullptr;
  const std::string table = counts_table({knot(), missing});
  EXPECT_EQ(cells(table, 3), (Cells{"KNOT", "knot of 10000", "10000", "-",
                                    "20396", "-", "20000", "-", "-", "-"}));
}

TEST(ReportTable, SaysWhatKeepsASurfaceFromBeingClosed) {
  const auto verdict_of = [](const json& change) {
    Row row = knot();
    row.report["surface"].update(change);
    return cells(counts_table({row}), 2).back();
  };
  EXPECT_EQ(verdict_of({{"closed", false}, {"boundary_edges", 7}}),
            "open, 7 boundary edges");
  EXPECT_EQ(verdict_of({{"manifold", false}}), "not manifold");
  EXPECT_EQ(verdict_of({{"unused_points", {4, 9}}}), "closed, 2 points unused");
}

TEST(ReportTable, KeepsEveryLineAsLongAsTheFirst) {
  Row longer = knot();
  longer.set = "a name longer than its heading";
  for (const std::string& table :
       {counts_table({knot(), longer}), seconds_table({knot(), longer})}) {
    std::istringstream lines(table);
    std::string first, line;
    std::getline(lines, first);
    while (std::getline(lines, line)) EXPECT_EQ(line.size(), first.size());
  }
}

TEST(ReportTable, ReadsAMissingRunAsNull) {
  std::istringstream in("headings\nKNOT\t10\t20\t1\t30\t2\t-\t-\n");
  const std::vector<Row> rows = read_rows(in);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].object, "KNOT");
  EXPECT_EQ(rows[0].set, "");
  EXPECT_EQ(rows[0].paper.points, "10");
  EXPECT_EQ(rows[0].paper.filter_triangles, "20");
  EXPECT_EQ(rows[0].paper.filter_seconds, "1");
  EXPECT_EQ(rows[0].paper.closed_triangles, "30");
  EXPECT_EQ(rows[0].paper.total_seconds, "2");
  EXPECT_TRUE(rows[0].report.is_null());
}

TEST(ReportTable, RefusesALineWithTooFewCellsAndAReportThatIsNone) {
  std::istringstream too_short("headings\nKNOT\t10\n");
  EXPECT_THROW(read_rows(too_short), std::invalid_argument);
  std::istringstream no_report("headings\nA\t-\t-\t-\t-\t-\tset\tno/such\n");
  EXPECT_THROW(read_rows(no_report), std::invalid_argument);
}

}  // namespace
}  // namespace report_table
