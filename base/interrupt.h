#pragma once

#include <exception>

namespace tetraglass::base {

/// The work was given up because nobody waits for it any more.
class Interrupted : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "interrupted"; }
};

/// From now on (or no longer) work that lasts, on any thread, ends by Interrupted at its next step.
void interrupt(bool on);

/// A step of work that lasts: throws Interrupted where it was asked for. Costs next to nothing.
void throw_if_interrupted();

}  // namespace tetraglass::base
