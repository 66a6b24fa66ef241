#include "delaunay/threads.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace delaunay {

void run_tasks(unsigned n_tasks, unsigned threads,
               const std::function<void(unsigned)>& task) {
  std::vector<std::exception_ptr> thrown(n_tasks);
  std::atomic<unsigned> next = 0;
  const auto work = [&] {
    for (unsigned i = next++; i < n_tasks; i = next++) try {
        task(i);
      } catch (...) {
        thrown[i] = std::current_exception();
      }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < std::min(threads, n_tasks); ++i)
      others.emplace_back(work);
    work();
  }
  for (const std::exception_ptr& e : thrown)
    if (e) std::rethrow_exception(e);
}

}  // namespace delaunay
