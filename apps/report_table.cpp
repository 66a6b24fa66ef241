#include "apps/report_table.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <iomanip>
#include <istream>
#include <sstream>
#include <stdexcept>

namespace report_table {
namespace {

using nlohmann::json;

enum class Align { Left, Right };

struct Column {
  std::string heading;
  Align align;
  std::function<std::string(const Row&)> cell;
};

Column paper(const std::string& heading, std::string PaperRow::*field) {
  return {heading, Align::Right,
          [field](const Row& row) { return row.paper.*field; }};
}

// The value at a JSON pointer as it is written, "" where there is none or null.
std::string text_at(const json& report, const char* pointer) {
  const json::json_pointer where(pointer);
  if (!report.contains(where) || report.at(where).is_null()) return "";
  return report.at(where).dump();
}

Column ours(const std::string& heading, const char* pointer) {
  return {heading, Align::Right,
          [pointer](const Row& row) { return text_at(row.report, pointer); }};
}

Column seconds(const std::string& stage) {
  const json::json_pointer where("/seconds/" + stage);
  return {stage, Align::Right, [where](const Row& row) {
            if (!row.report.contains(where)) return std::string();
            std::ostringstream text;
            text << std::fixed << std::setprecision(3)
                 << row.report.at(where).get<double>();
            return text.str();
          }};
}

// "closed", or what keeps the surface from it; then the points left out.
std::string verdict(const Row& row) {
  if (!row.report.contains("surface")) return "";
  const json& surface = row.report.at("surface");
  std::string text = "closed";
  if (!surface.value("closed", false)) {
    text = "open, " + text_at(surface, "/boundary_edges") + " boundary edges";
  } else if (!surface.value("manifold", false)) {
    text = "not manifold";
  }
  const std::size_t n_unused =
      surface.value("unused_points", json::array()).size();
  if (n_unused > 0) text += ", " + std::to_string(n_unused) + " points unused";
  return text;
}

// The column's cells, one a row; none if all are empty.
std::vector<std::string> cells_of(const Column& column,
                                  const std::vector<Row>& rows) {
  std::vector<std::string> cells(rows.size());
  std::ranges::transform(rows, cells.begin(), column.cell);
  const auto is_empty = [](const std::string& s) { return s.empty(); };
  if (std::ranges::all_of(cells, is_empty)) return {};
  for (std::string& cell : cells)
    if (cell.empty()) cell.push_back('-');
  return cells;
}

// One string a line of the table, to which the columns are appended in turn:
// the headings, the rule below them, the rows.
std::string render(const std::vector<Row>& rows,
                   const std::vector<Column>& columns) {
  std::vector<std::string> lines(rows.size() + 2);
  for (const Column& column : columns) {
    std::vector<std::string> cells = cells_of(column, rows);
    if (cells.empty()) continue;
    const bool is_left = column.align == Align::Left;
    std::size_t width = column.heading.size();
    for (const std::string& cell : cells) width = std::max(width, cell.size());

    cells.insert(cells.begin(), {column.heading, std::string(width - 1, '-')});
    cells[1].insert(is_left ? 0 : width - 1, ":");
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string gap(width - cells[i].size(), ' ');
      lines[i] += "| " + (is_left ? cells[i] + gap : gap + cells[i]) + ' ';
    }
  }
  std::string table;
  for (const std::string& line : lines) table += line + "|\n";
  return table;
}

json read_report(const std::string& path) {
  std::ifstream file(path);
  json report = json::parse(file, nullptr, /*allow_exceptions=*/false);
  if (!report.is_object())
    throw std::invalid_argument(path + ": not the report of a run");
  return report;
}

}  // namespace

std::vector<Row> read_rows(std::istream& in) {
  std::vector<Row> rows;
  std::string line;
  std::getline(in, line);  // headings
  for (int number = 2; std::getline(in, line); ++number) {
    std::istringstream cells(line);
    std::vector<std::string> c;
    for (std::string cell; std::getline(cells, cell, '\t');)
      c.push_back(cell == "-" ? "" : cell);
    if (c.size() != 8)
      throw std::invalid_argument("line " + std::to_string(number) + ": " +
                                  std::to_string(c.size()) +
                                  " cells instead of 8");
    rows.push_back({c[0],
                    c[6],
                    {c[1], c[2], c[3], c[4], c[5]},
                    c[7].empty() ? json() : read_report(c[7])});
  }
  return rows;
}

std::string counts_table(const std::vector<Row>& rows) {
  return render(
      rows, {{"object", Align::Left, [](const Row& row) { return row.object; }},
             {"set", Align::Left, [](const Row& row) { return row.set; }},
             paper("points, paper", &PaperRow::points),
             ours("points, ours", "/input/points"),
             paper("filter, paper", &PaperRow::filter_triangles),
             ours("filter, ours", "/filter/triangles"),
             paper("closed, paper", &PaperRow::closed_triangles),
             ours("closed, ours", "/surface/triangles"),
             ours("genus", "/surface/genus"),
             {"surface", Align::Left, verdict}});
}

std::string seconds_table(const std::vector<Row>& rows) {
  std::vector<Column> columns = {
      {"object", Align::Left, [](const Row& row) { return row.object; }},
      paper("filter, paper", &PaperRow::filter_seconds),
      paper("total, paper", &PaperRow::total_seconds)};
  for (const char* stage :
       {"read", "delaunay", "lambda", "filter", "clean_up", "holes", "closing",
        "surface", "certificate", "write", "total"})
    columns.push_back(seconds(stage));
  return render(rows, columns);
}

}  // namespace report_table
