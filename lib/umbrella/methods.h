/// @file
/// Ways to get from a Delaunay triangulation to candidates for the surface, by
/// name: what the clean-up and the closing start from.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "delaunay/triangulation3.h"
#include "umbrella/circumspheres.h"
#include "umbrella/filter.h"
#include "umbrella/triangle.h"

namespace umbrella {

/// What a name stands for; the numbers are its parameters, as many as it has.
struct MethodInfo {
  std::string_view name;
  std::string_view parameters;  ///< "alpha", "lower:upper"; empty if none
  std::string_view description;
};

/// "umbrella", the paper's filter, first.
std::span<const MethodInfo> all_methods();

struct Method {
  std::string_view name = "umbrella";  ///< as in all_methods()
  std::array<double, 2> parameters = {};

  bool is_umbrella() const { return name == "umbrella"; }
};

/// "crust", "alpha=0.1", "gamma=-0.2:0.4": a name, and for another choice than
/// the usual one its parameters.
///
/// @throws std::invalid_argument  no such method, or parameters that are no
///   numbers, too few or many, or out of range
Method parse_method(std::string_view text);

/// The triangles of a method other than the filter, ascending by corners.
std::vector<LocatedTriangle> method_triangles(
    const Method& method, const delaunay::Triangulation3& triangulation,
    const Circumspheres& spheres);

/// The same as if the filter had chosen them: ranked as the paper does, for the
/// clean-up, with the vertices around which they hold no umbrella.
///
/// @param triangulation  must outlive the triangles' order
FilterResult method_filter(const Method& method,
                           const delaunay::Triangulation3& triangulation,
                           const Circumspheres& spheres);

}  // namespace umbrella
