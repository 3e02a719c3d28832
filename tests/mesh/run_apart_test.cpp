#include "mesh/run_apart.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "support/temporary_folder.h"

namespace tetraglass::mesh {
namespace {

TEST(RunApart, GivesBackWhatTheWorkReturns) {
  const std::string large(3'000'000, 'x');
  const Apart apart = run_apart([&] { return large + '\0' + "end"; }, 10, "test");
  EXPECT_EQ(apart.ending, "");
  EXPECT_EQ(apart.result, large + '\0' + "end");
}

TEST(RunApart, OutlivesWorkThatEndsItsProcess) {
  EXPECT_EQ(run_apart([]() -> std::string { std::abort(); }, 10, "test").ending,
            "was stopped (Aborted)");
  EXPECT_EQ(run_apart([]() -> std::string { throw std::runtime_error("no"); }, 10, "test").ending,
            "failed");
  EXPECT_EQ(run_apart([]() -> std::string { std::_Exit(3); }, 10, "test").ending, "failed");
}

TEST(RunApart, WorkThatCallsExitRunsNoDestructorsOfTheOriginal) {
  static const tests::TemporaryFolder kFolder;  // removed by its destructor
  EXPECT_EQ(run_apart([]() -> std::string { std::exit(3); }, 10, "test").ending, "failed");
  tests::write_text(kFolder.file("a"), "b");
  EXPECT_EQ(tests::read_text(kFolder.file("a")), "b");
}

TEST(RunApart, SaysThatMemoryRanOut) {
  const auto ask_for_all = []() -> std::string {
    const std::string all(std::size_t{1} << 62U, 'x');
    return all.substr(0, 1);
  };
  EXPECT_EQ(run_apart(ask_for_all, 10, "test").ending, "took more memory than there is");
}

TEST(RunApart, StopsWorkThatDoesNotEnd) {
  const Apart apart = run_apart(
      []() -> std::string {
        for (std::atomic<int> i = 0;; ++i) {
        }
      },
      1, "test");
  EXPECT_EQ(apart.ending, "took more than 1 s");
}

// The copy is ended, not left running: it would never end by itself.
TEST(RunApart, IsGivenUpWhenInterrupted) {
  base::interrupt(true);
  EXPECT_THROW((void)run_apart(
                   []() -> std::string {
                     for (;;) ::pause();
                   },
                   1, "test"),
               base::Interrupted);
  base::interrupt(false);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
}

TEST(RunApart, PrintsNothingAndChangesNothing) {
  int value = 1;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  static_cast<void>(run_apart(
      [&] {
        value = 2;
        std::printf("out\n");
        std::fprintf(stderr, "err\n");
        std::fflush(stdout);
        return std::string();
      },
      10, "test"));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(value, 1);
}

}  // namespace
}  // namespace tetraglass::mesh
