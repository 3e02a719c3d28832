#pragma once

#include <optional>
#include <span>
#include <vector>

#include "project/gl/cell_parts.h"
#include "project/gl/normalization.h"
#include "project/gl/objects.h"
#include "project/gl/program.h"
#include "project/plan.h"
#include "project/scene.h"

namespace tetraglass::project::gl {

/// The mesh on the context: cells and vertices once, whatever the view, and no more than the scene
/// asks for. All of it, or a part at a time.
class MeshBuffers {
 public:
  /// Cells (4 vertex ids in ascending order, which both cells at a face agree on, and the sign of
  /// the orientation in that order), vertices (normalized position and value), the values of a cell
  /// field, the densities of cells that a scene modulates, and the gradients at the vertices if
  /// `gradients`. Nothing is on the context yet. Refers
  /// to the scene and the normalization, which outlive it.
  MeshBuffers(const Context& context, const Scene& scene, const Normalization& normalization,
              bool gradients);

  /// What a cell takes, and a point.
  [[nodiscard]] static std::size_t cell_bytes(const Scene& scene);
  [[nodiscard]] static std::size_t point_bytes(bool gradients);

  /// Puts the whole mesh there, for good. Throws UnavailableError where it does not fit.
  void load();

  /// Puts these cells there, a part that `cutter` has just cut, in place of the
  /// last part. Throws UnavailableError where it does not fit.
  void load(std::span<const std::uint32_t> cells, const CellCutter& cutter);

  /// Makes them the textures of the units that `Units` names.
  void bind() const;

  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] std::size_t density_bytes() const { return densities_ ? densities_->bytes() : 0; }
  [[nodiscard]] std::size_t gradient_bytes() const { return gradients_ ? gradients_->bytes() : 0; }

 private:
  const Scene& scene_;
  const Normalization& normalization_;
  std::vector<Eigen::Vector4f> vertex_gradients_;
  TextureBuffer cells_;
  TextureBuffer vertices_;
  std::optional<TextureBuffer> cell_values_;
  std::optional<TextureBuffer> gradients_;
  std::vector<float> cell_densities_;
  std::optional<TextureBuffer> densities_;
};

/// Whether the shaders light by gradients at the vertices.
[[nodiscard]] bool needs_vertex_gradients(const Scene& scene, const Plan& plan);

/// Tells the samplers of the mesh where its textures are.
void set_mesh_units(const Program& program);

/// The texture unit of each sampler of the shaders.
struct Units {
  static constexpr int kCells = 0;
  static constexpr int kVertices = 1;
  static constexpr int kOrder = 2;
  static constexpr int kCellValues = 3;
  static constexpr int kGradients = 4;
  static constexpr int kMediumPieces = 5;
  static constexpr int kMediumIndex = 6;
  static constexpr int kTable = 7;
  static constexpr int kSurfaces = 8;
  static constexpr int kMinima = 9;
  static constexpr int kLights = 10;
  static constexpr int kRayEnds = 11;
  static constexpr int kDiffuseMap = 12;
  static constexpr int kSpecularMap = 13;
  static constexpr int kBackTable = 14;
  static constexpr int kMaterialTable = 15;
  static constexpr int kDensities = 16;
};

}  // namespace tetraglass::project::gl
