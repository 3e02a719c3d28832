#pragma once

#include <algorithm>
#include <vector>

#include "project/gl/cell_layout.h"
#include "project/gl/cell_parts.h"
#include "project/gl/mesh_buffers.h"

namespace tetraglass::project::gl {

/// What the layouts `indexed` and `strip` may put on the context at once: as much as the plan has
/// it and as it can number.
[[nodiscard]] PartLimits indexed_limits(const Context& context, const Scene& scene,
                                        const Plan& plan);

/// As IndexedCells, for meshes that do not fit: the cells are cut into parts in the order to draw
/// them in, whatever it is, and each part is put on the context in place of the one before. Every
/// ray meets the same segments to the last bit.
class IndexedParts final : public CellLayout {
 public:
  IndexedParts(const Context& context, const Scene& scene, const Plan& plan,
               const Normalization& normalization, const std::vector<std::uint32_t>& drawn);

  [[nodiscard]] const char* vertex_shader() const override { return "cell.vert.glsl"; }
  [[nodiscard]] std::vector<std::string> switches() const override;
  void set_uniforms(const Program& program) const override;
  [[nodiscard]] bool draws_front_faces() const override { return false; }
  void set_order(const std::vector<std::uint32_t>& cells) override { cells_ = cells; }
  void draw() override;
  [[nodiscard]] std::size_t parts() const override { return std::max<std::size_t>(1, parts_); }
  [[nodiscard]] LayoutBytes bytes() const override { return most_; }

 private:
  const Context& context_;
  bool strip_;
  std::vector<std::uint32_t> cells_;  // in the order to draw
  CellCutter cutter_;
  MeshBuffers mesh_;
  CellFaces faces_;
  std::size_t parts_ = 0;
  LayoutBytes most_;
};

}  // namespace tetraglass::project::gl
