#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "project/effect.h"
#include "project/plan.h"
#include "project/scene.h"
#include "project/stats.h"

namespace tetraglass::project {

/// What a scene calls for of one effect.
struct EffectPlan {
  Effect effect = Effect::cells;
  bool needed = false;
  std::string why;  ///< or why not; for people
  /// What is expected to be stored for it, and to be spent on it once. None where an effect needs
  /// nothing of its own but a switch of the code that draws segments, and for what is not
  /// predicted: the projectors other than cpu and gl, the time of gl on a GPU.
  std::optional<std::size_t> bytes;
  std::optional<double> ms;
};

/// All effects, in the order of kEffects; those that are not needed cost nothing.
///
/// Bytes are those of the buffers. Times are a guess: of the geometry, a ray meets a convex cell
/// with the area of its shadow, the mean of which over all directions is a quarter of its surface
/// (Cauchy); of the machine, so many cores of 2.9 GHz with AVX-512 as there are `threads`.
/// Pure. Cost: linear in the cells.
[[nodiscard]] std::vector<EffectPlan> planned_effects(const Scene& scene, const Plan& plan,
                                                      int threads);

/// The same effects as a table for people, with what they took beside it where `stats` is given.
[[nodiscard]] std::string effects_table(const std::vector<EffectPlan>& effects,
                                        const Stats* stats = nullptr);

}  // namespace tetraglass::project
