// Every criterion, choice of umbrellas and method on analytic surfaces: what
// the first triangles are like, what the closing makes of them, and how far the
// result is from the truth.
//
//   criteria PREFIX [N...]    writes PREFIX.csv and PREFIX.md; N points, 3000

#include "umbrella/criteria.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/shapes.h"
#include "apps/shapes_truth.h"
#include "bench/mesh_distance.h"
#include "umbrella/methods.h"
#include "umbrella/reconstruct.h"
#include "umbrella/umbrella_choice.h"

namespace {

using mesh_distance::Point;

struct DataSet {
  std::string shape;
  std::size_t n_points;
  double noise;  // of the distance between neighbours
  shapes::Truth truth;
  std::vector<Point> points;
  std::vector<Point> surface;  // points of the true surface
};

struct Way {
  std::string name;
  umbrella::ReconstructOptions options;
};

struct Row {
  const DataSet* data;
  std::string way;
  umbrella::Reconstruction result;
  bool is_right = false;  // closed, all points used, genus and components true
  double mean = 0, hausdorff = 0;  // in thousandths of the size of the shape
  double seconds = 0;
};

std::vector<Way> all_ways() {
  std::vector<Way> ways;
  for (const std::string_view name : umbrella::criterion_names()) {
    ways.push_back({std::string(name), {}});
    ways.back().options.criterion = name;
  }
  for (const std::string_view name : umbrella::umbrella_choice_names()) {
    if (name == "first") continue;
    ways.push_back({"paper, " + std::string(name), {}});
    ways.back().options.umbrella = umbrella::umbrella_choice(name);
  }
  for (const umbrella::MethodInfo& method : umbrella::all_methods()) {
    if (method.name == "umbrella") continue;
    ways.push_back({"method " + std::string(method.name), {}});
    ways.back().options.method = method.name;
  }
  return ways;
}

std::vector<DataSet> all_sets(const std::vector<std::size_t>& sizes) {
  std::vector<DataSet> sets;
  for (const shapes::Shape& shape : shapes::all()) {
    if (shape.dimension < 3) continue;
    const auto truth = shapes::truth(shape.name);
    if (!truth) continue;
    for (const std::size_t n : sizes)
      for (const double noise : {0.0, 0.2})
        sets.push_back(
            {std::string(shape.name), n, noise, *truth,
             shapes::sample(shape.name, n, {.noise = noise}),
             shapes::sample(shape.name, 10000, {.seed = 2, .noise = 0})});
  }
  return sets;
}

/// Both ways: from the true surface to the mesh, and from points of its
/// triangles to the true surface. The mean is over the former.
void measure(const DataSet& data, Row& row) {
  Eigen::AlignedBox3d box;
  for (const Point& p : data.surface) box.extend(p);
  const double unit = box.diagonal().norm() / 1000;
  const mesh_distance::Tree tree(data.points, row.result.triangles);
  double sum = 0, largest = 0;
  for (const Point& p : data.surface) {
    const double d = tree.distance(p);
    sum += d;
    largest = std::max(largest, d);
  }
  constexpr int kSteps = 3;
  for (const auto& [a, b, c] : row.result.triangles)
    for (int i = 0; i <= kSteps; ++i)
      for (int k = 0; i + k <= kSteps; ++k) {
        const Point p = (i * data.points[a] + k * data.points[b] +
                         (kSteps - i - k) * data.points[c]) /
                        kSteps;
        largest = std::max(largest, data.truth.distance(p));
      }
  row.mean = sum / static_cast<double>(data.surface.size()) / unit;
  row.hausdorff = largest / unit;
}

Row run(const DataSet& data, const Way& way) {
  Row row{&data, way.name, {}};
  const auto start = std::chrono::steady_clock::now();
  row.result = umbrella::reconstruct(data.points, way.options);
  row.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
          .count();
  const umbrella::SurfaceReport& s = row.result.surface;
  row.is_right =
      s.closed && s.manifold && s.unused_vertices.empty() &&
      s.genus == data.truth.genus &&
      s.components == static_cast<std::size_t>(data.truth.components);
  measure(data, row);
  return row;
}

std::string genus_text(const umbrella::SurfaceReport& surface) {
  return surface.genus ? std::to_string(*surface.genus) : "-";
}

const std::vector<std::string> kColumns = {
    "shape",     "points", "noise",      "method",     "triangles",
    "without",   "holes",  "variables",  "infeasible", "closed",
    "unused",    "genus",  "true genus", "right",      "mean",
    "hausdorff", "seconds"};

/// Three digits, and no exponent.
std::string number(double x) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), x < 100 ? "%.3g" : "%.0f", x);
  return text.data();
}

