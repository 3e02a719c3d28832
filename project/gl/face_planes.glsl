// The planes of a cell's faces as the screen sees them, in double precision.
//
// Depth is measured as Z = (z - focus) focus / z in perspective and Z = z - focus in parallel views, z
// being the distance along the view axis: linear on the screen on every plane, increasing with z, and
// small where the mesh is, so that floats hold it. A value s of the field is carried as s focus / z (as
// it is in parallel views), linear on the screen too. The fragment stage undoes both (see `segment`).
//
// Both cells at a face compute its planes from the same operands in the same order (ascending vertex
// ids), hence to the last bit the same: no ray is lost or counted twice between them, however the
// planes were rounded.

struct Plane {
  double at_anchor;  // at the anchor of the face, a pixel position
  double dx;         // per pixel to the right
  double dy;         // per pixel down
};

struct Face {
  double facing;  // barycentric coordinate of the homogeneous eye but for a factor of the cell; the sign
                  // is that of vertices in ascending order
  Plane depth;
  Plane value;
};

// A plane nearer to the eye than this part of its distance from a corner and the mesh's half diagonal cannot be told
// from one through the eye: 2^-53 for each of the 9 roundings on the longest way through the determinant, and a
// factor of 3 for the roundings of its operands.
const double kNoDigits = 2.9976021664879227e-15;

// Keeps the quotient of zeros zero where a face is a point.
const double kSmallest = 1e-300;

// The value for an edge-on face can be either sign, but has to be the same for both of its cells.
double away_from_zero(double value, double terms) {
  double least = kNoDigits * terms + kSmallest;
  return abs(value) < least ? least : value;
}

// The gradient in the plane of the triangle a, a + e1, a + e2 (n = e1 x e2) of the linear function with
// the values s at its corners.
dvec3 gradient_in_plane(dvec3 e1, dvec3 e2, dvec3 n, dvec3 s) {
  return ((s.y - s.x) * cross(e2, n) + (s.z - s.x) * cross(n, e1)) / (dot(n, n) + kSmallest);
}

// a, b, c: the corners in camera space; s: their values; anchor: a pixel position near a.
Face face_planes(dvec3 a, dvec3 b, dvec3 c, dvec3 s, dvec2 anchor) {
  precise dvec3 e1 = b - a;
  precise dvec3 e2 = c - a;
  precise dvec3 n = cross(e1, e2);
  precise dvec2 ray = image_plane(anchor);
  precise double extent = dot(abs(e1), dvec3(1)) + dot(abs(e2), dvec3(1));
  precise dvec2 depth_slope;
  precise dvec2 value_slope;
  precise Face face;
#ifdef PARALLEL
  // The ray (u, v, z) meets n.p = n.a at z = a.z - (n.x (u - a.x) + n.y (v - a.y)) / n.z.
  face.facing = away_from_zero(n.z, dot(abs(n), dvec3(1)));
  precise dvec2 offset = ray - a.xy;
  depth_slope = -n.xy / face.facing;
  face.depth.at_anchor = (a.z - focus) + dot(depth_slope, offset);
#ifdef VALUES
  precise dvec3 g = gradient_in_plane(e1, e2, n, s);
  value_slope = g.xy + g.z * depth_slope;
  face.value.at_anchor = s.x + dot(value_slope, offset);
#endif
#else
  // The ray z (u, v, 1) = z D meets n.p = n.a at 1 / z = n.D / n.a. Relative to the corner a, whose image
  // is (nearly) the anchor: a.z / z = 1 + n.(a.z D - a) / n.a, and nothing cancels.
  face.facing = away_from_zero(dot(n, a), dot(abs(n), abs(a) + 1));
  precise double scale = a.z > 0 ? a.z : 1.0;  // any factor will do for a corner without an image
  precise dvec3 offset = scale * dvec3(ray, 1) - a;
  precise double nearer = dot(n, offset) / face.facing;
  depth_slope = -(focus * focus) * n.xy / face.facing;
  face.depth.at_anchor = focus * ((scale - focus) - focus * nearer) / scale;
  extent *= (focus / scale) * (focus / scale);  // dZ/dz
#ifdef VALUES
  // On the plane s(p) = s.x + g.(p - a), and p / z = D.
  precise dvec3 g = gradient_in_plane(e1, e2, n, s);
  value_slope = focus * ((s.x - dot(g, a)) * n.xy / face.facing + g.xy);
  face.value.at_anchor = focus * (s.x * (1 + nearer) + dot(g, offset - a * nearer)) / scale;
#endif
#endif
  face.depth.dx = depth_slope.x * pitch;
  face.depth.dy = -depth_slope.y * pitch;
#ifdef VALUES
  face.value.dx = value_slope.x * pitch;
  face.value.dy = -value_slope.y * pitch;
#endif
  // A face whose image is thinner than the rounding of the vertices is taken as edge-on, and rays
  // exactly on it as if they were moved by tie_shift to the right and up: the rule of the reference.
  // (Elsewhere the move would be an error, however small; here it only chooses the side.)
  if ((abs(face.depth.dx) + abs(face.depth.dy)) * tie_shift.y > extent) {
    face.depth.at_anchor += face.depth.dx * tie_shift.x - face.depth.dy * tie_shift.y;
#ifdef VALUES
    face.value.at_anchor += face.value.dx * tie_shift.x - face.value.dy * tie_shift.y;
#endif
  }
  return face;
}
