#include "apps/picture_files.h"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/mesh_input.h"
#include "apps/options.h"
#include "base/output_file.h"
#include "base/suggest.h"
#include "project/image_file.h"

namespace tetraglass::apps {
namespace {

using project::Mode;

double longest_path(const project::Image& image) {
  float longest = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) longest = std::max(longest, image.rgba[i]);
  return static_cast<double>(longest);
}

/// A picture in the mesh's units of length, scaled for 8 bits.
project::Image scaled(const project::Image& image, double white) {
  project::Image result = image;
  if (!(white > 0)) return result;
  for (std::size_t i = 0; i < result.rgba.size(); ++i) {
    if (i % 4 != 3) result.rgba[i] /= static_cast<float>(white);
  }
  return result;
}

std::string extension_of(const std::string& file) {
  const std::size_t dot = file.rfind('.');
  return dot == std::string::npos ? "" : CLI::detail::to_lower(file.substr(dot));
}

}  // namespace

project::Image scaled_for_8_bits(const project::Image& image, Mode mode) {
  return mode == Mode::thickness ? scaled(image, longest_path(image)) : image;
}

void check_outputs(const RenderArguments& arguments) {
  std::vector<std::string> known = project::image_extensions();
  if (draws_frames(arguments)) known.insert(known.end(), {".mp4", ".webm", ".gif"});
  for (const std::string& output : arguments.outputs) {
    const std::string extension = extension_of(output);
    if (std::find(known.begin(), known.end(), extension) == known.end()) {
      throw base::WriteError(output, is_film(output) ? "is a film: it needs --orbit N or --time all"
                                                     : base::unknown_extension(extension, known));
    }
    const base::OutputFile probe(output);
  }
  if (!arguments.stats.empty()) const base::OutputFile probe(arguments.stats);
}

void write_pictures(const RenderArguments& arguments, const std::vector<std::string>& files,
                    Mode mode, const project::Image& image, double white) {
  const project::Background background = make_background(arguments, mode);
  for (const std::string& file : files) {
    const bool scale = mode == Mode::thickness && extension_of(file) == ".png";
    const double brightest = white > 0 ? white : (scale ? longest_path(image) : 0);
    if (scale && !(white > 0))
      fmt::print(stderr, "thickness in .png: white is {:.6g}\n", brightest);
    const project::WriteReport report =
        project::write_image(scale ? scaled(image, brightest) : image, file, background);
    if (report.clipped_pixels > 0) {
      warn(fmt::format(
          "{}: {} pixels are brighter than white and were clipped; .exr and .npy keep them", file,
          report.clipped_pixels));
    }
  }
}

FrameOutputs::FrameOutputs(const RenderArguments& arguments, Mode mode, int count, int width,
                           int height, double white)
    : arguments_(arguments),
      mode_(mode),
      background_(make_background(arguments, mode)),
      count_(count),
      white_(white) {
  for (const std::string& output : arguments.outputs) {
    if (!is_film(output)) {
      (void)frame_file(output, 0, count);  // throws for names without a place for numbers
      stills_.push_back(output);
      continue;
    }
    double frames_per_second = 25;
    if (!arguments.fps.empty()) frames_per_second = parse_number(arguments.fps, "--fps");
    if (!(frames_per_second > 0 && frames_per_second <= 1000))
      throw base::UsageError("--fps needs a number above 0, to 1000");
    films_.push_back({output, std::make_unique<Film>(output, width, height, frames_per_second)});
  }
}

void FrameOutputs::add(const project::Image& image) {
  std::vector<std::string> files;
  for (const std::string& still : stills_) files.push_back(frame_file(still, next_, count_));
  write_pictures(arguments_, files, mode_, image, white_);
  written_.insert(written_.end(), files.begin(), files.end());
  const project::Image shown = mode_ == Mode::thickness ? scaled(image, white_) : image;
  for (const FilmInWork& film : films_) film.film->add(shown, background_);
  ++next_;
}

std::vector<std::string> FrameOutputs::finish() {
  for (const FilmInWork& film : films_) {
    film.film->finish();
    written_.push_back(film.file);
  }
  return written_;
}

}  // namespace tetraglass::apps
