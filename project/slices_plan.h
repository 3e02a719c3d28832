#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "project/scene.h"

namespace tetraglass::project {

/// What cuts the rays through a grid into the segments that are drawn one after the other, and the
/// textures that hold the grid.
enum class Stack {
  planes,   ///< planes parallel to the image; a 3D texture (wilson1994)
  shells,   ///< spheres about the eye (planes in parallel views); a 3D texture
  textures  ///< planes of the grid across the axis that is seen most directly; each a 2D texture
            ///< (meissner2002 section 2)
};

/// What the field is between the points of the grid.
enum class Filter { linear, nearest };

/// How a number of the grid is stored.
enum class TexelBits { bits8, bits12, bits16, floats };

/// When the transfer function is applied.
enum class Classify {
  post,       ///< to the value at the middle of the slab, constant in it
  pre,        ///< to the grid's values: colors are interpolated (wilson1994)
  integrated  ///< to all values from the front to the back of the slab (lum2004, meissner2002)
};

/// What the user forced of SlicesPlan.
struct SlicesRequest {
  std::optional<Stack> stack;
  std::optional<Filter> filter;
  std::optional<TexelBits> texels;
  std::optional<Classify> classify;
  std::optional<int> slices;       ///< slabs across the grid's diagonal
  std::optional<double> distance;  ///< between slices, in world units
  std::optional<bool> skip_empty;
  std::optional<bool> compress;
  std::optional<std::size_t> brick_bytes;
};

/// The part of a plan that only the slices projector knows.
struct SlicesPlan {
  Stack stack = Stack::planes;
  Filter filter = Filter::linear;
  TexelBits texels = TexelBits::floats;
  Classify classify = Classify::integrated;
  double distance = 0;     ///< between slices, in world units; 0: the grid's planes (`textures`)
  bool skip_empty = true;  ///< blocks of the grid that show nothing are not drawn
  bool compress =
      false;  ///< textures in blocks of 4 x 4 texels (Stack::textures; meissner2002 5.1)
  std::size_t brick_bytes = 0;  ///< the largest texture, loaded one after the other; 0: one for all
};

/// Slices need not be more across the grid's diagonal: finer ones are below a float's rounding.
inline constexpr int kMostSlices = 1 << 16;

/// Of a scene with a grid. By default two slices a point of the grid, at which wilson1994 found the
/// best pictures. Throws UsageError for what slices, the mode or the classification lack. One line
/// per decision goes to `reasons`.
[[nodiscard]] SlicesPlan plan_slices(const Scene& scene, const SlicesRequest& request,
                                     std::vector<std::string>& reasons);

/// Whether the user forced anything.
[[nodiscard]] bool is_any_set(const SlicesRequest& request);

[[nodiscard]] std::string to_string(Stack stack);
[[nodiscard]] std::string to_string(Filter filter);
[[nodiscard]] std::string to_string(TexelBits texels);
[[nodiscard]] std::string to_string(Classify classify);

}  // namespace tetraglass::project
