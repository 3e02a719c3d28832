#include "mesh/run_apart.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/progress.h"

namespace tetraglass::mesh {
namespace {

constexpr int kFailed = 1;
constexpr int kNoMemory = 2;

/// Both ends of a pipe; closed at the latest with it.
struct Pipe {
  Pipe() {
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
      throw base::Error(std::string("no pipe can be made: ") + std::strerror(errno));
    }
  }
  ~Pipe() {
    close(0);
    close(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close(std::size_t end) {
    if (ends[end] >= 0) ::close(ends[end]);
    ends[end] = -1;
  }
  std::array<int, 2> ends{-1, -1};
};

void set_limit(decltype(RLIMIT_CPU) resource, rlim_t soft, rlim_t hard) {
  const rlimit limit = {soft, hard};
  ::setrlimit(resource, &limit);
}

bool write_all(int output, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = ::write(output, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

[[noreturn]] void be_the_copy(const std::function<std::string()>& work, unsigned seconds,
                              int output, int stages) {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(stages, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  set_limit(RLIMIT_CORE, 0, 0);
  set_limit(RLIMIT_CPU, seconds, seconds + 1);
  const auto memory =
      static_cast<rlim_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
  set_limit(RLIMIT_DATA, memory, memory);
  // Libraries that end the process by exit() must not run the destructors of the original, which
  // may remove its files: the handler registered last is called first.
  std::atexit([] { ::_exit(kFailed); });
  int status = kFailed;
  try {
    status = write_all(output, work()) ? 0 : kFailed;
  } catch (const std::bad_alloc&) {
    status = kNoMemory;
  } catch (...) {
  }
  ::_exit(status);  // without the destructors and exit handlers of the original
}

/// Reads what has come; false at the end.
bool read_some(int input, std::string& text) {
  std::array<char, 1U << 16U> buffer{};
  const ssize_t count = ::read(input, buffer.data(), buffer.size());
  if (count < 0 && errno == EINTR) return true;
  if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
  return count > 0;
}

/// The last whole line of `printed`, without the dots that libraries put behind; what stands before
/// it is dropped.
std::string last_line(std::string& printed) {
  const std::size_t end = printed.rfind('\n');
  if (end == std::string::npos) return "";
  const std::size_t before = end == 0 ? std::string::npos : printed.rfind('\n', end - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  std::string line = printed.substr(begin, end - begin);
  printed.erase(0, end + 1);
  while (!line.empty() && (line.back() == '.' || line.back() == ' ')) line.pop_back();
  return line;
}

/// Gathers the result, and shows the time and the stage until it is there.
std::string await(int result_end, int stage_end, const std::string& label) {
  constexpr int kEveryMs = 200;
  base::Progress progress(label, 0);
  std::string result;
  std::string printed;
  std::array<pollfd, 2> waiting = {{{result_end, POLLIN, 0}, {stage_end, POLLIN, 0}}};
  while (waiting[0].fd >= 0) {
    ::poll(waiting.data(), waiting.size(), kEveryMs);
    progress.advance(0);
    if (waiting[1].revents != 0) {
      if (!read_some(stage_end, printed)) waiting[1].fd = -1;
      if (const std::string line = last_line(printed); !line.empty()) progress.set_stage(line);
    }
    if (waiting[0].revents != 0 && !read_some(result_end, result)) waiting[0].fd = -1;
  }
  return result;
}

std::string ending_of(int status, unsigned seconds) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    return "took more than " + std::to_string(seconds) + " s";
  }
  if (WIFSIGNALED(status)) {
    return std::string("was stopped (") + ::strsignal(WTERMSIG(status)) + ")";
  }
  if (WEXITSTATUS(status) == kNoMemory) return "took more memory than there is";
  return WEXITSTATUS(status) == 0 ? "" : "failed";
}

}  // namespace

Apart run_apart(const std::function<std::string()>& work, unsigned seconds,
                const std::string& label) {
  Pipe results;
  Pipe stages;
  std::fflush(stdout);  // or the copy prints it as well
  const pid_t copy = ::fork();
  if (copy == 0) be_the_copy(work, seconds, results.ends[1], stages.ends[1]);
  const int error = errno;
  results.close(1);
  stages.close(1);
  if (copy < 0) {
    throw base::Error(std::string("no process can be made: ") + std::strerror(error));
  }
  Apart apart;
  int status = 0;
  const auto wait = [&] {
    while (::waitpid(copy, &status, 0) < 0 && errno == EINTR) {
    }
  };
  try {
    apart.result = await(results.ends[0], stages.ends[0], label);
  } catch (...) {  // nobody waits for it any more
    ::kill(copy, SIGKILL);
    wait();
    throw;
  }
  wait();
  apart.ending = ending_of(status, seconds);
  return apart;
}

}  // namespace tetraglass::mesh
