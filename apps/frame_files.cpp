#include "apps/frame_files.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "apps/options.h"
#include "base/output_file.h"

namespace tetraglass::apps {
namespace {

constexpr const char* kCoder = "ffmpeg";

std::string extension_of(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Where the program lies among the folders of PATH; empty where it does not.
std::string find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::string file = (folder.empty() ? "." : folder) + "/" + name;
    if (access(file.c_str(), X_OK) == 0) return file;
  }
  return "";
}

std::vector<std::string> arguments_for(const std::string& file, int width, int height,
                                       double frames_per_second) {
  std::vector<std::string> words = {kCoder,     "-v",
                                    "error",    "-y",
                                    "-f",       "rawvideo",
                                    "-pix_fmt", "rgb24",
                                    "-s",       fmt::format("{}x{}", width, height),
                                    "-r",       fmt::format("{}", frames_per_second),
                                    "-i",       "pipe:0"};
  const std::string extension = extension_of(file);
  if (extension == ".gif") {
    words.insert(words.end(), {"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse"});
  } else {
    // The usual coding of colors wants even sides.
    words.insert(words.end(), {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"});
    if (extension == ".mp4") {
      words.insert(words.end(), {"-c:v", "libx264", "-crf", "18", "-movflags", "+faststart"});
    } else {
      words.insert(words.end(), {"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0"});
    }
  }
  words.push_back(file);
  return words;
}

}  // namespace

bool is_film(const std::string& file) {
  const std::string extension = extension_of(file);
  return extension == ".mp4" || extension == ".webm" || extension == ".gif";
}

std::string frame_file(const std::string& output, int index, int count) {
  const std::size_t place = output.find('%');
  if (place == std::string::npos) {
    const int digits = std::max(4, static_cast<int>(std::to_string(count - 1).size()));
    const std::filesystem::path path(output);
    return (path.parent_path() / path.stem()).string() + fmt::format("-{:0{}}", index, digits) +
           path.extension().string();
  }
  std::size_t end = place + 1;
  while (end < output.size() && output[end] >= '0' && output[end] <= '9') ++end;
  const std::string width = output.substr(place + 1, end - place - 1);
  if (end >= output.size() || output[end] != 'd' || width.size() > 2 ||
      output.find('%', place + 1) != std::string::npos) {
    throw base::UsageError("'" + output +
                           "' names no frames: a number goes where %d or %04d is, once");
  }
  const int digits = width.empty() ? 1 : std::stoi(width);
  const std::string number = width.starts_with("0") ? fmt::format("{:0{}}", index, digits)
                                                    : fmt::format("{:{}}", index, digits);
  return output.substr(0, place) + number + output.substr(end + 1);
}

struct Film::Process {
  Process(const std::string& name, int w, int h) : file(name), width(w), height(h) {}

  base::OutputFile file;
  int width;
  int height;
  pid_t pid = -1;
  int frames = -1;    ///< the pipe that it reads
  int messages = -1;  ///< the file that it complains to
  std::vector<unsigned char> bytes;

  /// Waits; the exit status.
  int end() {
    if (frames >= 0) close(frames);
    frames = -1;
    if (pid < 0) return 0;
    int status = 0;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    pid = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  }

  [[noreturn]] void fail(int status) const {
    throw base::WriteError(file.path(),
                           fmt::format("ffmpeg ended with status {}: {}", status, complaint()));
  }

  /// The last line that it wrote.
  [[nodiscard]] std::string complaint() const {
    std::string text(4096, '\0');
    const off_t size = lseek(messages, 0, SEEK_END);
    const ssize_t got = pread(messages, text.data(), text.size(), std::max<off_t>(0, size - 4096));
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    const std::size_t line = text.rfind('\n');
    return line == std::string::npos ? text : text.substr(line + 1);
  }
};

Film::Film(const std::string& file, int width, int height, double frames_per_second) {
  const std::string program = find_program(kCoder);
  if (program.empty()) {
    throw base::UnavailableError(file +
                                 ": films are written by ffmpeg, which is not installed; "
                                 "write frames with -o NAME.png instead");
  }
  process_ = std::make_unique<Process>(file, width, height);
  std::array<int, 2> pipe_ends{};
  std::string name = (std::filesystem::temp_directory_path() / "tetraglass-XXXXXX").string();
  process_->messages = mkostemp(name.data(), O_CLOEXEC);
  if (process_->messages >= 0) unlink(name.c_str());
  if (process_->messages < 0 || pipe2(pipe_ends.data(), O_CLOEXEC) != 0) {
    throw base::WriteError(file, std::string("ffmpeg cannot be started: ") + std::strerror(errno));
  }
  std::vector<std::string> words =
      arguments_for(process_->file.temporary_path(), width, height, frames_per_second);
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, process_->messages, STDERR_FILENO);
  const int error =
      posix_spawn(&process_->pid, program.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[0]);
  process_->frames = pipe_ends[1];
  if (error != 0) {
    process_->pid = -1;
    throw base::WriteError(file, std::string("ffmpeg cannot be started: ") + std::strerror(error));
  }
}

Film::~Film() {
  if (!process_) return;
  process_->end();
  if (process_->messages >= 0) close(process_->messages);
}

void Film::add(const project::Image& image, const project::Background& background) {
  project::Background opaque = background;
  opaque.alpha = 1;
  const project::Image encoded = project::encode(image, opaque);
  process_->bytes.clear();
  for (std::size_t i = 0; i < encoded.rgba.size(); ++i) {
    if (i % 4 == 3) continue;
    const float value = std::clamp(encoded.rgba[i], 0.0F, 1.0F);
    process_->bytes.push_back(static_cast<unsigned char>(std::lround(255 * value)));
  }
  // A coder that has ended must not end this program: what is wrong is told by finish().
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  std::size_t done = 0;
  while (done < process_->bytes.size()) {
    const ssize_t wrote =
        write(process_->frames, process_->bytes.data() + done, process_->bytes.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) break;
    done += static_cast<std::size_t>(wrote);
  }
  std::signal(SIGPIPE, before);
  if (done < process_->bytes.size()) process_->fail(process_->end());
}

void Film::finish() {
  const int status = process_->end();
  if (status != 0) process_->fail(status);
  process_->file.commit();
}

}  // namespace tetraglass::apps
