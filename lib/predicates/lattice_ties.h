/// @file
/// The tie-break of insphere for points of a lattice that are few units apart
/// and known to be cospherical: on integer grids almost all of them.
#pragma once

#include <bit>
#include <cstdint>

namespace predicates {

static_assert(std::endian::native == std::endian::little);

/// A point of a lattice in four numbers of 16 bits, modulo 2^16: in the lowest
/// bits x, in units, then y and z, then 2^10 x + 2^5 y + z, by which points few
/// units apart compare in lexicographic order.
enum class LatticePoint : std::uint64_t {};

/// @param unit  a power of two that divides the coordinates at most 2^62 times
inline LatticePoint lattice_point(const double* q, double unit) {
  const auto multiple = [&](int i) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(q[i] / unit));
  };
  const std::uint64_t x = multiple(0), y = multiple(1), z = multiple(2);
  constexpr std::uint64_t kLow = 0xffff;
  return LatticePoint{(x & kLow) | (y & kLow) << 16U | (z & kLow) << 32U |
                      ((x << 10U) + (y << 5U) + z) << 48U};
}

/// A query point e of insphere_perturbed.
class LatticeTies {
 public:
  /// Radius in units up to which all numbers fit 16 bits (docs/math.md, "Ties
  /// on lattices").
  static constexpr double kReach = 8;

  explicit LatticeTies(LatticePoint e) : e_(side_by_side(e, e)) {}

  /// Whether insphere_perturbed(a, b, c, d, e) is 1.
  /// @pre a, b, c, d are a positive simplex, all five points on one sphere of
  ///   a radius of at most kReach units, and e is none of the others
  bool is_inside(LatticePoint a, LatticePoint b, LatticePoint c,
                 LatticePoint d) const {
    const Words ac = side_by_side(a, c) - e_;
    const Words bd = side_by_side(b, d) - e_;
    const Words normals = halves_swapped(cross(ac, bd));  // c x d, a x b
    // The weights of the corners' raises: det(b, c, d), -det(a, c, d),
    // det(a, b, d), -det(a, b, c).
    const Signed weight_ac = dot(bd, normals);
    const Signed minus_weight_bd = dot(ac, normals);
    const Signed place_ac = last(ac);
    const Signed place_bd = last(bd);
    const Signed raises =
        max((weight_ac > 0) & place_ac, (minus_weight_bd < 0) & place_bd);
    const Signed lowers =
        max((weight_ac < 0) & place_ac, (minus_weight_bd > 0) & place_bd);
    return largest(raises) > largest(lowers);
  }

 private:
  /// Of a point each half, as LatticePoint has it.
  using Words [[gnu::vector_size(16)]] = std::uint16_t;
  /// A number in the first place of each half, and anything in the others.
  using Signed [[gnu::vector_size(16)]] = std::int16_t;
  using Pairs [[gnu::vector_size(16)]] = std::uint32_t;
  using Halves [[gnu::vector_size(16)]] = std::uint64_t;

  static Words side_by_side(LatticePoint p, LatticePoint q) {
    return std::bit_cast<Words>(
        Halves{static_cast<std::uint64_t>(p), static_cast<std::uint64_t>(q)});
  }
  template <class Vector>
  static Vector halves_swapped(Vector w) {
    return __builtin_shufflevector(w, w, 4, 5, 6, 7, 0, 1, 2, 3);
  }
  static Words yzx(Words w) {
    return __builtin_shufflevector(w, w, 1, 2, 0, 3, 5, 6, 4, 7);
  }
  static Signed max(Signed p, Signed q) { return p > q ? p : q; }

  /// With 0 in the last place.
  static Words cross(Words p, Words q) { return yzx(p * yzx(q) - yzx(p) * q); }
  static Signed last(Words w) {
    return std::bit_cast<Signed>(std::bit_cast<Halves>(w) >> 48U);
  }
  /// @param q  with 0 in the last place
  static Signed dot(Words p, Words q) {
    const Words terms = p * q;
    const Words two =
        terms + std::bit_cast<Words>(std::bit_cast<Pairs>(terms) >> 16U);
    return std::bit_cast<Signed>(
        two + std::bit_cast<Words>(std::bit_cast<Halves>(two) >> 32U));
  }
  /// Of the first number of each half. No less than 0: weights of both signs
  /// occur, as the query is outside the simplex, so one is masked.
  static std::int16_t largest(Signed w) { return max(w, halves_swapped(w))[0]; }

  Words e_;
};

}  // namespace predicates
