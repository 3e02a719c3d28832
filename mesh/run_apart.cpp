#include "mesh/run_apart.h"

#include <array>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/errors.h"

namespace tetraglass::mesh {
namespace {

[[noreturn]] void be_the_copy(const std::function<std::string()>& work, unsigned seconds,
                              int output) {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const rlimit time = {seconds, seconds + 1};
  ::setrlimit(RLIMIT_CPU, &time);
  int status = 1;
  try {
    const std::string result = work();
    std::size_t done = 0;
    while (done < result.size()) {
      const ssize_t count = ::write(output, result.data() + done, result.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) break;
      done += static_cast<std::size_t>(count);
    }
    status = done == result.size() ? 0 : 1;
  } catch (...) {
  }
  ::_exit(status);  // without the destructors and exit handlers of the original
}

}  // namespace

Apart run_apart(const std::function<std::string()>& work, unsigned seconds) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw base::Error(std::string("no pipe can be made: ") + std::strerror(errno));
  }
  const pid_t copy = ::fork();
  if (copy == 0) {
    ::close(ends[0]);
    be_the_copy(work, seconds, ends[1]);
  }
  const int error = errno;
  ::close(ends[1]);
  if (copy < 0) {
    ::close(ends[0]);
    throw base::Error(std::string("no process can be made: ") + std::strerror(error));
  }
  Apart apart;
  std::array<char, 1U << 16U> buffer{};
  while (true) {
    const ssize_t count = ::read(ends[0], buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    apart.result.append(buffer.data(), static_cast<std::size_t>(count));
  }
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(copy, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) {
    apart.ending = std::string("was stopped (") + ::strsignal(WTERMSIG(status)) + ")";
  } else if (WEXITSTATUS(status) != 0) {
    apart.ending = "failed";
  }
  return apart;
}

}  // namespace tetraglass::mesh
