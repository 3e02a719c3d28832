#pragma once

#include <string>

namespace tetraglass::base {

/// A file that appears whole or not at all: everything is written to `temporary_path()` in the same
/// folder (same extension), and `commit()` renames it over `path`. Without a commit the destructor
/// removes it.
class OutputFile {
 public:
  /// Throws WriteError where the folder does not exist or cannot be written to.
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  [[nodiscard]] const std::string& temporary_path() const { return temporary_; }
  [[nodiscard]] const std::string& path() const { return path_; }

  /// Writes `bytes` as the whole content. Throws WriteError (disk full, ...).
  void write(const std::string& bytes);

  /// Makes the file visible under its name. Throws WriteError.
  void commit();

 private:
  std::string path_;
  std::string temporary_;
  bool committed_ = false;
};

}  // namespace tetraglass::base
