#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "project/gl/normalization.h"
#include "project/gl/program.h"
#include "project/plan.h"
#include "project/scene.h"

namespace tetraglass::project::gl {

/// What cells take in memory.
struct LayoutBytes {
  std::size_t cells = 0;
  std::size_t order = 0;  ///< only where they are sorted
  std::size_t gradients = 0;
  std::size_t densities = 0;  ///< of cells that a scene modulates

  [[nodiscard]] std::size_t sum() const { return cells + order + gradients + densities; }
};

/// The cells that a scene shows, as one layout keeps them on the context and draws them.
class CellLayout {
 public:
  CellLayout() = default;
  virtual ~CellLayout() = default;
  CellLayout(const CellLayout&) = delete;
  CellLayout& operator=(const CellLayout&) = delete;

  /// The file of the vertex stage.
  [[nodiscard]] virtual const char* vertex_shader() const = 0;

  /// The `#define`s that the layout adds to those of the scene.
  [[nodiscard]] virtual std::vector<std::string> switches() const = 0;

  /// Sets the uniforms that do not depend on the view.
  virtual void set_uniforms(const Program& program) const = 0;

  /// Whether a fragment stands for the ray's entry into a cell; otherwise for its exit.
  [[nodiscard]] virtual bool draws_front_faces() const = 0;

  /// The cells (their numbers in the mesh: a permutation of those to draw) in the order to draw
  /// them in. Only for plans that sort.
  virtual void set_order(const std::vector<std::uint32_t>& cells) = 0;

  /// Draws all cells with the program in use.
  virtual void draw() = 0;

  /// As how many parts, one after the other, `draw` put the cells on the context. 1: all of them
  /// stay there.
  [[nodiscard]] virtual std::size_t parts() const = 0;

  /// What is kept, on the context and beside it; of parts the most at once so far.
  [[nodiscard]] virtual LayoutBytes bytes() const = 0;
};

/// Lays out the cells `drawn` of the scene (in the order of the mesh) as the plan has it: in parts
/// where they are more than the context or the plan's memory holds. Refers to the context, the
/// scene and the normalization, which outlive it. Throws UnavailableError where not even one cell
/// fits.
[[nodiscard]] std::unique_ptr<CellLayout> make_cell_layout(const Context& context,
                                                           const Scene& scene, const Plan& plan,
                                                           const Normalization& normalization,
                                                           const std::vector<std::uint32_t>& drawn);

}  // namespace tetraglass::project::gl
