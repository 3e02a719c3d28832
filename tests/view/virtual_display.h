#pragma once

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tetraglass::tests {

/// Asks again and again until it is so; false after a time that is long for any machine.
inline bool wait_until(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

inline bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// A program that runs beside the test, and is ended with it.
class Beside {
 public:
  /// `before` is called in the child, before the program is.
  Beside(const std::vector<std::string>& words, const std::function<void()>& before) {
    std::vector<char*> pointers;
    for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    id_ = ::fork();
    if (id_ != 0) return;
    before();
    ::execvp(pointers[0], pointers.data());
    ::_exit(127);
  }
  ~Beside() {
    if (running()) {
      ::kill(id_, SIGKILL);
      ::waitpid(id_, nullptr, 0);
    }
  }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  [[nodiscard]] bool running() {
    if (!ended_) ended_ = ::waitpid(id_, &status_, WNOHANG) != 0;
    return !ended_;
  }
  /// Of a program that has ended; -1 where a signal ended it.
  [[nodiscard]] int exit_status() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1; }

 private:
  pid_t id_ = 0;
  bool ended_ = false;
  int status_ = 0;
};

/// An X server without a screen, on a display that is free.
class VirtualDisplay {
 public:
  /// `options`: more of Xvfb.
  explicit VirtualDisplay(const std::vector<std::string>& options = {})
      : pipe_(make_pipe()), server_(server_words(options), [] {}) {
    ::close(pipe_.second);
    char digit = 0;
    // The server writes the number when it is ready, and closes the pipe when it cannot start.
    while (::read(pipe_.first, &digit, 1) == 1 && digit != '\n') number_ += digit;
    ::close(pipe_.first);
  }

  [[nodiscard]] bool ready() const { return !number_.empty(); }
  [[nodiscard]] std::string name() const { return ":" + number_; }

 private:
  static std::pair<int, int> make_pipe() {
    int ends[2] = {-1, -1};
    if (::pipe(ends) != 0) return {-1, -1};
    ::fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    return {ends[0], ends[1]};
  }
  [[nodiscard]] std::vector<std::string> server_words(
      const std::vector<std::string>& options) const {
    std::vector<std::string> words = {"Xvfb",      "-displayfd", std::to_string(pipe_.second),
                                      "-screen",   "0",          "1600x1000x24",
                                      "-nolisten", "tcp",        "-noreset"};
    words.insert(words.end(), options.begin(), options.end());
    return words;
  }

  std::pair<int, int> pipe_;
  Beside server_;
  std::string number_;
};

}  // namespace tetraglass::tests
