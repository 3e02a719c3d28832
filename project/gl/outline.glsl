// The outline of a cell on the screen, moved outwards by a margin: the rasterizer rounds vertices to a
// fraction of a pixel and would otherwise miss rays through the rim of a cell. Which of the rays in the
// margin meet the cell is decided by its planes.
//
// The images of the four faces that are seen from behind cover the outline of any four points exactly once, so
// corners may be moved freely: each ray still gets one fragment from each cell.

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

vec2 direction(vec2 r) {
  float size = length(r);
  return size > 0 ? r / size : vec2(0);
}

// Whether two directions enclose the third, by the cross products of theirs and of the other pairs in turn:
// the sign of theirs is the one that differs. Zeros go with either sign.
bool enclose(float theirs, float other1, float other2) {
  return (theirs >= 0 && other1 <= 0 && other2 <= 0) || (theirs <= 0 && other1 >= 0 && other2 >= 0);
}

// How far to move the corner from which the others are seen at r0, r1, r2 (pixels): its two edges of the
// outline then lie `margin` further out. 0 for a corner inside the outline.
vec2 outward(vec2 r0, vec2 r1, vec2 r2, float margin) {
  float c01 = cross2(r0, r1);
  float c12 = cross2(r1, r2);
  float c20 = cross2(r2, r0);
  if ((c01 > 0 && c12 > 0 && c20 > 0) || (c01 < 0 && c12 < 0 && c20 < 0)) return vec2(0);
  // The neighbours a, b on the outline enclose the third. Where corners coincide or lie on a line several pairs
  // seem to: the one with the largest cross product does.
  float size01 = enclose(c01, c12, c20) ? abs(c01) : -1;
  float size12 = enclose(c12, c20, c01) ? abs(c12) : -1;
  float size20 = enclose(c20, c01, c12) ? abs(c20) : -1;
  bool use01 = size01 >= size12 && size01 >= size20;
  bool use12 = !use01 && size12 >= size20;
  vec2 a = use01 ? r0 : (use12 ? r1 : r2);
  vec2 b = use01 ? r1 : (use12 ? r2 : r0);
  vec2 c = use01 ? r2 : (use12 ? r0 : r1);
  vec2 along_a = direction(a);
  vec2 along_b = direction(b);
  // Away from the middle of the two edges; where they point away from each other, across them.
  vec2 apart = along_a - along_b;
  vec2 inner = dot(along_a, along_b) > 0 ? along_a + along_b : vec2(-apart.y, apart.x);
  if (dot(inner, along_a + along_b + direction(c)) < 0) inner = -inner;
  float half_sine = 0.5 * length(apart);  // of half the angle between the edges
  // A needle's tip may move as far as the needle is long: half of the margin is then left everywhere.
  float most = max(max(length(a), length(b)), 2 * margin);
  float reach = half_sine * most > margin ? margin / half_sine : most;
  return -reach * direction(inner);
}
