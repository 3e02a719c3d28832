// The rooms and who may call whom (README, "Architecture"): read from the sources' #include lines.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::set<std::string>>& allowed() {
  static const std::map<std::string, std::set<std::string>> kAllowed = {
      {"base", {"base"}},
      {"mesh", {"mesh", "base"}},
      {"sort", {"sort", "mesh", "base"}},
      {"preint", {"preint", "base"}},
      {"project", {"project", "sort", "preint", "mesh", "base"}},
      {"apps", {"apps", "project", "sort", "preint", "mesh", "base"}},
  };
  return kAllowed;
}

struct Include {
  std::string file;  // relative to the sources
  int line = 0;
  std::string name;
  bool angled = false;
};

std::vector<Include> includes_of(const fs::path& root, const fs::path& file) {
  static const std::regex kPattern(R"(^\s*#\s*include\s*(["<])([^">]+)[">])");
  std::vector<Include> result;
  std::ifstream stream(file);
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    std::smatch match;
    if (!std::regex_search(text, match, kPattern)) continue;
    result.push_back({fs::relative(file, root).string(), line, match[2], match[1] == "<"});
  }
  return result;
}

/// Code that is compiled once per instruction set (Highway's convention) belongs to the one .cpp
/// that includes it: no public header.
bool is_inlined_source(const fs::path& file) {
  return file.filename().string().ends_with("-inl.h");
}

std::vector<std::string> violations(const fs::path& root) {
  // The C++ standard library's headers have no extension and no folder; these are the system's own.
  static const std::set<std::string> kSystem = {"unistd.h", "fcntl.h", "sys/stat.h",
                                                "sys/resource.h"};
  std::vector<std::string> result;
  for (const auto& [room, may_call] : allowed()) {
    for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      for (const Include& include : includes_of(root, entry.path())) {
        const std::string where =
            include.file + ":" + std::to_string(include.line) + ": " + include.name;
        const std::string folder = include.name.substr(0, include.name.find('/'));
        if (!include.angled) {
          if (may_call.count(folder) == 0)
            result.push_back(where + ": " + room + " may not call this room");
        } else if (extension == ".h" && !is_inlined_source(entry.path())) {
          const bool standard = include.name.find_first_of("./") == std::string::npos;
          if (!standard && folder != "Eigen" && kSystem.count(include.name) == 0) {
            result.push_back(where + ": a third-party header other than Eigen's in a header");
          }
        }
      }
    }
  }
  return result;
}

TEST(Rooms, EachCallsOnlyTheRoomsBelowIt) {
  for (const std::string& violation : violations(TETRAGLASS_SOURCE_DIR)) ADD_FAILURE() << violation;
}

// The test itself must be able to fail.
TEST(Rooms, ViolationsAreSeen) {
  const fs::path root = fs::temp_directory_path() / ("rooms-" + std::to_string(::getpid()));
  for (const auto& [room, unused] : allowed()) fs::create_directories(root / room);
  std::ofstream(root / "mesh" / "a.cpp")
      << "#include <vtkPoints.h>\n#include \"project/scene.h\"\n";
  std::ofstream(root / "preint" / "b.h")
      << "#include <vector>\n  # include <vtkPoints.h>\n#include <Eigen/Core>\n";
  std::ofstream(root / "preint" / "c.cpp")
      << "#include \"mesh/tet_mesh.h\"\n#include \"base/errors.h\"\n";
  const std::vector<std::string> found = violations(root);
  fs::remove_all(root);
  EXPECT_EQ(found.size(), 3U);
}

}  // namespace
