/// @file
/// Pieces of surface that close upon themselves too early.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "umbrella/working_surface_internal.h"

namespace umbrella {

/// A set of triangles that share no vertex with any other.
struct Piece {
  std::size_t n_triangles = 0;
  /// Corners of its triangles from the program at hand; ascending.
  std::vector<VertexId> vertices;
  std::vector<VertexId> all_vertices;
};

/// What a program would do to a surface.
struct Change {
  std::span<const TriangleIndex> freed;     ///< would go
  std::span<const LocatedTriangle> chosen;  ///< would come
  std::span<const VertexId> vertices;       ///< would be done with; ascending
};

/// Looks for small pieces about the triangles that a program has chosen.
class PieceFinder {
 public:
  /// @param surface  must outlive this object; may change between calls
  /// @param limit  pieces with more triangles are of no interest
  PieceFinder(const WorkingSurface& surface, std::size_t limit)
      : surface_(surface),
        limit_(limit),
        piece_of_(surface.n_vertices()),
        is_in_patch_(surface.n_vertices()) {}

  /// The pieces of at most `limit` triangles with a chosen one, on the changed
  /// surface; in the order of `chosen`.
  ///
  /// @param change  made, if at all, before the next call
  /// @param is_open  vertices that wait for triangles, perhaps from this
  ///   change: a piece with one that still waits is not finished, and left out
  std::vector<Piece> find(const Change& change,
                          const std::vector<bool>& is_open);

  /// Whether some piece of the last call of find() was left out because of an
  /// open vertex. If not, the same call finds the same, whatever becomes of the
  /// open vertices.
  bool has_waited() const { return has_waited_; }

  /// By how many pieces the changed surface would have more than the surface
  /// as it is.
  std::ptrdiff_t n_pieces_added(const Change& change);

  /// Vertices met by the walks of all these calls.
  std::uint64_t n_steps() const { return n_steps_; }

  /// Whether the surface as it is has one piece and goes through all vertices.
  /// May be false as well where it takes a look at all of it to tell.
  ///
  /// @pre no vertex is open, and all changes since the first call of find()
  ///   were looked at by it, or free triangles with open corners only
  bool is_one_piece();

 private:
  static constexpr std::uint32_t kNotReached = 0;
  static constexpr std::uint32_t kLarge = 1;  // pieces are counted from here

  class Walks;

  struct Corner {
    VertexId vertex;
    std::uint32_t triangle;  // position in `chosen`
  };

  /// What a change does to the pieces whose triangles it frees.
  struct Tear {
    bool is_certain = false;        // that no more than this is cut off
    std::vector<VertexId> cut_off;  // pieces that are all known
    std::size_t n_triangles = 0;    // at least as many as these have
  };

  void mark(const Change& change);
  void unmark(const Change& change);
  std::size_t n_pieces_at(std::span<const VertexId> vertices,
                          const Change& change);
  std::size_t walk(std::span<const VertexId> starts, const Change& change,
                   std::size_t most, Walks& walks);
  bool are_patches_worth_it() const;
  void find_large_patches(const std::vector<bool>& is_open);
  void settle_patches();
  void doubt_patches(const Change& change);
  Tear look_for_tear(const Change& change);
  template <class Visit>
  bool for_each_at(VertexId v, const Change& change, Visit visit) const;
  bool is_used(VertexId v, const Change& change) const;
  void forget_reached();
  bool explore(VertexId start, const Change& change,
               const std::vector<bool>& is_open, Piece& piece);

  const WorkingSurface& surface_;
  std::size_t limit_;
  std::vector<std::uint32_t> piece_of_;  // by vertex
  std::vector<VertexId> reached_;        // where that is not kNotReached
  std::vector<Corner> corners_;          // of `chosen`, by vertex
  std::vector<bool> is_freed_;
  /// Vertices of triangles that hung together, without an open corner, and were
  /// more than the limit: wherever a walk meets one, its piece is large.
  std::vector<std::uint8_t> is_in_patch_;
  bool has_looked_for_patches_ = false;
  std::size_t n_explored_ = 0;  // vertices, since then
  std::size_t n_patches_ = 0;
  std::size_t n_spare_ = 0;   // triangles of the least patch above the limit
  bool uses_patches_ = true;  // in the call at hand
  bool is_patch_touched_ = false;  // by a change that may have been made
  // Of the last call, if it touched a patch:
  std::optional<TriangleIndex> doubtful_;  // goes if the change is made
  bool is_last_certain_ = false;   // whether it is known what that cuts off
  std::vector<VertexId> doubted_;  // taken out of patches for it
  std::size_t n_doubted_ = 0;      // triangles, at least as many as there
  std::uint32_t n_pieces_ = 0;
  bool has_waited_ = false;
  std::uint64_t n_steps_ = 0;
};

}  // namespace umbrella
