/// @file
/// The exact stages, instantiated for each predicate in exact.cpp and
/// expansion.cpp.
#pragma once

#include <optional>

#include "predicates/polynomial_internal.h"

namespace predicates::internal {

/// By integers wide enough for the exponents at hand.
template <class Predicate>
int wide_integer_sign(const Points<Predicate::kPoints>& p);

/// The quickest exact stage that takes these points.
template <class Predicate>
int exact_sign(const Points<Predicate::kPoints>& p);

/// Stages B, C and D of [Shewchuk97, Sec. 4]; nullopt where a term could
/// overflow or lose bits to underflow. Not part of exact_sign
/// (docs/decisions/exact_stage.md): an independent check of the integers.
template <class Predicate>
std::optional<int> adaptive_expansion_sign(const Points<Predicate::kPoints>& p);

/// Stage D alone.
template <class Predicate>
std::optional<int> expansion_sign(const Points<Predicate::kPoints>& p);

}  // namespace predicates::internal
