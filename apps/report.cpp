#include "apps/report.h"

#include <algorithm>

#include "build_info.h"

namespace report {
namespace {

std::string value_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  constexpr std::size_t kShown = 8;
  std::string out = std::to_string(value.size());
  for (std::size_t i = 0; i < std::min(value.size(), kShown); ++i)
    out += (i == 0 ? ": " : ", ") + value_text(value[i]);
  return out + (value.size() > kShown ? ", ..." : "");
}

}  // namespace

Json surface(const umbrella::SurfaceReport& report, std::size_t points_used,
             const std::vector<std::uint32_t>& unused_rows) {
  Json json = {{"vertices", report.vertices},
               {"triangles", report.triangles},
               {"euler", report.euler},
               {"genus", report.genus ? Json(*report.genus) : Json(nullptr)},
               {"components", report.components},
               {"boundary_edges", report.boundary_edges},
               {"nonmanifold_edges", report.nonmanifold_edges},
               {"nonmanifold_vertices", report.nonmanifold_vertices},
               {"degenerate_triangles", report.degenerate_triangles},
               {"duplicate_triangles", report.duplicate_triangles},
               {"closed", report.closed},
               {"manifold", report.manifold},
               {"orientable", report.orientable},
               {"oriented", report.oriented},
               {"outward", report.outward},
               {"area", report.area},
               {"volume", report.volume},
               {"points_used", points_used},
               {"unused_points", unused_rows}};
  return json;
}

Json curve(const umbrella::CurveReport& report, std::size_t points_used,
           const std::vector<std::uint32_t>& unused_rows) {
  return {{"vertices", report.vertices},
          {"edges", report.edges},
          {"components", report.components},
          {"ends", report.ends},
          {"branchings", report.branchings},
          {"degenerate_edges", report.degenerate_edges},
          {"duplicate_edges", report.duplicate_edges},
          {"closed", report.closed},
          {"manifold", report.manifold},
          {"points_used", points_used},
          {"unused_points", unused_rows}};
}

void add_build(Json& json) {
  json["version"] = build_info::kVersion;
  json["build"] = {{"compiler", build_info::kCompiler},
                   {"flags", build_info::kFlags}};
}

std::string lines(const Json& json) {
  constexpr std::size_t kColumn = 28;
  std::string out;
  for (const auto& [key, value] : json.items()) {
    if (value.is_object()) {
      out += key + "\n" + lines(value);
      continue;
    }
    std::string label = "  " + key;
    label.resize(std::max(kColumn, label.size() + 1), ' ');
    out += label + value_text(value) + "\n";
  }
  return out;
}

// File names may hold any byte; JSON holds UTF-8 alone.
std::string text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace report
