#pragma once

#include "project/gl/normalization.h"
#include "project/gl/objects.h"
#include "project/scene.h"

namespace tetraglass::project::gl {

/// The mesh on the context: cells and vertices once, whatever the view, and no more than the scene
/// asks for.
class MeshBuffers {
 public:
  /// Cells (4 vertex ids in ascending order, which both cells at a face agree on, and the sign of
  /// the orientation in that order), vertices (normalized position and value), the values of a cell
  /// field, and the gradients at the vertices if `gradients`. Throws UnavailableError where they do
  /// not fit.
  MeshBuffers(const Context& context, const Scene& scene, const Normalization& normalization,
              bool gradients);

  /// Makes them the textures of the units that `Units` names.
  void bind() const;

  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] std::size_t gradient_bytes() const { return gradients_ ? gradients_->bytes() : 0; }

 private:
  TextureBuffer cells_;
  TextureBuffer vertices_;
  std::optional<TextureBuffer> cell_values_;
  std::optional<TextureBuffer> gradients_;
};

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
};

}  // namespace tetraglass::project::gl
