/// @file
/// The order in which the vertices of a mesh are inserted.
#pragma once

#include <vector>

#include "delaunay/mesh3_internal.h"

namespace delaunay {

/// All vertices, in rounds: each a pseudo-random choice of those not in a round
/// before it, and many times as large [Amenta03]. Within a round they ascend,
/// unless the sites fill an eighth of the blocks of a lattice that they lie in
/// (16 x 16 x 16 places each); then they follow one another so that few cells
/// have to be made. Depends on the sites alone.
std::vector<std::vector<VertexId>> insertion_rounds(const Mesh3& mesh);

}  // namespace delaunay
