#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/frame_files.h"
#include "apps/render_arguments.h"
#include "project/image.h"
#include "project/scene.h"

namespace tetraglass::apps {

/// A picture of mode thickness, which is in the mesh's units of length, scaled for 8 bits so that
/// the longest path is white; of other modes as it is.
[[nodiscard]] project::Image scaled_for_8_bits(const project::Image& image, project::Mode mode);

/// Checks the names of all outputs before anything long is done. Throws WriteError for an unknown
/// extension or a folder that cannot be written to.
void check_outputs(const RenderArguments& arguments);

/// Writes a picture under these names, over the background that the arguments ask for; tells on
/// stderr of what 8 bits cannot hold. Pictures of mode thickness are scaled for .png: white is
/// `white`, or the longest path where it is 0.
void write_pictures(const RenderArguments& arguments, const std::vector<std::string>& files,
                    project::Mode mode, const project::Image& image, double white = 0);

/// The outputs of a row of frames: numbered pictures, and films.
class FrameOutputs {
 public:
  /// `count` frames of this size in all; `white`: as in `write_pictures`. Throws as Film does.
  FrameOutputs(const RenderArguments& arguments, project::Mode mode, int count, int width,
               int height, double white);

  void add(const project::Image& image);

  /// The files written, in order; films are whole from now on.
  [[nodiscard]] std::vector<std::string> finish();

 private:
  struct FilmInWork {
    std::string file;
    std::unique_ptr<Film> film;
  };

  const RenderArguments& arguments_;
  project::Mode mode_;
  project::Background background_;
  int count_;
  double white_;
  int next_ = 0;
  std::vector<std::string> stills_;  // names as given
  std::vector<FilmInWork> films_;
  std::vector<std::string> written_;
};

}  // namespace tetraglass::apps
