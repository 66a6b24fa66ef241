/// @file
/// What the two sides of rooms force.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "ilp/antecedents.h"
#include "ilp/assignment.h"
#include "ilp/problem.h"

namespace ilp {

/// Rooms whose relative sides are known form a group; a wall with a value
/// merges the groups of its two rooms. Taking back is in reverse order.
class Sides {
 public:
  explicit Sides(const Problem& problem);

  /// Assigns the walls between a room and itself. @return false on a conflict
  bool start(Assignment& assignment, Conflict& conflict);

  /// Merges by a literal that holds, once, and assigns what follows.
  /// @return false on a conflict
  bool propagate(Literal l, Assignment& assignment, Conflict& conflict) {
    return walls_.empty() || follow(l, assignment, conflict);
  }
  /// Takes back the merging by l, if any.
  void undo(Literal l) {
    if (!merges_.empty()) unfollow(l);
  }

  /// Appends the literals that imply l by its reason, a wall.
  void explain(Literal l, const Assignment& assignment,
               std::vector<Literal>& out) const;
  Antecedent origin(const Reason& reason) const;

 private:
  // The side of a room relative to the first room of its group.
  struct Room {
    std::uint32_t group;
    std::uint32_t side;  // 0 or 1
  };

  // `group` became part of another; the sides of its rooms changed by `flip`.
  struct Merge {
    std::uint32_t wall;
    std::uint32_t group;
    std::uint32_t flip;
  };

  bool follow(Literal l, Assignment& assignment, Conflict& conflict);
  void unfollow(Literal l);
  bool settle(std::uint32_t wall, Assignment& assignment,
              Conflict& conflict) const;
  void merge(std::uint32_t wall, bool value);
  void unmerge();
  void move_group(const Merge& m, std::uint32_t to);
  void plant(std::uint32_t room, std::uint32_t wall);
  std::size_t depth(std::uint32_t room) const;
  void append_path(std::uint32_t wall, const Assignment& assignment,
                   std::vector<Literal>& out) const;
  std::pair<std::uint32_t, std::uint32_t> ends(std::uint32_t wall) const {
    return {walls_[wall].a, walls_[wall].b};
  }
  template <class Visit>
  void for_each_room(std::uint32_t group, Visit visit) const {
    std::uint32_t room = group;
    do {
      visit(room);
      room = next_[room];
    } while (room != group);
  }

  std::vector<Wall> walls_;  // rooms of different constraints are different
  std::vector<std::uint32_t> constraint_of_;  // by wall
  Rows<std::uint32_t> walls_of_variable_;
  Rows<std::uint32_t> walls_of_room_;

  std::vector<Room> rooms_;
  std::vector<std::uint32_t> next_;  // circular list of each group
  std::vector<std::uint32_t> size_;  // by group, called after its first room
  // The merging walls are a forest over the rooms: the first wall on the way
  // to the root, by room.
  std::vector<std::uint32_t> way_;
  std::vector<Merge> merges_;
  std::vector<std::uint32_t> enclosed_;  // scratch
};

}  // namespace ilp
