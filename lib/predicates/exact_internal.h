/// @file
/// The exact stages: right for all finite doubles. Instantiated in exact.cpp
/// for each predicate.
#pragma once

#include "predicates/polynomial_internal.h"

namespace predicates::internal {

/// By integers wide enough for the exponents at hand.
template <class Predicate>
int wide_integer_sign(const Points<Predicate::kPoints>& p);

/// The quickest exact stage that takes these points.
template <class Predicate>
int exact_sign(const Points<Predicate::kPoints>& p);

}  // namespace predicates::internal
