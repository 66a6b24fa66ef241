#include <algorithm>

#include "umbrella/disjoint_sets_internal.h"
#include "umbrella/pieces_internal.h"

namespace umbrella {

/// Walks that may meet each other, by their steps.
class PieceFinder::Walks {
 public:
  /// A step not yet done, the first of a walk.
  std::uint32_t add() {
    n_open_.push_back(1);
    sets_.add();
    ++n_going_;
    return static_cast<std::uint32_t>(n_open_.size() - 1);
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = sets_.root(a);
    b = sets_.root(b);
    if (!sets_.unite(a, b)) return;
    n_going_ -= n_open_[a] > 0 && n_open_[b] > 0 ? 1 : 0;
    n_open_[sets_.root(a)] = n_open_[a] + n_open_[b];
  }
  /// The first that is not yet done.
  void finish_step() {
    if (--n_open_[sets_.root(n_done_++)] > 0) return;
    --n_going_;
    ++n_ended_;
  }
  std::uint32_t n_done() const { return n_done_; }
  /// Walks with steps not yet done.
  std::size_t n_going() const { return n_going_; }
  /// Those that have none left. None of the others can meet them.
  std::size_t n_ended() const { return n_ended_; }
  bool is_going(std::uint32_t i) { return n_open_[sets_.root(i)] > 0; }

