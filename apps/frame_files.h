#pragma once

#include <memory>
#include <string>
#include <vector>

#include "project/image.h"
#include "project/image_file.h"

namespace tetraglass::apps {

/// Whether the file is a film that ffmpeg writes: .mp4, .webm or .gif.
[[nodiscard]] bool is_film(const std::string& file);

/// The file of frame number `index` of `count`: out.png becomes out-0007.png; a place %d, %4d or
/// %04d in the name takes the number. Throws UsageError for more than one such place, or another
/// after a %.
[[nodiscard]] std::string frame_file(const std::string& output, int index, int count);

/// A film in work: frames are handed to ffmpeg, which runs beside the program. The file appears
/// whole or not at all.
class Film {
 public:
  /// Throws UnavailableError where there is no ffmpeg, WriteError where the file cannot be.
  Film(const std::string& file, int width, int height, double frames_per_second);
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  /// The next frame, over the background (opaque in films).
  void add(const project::Image& image, const project::Background& background);

  /// Throws WriteError with what ffmpeg says where it fails.
  void finish();

 private:
  struct Process;
  std::unique_ptr<Process> process_;
};

}  // namespace tetraglass::apps
