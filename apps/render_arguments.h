#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/camera_options.h"
#include "apps/figure_arguments.h"
#include "apps/slices_options.h"
#include "mesh/import.h"
#include "preint/transfer_function.h"
#include "project/image_file.h"
#include "project/plan.h"
#include "project/scene.h"

namespace CLI {
class App;
}

namespace tetraglass::apps {

/// The options as typed; empty where not given.
struct RenderArguments : CameraArguments {
  std::string input;
  std::vector<std::string> outputs;
  std::string size = "800x600";
  std::string region;
  std::string samples;
  std::string field;
  std::string mode = "full";
  std::string mip_of = "field";
  std::vector<std::string> isovalues;
  std::vector<std::string> iso_colors;
  std::string iso_opacity;
  std::string transfer_function = "viridis";
  /// In the place of what `transfer_function` names.
  std::optional<preint::TransferFunction> own_transfer_function;
  std::string range;
  std::string opacity;
  std::string opacity_scale;
  bool logarithmic = false;
  std::vector<std::string> clip;
  std::string depth_cue;
  std::string projector = "auto";
  std::string context = "auto";
  std::string sort = "auto";
  std::string opaque_at;
  std::string integrator = "auto";
  std::string table;
  std::string layout = "auto";
  std::string edge_fix;
  std::string minimum;
  std::string perspective;
  std::string target_format;
  std::string gpu_memory;
  std::string shading;
  std::string gradient;
  std::string lights;
  /// In the place of what `lights` names.
  std::optional<project::Lights> own_lights;
  std::string light_map;
  std::string modulate;
  std::string background;
  std::string stats;
  std::string verify;
  std::string max_error;
  std::string threads;
  bool explain = false;
  SlicesArguments slices;
  FigureArguments figure;
  std::string orbit;
  std::string fps;
  std::string scene;
  std::string save_scene;
  mesh::ImportOptions import;
};

/// Whether the trilinear field of a grid is drawn, not cells.
[[nodiscard]] bool draws_grid(const RenderArguments& arguments);

/// Whether a row of frames is asked for: --orbit, --time all.
[[nodiscard]] bool draws_frames(const RenderArguments& arguments);

/// Whether the frames are time steps.
[[nodiscard]] bool draws_all_times(const RenderArguments& arguments);

/// The frames of --orbit; 0 where it is not given. Throws UsageError.
[[nodiscard]] int orbit_frames(const RenderArguments& arguments);

/// What --orbit turns around: where the eye looks, if it is given, else the middle of the scene.
[[nodiscard]] Eigen::Vector3d orbit_pivot(const RenderArguments& arguments,
                                          const project::Scene& scene);

/// What is drawn, seen how: all options of a scene but its camera's.
void add_scene_options(CLI::App* app, RenderArguments& arguments);

/// What stands around the picture and among the volume.
void add_figure_options(CLI::App* app, FigureArguments& arguments);

/// How it is drawn: the projector and what can be chosen of it.
void add_method_options(CLI::App* app, RenderArguments& arguments);

/// What a scene takes of its mesh for a field, however it is drawn.
struct DrawnField {
  mesh::ScalarField field;
  mesh::Drawable drawable;
  mesh::Box box;  ///< of the mesh
};

/// Depends on nothing of the arguments but the field and whether a grid is drawn. Throws InputError
/// where there is no such field, or nothing to draw of it. Cost: passes over all cells.
[[nodiscard]] DrawnField select_field(const RenderArguments& arguments, const mesh::TetMesh& mesh);

/// The scene that the arguments ask for, of a mesh that outlives it. Throws UsageError for values
/// that cannot be, InputError and ReadError where the mesh or the transfer function's file lack
/// what is needed; warns on stderr of what will not be seen. Its size is that of the picture of
/// the volume: what Figure (figure.h) leaves of the size asked for.
/// `values`: what the transfer function and the isosurfaces are made for, where it is not the field
/// of the mesh (but that of all time steps).
[[nodiscard]] project::Scene make_scene(const RenderArguments& arguments, const mesh::TetMesh& mesh,
                                        const mesh::ScalarField* values = nullptr);

/// The same of what was selected of this mesh before.
[[nodiscard]] project::Scene make_scene(const RenderArguments& arguments, const mesh::TetMesh& mesh,
                                        DrawnField drawn,
                                        const mesh::ScalarField* values = nullptr);

/// The way of drawing that the arguments force. Throws UsageError.
[[nodiscard]] project::Request make_request(const RenderArguments& arguments);

/// What stands behind a .png. Throws UsageError.
[[nodiscard]] project::Background make_background(const RenderArguments& arguments,
                                                  project::Mode mode);

}  // namespace tetraglass::apps
