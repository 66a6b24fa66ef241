/// @file
/// Work on an array by ranges of it, on several threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "delaunay/threads.h"

namespace umbrella {

/// begin, begin + 1, .. end - 1.
struct IndexRange {
  std::size_t begin;
  std::size_t end;

  std::size_t size() const { return end - begin; }
};

/// work(range) for ranges that make up 0 .. n - 1, one for each thread, at the
/// same time.
///
/// @param threads  at most so many; of no use beyond 255
/// @return what `work` returned, in the order of the ranges; of at least one
template <class Work>
auto for_ranges(std::size_t n, unsigned threads, const Work& work) {
  constexpr std::size_t kMost = 255;
  const std::size_t n_ranges =
      std::clamp<std::size_t>(threads, 1, std::clamp<std::size_t>(n, 1, kMost));
  std::vector<std::invoke_result_t<Work, IndexRange>> results(n_ranges);
  delaunay::run_tasks(
      static_cast<unsigned>(n_ranges), threads, [&](unsigned i) {
        results[i] = work(IndexRange{n * i / n_ranges, n * (i + 1) / n_ranges});
      });
  return results;
}

/// One after another; each is freed once it is copied.
template <class Array>
Array joined(std::vector<Array> parts) {
  std::size_t n = 0;
  for (const Array& part : parts) n += part.size();
  Array all = std::move(parts.front());
  all.reserve(n);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    all.insert(all.end(), parts[i].begin(), parts[i].end());
    parts[i] = {};
  }
  return all;
}

}  // namespace umbrella
