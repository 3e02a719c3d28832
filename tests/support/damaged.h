#pragma once

#include <string>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/import.h"
#include "support/temporary_folder.h"

namespace tetraglass::tests {

/// Such a file is refused in one line.
inline void expect_refused(const std::string& file, const std::string& content) {
  write_text(file, content);
  try {
    static_cast<void>(mesh::import_mesh(file));
    ADD_FAILURE() << "was read";
  } catch (const base::Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

/// Nonsense is, and so is this sound content wherever it is cut off (in 16 places).
inline void expect_damage_refused(const std::string& file, const std::string& whole) {
  expect_refused(file, "nonsense");
  for (std::size_t size = 1; size < whole.size(); size += whole.size() / 16) {
    expect_refused(file, whole.substr(0, size));
  }
}

}  // namespace tetraglass::tests
