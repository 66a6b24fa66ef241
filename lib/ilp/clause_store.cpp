#include "ilp/clause_store.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace ilp {

bool normalize(std::vector<Literal>& clause) {
  std::ranges::sort(clause);
  clause.erase(std::unique(clause.begin(), clause.end()), clause.end());
  return std::ranges::adjacent_find(clause, [](Literal a, Literal b) {
           return a.var() == b.var();
         }) == clause.end();
}

// A watch that moves takes two places at its new literal.
void ClauseStore::reserve(std::size_t n_clauses, std::size_t n_literals) {
  clauses_.reserve(n_clauses);
  literals_.reserve(n_literals);
  watches_.reserve(8 * n_clauses);
}

ClauseRef ClauseStore::add(std::span<const Literal> literals, Antecedent origin,
                           std::uint32_t glue) {
  constexpr std::size_t kMax = std::numeric_limits<std::uint32_t>::max();
  if (literals.size() > kMax - literals_.size())
    throw std::length_error("ilp: the clauses have 2^32 literals");
  const ClauseRef ref{static_cast<std::uint32_t>(clauses_.size())};
  clauses_.push_back({static_cast<std::uint32_t>(literals_.size()),
                      static_cast<std::uint32_t>(literals.size()), origin,
                      glue});
  literals_.insert(literals_.end(), literals.begin(), literals.end());
  if (literals.size() >= 2) {
    watch(literals[0], {ref, literals[1]});
    watch(literals[1], {ref, literals[0]});
  }
  return ref;
}

std::vector<ClauseRef> ClauseStore::compact(
    const std::vector<bool>& is_garbage) {
  std::vector<ClauseRef> moved(clauses_.size());
  std::uint32_t n_kept = 0;
  std::uint32_t end = 0;
  for (std::size_t i = 0; i < clauses_.size(); ++i) {
    if (is_garbage[i]) continue;
    Clause c = clauses_[i];
    for (std::uint32_t k = 0; k < c.size; ++k)
      literals_[end + k] = literals_[c.begin + k];
    c.begin = end;
    end += c.size;
    clauses_[n_kept] = c;
    moved[i] = ClauseRef{n_kept++};
  }
  clauses_.resize(n_kept);
  literals_.resize(end);
  compact_watches(is_garbage, moved);
  return moved;
}

void ClauseStore::compact_watches(const std::vector<bool>& is_garbage,
                                  std::span<const ClauseRef> moved) {
  std::vector<Watch> kept;
  kept.reserve(watches_.size());
  for (List& list : lists_) {
    const std::size_t begin = kept.size();
    for (std::uint32_t i = 0; i < list.size; ++i) {
      const auto& [clause, blocker] = watches_[list.begin + i];
      const auto c = static_cast<std::size_t>(clause);
      if (!is_garbage[c]) kept.push_back({moved[c], blocker});
    }
    const auto size = static_cast<std::uint32_t>(kept.size() - begin);
    list = {begin, size, size};
  }
  watches_ = std::move(kept);
}

void ClauseStore::make_room(List& list) {
  constexpr std::uint32_t kFirst = 2;
  const std::size_t begin = watches_.size();
  list.capacity = std::max(kFirst, 2 * list.capacity);
  watches_.resize(begin + list.capacity);
  std::copy_n(watches_.begin() + static_cast<std::ptrdiff_t>(list.begin),
              list.size, watches_.begin() + static_cast<std::ptrdiff_t>(begin));
  list.begin = begin;
}

}  // namespace ilp
