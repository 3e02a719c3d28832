#pragma once

namespace tetraglass::preint {

/// Extinction of a preset at the top of the range, times the diagonal. A ray along the whole
/// diagonal through the upper half of the range (three quarters of this on average) keeps exp(-6) =
/// 0.25 % of the light; a plume a twentieth of the diagonal thick hides a quarter of what is behind
/// it, the cold air around it (a twentieth of the range) a third.
inline constexpr double kDepthAtTop = 8;

}  // namespace tetraglass::preint
