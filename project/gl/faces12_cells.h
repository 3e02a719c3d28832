#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "project/gl/cell_layout.h"
#include "project/gl/objects.h"

namespace tetraglass::project::gl {

/// The layout of weiler2002, section 6: for each of a cell's four faces three vertices of its own,
/// in four plain vertex arrays:
/// - position; constant of the plane of the face opposite to the vertex: 4 floats,
/// - value and gradient of the field: 4 numbers,
/// - two components of the normal of that plane; which of the fragment's three ray parameters is
///   the vertex's own (0, 1, 2 around the face); the longest edge of the cell: 4 numbers,
/// - the normal of the face across the edge that starts at the vertex: 3 numbers.
///
/// Numbers are floats, 720 bytes a cell, or (`faces12_short`) 16-bit but for the first array, 456
/// bytes a cell. One draw call unsorted; sorted one pair (first vertex, number of vertices) a cell.
/// Cells that do not fit are drawn in parts, in their order, each put on the context in place of
/// the one before. A cell too thin for floats to have a volume is left out (its segments are
/// thinner than their rounding).
class Faces12Cells final : public CellLayout {
 public:
  /// Throws UnavailableError where not even one cell fits.
  Faces12Cells(const Context& context, const Scene& scene, const Plan& plan,
               const Normalization& normalization, const std::vector<std::uint32_t>& drawn);

  [[nodiscard]] const char* vertex_shader() const override { return "faces12.vert.glsl"; }
  [[nodiscard]] std::vector<std::string> switches() const override;
  void set_uniforms(const Program& program) const override;
  [[nodiscard]] bool draws_front_faces() const override { return true; }
  void set_order(const std::vector<std::uint32_t>& cells) override;
  void draw() override;
  [[nodiscard]] std::size_t parts() const override;
  [[nodiscard]] LayoutBytes bytes() const override {
    return {bytes_, sizeof(std::uint32_t) * place_.size() + sizeof(int) * firsts_.size(), 0};
  }

 private:
  /// In place of what was there.
  void load(std::span<const std::uint32_t> cells);
  template <class Number>
  void upload(std::span<const std::uint32_t> cells);

  const Context& context_;
  const Scene& scene_;
  const Normalization& normalization_;
  GlPlan plan_;
  bool needs_depth_;  // where on the ray a segment lies matters
  std::size_t count_;
  std::size_t at_once_;  // so many cells
  std::size_t bytes_ = 0;
  VertexArrays arrays_;
  std::optional<Table> minima_;
  Eigen::Vector4f scale_ = Eigen::Vector4f::Ones();  // of values, gradients, normals, edges
  std::vector<std::uint32_t> place_;                 // of a cell of the mesh among those drawn
  std::vector<int> firsts_;           // vertices, in the order to draw; none: one run
  std::vector<std::uint32_t> cells_;  // in the order to draw, where they are drawn in parts
};

}  // namespace tetraglass::project::gl
