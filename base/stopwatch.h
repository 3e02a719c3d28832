#pragma once

#include <chrono>
#include <cstdint>

namespace tetraglass::base {

/// Wall-clock time since its construction or the last `restart`.
class Stopwatch {
 public:
  [[nodiscard]] double milliseconds() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }
  void restart() { start_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// The largest resident size this process has had, in bytes.
[[nodiscard]] std::uint64_t peak_bytes();

}  // namespace tetraglass::base
