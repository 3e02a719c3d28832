#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "base/stopwatch.h"

namespace tetraglass::base {

/// A progress bar with the time left on stderr, for work that lasts over a second; nothing is
/// printed where stderr is no terminal. `advance` may be called from several threads at once.
class Progress {
 public:
  /// `total` is the number of steps; 0 means unknown: only the elapsed time is shown.
  Progress(std::string label, std::uint64_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Throws Interrupted (interrupt.h).
  void advance(std::uint64_t steps = 1);

  /// Says what is being done, behind the label. Not from several threads at once.
  void set_stage(const std::string& stage);

 private:
  void draw(std::uint64_t done);

  std::string label_;
  std::string stage_;
  std::uint64_t total_;
  bool terminal_;
  Stopwatch clock_;
  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::int64_t> last_drawn_ms_{0};
  std::atomic<bool> drawn_{false};
};

}  // namespace tetraglass::base
