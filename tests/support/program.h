#pragma once

#include <cstdlib>
#include <string>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace tetraglass::tests {

struct ProgramRun {
  int status = -1;  ///< exit status; -1 if the program was ended by a signal
  std::string out;
  std::string err;
};

/// Runs the built program with these arguments (as typed in a shell).
inline ProgramRun run_program(const std::string& arguments) {
  const TemporaryFolder folder;
  const std::string command = std::string("'") + TETRAGLASS_PROGRAM + "' " + arguments + " >'" +
                              folder.file("out") + "' 2>'" + folder.file("err") + "' </dev/null";
  const int result = std::system(command.c_str());
  return {WIFEXITED(result) ? WEXITSTATUS(result) : -1, read_text(folder.file("out")),
          read_text(folder.file("err"))};
}

/// Whether programs can be given terminals: not on machines without /dev/pts.
inline bool has_terminals() {
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal < 0) return false;
  bool usable = ::grantpt(terminal) == 0 && ::unlockpt(terminal) == 0;
  const char* name = usable ? ::ptsname(terminal) : nullptr;
  usable = name != nullptr && ::access(name, R_OK | W_OK) == 0;
  ::close(terminal);
  return usable;
}

}  // namespace tetraglass::tests
