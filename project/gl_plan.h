#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "project/scene.h"

namespace tetraglass::project {

/// How cells lie in the memory of the gl projector, and what the fragment stage gets of them.
enum class Layout {
  indexed,  ///< cells and vertices once, 4 vertices a cell, the planes of the faces per fragment
  strip,    ///< the same drawn as one strip of 6 vertices a cell (weiler2002 section 8)
  faces12,  ///< 12 vertices of 15 floats a cell, interpolated ray parameters (weiler2002)
  faces12_short  ///< the same with 16-bit numbers where the paper has them: 456 bytes a cell
};

/// Where the smallest of the three ray parameters is found (weiler2002 section 4.1).
enum class Minimum { shader, texture8, texture16 };

/// What a frame is accumulated in.
enum class TargetFormat { rgba32f, rgba16f, rgba8 };

/// What the user forced of GlPlan.
struct GlRequest {
  std::optional<Layout> layout;
  std::optional<bool> edge_fix;
  std::optional<Minimum> minimum;
  std::optional<bool> interpolate_lengths;
  std::optional<TargetFormat> target;
  std::optional<std::size_t> memory;
};

/// The part of a plan that only the gl projector knows.
struct GlPlan {
  Layout layout = Layout::indexed;
  bool edge_fix = true;               ///< faces12: weiler2002 section 4.3
  Minimum minimum = Minimum::shader;  ///< faces12
  bool interpolate_lengths = false;   ///< faces12: the paper's parameters, wrong in perspective
  TargetFormat target = TargetFormat::rgba32f;
  /// Most bytes that the mesh takes on the context at once; larger ones are drawn part after part.
  /// 0: as much as OpenGL can hold.
  std::size_t memory = 0;
  /// What positions in the picture are rounded to, in pixels: vertices are floats of half the
  /// mesh's diagonal. Beyond kLargestPositionRounding cells fall apart, and plan tells so.
  double position_rounding = 0;
};

/// Half of what tells neighbouring pixels' rays apart.
inline constexpr double kLargestPositionRounding = 0.25;

/// Throws UsageError for what the layout or the mode lacks. One line per decision that is not the
/// default goes to `reasons`.
[[nodiscard]] GlPlan plan_gl(const Scene& scene, const GlRequest& request,
                             std::vector<std::string>& reasons);

/// Whether the user forced anything.
[[nodiscard]] bool is_any_set(const GlRequest& request);

/// Whether the layout has 12 vertices a cell.
[[nodiscard]] constexpr bool has_faces12(Layout layout) {
  return layout == Layout::faces12 || layout == Layout::faces12_short;
}

/// What a cell takes of those with 12 vertices.
[[nodiscard]] constexpr std::size_t faces12_bytes(Layout layout) {
  return layout == Layout::faces12 ? 720 : 456;
}

[[nodiscard]] std::string to_string(Layout layout);
[[nodiscard]] std::string to_string(Minimum minimum);
[[nodiscard]] std::string to_string(TargetFormat target);

}  // namespace tetraglass::project