 private:
  DisjointSets sets_{0};
  std::vector<std::uint32_t> n_open_;  // by root
  std::uint32_t n_done_ = 0;           // steps
  std::size_t n_going_ = 0;
  std::size_t n_ended_ = 0;
};

std::vector<Piece> PieceFinder::find(const Change& change,
                                     const std::vector<bool>& is_open) {
  if (are_patches_worth_it()) find_large_patches(is_open);
  mark(change);
  doubt_patches(change);
  std::vector<Piece> pieces;
  n_pieces_ = kLarge;
  has_waited_ = false;
  for (const LocatedTriangle& t : change.chosen) {
    const VertexId start = t.corners[0];
    if (piece_of_[index(start)] != kNotReached) continue;
    Piece piece;
    if (explore(start, change, is_open, piece)) pieces.push_back(piece);
  }
  forget_reached();
  unmark(change);
  for (const VertexId v : doubted_) is_in_patch_[index(v)] = 1;
  uses_patches_ = true;
  return pieces;
}

void PieceFinder::mark(const Change& change) {
  is_freed_.resize(surface_.n_indices());
  for (const TriangleIndex t : change.freed) is_freed_[t] = true;
  for (std::uint32_t t = 0; t < change.chosen.size(); ++t)
    for (const VertexId v : change.chosen[t].corners)
      corners_.push_back({v, t});
  std::sort(corners_.begin(), corners_.end(),
            [](const Corner& a, const Corner& b) {
              return a.vertex != b.vertex ? a.vertex < b.vertex
                                          : a.triangle < b.triangle;
            });
}

void PieceFinder::unmark(const Change& change) {
  for (const TriangleIndex t : change.freed) is_freed_[t] = false;
  corners_.clear();
}

std::ptrdiff_t PieceFinder::n_pieces_added(const Change& change) {
  is_freed_.resize(surface_.n_indices());
  const std::size_t n_before = n_pieces_at(change.vertices, {});
  mark(change);
  const std::size_t n_after = n_pieces_at(change.vertices, change);
  unmark(change);
  return static_cast<std::ptrdiff_t>(n_after) -
         static_cast<std::ptrdiff_t>(n_before);
}

/// All walks but one come to an end, or meet another one.
std::size_t PieceFinder::n_pieces_at(std::span<const VertexId> vertices,
                                     const Change& change) {
  Walks walks;
  (void)walk(vertices, change, surface_.n_vertices(), walks);
  n_steps_ += walks.n_done();
  forget_reached();
  return walks.n_ended() + walks.n_going();
}

/// From all of these at once, in turn, until one walk is left or so many
/// vertices are done; these are the first in reached_.
/// @return how many triangles have their first corner there
std::size_t PieceFinder::walk(std::span<const VertexId> starts,
                              const Change& change, std::size_t most,
                              Walks& walks) {
  const auto enter = [&](VertexId v) {
    std::uint32_t& step = piece_of_[index(v)];
    if (step == kNotReached) {
      reached_.push_back(v);
      step = walks.add() + 1;
    }
    return step - 1;
  };
  for (const VertexId v : starts)
    if (is_used(v, change)) enter(v);
  std::size_t n_triangles = 0;
  while (walks.n_going() > 1 && walks.n_done() < most) {
    const std::uint32_t i = walks.n_done();
    const VertexId v = reached_[i];
    for_each_at(v, change, [&](const Triangle& t) {
      for (const VertexId corner : t) walks.join(i, enter(corner));
      n_triangles += t[0] == v ? 1 : 0;
    });
    walks.finish_step();
  }
  return n_triangles;
}

void PieceFinder::forget_reached() {
  for (const VertexId v : reached_) piece_of_[index(v)] = kNotReached;
  reached_.clear();
}

/// A look at the whole surface takes as long as walks over all of it, or over
/// one piece up to a limit that is a large part of it. So it takes no longer in
/// all than the walks since the last one, which has then lost its use.
bool PieceFinder::are_patches_worth_it() const {
  constexpr std::size_t kLargePart = 8;  // one in so many
  const std::size_t n = surface_.n_vertices();
  return n_explored_ > n ||
         (!has_looked_for_patches_ && kLargePart * limit_ > n);
}

void PieceFinder::find_large_patches(const std::vector<bool>& is_open) {
  has_looked_for_patches_ = true;
  n_explored_ = 0;
  n_patches_ = 0;
  doubtful_.reset();
  doubted_.clear();
  const std::size_t n = surface_.n_vertices();
  DisjointSets sets(n);
  const std::vector<std::uint8_t> waits(is_open.begin(), is_open.end());
  std::vector<std::uint32_t> n_triangles(n);  // at the corner, then in the set
  for (TriangleIndex t = 0; t < surface_.n_indices(); ++t) {
    const auto& [a, b, c] = surface_.corners(t);
    if (!surface_.contains(t) ||
        (waits[index(a)] | waits[index(b)] | waits[index(c)]) != 0)
      continue;
    sets.unite(index(a), index(b));
    sets.unite(index(a), index(c));
    ++n_triangles[index(a)];
  }
  sets.add_at_roots(n_triangles);
  n_spare_ = surface_.n_indices();
  for (std::size_t v = 0; v < n; ++v) {
    const std::uint32_t root = sets.root(v);
    is_in_patch_[v] = n_triangles[root] > limit_ ? 1 : 0;
    if (root != v || n_triangles[v] <= limit_) continue;
    ++n_patches_;
    n_spare_ = std::min(n_spare_, n_triangles[v] - limit_);
  }
}

/// Keeps the patches right if the change of the last call was made.
void PieceFinder::settle_patches() {
  if (!doubtful_ || surface_.contains(*doubtful_)) return;
  doubtful_.reset();
  if (is_last_certain_) {
    for (const VertexId v : doubted_) is_in_patch_[index(v)] = 0;
    n_spare_ -= n_doubted_;
  } else {
    is_in_patch_.assign(surface_.n_vertices(), 0);
    n_patches_ = 0;
  }
}

/// Leaves no more of the patches than is in large pieces of the changed surface
/// for certain.
void PieceFinder::doubt_patches(const Change& change) {
  const auto& freed = change.freed;
  settle_patches();
  doubtful_.reset();
  doubted_.clear();
  const bool touches_patch =
      std::any_of(freed.begin(), freed.end(), [this](TriangleIndex t) {
        return is_in_patch_[index(surface_.corners(t)[0])] != 0;
      });
  if (!touches_patch) return;
  is_patch_touched_ = true;
  doubtful_ = freed.front();
  const Tear tear = look_for_tear(change);
  is_last_certain_ =
      tear.is_certain && freed.size() + tear.n_triangles < n_spare_;
  uses_patches_ = is_last_certain_;
  if (!uses_patches_) return;
  n_spare_ -= freed.size();
  n_doubted_ = tear.n_triangles;
  for (const VertexId v : tear.cut_off)
    if (is_in_patch_[index(v)] != 0) {
      is_in_patch_[index(v)] = 0;
      doubted_.push_back(v);
    }
}

/// Walks around the corners of the triangles that would go. Whatever is left of
/// a piece has such a corner: so once all walks but one have come to an end or
/// met another one, that is where the rest of it is. Without an answer each
/// piece is walked over until it is too large, so half of that is not too much.
PieceFinder::Tear PieceFinder::look_for_tear(const Change& change) {
  const std::size_t most =  // vertices
      std::max(64 + 16 * change.freed.size(), limit_ / 4);
  std::vector<VertexId> corners;
  for (const TriangleIndex t : change.freed)
    corners.insert(corners.end(), surface_.corners(t).begin(),
                   surface_.corners(t).end());
  Walks walks;
  Tear tear;
  tear.n_triangles = walk(corners, change, most, walks);
  tear.is_certain = walks.n_going() <= 1;
  for (std::uint32_t i = 0; i < walks.n_done(); ++i)
    if (!walks.is_going(i)) tear.cut_off.push_back(reached_[i]);
  forget_reached();
  return tear;
}

bool PieceFinder::is_one_piece() {
  const std::size_t n = surface_.n_vertices();
  if (!has_looked_for_patches_) find_large_patches(std::vector<bool>(n));
  settle_patches();
  if (n_patches_ != 1) return false;
  DisjointSets sets(n + 1);  // the last one: vertices of the patch
  const auto place = [&](VertexId v) {
    return is_in_patch_[index(v)] != 0 ? n : index(v);
  };
  const auto join = [&](TriangleIndex t) {
    const auto& [a, b, c] = surface_.corners(t);
    sets.unite(place(a), place(b));
    sets.unite(place(a), place(c));
  };
  for (std::uint32_t v = 0; v < n; ++v)
    if (is_in_patch_[v] == 0) surface_.for_each_at(VertexId{v}, join);
  const std::uint32_t root = sets.root(n);
  for (std::uint32_t v = 0; v < n; ++v)
    if (is_in_patch_[v] != 0
            ? is_patch_touched_ && !surface_.is_used(VertexId{v})
            : sets.root(v) != root)
      return false;
  return true;
}

/// Calls visit for each triangle at v on the changed surface. @return whether a
///   chosen one is among them
template <class Visit>
bool PieceFinder::for_each_at(VertexId v, const Change& change,
                              Visit visit) const {
  surface_.for_each_at(v, [&](TriangleIndex t) {
    if (!is_freed_[t]) visit(surface_.corners(t));
  });
  const auto first = std::lower_bound(
      corners_.begin(), corners_.end(), v,
      [](const Corner& c, VertexId wanted) { return c.vertex < wanted; });
  auto at = first;
  for (; at != corners_.end() && at->vertex == v; ++at)
    visit(change.chosen[at->triangle].corners);
  return at != first;
}

bool PieceFinder::is_used(VertexId v, const Change& change) const {
  bool is_left = false;
  return for_each_at(v, change, [&](const Triangle&) { is_left = true; }) ||
         is_left;
}

/// Walks over all triangles that hang together with `start`; stops as soon as
/// they are too many, or are known to be. @return whether the piece is small
bool PieceFinder::explore(VertexId start, const Change& change,
                          const std::vector<bool>& is_open, Piece& piece) {
  const std::uint32_t name = ++n_pieces_;
  const std::size_t first = reached_.size();
  bool is_large = false;
  const auto enter = [&](VertexId v) {
    std::uint32_t& known = piece_of_[index(v)];
    const bool waits =
        is_open[index(v)] &&
        !std::binary_search(change.vertices.begin(), change.vertices.end(), v);
    is_large = is_large || known == kLarge || waits ||
               (uses_patches_ && is_in_patch_[index(v)] != 0);
    has_waited_ = has_waited_ || waits;
    if (known != kNotReached) return;
    known = name;
    reached_.push_back(v);
  };
  enter(start);
  for (std::size_t i = first; i < reached_.size() && !is_large; ++i) {
    const VertexId v = reached_[i];
    const bool has_chosen = for_each_at(v, change, [&](const Triangle& t) {
      for (const VertexId corner : t) enter(corner);
      if (t[0] == v) ++piece.n_triangles;  // each is met at three corners
    });
    if (has_chosen) piece.vertices.push_back(v);
    is_large = is_large || piece.n_triangles > limit_;
  }
  if (is_large)
    for (std::size_t i = first; i < reached_.size(); ++i)
      piece_of_[index(reached_[i])] = kLarge;
  n_explored_ += reached_.size() - first;
  std::sort(piece.vertices.begin(), piece.vertices.end());
  if (!is_large)
    piece.all_vertices.assign(
        reached_.begin() + static_cast<std::ptrdiff_t>(first), reached_.end());
  return !is_large;
}

}  // namespace umbrella
