#pragma once

#include <optional>

#include "project/gl/cell_layout.h"
#include "project/gl/mesh_buffers.h"

namespace tetraglass::project::gl {

/// Cells and vertices once, in texture buffers; the vertex stage makes 4 vertices a cell
/// (`indexed`: the faces as 12 indices) or 6 (`strip`: the faces as one triangle strip, weiler2002
/// section 8).
class IndexedCells final : public CellLayout {
 public:
  /// Whether the mesh, `drawn` cells of which are to be drawn, fits as a whole.
  [[nodiscard]] static bool fit(const PartLimits& limits, const Scene& scene, const Plan& plan,
                                std::size_t drawn);

  /// Throws UnavailableError where it does not.
  IndexedCells(const Context& context, const Scene& scene, const Plan& plan,
               const Normalization& normalization, const std::vector<std::uint32_t>& drawn);

  [[nodiscard]] const char* vertex_shader() const override { return "cell.vert.glsl"; }
  [[nodiscard]] std::vector<std::string> switches() const override;
  void set_uniforms(const Program& program) const override;
  [[nodiscard]] bool draws_front_faces() const override { return false; }
  void set_order(const std::vector<std::uint32_t>& cells) override;
  void draw() override;
  [[nodiscard]] std::size_t parts() const override { return 1; }
  [[nodiscard]] LayoutBytes bytes() const override;

 private:
  bool strip_;
  bool sorted_;
  std::size_t count_;
  MeshBuffers mesh_;
  std::optional<TextureBuffer> order_;  // cells to draw; without it all are drawn
  CellFaces faces_;
};

}  // namespace tetraglass::project::gl
