/// @file
/// Literals that came to hold later than they might have.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "ilp/assignment.h"

namespace ilp {

/// A clause that would force its literal far below the present level is not
/// worth taking back all levels between [Nadel18]. So the literal comes late,
/// and is to hold again as long as the level stays at which it was known.
class LateLiterals {
 public:
  /// The last literal of the trail is known at a level below.
  void note(Literal l, std::uint32_t known_at) {
    late_.push_back({l, {}, known_at});
  }

  struct Late {
    Literal literal;
    Reason reason;
    std::uint32_t known_at;
  };
  /// To be called before the literals from a place in the trail on are taken
  /// back, down to a level. @return the late ones that still hold there
  std::vector<Late> take(const Assignment& assignment, std::size_t place,
                         std::uint32_t level) {
    const auto first =
        std::ranges::partition_point(late_, [&](const Late& late) {
          return assignment.position(late.literal.var()) < place;
        });
    std::vector<Late> known;
    std::copy_if(first, late_.end(), std::back_inserter(known),
                 [level](const Late& late) { return late.known_at <= level; });
    for (Late& late : known)
      late.reason = assignment.reason(late.literal.var());
    late_.erase(first, late_.end());
    return known;
  }

 private:
  std::vector<Late> late_;  // as they come in the trail
};

}  // namespace ilp
