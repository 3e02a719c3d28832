#pragma once

#include "project/plan.h"
#include "project/scene.h"

namespace tetraglass::tests {

/// What a projector may round. Its picture has to be the exact one of a scene that differs by no
/// more than this from the one that was asked for, but for the rounding of sums.
struct Roundings {
  double position = 0;       ///< of a ray, in pixels
  double vertex = 0;         ///< of the mesh's vertices, in its units
  double depth = 0;          ///< of a face along the view axis, in units of the mesh
  double value = 0;          ///< of the field on a face
  double control_point = 0;  ///< of the transfer function's values
  double per_segment = 0;    ///< of a sum over a ray, by each segment, relative (see `unit`)
  double channel = 0;        ///< of what comes out, relative
  /// Relative to the largest channel or to this: of colors 1, of lengths the half diagonal.
  double unit = 1;
};

/// The bounds come from the formats in which each projector holds its numbers:
/// - reference: doubles; the picture, as what it is held against, is of floats (2^-24 each).
/// - cpu: positions in blocks of pixels to 2^-20 (face_planes-inl.h, kShiftRight), depths and
/// values
///   of faces to 2^-20 of the mesh's half diagonal and of half the field's range (kSteep); two
///   roundings of 2^-24 a segment; segments of mode full to 1e-6 of their opacity
///   (preint::kFinestPiece), and 2e-5 behind pixels taken for opaque (--opaque-at).
/// - gl: vertices as floats of half diagonals and planes as floats of pixels, so that positions
///   hold 2^-21 of the picture's or the half diagonal's size in pixels (view_uniforms.cpp,
///   tie_shift); planes are anchored at a vertex, within two half diagonals of the mesh: four
///   roundings of 2^-23 are 2^-21 a face, and the same for values; segments of mode full to 2.2e-7
///   (model.glsl).
/// Crossings are decided with isovalues 2^-21 of half the range lower
/// (ValueScale::isovalue_threshold). Both hold control points as floats of half the range. What a
/// headlight adds to an isosurface changes with the cosine by 0.2 * 32 * 4 of specular and 0.7 of
/// diffuse light, and that is rounded by four floats. Depths in perspective are kept as quotients:
/// a rounding grows with the square of the depth over that of the mesh's middle, fourfold at most.
/// `input`: what points of the mesh were rounded to, in its units.
[[nodiscard]] Roundings roundings(const project::Scene& scene, project::Projector projector,
                                  double input = 0);

}  // namespace tetraglass::tests
