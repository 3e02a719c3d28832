// Every file of the folder of real files, read by the program itself, against the table
// tests/apps/shared_data.json: what the list of their sources says of them (numbers of points,
// cells, tetrahedra, inverted and flat ones, bounds, fields with their ranges; values that only
// points and cells without volume have are left out), or how the one line begins that refuses them.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/data.h"
#include "tests/support/temporary_folder.h"

namespace tetraglass::apps {
namespace {

using Json = nlohmann::json;

struct Run {
  int status = -1;  ///< exit status; -1 if the program was ended by a signal
  std::string out;
  std::string err;
  double seconds = 0;  ///< of processor time
  double gigabytes = 0;
};

/// Runs the program and measures it.
Run run(const std::vector<std::string>& arguments) {
  const tests::TemporaryFolder folder;
  const std::string out = folder.file("out");
  const std::string err = folder.file("err");
  std::vector<char*> words;
  std::string program = TETRAGLASS_PROGRAM;
  words.push_back(program.data());
  std::vector<std::string> copies = arguments;
  for (std::string& word : copies) words.push_back(word.data());
  words.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    ::execv(program.c_str(), words.data());
    ::_exit(127);
  }
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, tests::read_text(out),
          tests::read_text(err), seconds(usage.ru_utime) + seconds(usage.ru_stime),
          static_cast<double>(usage.ru_maxrss) * 1024 / 1e9};
}

Json table() {
  return Json::parse(
      tests::read_text(std::string(TETRAGLASS_SOURCE_DIR) + "/tests/apps/shared_data.json"));
}

/// The sources give five digits at least, of the largest number of a group.
void expect_near(double actual, double known, double largest, const std::string& what) {
  EXPECT_NEAR(actual, known, 1e-4 * largest) << what;
}

void expect_fields(const Json& known, const Json& actual) {
  for (const Json& field : known) {
    const auto name = field["name"].get<std::string>();
    const auto found = std::ranges::find_if(actual, [&](const Json& other) {
      return other["name"] == field["name"] && other["location"] == field["location"];
    });
    if (found == actual.end()) {
      ADD_FAILURE() << "there is no field '" << name << "'";
      continue;
    }
    EXPECT_EQ((*found)["components"], field["components"]) << name;
    if (!field.contains("min")) continue;
    const double low = field["min"].get<double>();
    const double high = field["max"].get<double>();
    const double largest = std::max(std::abs(low), std::abs(high));
    expect_near((*found)["min"].get<double>(), low, largest, name);
    expect_near((*found)["max"].get<double>(), high, largest, name);
  }
}

void expect_known(const Json& known, const Json& actual) {
  for (const char* key : {"points", "cells", "tetrahedra", "inverted", "degenerate", "parts"}) {
    if (known.contains(key)) {
      EXPECT_EQ(actual[key], known[key]) << key;
    }
  }
  if (known.contains("bounds")) {
    double largest = 0;
    for (const Json& bound : known["bounds"])
      largest = std::max(largest, std::abs(bound.get<double>()));
    for (std::size_t i = 0; i < 6; ++i) {
      expect_near(actual["bounds"][i].get<double>(), known["bounds"][i].get<double>(), largest,
                  "bounds");
    }
  }
  if (known.contains("fields")) expect_fields(known["fields"], actual["fields"]);
}

void check_file(const Json& known) {
  const auto name = known["file"].get<std::string>();
  SCOPED_TRACE(name);
  const std::string file = (tests::data_folder() / name).string();
  const bool refused = known.contains("error");
  const tests::TemporaryFolder folder;
  // Refused files are given to `import`, which must leave nothing behind.
  std::vector<std::string> arguments = {refused ? "import" : "info", file};
  for (const Json& word : known.value("arguments", Json::array())) arguments.push_back(word);
  if (refused) {
    arguments.insert(arguments.end(), {"-o", folder.file("out.vtu")});
  } else {
    arguments.emplace_back("--json");
  }
  const Run done = run(arguments);
  constexpr double kMostSeconds = 30;
  constexpr double kMostGigabytes = 4;
  EXPECT_LE(done.seconds, kMostSeconds);
  EXPECT_LE(done.gigabytes, kMostGigabytes);
  if (refused) {
    EXPECT_EQ(done.status, 1);
    EXPECT_EQ(done.out, "");
    EXPECT_TRUE(done.err.starts_with("tetraglass: error: " + file + ": ")) << done.err;
    EXPECT_NE(done.err.find(known["error"].get<std::string>()), std::string::npos) << done.err;
    EXPECT_EQ(std::ranges::count(done.err, '\n'), 1) << done.err;
    EXPECT_TRUE(folder.is_empty());
  } else {
    ASSERT_EQ(done.status, 0) << done.err;
    expect_known(known, Json::parse(done.out));
  }
}

/// The files of a folder (and those below it) whose names begin with one of the letters.
void check_folder(const std::string& folder, char first = '0', char last = 'z') {
  SKIP_WITHOUT_DATA();
  std::size_t count = 0;
  for (const Json& known : table()) {
    const std::filesystem::path path = known["file"].get<std::string>();
    const std::string top = path.has_parent_path() ? path.begin()->string() : "";
    const char letter = path.filename().string()[0];
    if (top != folder || letter < first || letter > last) continue;
    ++count;
    check_file(known);
  }
  EXPECT_GT(count, 0U);
}

TEST(SharedData, HasARowForEveryFile) {
  SKIP_WITHOUT_DATA();
  std::set<std::string> known;
  for (const Json& row : table()) known.insert(row["file"].get<std::string>());
  std::set<std::string> there;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(tests::data_folder())) {
    if (entry.is_regular_file()) {
      there.insert(std::filesystem::relative(entry.path(), tests::data_folder()).string());
    }
  }
  EXPECT_EQ(known, there);
}

TEST(SharedData, ItsListOfSources) {
  check_folder("");
}
TEST(SharedData, Classics) {
  check_folder("classics");
}
TEST(SharedData, Tetrahedra) {
  check_folder("tets");
}
TEST(SharedData, MixedCells) {
  check_folder("mixed");
}
TEST(SharedData, SurfacesOfFirstNames) {
  check_folder("surfaces", '0', 'g');
}
TEST(SharedData, SurfacesOfLastNames) {
  check_folder("surfaces", 'h', 'z');
}
TEST(SharedData, BadSurfaces) {
  check_folder("surfaces_bad");
}
TEST(SharedData, VolumesOfFirstNames) {
  check_folder("volumes", '0', 's');
}
TEST(SharedData, VolumesOfLastNames) {
  check_folder("volumes", 't', 'z');
}
TEST(SharedData, TortureOfFirstNames) {
  check_folder("torture", '0', 'l');
}
TEST(SharedData, TortureOfLastNames) {
  check_folder("torture", 'm', 'z');
}

}  // namespace
}  // namespace tetraglass::apps
