#include "sort/boundary_relations.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include "sort/face_pair.h"
#include "sort/image_triangle.h"
#include "sort/key_sort.h"

namespace tetraglass::sort {
namespace {

using Eigen::Vector3d;

// More than the relative error of a few roundings: boxes are enlarged by it, so that none is too
// small.
constexpr double kSlack = 0x1p-49;

// Where the image of a face can lie, and its depth. Depths grow along every ray.
struct ImageBox {
  std::array<double, 2> low;
  std::array<double, 2> high;
  double near = 0;
  double far = 0;
  bool in_half_space = true;  ///< all of the face is in front of the eye

  void include(const ImageBox& other) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
    near = std::min(near, other.near);
    far = std::max(far, other.far);
  }
  [[nodiscard]] bool overlaps(const ImageBox& other) const {
    return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
           other.low[1] <= high[1];
  }
};

// One image plane: in parallel views that through the origin across the largest component of the
// direction; in perspective one side of a cube around the eye.
class ImagePlane {
 public:
  ImagePlane(const mesh::TetMesh& mesh, const View& view, int axis, double sign)
      : points_(mesh.points),
        eye_(view.eye),
        parallel_(view.parallel),
        axis_(axis),
        sign_(sign),
        slope_(view.direction[(axis + 1) % 3] / view.direction[axis],
               view.direction[(axis + 2) % 3] / view.direction[axis]) {}

  // None if the face cannot be seen on this plane. The image is set only where all of the face is
  // in front of the eye.
  [[nodiscard]] std::optional<ImageBox> box(const BoundaryFace& face, ImageTriangle& image) const {
    return parallel_ ? parallel_box(face, image) : perspective_box(face, image);
  }

  // Whether any face within this box may be seen on this plane.
  [[nodiscard]] bool may_see(const mesh::Box& box) const {
    if (parallel_ || box.isEmpty()) return true;
    std::array<Vector3d, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      corners[i] = from_eye(box.corner(static_cast<mesh::Box::CornerType>(i)));
    }
    return !is_beyond_a_side(corners);
  }

 private:
  [[nodiscard]] ImageBox parallel_box(const BoundaryFace& face, ImageTriangle& image) const {
    ImageBox box = nothing();
    double size = 0;
    std::array<Eigen::Vector2d, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d& p = points_[face.vertices[i]];
      const double depth = p[axis_];
      for (std::size_t k = 0; k < 2; ++k) {
        const double across = p[(axis_ + 1 + static_cast<int>(k)) % 3];
        // Errors: the slope (at most 1), the product and the difference round once each.
        size = std::max(size, std::abs(across) + std::abs(depth));
        corners[i][static_cast<int>(k)] = across - slope_[static_cast<int>(k)] * depth;
        include(box, k, corners[i][static_cast<int>(k)]);
      }
      box.near = std::min(box.near, sign_ * depth);
      box.far = std::max(box.far, sign_ * depth);
    }
    for (std::size_t k = 0; k < 2; ++k) {
      box.low[k] -= kSlack * size;
      box.high[k] += kSlack * size;
    }
    image = ImageTriangle(corners, size);
    return box;
  }

  // A point as this plane sees it: across, across, depth. Each coordinate rounds once.
  [[nodiscard]] Vector3d from_eye(const Vector3d& p) const {
    const Vector3d d = p - eye_;
    return {d[(axis_ + 1) % 3], d[(axis_ + 2) % 3], sign_ * d[axis_]};
  }

  // Whether all points lie beyond one side of the pyramid of directions that this plane sees.
  template <std::size_t N>
  [[nodiscard]] static bool is_beyond_a_side(const std::array<Vector3d, N>& points) {
    const auto all = [&](const auto& test) {
      return std::all_of(points.begin(), points.end(), test);
    };
    if (all([](const Vector3d& p) { return p.z() <= 0; })) return true;
    for (int k = 0; k < 2; ++k) {
      const auto beyond = [k](const Vector3d& p, double side) {
        return side * p[k] - p.z() > kSlack * (std::abs(p[k]) + std::abs(p.z()));
      };
      if (all([&](const Vector3d& p) { return beyond(p, 1); }) ||
          all([&](const Vector3d& p) { return beyond(p, -1); })) {
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] std::optional<ImageBox> perspective_box(const BoundaryFace& face,
                                                        ImageTriangle& image) const {
    std::array<Vector3d, 3> v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = from_eye(points_[face.vertices[i]]);
    if (is_beyond_a_side(v)) return std::nullopt;
    ImageBox box = nothing();
    for (const Vector3d& p : v) {
      box.in_half_space = box.in_half_space && p.z() > 0;
      box.near = std::min(box.near, p.z() - kSlack * std::abs(p.z()));
      box.far = std::max(box.far, p.z() + kSlack * std::abs(p.z()));
    }
    box.near = std::max(box.near, 0.0);
    if (box.in_half_space) image = perspective_image(v);
    for (std::size_t k = 0; k < 2; ++k) {
      if (box.in_half_space) {
        for (const Vector3d& p : v) include(box, k, p[static_cast<int>(k)] / p.z());
        box.low[k] -= kSlack * std::abs(box.low[k]);
        box.high[k] += kSlack * std::abs(box.high[k]);
      } else {
        box.low[k] = -2;
        box.high[k] = 2;
      }
      box.low[k] = std::max(box.low[k], -2.0);
      box.high[k] = std::min(box.high[k], 2.0);
    }
    return box;
  }

  // Three roundings: of the two coordinates and of the quotient.
  static ImageTriangle perspective_image(const std::array<Vector3d, 3>& v) {
    std::array<Eigen::Vector2d, 3> corners;
    double size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = v[i].head<2>() / v[i].z();
      size = std::max(size, corners[i].cwiseAbs().maxCoeff());
    }
    return ImageTriangle(corners, size);
  }

  static ImageBox nothing() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {{kInfinity, kInfinity}, {-kInfinity, -kInfinity}, kInfinity, -kInfinity, true};
  }
  static void include(ImageBox& box, std::size_t k, double x) {
    box.low[k] = std::min(box.low[k], x);
    box.high[k] = std::max(box.high[k], x);
  }

  const std::vector<Vector3d>& points_;
  Vector3d eye_;
  bool parallel_;
  int axis_;
  double sign_;
  Eigen::Vector2d slope_;
};

