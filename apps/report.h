/// @file
/// The reports of the command as JSON, and as lines for people.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "umbrella/certificate.h"

namespace report {

using Json = nlohmann::ordered_json;  // keys stay in the order of the text

/// The key `surface`; the last two are what the caller knows of its points.
Json surface(const umbrella::SurfaceReport& report, std::size_t points_used,
             const std::vector<std::uint32_t>& unused_rows);
Json curve(const umbrella::CurveReport& report, std::size_t points_used,
           const std::vector<std::uint32_t>& unused_rows);

/// {version, build}
void add_build(Json& json);

/// A line `key value` per member, keys indented; of a list its length and its
/// first values; objects within objects as sections.
std::string lines(const Json& json);

/// Indented text with a line feed at the end.
std::string text(const Json& json);

}  // namespace report
