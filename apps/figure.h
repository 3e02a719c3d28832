#pragma once

#include "apps/render_arguments.h"
#include "project/image.h"
#include "project/scene.h"

namespace tetraglass::apps {

/// The picture of a volume with what stands around it: title, color legend, axes. Made once for all
/// pictures of a scene that differ by their camera.
class Figure {
 public:
  /// Of `width` x `height` pixels in all. Reads of the scene all but its camera and size; the scene
  /// outlives this. Throws UsageError where there is no room for the picture, mode thickness (whose
  /// pictures hold lengths, not colors) or only a part of the picture is asked for,
  /// UnavailableError where there is no font.
  Figure(const RenderArguments& arguments, const project::Scene& scene, int width, int height);

  /// What is left for the picture of the volume itself, in pixels.
  [[nodiscard]] int picture_width() const { return picture_.width; }
  [[nodiscard]] int picture_height() const { return picture_.height; }

  /// The whole figure: the picture (of picture_width() x picture_height() pixels, seen by `camera`)
  /// in its place, all else laid over it in linear light, premultiplied. With nothing asked for the
  /// picture as it is. Cost: that of some passes over the pixels.
  [[nodiscard]] project::Image around(const project::Image& picture,
                                      const project::Camera& camera) const;

  /// The first of these cameras moved back and sideways as far as needed for all axes and their
  /// labels to be seen, and the same by the others moved with it; of parallel views, whose height
  /// is given, sideways only. As it is where no axes are asked for.
  [[nodiscard]] project::Camera with_room_for_axes(std::vector<project::Camera> cameras) const;

 private:
  [[nodiscard]] std::string legend_title() const;

  FigureArguments arguments_;  // texts as they can be set
  bool logarithmic_;
  const project::Scene& scene_;
  project::Background background_;
  mesh::Box box_;  // of axes
  int width_;
  int height_;
  double scale_;
  project::Region picture_;  ///< its place
};

/// The box of what is drawn: the cells that can be, and opaque surfaces.
[[nodiscard]] mesh::Box drawn_box(const project::Scene& scene);

/// Adds the outline and the surfaces that are asked for to the scene's opaque geometry. Throws
/// ReadError and InputError for a surface that cannot be read.
void add_opaque_geometry(const RenderArguments& arguments, project::Scene& scene);

}  // namespace tetraglass::apps