struct BoxedFace {
  ImageBox box;
  std::uint32_t face = 0;
};

struct SeenFaces {
  std::vector<BoxedFace> faces;
  std::vector<ImageTriangle> images;  // of all faces
};

SeenFaces see(const std::vector<BoundaryFace>& faces, const ImagePlane& plane) {
  std::vector<std::optional<ImageBox>> boxes(faces.size());
  SeenFaces seen;
  seen.images.resize(faces.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, faces.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      boxes[i] = plane.box(faces[i], seen.images[i]);
    }
  });
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (boxes[i]) seen.faces.push_back({*boxes[i], static_cast<std::uint32_t>(i)});
  }
  return seen;
}

// A binary tree of boxes over faces, halved by number along the longer side of the image.
class BoxTree {
 public:
  explicit BoxTree(std::vector<BoxedFace> faces) : faces_(std::move(faces)) {
    if (faces_.empty()) return;
    std::size_t leaves = 1;
    while (leaves * kLeaf < faces_.size()) leaves *= 2;
    nodes_.resize(2 * leaves);
    build(1, 0, faces_.size());
  }

  // Calls f(face) for each face whose box overlaps `box` and that may be behind it.
  template <typename F>
  void for_each_behind(const ImageBox& box, const F& f) const {
    if (!faces_.empty()) visit(1, 0, faces_.size(), box, f);
  }

 private:
  static constexpr std::size_t kLeaf = 4;

  [[nodiscard]] bool is_leaf(std::size_t node) const { return 2 * node >= nodes_.size(); }

  void build(std::size_t node, std::size_t begin, std::size_t end) {
    ImageBox box = faces_[begin].box;
    for (std::size_t i = begin + 1; i < end; ++i) box.include(faces_[i].box);
    nodes_[node] = box;
    if (is_leaf(node)) return;
    const std::size_t axis = box.high[0] - box.low[0] >= box.high[1] - box.low[1] ? 0 : 1;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return faces_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(
        at(begin), at(middle), at(end), [axis](const BoxedFace& a, const BoxedFace& b) {
          return a.box.low[axis] + a.box.high[axis] < b.box.low[axis] + b.box.high[axis];
        });
    const auto left = [&] { build(2 * node, begin, middle); };
    const auto right = [&] { build(2 * node + 1, middle, end); };
    constexpr std::size_t kParallel = 4096;
    if (end - begin > kParallel) {
      tbb::parallel_invoke(left, right);
    } else {
      left();
      right();
    }
  }

