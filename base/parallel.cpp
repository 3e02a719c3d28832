#include "base/parallel.h"

#include <algorithm>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace tetraglass::base {

void parallel_ranges(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t, std::size_t)>& work) {
  const tbb::blocked_range<std::size_t> all(0, count, std::max<std::size_t>(1, grain));
  tbb::parallel_for(all, [&](const auto& range) { work(range.begin(), range.end()); });
}

int thread_count() {
  return tbb::this_task_arena::max_concurrency();
}

}  // namespace tetraglass::base
