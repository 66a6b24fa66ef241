/// @file
/// Reports of the `umbrella` command beside the paper's Table 2, as Markdown.
#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace report_table {

/// What the paper printed for an object [Adamy02, Table 2]; empty cells where
/// the object is not the paper's.
struct PaperRow {
  std::string points;
  std::string filter_triangles;
  std::string filter_seconds;
  std::string closed_triangles;
  std::string total_seconds;
};

/// One object, the set that stood for it and the report of its run; without a
/// run `report` is null.
struct Row {
  std::string object;
  std::string set;
  PaperRow paper;
  nlohmann::json report;
};

/// Reads rows of tab-separated cells below one line of headings:
/// object, points, filter_triangles, filter_seconds, closed_triangles,
/// total_seconds, set, report. A `-` is an empty cell; `report` names a file.
///
/// @throws std::invalid_argument  a line with another number of cells, or a
///   report that cannot be read (names the line or the file)
std::vector<Row> read_rows(std::istream& in);

/// Points and triangles, and what surface came out. Columns without any cell
/// are left out; what a report lacks is printed as `-`.
std::string counts_table(const std::vector<Row>& rows);

/// Wall-clock seconds of each stage and in total.
std::string seconds_table(const std::vector<Row>& rows);

}  // namespace report_table
