/// @file
/// Union-find over 0 .. n-1 that knows of any two members of a set whether
/// they are alike.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace umbrella {

class ParitySets {
 public:
  /// @param n  below 2^31
  explicit ParitySets(std::size_t n) : link_(n), size_(n, 1) {
    assert(n <= std::size_t{1} << 31U);
    for (std::size_t i = 0; i < n; ++i)
      link_[i] = Link(static_cast<std::uint32_t>(i), 0);
  }

  std::size_t size() const { return link_.size(); }
  /// A new member, in a set of its own.
  std::uint32_t add() {
    const auto i = static_cast<std::uint32_t>(size());
    link_.push_back(Link(i, 0));
    size_.push_back(1);
    return i;
  }

  struct Place {
    std::uint32_t root;
    std::uint32_t parity;  ///< 0: like the root
  };

  Place find(std::size_t i) {
    auto at = static_cast<std::uint32_t>(i);
    std::uint32_t parity = 0;
    while (link_[at].parent() != at) {
      const Link link = link_[at], above = link_[link.parent()];
      // Halves the path; the parity of a root is 0.
      link_[at] = Link(above.parent(), link.parity() ^ above.parity());
      parity ^= link_[at].parity();
      at = link_[at].parent();
    }
    return {at, parity};
  }

  /// Makes i and k alike (parity 0) or not (1).
  /// @return whether they are so now: false if they were known not to be
  bool relate(std::size_t i, std::size_t k, std::uint32_t parity) {
    Place a = find(i), b = find(k);
    const std::uint32_t wanted = a.parity ^ b.parity ^ parity;
    if (a.root == b.root) return wanted == 0;
    if (size_[a.root] < size_[b.root]) std::swap(a, b);
    link_[b.root] = Link(a.root, wanted);
    size_[a.root] += size_[b.root];
    return true;
  }

 private:
  class Link {
   public:
    Link() = default;
    Link(std::uint32_t parent, std::uint32_t parity)
        : bits_(parent << 1U | parity) {}
    std::uint32_t parent() const { return bits_ >> 1U; }
    std::uint32_t parity() const { return bits_ & 1U; }  // against the parent

   private:
    std::uint32_t bits_ = 0;
  };

  std::vector<Link> link_;
  std::vector<std::uint32_t> size_;  // of a root's set
};

}  // namespace umbrella
