/// @file
/// A mesh as a page that a browser shows.
#pragma once

#include <span>
#include <string>

#include "io/mesh.h"

namespace command {

/// A page that holds all it needs: no other file and no network. The mesh is
/// in it moved and scaled into a cube of side 2, as floats.
///
/// @param title   of the page; plain text
/// @param lambda  one a triangle, for colours, or none
std::string viewer_page(const std::string& title, const io::Mesh& mesh,
                        std::span<const double> lambda = {});

}  // namespace command
