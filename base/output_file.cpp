#include "base/output_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/errors.h"

namespace tetraglass::base {
namespace fs = std::filesystem;

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  const fs::path target(path_);
  const fs::path folder = target.parent_path().empty() ? fs::path(".") : target.parent_path();
  std::error_code ignored;
  if (path_.empty() || fs::is_directory(target, ignored)) {
    throw WriteError(path_.empty() ? "(empty name)" : path_, "is a folder, not a file name");
  }
  if (!fs::is_directory(folder, ignored)) {
    throw WriteError(path_, "the folder '" + folder.string() + "' does not exist; create it first");
  }
  temporary_ = (folder / (target.stem().string() + ".part-" + std::to_string(::getpid()) +
                          target.extension().string()))
                   .string();
  // Creating it now tells at once, before any work, that the place cannot be written to.
  const int file = ::open(temporary_.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) throw WriteError(path_, std::string("cannot be written: ") + std::strerror(errno));
  ::close(file);
}

OutputFile::~OutputFile() {
  if (!committed_) ::unlink(temporary_.c_str());
}

void OutputFile::write(const std::string& bytes) {
  const int file = ::open(temporary_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  std::size_t done = 0;
  bool failed = file < 0;
  while (!failed && done < bytes.size()) {
    const ssize_t count = ::write(file, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    failed = count <= 0;
    if (!failed) done += static_cast<std::size_t>(count);
  }
  const int error = errno;
  if (file >= 0 && ::close(file) != 0) failed = true;
  if (failed) throw WriteError(path_, std::string("cannot be written: ") + std::strerror(error));
}

void OutputFile::commit() {
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) {
    throw WriteError(path_, std::string("cannot be written: ") + std::strerror(errno));
  }
  committed_ = true;
}

}  // namespace tetraglass::base