  template <typename F>
  void visit(std::size_t node, std::size_t begin, std::size_t end, const ImageBox& box,
             const F& f) const {
    if (nodes_[node].far < box.near || !nodes_[node].overlaps(box)) return;
    if (is_leaf(node)) {
      for (std::size_t i = begin; i < end; ++i) {
        if (faces_[i].box.far >= box.near && faces_[i].box.overlaps(box)) f(faces_[i]);
      }
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    visit(2 * node, begin, middle, box, f);
    visit(2 * node + 1, middle, end, box, f);
  }

  std::vector<BoxedFace> faces_;
  std::vector<ImageBox> nodes_;
};

mesh::Box bounds(const mesh::TetMesh& mesh, const std::vector<BoundaryFace>& faces) {
  mesh::Box box;
  for (const BoundaryFace& face : faces) {
    for (const std::uint32_t v : face.vertices) box.extend(mesh.points[v]);
  }
  return box;
}

// Entries of the cell behind, as the key, and of the one in front.
void add_relations(const mesh::TetMesh& mesh, const std::vector<BoundaryFace>& exits,
                   const std::vector<BoundaryFace>& entries, const View& view,
                   const ImagePlane& plane, std::vector<KeyedItem>& relations) {
  const SeenFaces seen_exits = see(exits, plane);
  if (seen_exits.faces.empty()) return;
  SeenFaces seen_entries = see(entries, plane);
  const BoxTree tree(std::move(seen_entries.faces));
  tbb::enumerable_thread_specific<std::vector<KeyedItem>> found;
  const auto relate = [&](const BoxedFace& exit, std::vector<KeyedItem>& mine) {
    const BoundaryFace& exit_face = exits[exit.face];
    const ImageTriangle& exit_image = seen_exits.images[exit.face];
    tree.for_each_behind(exit.box, [&](const BoxedFace& entry) {
      const BoundaryFace& entry_face = entries[entry.face];
      if (entry_face.cell == exit_face.cell) return;
      const bool in_half_space = exit.box.in_half_space && entry.box.in_half_space;
      const bool farther = entry.box.near > exit.box.far;
      const Overlap overlap = in_half_space
                                  ? find_overlap(exit_image, seen_entries.images[entry.face])
                                  : Overlap::uncertain;
      if (overlap == Overlap::none) return;
      if ((overlap == Overlap::some && farther) ||
          hides(mesh, exit_face, entry_face, view, in_half_space, farther)) {
        mine.push_back(keyed(entry_face.cell, exit_face.cell));
      }
    });
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, seen_exits.faces.size(), 64),
                    [&](const auto& range) {
                      std::vector<KeyedItem>& mine = found.local();
                      for (std::size_t i = range.begin(); i != range.end(); ++i) {
                        relate(seen_exits.faces[i], mine);
                      }
                    });
  for (const std::vector<KeyedItem>& part : found) {
    relations.insert(relations.end(), part.begin(), part.end());
  }
}

// By the cell behind, then by that in front, once each: in an order that does not depend on the
// threads.
std::vector<Relation> sort_relations(std::vector<KeyedItem> found, std::size_t cells) {
  // Cells take all the bits of the keys, so that the buckets are even.
  const int shift = std::countl_zero(static_cast<std::uint32_t>(cells));
  KeySorter sorter;
  const auto write = [&](std::size_t begin, std::size_t count, KeyedItem* target) {
    for (std::size_t i = 0; i < count; ++i) {
      const KeyedItem relation = found[begin + i];
      target[i] = keyed(key_of(relation) << shift, item_of(relation));
    }
  };
  const auto finish = [&](std::span<const KeyedItem> sorted, std::size_t place) {
    std::copy(sorted.begin(), sorted.end(), found.begin() + static_cast<std::ptrdiff_t>(place));
    const auto at = [&](std::size_t i) {
      return found.begin() + static_cast<std::ptrdiff_t>(place + i);
    };
    for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
      while (end < sorted.size() && key_of(sorted[end]) == key_of(sorted[begin])) ++end;
      std::sort(at(begin), at(end));
    }
  };
  sorter.sort(found.size(), write, finish);
  std::vector<Relation> relations;
  relations.reserve(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (i > 0 && found[i] == found[i - 1]) continue;
    relations.push_back({item_of(found[i]), key_of(found[i]) >> shift});
  }
  return relations;
}

}  // namespace

std::vector<Relation> boundary_relations(const mesh::TetMesh& mesh,
                                         const std::vector<BoundaryFace>& exits,
                                         const std::vector<BoundaryFace>& entries,
                                         const View& view) {
  std::vector<KeyedItem> relations;
  if (view.parallel) {
    int axis = 0;
    view.direction.cwiseAbs().maxCoeff(&axis);
    add_relations(mesh, exits, entries, view,
                  {mesh, view, axis, view.direction[axis] > 0 ? 1.0 : -1.0}, relations);
  } else {
    const mesh::Box box = bounds(mesh, exits);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        const ImagePlane plane(mesh, view, axis, sign);
        if (plane.may_see(box)) add_relations(mesh, exits, entries, view, plane, relations);
      }
    }
  }
  return sort_relations(std::move(relations), mesh.cells.size());
}

}  // namespace tetraglass::sort