std::vector<std::string> cells(const Row& row) {
  const auto& n = row.result.counts;
  const auto& closing = row.result.closing;
  const auto& surface = row.result.surface;
  return {row.data->shape,
          std::to_string(row.data->n_points),
          number(row.data->noise),
          row.way,
          std::to_string(n.filter_triangles),
          std::to_string(n.filter_without_umbrella),
          std::to_string(n.holes),
          std::to_string(closing.variables),
          std::to_string(closing.infeasible),
          surface.closed && surface.manifold ? "1" : "0",
          std::to_string(surface.unused_vertices.size()),
          genus_text(surface),
          std::to_string(row.data->truth.genus),
          row.is_right ? "1" : "0",
          number(row.mean),
          number(row.hausdorff),
          number(row.seconds)};
}

void write_line(std::ostream& out, const std::vector<std::string>& texts,
                std::string_view before, std::string_view between,
                std::string_view after) {
  out << before;
  for (std::size_t i = 0; i < texts.size(); ++i)
    out << (i == 0 ? "" : between) << texts[i];
  out << after;
}

void write_markdown_head(std::ostream& out,
                         const std::vector<std::string>& columns) {
  write_line(out, columns, "| ", " | ", " |\n");
  write_line(out, std::vector<std::string>(columns.size(), "---"), "|", "|",
             "|\n");
}

/// Sums over the data sets of one way.
struct Summary {
  std::size_t n = 0, closed = 0, right = 0, without = 0, holes = 0;
  std::size_t variables = 0, infeasible = 0;
  double excess = 0;  // first triangles over those of the true surface
  double mean = 0, hausdorff = 0, seconds = 0;

  void add(const Row& row) {
    const auto& surface = row.result.surface;
    ++n;
    closed += surface.closed && surface.manifold ? 1 : 0;
    right += row.is_right ? 1 : 0;
    without += row.result.counts.filter_without_umbrella;
    holes += row.result.counts.holes;
    variables += row.result.closing.variables;
    infeasible += row.result.closing.infeasible;
    const shapes::Truth& truth = row.data->truth;
    const double triangles = 2.0 * static_cast<double>(row.data->n_points) +
                             4.0 * (truth.genus - truth.components);
    excess +=
        static_cast<double>(row.result.counts.filter_triangles) / triangles;
    mean += row.mean;
    hausdorff += row.hausdorff;
    seconds += row.seconds;
  }

  std::vector<std::string> cells(const std::string& way) const {
    const auto average = [this](double sum) {
      return number(sum / static_cast<double>(n));
    };
    return {way,
            std::to_string(right) + " of " + std::to_string(n),
            std::to_string(closed),
            average(excess),
            average(static_cast<double>(without)),
            average(static_cast<double>(holes)),
            average(static_cast<double>(variables)),
            std::to_string(infeasible),
            average(mean),
            average(hausdorff),
            average(seconds)};
  }
};

void write(const std::string& prefix, const std::vector<Row>& rows,
           const std::vector<Way>& ways) {
  std::ofstream csv(prefix + ".csv");
  write_line(csv, kColumns, "", ",", "\n");
  std::map<std::string, Summary> summaries;
  for (const Row& row : rows) {
    std::vector<std::string> texts = cells(row);
    texts[3] = "\"" + texts[3] + "\"";
    write_line(csv, texts, "", ",", "\n");
    summaries[row.way].add(row);
  }
  std::ofstream markdown(prefix + ".md");
  write_markdown_head(markdown, {"method", "right", "closed", "first triangles",
                                 "without", "holes", "variables", "infeasible",
                                 "mean", "Hausdorff", "seconds"});
  for (const Way& way : ways)
    write_line(markdown, summaries[way.name].cells(way.name), "| ", " | ",
               " |\n");
  markdown << '\n';
  write_markdown_head(markdown, kColumns);
  for (const Row& row : rows)
    write_line(markdown, cells(row), "| ", " | ", " |\n");
  if (!csv.flush() || !markdown.flush())
    throw std::runtime_error("cannot write " + prefix + ".csv or .md");
}

std::vector<std::size_t> sizes(int argc, char** argv) {
  std::vector<std::size_t> result;
  for (int i = 2; i < argc; ++i) {
    const long n = std::strtol(argv[i], nullptr, 10);
    if (n < 4 || n > 10'000'000)
      throw std::invalid_argument("no number of points: " +
                                  std::string(argv[i]));
    result.push_back(static_cast<std::size_t>(n));
  }
  if (result.empty()) result.push_back(3000);
  return result;
}

int criteria(int argc, char** argv) {
  if (argc < 2) throw std::invalid_argument("usage: criteria PREFIX [N...]");
  const std::vector<Way> ways = all_ways();
  const std::vector<DataSet> sets = all_sets(sizes(argc, argv));
  std::vector<Row> rows;
  for (const DataSet& data : sets) {
    for (const Way& way : ways) {
      rows.push_back(run(data, way));
      write_line(std::cerr, cells(rows.back()), "", " ", "\n");
    }
  }
  write(argv[1], rows, ways);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return criteria(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "criteria: " << error.what() << '\n';
    return 2;
  }
}
