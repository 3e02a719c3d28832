#pragma once

#include <cstddef>
#include <functional>

namespace tetraglass::base {

/// Calls `work(begin, end)` on pieces of [0, count) of at least `grain` elements (the last may be
/// smaller), on all threads that the program may use. Returns when all are done; passes on the
/// first exception.
void parallel_ranges(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t, std::size_t)>& work);

/// How many threads `parallel_ranges` may use.
[[nodiscard]] int thread_count();

}  // namespace tetraglass::base
