/// @file
/// Independent tasks on several threads.
#pragma once

#include <functional>

namespace delaunay {

/// Calls task(0) .. task(n_tasks - 1), each once, in any order, on at most
/// `threads` threads of which the caller's is one. Returns when all are done;
/// then rethrows what the lowest task threw, if any did.
void run_tasks(unsigned n_tasks, unsigned threads,
               const std::function<void(unsigned)>& task);

}  // namespace delaunay
