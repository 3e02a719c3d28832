#include "sort/face_pair.h"

#include <algorithm>
#include <array>

#include "sort/eye_side.h"

namespace tetraglass::sort {
namespace {

using Eigen::Vector3d;

struct Triangle {
  std::array<const Vector3d*, 3> vertices;
  const Vector3d& operator[](std::size_t i) const { return *vertices[i % 3]; }
};

Triangle triangle(const mesh::TetMesh& mesh, const BoundaryFace& face) {
  return {{&mesh.points[face.vertices[0]], &mesh.points[face.vertices[1]],
           &mesh.points[face.vertices[2]]}};
}

// On which sides of the plane of `face` the vertices of the other triangle lie.
struct Sides {
  bool above = false;  // one of them on the outer side
  bool below = false;
};

Sides sides_of(const Triangle& face, const Triangle& other) {
  Sides sides;
  for (const Vector3d* v : other.vertices) {
    // A corner that both have; to find the zero takes exact numbers.
    if (std::find(face.vertices.begin(), face.vertices.end(), v) != face.vertices.end()) continue;
    const int side = mesh::orientation(face[0], face[1], face[2], *v);
    sides.above |= side > 0;
    sides.below |= side < 0;
  }
  return sides;
}

// Whether a plane through the eye and an edge of `a` has the inside of a's image on one side and
// all of b's on the other. `turn` is the eye_side of a.
bool edge_separates(const Triangle& a, int turn, const Triangle& b, const View& view) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto outside = [&](const Vector3d* v) {
      return v == a.vertices[i] || v == a.vertices[(i + 1) % 3] ||
             eye_side(view, a[i], a[i + 1], *v) * turn <= 0;
    };
    if (std::all_of(b.vertices.begin(), b.vertices.end(), outside)) return true;
  }
  return false;
}

// Whether a plane through the eye, a vertex of `a` and one of `b` has them on different sides. Of
// two cones in no common half-space the planes of their faces are not enough to tell them apart.
bool vertices_separate(const Triangle& a, const Triangle& b, const View& view) {
  for (const Vector3d* p : a.vertices) {
    for (const Vector3d* q : b.vertices) {
      std::array<int, 3> of_a{};
      std::array<int, 3> of_b{};
      for (std::size_t i = 0; i < 3; ++i) {
        of_a[i] = eye_side(view, *p, *q, a[i]);
        of_b[i] = eye_side(view, *p, *q, b[i]);
      }
      const auto [low_a, high_a] = std::minmax_element(of_a.begin(), of_a.end());
      const auto [low_b, high_b] = std::minmax_element(of_b.begin(), of_b.end());
      if (*high_a <= 0 && *low_b >= 0 && (*low_a < 0 || *high_b > 0)) return true;
      if (*low_a >= 0 && *high_b <= 0 && (*high_a > 0 || *low_b < 0)) return true;
    }
  }
  return false;
}

bool covers(const Triangle& a, int turn, const Vector3d& v, const View& view) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (eye_side(view, a[i], a[i + 1], v) * turn < 0) return false;
  }
  return true;
}

// 1 if where the images of the edges pq and rs cross rs is the farther one, -1 if it is the nearer
// one, 0 if they do not cross or touch.
int compare_edges(const Vector3d& p, const Vector3d& q, const Vector3d& r, const Vector3d& s,
                  const View& view) {
  const int r_side = eye_side(view, p, q, r);
  const int s_side = eye_side(view, p, q, s);
  if (r_side * s_side >= 0) return 0;
  if (eye_side(view, r, s, p) * eye_side(view, r, s, q) >= 0) return 0;
  if (!view.parallel) {
    // The edges cross in the image, and not one in front of the eye with the other one behind it:
    // the direction of one crossing agrees with that of the other. They are parallel, so that
    // rounding cannot turn the sign of their product.
    const Vector3d n = (p - view.eye).cross(q - view.eye);
    const Vector3d m = (r - view.eye).cross(s - view.eye);
    const Vector3d line = n.cross(m);
    const double first = line.dot(p - view.eye + (q - view.eye));
    const double second = line.dot(r - view.eye + (s - view.eye));
    if ((first > 0) != (second > 0)) return 0;
  }
  // s is on the side of the plane pqr that the eye is not on exactly if rs passes behind pq.
  return -mesh::orientation(p, q, r, s) * r_side;
}

// Of two faces whose images overlap, and neither of which lies on one side of the other one's
// plane, whether `entry` is the farther one: seen at a corner of the overlap.
bool is_behind_at_a_corner(const Triangle& exit, const Triangle& entry, const View& view) {
  for (const Vector3d* v : entry.vertices) {
    if (!covers(exit, -1, *v, view)) continue;
    const int side = mesh::orientation(exit[0], exit[1], exit[2], *v);
    if (side != 0) return side > 0;
  }
  for (const Vector3d* v : exit.vertices) {
    if (!covers(entry, 1, *v, view)) continue;
    const int side = mesh::orientation(entry[0], entry[1], entry[2], *v);
    if (side != 0) return side > 0;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const int order = compare_edges(exit[i], exit[i + 1], entry[j], entry[j + 1], view);
      if (order != 0) return order > 0;
    }
  }
  return true;  // they touch wherever they meet: a gap of no width
}

}  // namespace

bool hides(const mesh::TetMesh& mesh, const BoundaryFace& exit_face, const BoundaryFace& entry_face,
           const View& view, bool in_half_space, bool farther) {
  const Triangle exit = triangle(mesh, exit_face);
  const Triangle entry = triangle(mesh, entry_face);
  bool decided = farther;
  if (!decided) {
    // The eye is on the inner side of the exit and on the outer side of the entry.
    const Sides of_entry = sides_of(exit, entry);
    if (of_entry.below && !of_entry.above) return false;
    decided = !of_entry.below;
  }
  if (!decided) {
    const Sides of_exit = sides_of(entry, exit);
    if (of_exit.below && !of_exit.above) return false;
    decided = !of_exit.below;
  }
  if (edge_separates(exit, -1, entry, view) || edge_separates(entry, 1, exit, view)) return false;
  if (!in_half_space && vertices_separate(exit, entry, view)) return false;
  return decided || is_behind_at_a_corner(exit, entry, view);
}

}  // namespace tetraglass::sort
