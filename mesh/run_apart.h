#pragma once

#include <functional>
#include <string>

namespace tetraglass::mesh {

/// What came of work in a process of its own.
struct Apart {
  std::string result;  ///< what the work returned
  std::string ending;  ///< empty, or why it has not: "was stopped (Aborted)"
};

/// Does the work in a copy of this process, so that libraries that end the process where they fail
/// end only the copy. The last line that is printed there on stdout is shown, with `label`, beside
/// the time (base/progress.h); all else that is printed is lost, and so is every change of memory.
/// The copy may use `seconds` of processor time, and as much memory as the machine has. Throws
/// Error where the system allows no more processes, Interrupted (base/interrupt.h) with the copy
/// ended.
[[nodiscard]] Apart run_apart(const std::function<std::string()>& work, unsigned seconds,
                              const std::string& label);

}  // namespace tetraglass::mesh
