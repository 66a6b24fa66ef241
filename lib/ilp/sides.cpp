// Rooms on two sides are a system of equations over GF(2), one for each wall:
// side(a) + side(b) = value (+ 1). What follows from the walls that have a
// value is read off their groups, as in union-find, but with labels written out
// and the smaller group relabelled, so that merging can be taken back. The
// merging walls form a forest; the tree path between the rooms of a wall
// explains its value, and later merging never alters it.

#include "ilp/sides.h"

#include <algorithm>
#include <utility>

namespace ilp {
namespace {

constexpr std::uint32_t kNone = 0xffff'ffffU;

Reason wall_reason(std::uint32_t wall) {
  return {Reason::Kind::Sides, wall, {}};
}

}  // namespace

Sides::Sides(const Problem& problem) {
  std::uint32_t n_rooms = 0;
  for (std::uint32_t s = 0; s < problem.n_sides(); ++s) {
    const std::uint32_t first = n_rooms;
    for (Wall w : problem.sides(s)) {
      w.a += first;
      w.b += first;
      n_rooms = std::max({n_rooms, w.a + 1, w.b + 1});
      walls_.push_back(w);
      constraint_of_.push_back(s);
    }
  }
  const auto half = [](std::size_t i) {
    return static_cast<std::uint32_t>(i / 2);
  };
  const auto itself = [](std::size_t i) {
    return static_cast<std::uint32_t>(i);
  };
  walls_of_variable_ = Rows<std::uint32_t>::grouped(
      problem.n_variables(), walls_.size(),
      [this](std::size_t i) { return index(walls_[i].var); }, itself);
  walls_of_room_ = Rows<std::uint32_t>::grouped(
      n_rooms, 2 * walls_.size(),
      [this](std::size_t i) {
        return i % 2 == 0 ? walls_[i / 2].a : walls_[i / 2].b;
      },
      half);
  for (std::uint32_t r = 0; r < n_rooms; ++r) {
    rooms_.push_back({r, 0});
    next_.push_back(r);
  }
  size_.assign(n_rooms, 1);
  way_.assign(n_rooms, kNone);
}

bool Sides::start(Assignment& assignment, Conflict& conflict) {
  for (std::uint32_t w = 0; w < walls_.size(); ++w)
    if (walls_[w].a == walls_[w].b && !settle(w, assignment, conflict))
      return false;
  return true;
}

bool Sides::follow(Literal l, Assignment& assignment, Conflict& conflict) {
  for (const std::uint32_t w : walls_of_variable_[index(l.var())]) {
    const auto [a, b] = ends(w);
    if (rooms_[a].group != rooms_[b].group) merge(w, l.value());
  }
  for (const std::uint32_t w : enclosed_)
    if (!settle(w, assignment, conflict)) {
      enclosed_.clear();
      return false;
    }
  enclosed_.clear();
  return true;
}

// The rooms of the wall are in one group, so the wall has a value.
bool Sides::settle(std::uint32_t wall, Assignment& assignment,
                   Conflict& conflict) const {
  const Wall& w = walls_[wall];
  const bool differ = rooms_[w.a].side != rooms_[w.b].side;
  const Literal l(w.var, differ != w.inverted);
  if (assignment.is_open(w.var)) assignment.assign(l, wall_reason(wall));
  if (assignment.holds(l)) return true;
  conflict = {wall_reason(wall), {!l}};
  append_path(wall, assignment, conflict.literals);
  return false;
}

// Also collects the walls that are now within one group.
void Sides::merge(std::uint32_t wall, bool value) {
  auto [a, b] = ends(wall);
  if (size_[rooms_[a].group] > size_[rooms_[b].group]) std::swap(a, b);
  const Room to = rooms_[b];
  const std::uint32_t differ = value != walls_[wall].inverted ? 1 : 0;
  const Merge m{wall, rooms_[a].group, rooms_[a].side ^ to.side ^ differ};
  move_group(m, to.group);
  for_each_room(m.group, [&](std::uint32_t room) {
    for (const std::uint32_t w : walls_of_room_[room])
      if (rooms_[walls_[w].a].group == rooms_[walls_[w].b].group)
        enclosed_.push_back(w);
  });
  plant(a, wall);
  size_[to.group] += size_[m.group];
  std::swap(next_[m.group], next_[to.group]);
  merges_.push_back(m);
}

void Sides::unfollow(Literal l) {
  const auto walls = walls_of_variable_[index(l.var())];
  for (std::size_t i = walls.size(); i-- > 0;)
    if (!merges_.empty() && merges_.back().wall == walls[i]) unmerge();
}

void Sides::unmerge() {
  const Merge m = merges_.back();
  merges_.pop_back();
  const std::uint32_t from = rooms_[m.group].group;
  std::swap(next_[m.group], next_[from]);
  size_[from] -= size_[m.group];
  move_group(m, m.group);
  const auto [a, b] = ends(m.wall);
  way_[way_[a] == m.wall ? a : b] = kNone;
}

void Sides::move_group(const Merge& m, std::uint32_t to) {
  for_each_room(m.group, [&](std::uint32_t room) {
    rooms_[room].group = to;
    rooms_[room].side ^= m.flip;
  });
}

// Makes `room` the root of its tree, and then hangs it on the wall.
void Sides::plant(std::uint32_t room, std::uint32_t wall) {
  while (wall != kNone) {
    const std::uint32_t above = way_[room];
    way_[room] = wall;
    wall = above;
    if (wall != kNone) room ^= walls_[wall].a ^ walls_[wall].b;
  }
}

std::size_t Sides::depth(std::uint32_t room) const {
  std::size_t n = 0;
  for (; way_[room] != kNone; ++n)
    room ^= walls_[way_[room]].a ^ walls_[way_[room]].b;
  return n;
}

// The walls between the rooms of a wall along the forest.
void Sides::append_path(std::uint32_t wall, const Assignment& assignment,
                        std::vector<Literal>& out) const {
  auto [a, b] = ends(wall);
  std::size_t depth_a = depth(a), depth_b = depth(b);
  while (a != b) {
    if (depth_a < depth_b) {
      std::swap(a, b);
      std::swap(depth_a, depth_b);
    }
    const Wall& w = walls_[way_[a]];
    out.push_back(assignment.literal(w.var));
    a ^= w.a ^ w.b;
    --depth_a;
  }
}

void Sides::explain(Literal l, const Assignment& assignment,
                    std::vector<Literal>& out) const {
  append_path(assignment.reason(l.var()).index, assignment, out);
}

Antecedent Sides::origin(const Reason& reason) const {
  return Antecedent({ConstraintKind::Sides, constraint_of_[reason.index]});
}

}  // namespace ilp
