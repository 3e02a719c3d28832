// The segment of a ray in a cell by the planes of its faces: no interpolation, so exact in perspective and with
// the eye inside, and the same to the last bit in both cells at a face.

flat in vec4 depth_at_anchor;
flat in vec4 depth_dx;
flat in vec4 depth_dy;
flat in vec4 facing;
flat in vec4 anchors;
#ifdef VALUES
flat in vec4 value_at_anchor;
flat in vec4 value_dx;
flat in vec4 value_dy;
flat in vec4 value_least;
flat in vec4 value_most;
flat in float value_at_eye;
#endif
#ifdef CELL_FIELD
flat in float cell_value;
#endif
#ifdef SHADING_SMOOTH
flat in vec3 vertex_gradients[4];
#endif

uniform float nearest;        // Z in front of the whole mesh, or at the eye
uniform float farthest;       // Z behind the whole mesh

// No plane lies here.
const float kNowhere = 1e32;

// Nearer than this part of the focus cannot be told from the eye: what depths are rounded to.
const float kAtEye = 9.5367431640625e-7;  // 2^-20

// Not a segment of the ray: false.
bool segment(vec2 position, out Segment seg) {
  vec4 x = position.x - anchors.xzzz;
  vec4 y = position.y - anchors.ywww;
  precise vec4 z = depth_at_anchor + depth_dx * x + depth_dy * y;
#ifdef VALUES
  precise vec4 s = value_at_anchor + value_dx * x + value_dy * y;
#endif
  // The ray enters through the farthest of the front faces and leaves through the nearest of the others.
  float enter = -kNowhere;
  float leave = kNowhere;
  float s_enter = 0;
  float s_leave = 0;
  vec2 enter_range = vec2(0);
  vec2 leave_range = vec2(0);
  for (int i = 0; i < 4; ++i) {
    bool front = facing[i] < 0;
    bool later = front && z[i] > enter;
    bool sooner = !front && z[i] < leave;
    enter = later ? z[i] : enter;
    leave = sooner ? z[i] : leave;
#ifdef VALUES
    s_enter = later ? s[i] : s_enter;
    s_leave = sooner ? s[i] : s_leave;
    enter_range = later ? vec2(value_least[i], value_most[i]) : enter_range;
    leave_range = sooner ? vec2(value_least[i], value_most[i]) : leave_range;
#endif
  }
  if (!(enter < leave) || leave == kNowhere) return false;
  // Without a front face the ray starts in the cell, at the eye: Z -> -infinity, z - focus = -focus.
  bool at_eye = enter == -kNowhere;
  leave = min(leave, farthest);
  enter = clamp(enter, nearest, leave);
  precise float enter_scale = 1 / (1 - focus_inverse * enter);
  precise float leave_scale = 1 / (1 - focus_inverse * leave);
  seg.entry = enter * enter_scale;
  seg.exit = leave * leave_scale;
  seg.front = 0;
  seg.back = 0;
#ifdef VALUES
  // A face through the eye is met there by every ray. Z and s are then quotients by (nearly) zero, whose
  // own quotient has few digits; the value at the eye has all.
  s_enter = enter_scale < kAtEye ? value_at_eye : s_enter * enter_scale;
  s_leave = leave_scale < kAtEye ? value_at_eye : s_leave * leave_scale;
  // A value on a face lies among those of its corners; so it is exact where they are equal.
  seg.front = at_eye ? value_at_eye : clamp(s_enter, enter_range.x, enter_range.y);
  seg.back = clamp(s_leave, leave_range.x, leave_range.y);
#endif
#ifdef CELL_FIELD
  seg.front = cell_value;
  seg.back = cell_value;
#endif
  seg.size = (seg.exit - seg.entry) * stretch(position);
  return seg.exit > seg.entry;
}

#ifdef SHADING_SMOOTH
// Of the vertices, at a depth (z - focus) of the ray; its length does not matter.
vec3 interpolated_gradient(vec2 position, float depth) {
  // lambda_i of a point at Z = depth / w is facing_i (Z_i - Z), but for a factor common to the four: w, here, which
  // is 0 at the eye.
  float w = 1 + focus_inverse * depth;
  vec4 x = position.x - anchors.xzzz;
  vec4 y = position.y - anchors.ywww;
  vec4 lambda = max(facing * ((depth_at_anchor + depth_dx * x + depth_dy * y) * w - depth), 0.0);
  lambda /= max(max(max(lambda.x, lambda.y), max(lambda.z, lambda.w)), 1e-37);
#ifdef UNIT_VERTICES
  lambda /= dot(lambda, vec4(1));
#endif
  return lambda.x * vertex_gradients[0] + lambda.y * vertex_gradients[1] + lambda.z * vertex_gradients[2] +
         lambda.w * vertex_gradients[3];
}
#endif
