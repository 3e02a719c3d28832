#include "base/progress.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include "base/interrupt.h"

namespace tetraglass::base {
namespace {

constexpr std::int64_t kFirstMs = 1000;
constexpr std::int64_t kEveryMs = 100;

}  // namespace

Progress::Progress(std::string label, std::uint64_t total)
    : label_(std::move(label)), total_(total), terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
}

void Progress::advance(std::uint64_t steps) {
  throw_if_interrupted();
  const std::uint64_t done = done_ += steps;
  if (!terminal_) return;
  const auto now = static_cast<std::int64_t>(clock_.milliseconds());
  std::int64_t last = last_drawn_ms_;
  if (now < kFirstMs || now - last < kEveryMs) return;
  if (last_drawn_ms_.compare_exchange_strong(last, now)) draw(done);
}

void Progress::set_stage(const std::string& stage) {
  stage_ = stage.empty() ? "" : ": " + stage;
}

void Progress::draw(std::uint64_t done) {
  drawn_ = true;
  const double seconds = clock_.milliseconds() / 1000.0;
  if (total_ == 0) {
    fmt::print(stderr, "\r\033[K{}{} {:.0f} s", label_, stage_, seconds);
  } else {
    const double part =
        std::clamp(static_cast<double>(done) / static_cast<double>(total_), 1e-9, 1.0);
    const int bars = static_cast<int>(part * 30);
    fmt::print(stderr, "\r\033[K{}{} [{:<30}] {:3.0f} % {:.0f} s left", label_, stage_,
               std::string(bars, '='), 100 * part, seconds * (1 - part) / part);
  }
  std::fflush(stderr);
}

}  // namespace tetraglass::base
