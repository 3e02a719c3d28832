#include "base/interrupt.h"

#include <atomic>

namespace tetraglass::base {
namespace {

std::atomic<bool> interrupted{false};

}  // namespace

void interrupt(bool on) {
  interrupted.store(on, std::memory_order_relaxed);
}

void throw_if_interrupted() {
  if (interrupted.load(std::memory_order_relaxed)) throw Interrupted();
}

}  // namespace tetraglass::base
