#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace tetraglass::tests {

/// The folder of real files: $TETRAGLASS_DATA, default ../shared/data beside the sources.
inline std::filesystem::path data_folder() {
  const char* chosen = std::getenv("TETRAGLASS_DATA");
  return chosen != nullptr
             ? std::filesystem::path(chosen)
             : std::filesystem::path(TETRAGLASS_SOURCE_DIR) / ".." / "shared" / "data";
}

}  // namespace tetraglass::tests

/// Ends the test as skipped, saying so, where the folder of real files is absent.
#define SKIP_WITHOUT_DATA()                                                           \
  if (!std::filesystem::is_directory(tetraglass::tests::data_folder())) {             \
    GTEST_SKIP() << "no real files at '" << tetraglass::tests::data_folder().string() \
                 << "'; name their folder with TETRAGLASS_DATA";                      \
  }                                                                                   \
  static_assert(true, "wants a semicolon")
