#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/errors.h"

namespace tetraglass::mesh {

/// Thrown where a time step is asked for beyond the last.
class NoTimeStepError : public base::UsageError {
 public:
  NoTimeStepError(const std::string& what, std::size_t steps) : UsageError(what), steps_(steps) {}

  /// How many there are.
  [[nodiscard]] std::size_t steps() const { return steps_; }

 private:
  std::size_t steps_;
};

/// The index of the time step that `wanted` names: "" or "last", "index:N" counted from 0, or a
/// time value, of which the nearest step is taken. `times` is not empty. Throws NoTimeStepError
/// for an index beyond the last, UsageError for anything else.
[[nodiscard]] std::size_t find_time_step(const std::string& wanted, std::span<const double> times);

/// Tells which of several steps was taken: "time step 2 of 5 (time 0.4)", after `of` where that
/// names what has the steps. Of a single step there is nothing to tell.
void note_time_step(std::vector<std::string>& notes, std::size_t step,
                    std::span<const double> times, const std::string& of = "");

/// What `note_time_step` told.
struct NotedTimeStep {
  std::size_t step = 0;  ///< counted from 0
  std::size_t count = 0;
  std::string time;
};

/// The first step that the notes tell of; nothing where they tell of none.
[[nodiscard]] std::optional<NotedTimeStep> noted_time_step(std::span<const std::string> notes);

}  // namespace tetraglass::mesh
