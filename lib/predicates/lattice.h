/// @file
/// Predicates for points that all lie on a lattice, as those of integer grids
/// and quantised scans do.
#pragma once

namespace predicates {

/// All coordinates are multiples of a power of two, the unit. Where they differ
/// by few units, doubles hold every intermediate result of a determinant, by
/// some more native integers do (docs/math.md, "Lattices"), and the tie-break
/// needs no more than those.
class Lattice {
 public:
  /// No lattice: every test is as without this class.
  Lattice() = default;
  /// @param unit  a power of two from 2^-150 to 2^150
  explicit Lattice(double unit) : unit_(unit) {}

  /// The same signs as of the functions of these names.
  int orient3d(const double* a, const double* b, const double* c,
               const double* d) const;
  int insphere_perturbed(const double* a, const double* b, const double* c,
                         const double* d, const double* e) const;

 private:
  double unit_ = 0;
};

}  // namespace predicates
