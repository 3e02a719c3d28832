#include "project/opaque_layers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "project/light/phong.h"

namespace tetraglass::project {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A fragment and the pixel that it is in.
struct PlacedFragment {
  std::size_t pixel = 0;
  double extent = 0;  ///< of its line, in depth
  OpaqueFragment fragment;
};

std::array<float, 3> floats(const preint::Color& color) {
  return {static_cast<float>(color.x()), static_cast<float>(color.y()),
          static_cast<float>(color.z())};
}

/// Draws lines into pixels.
class LineRaster {
 public:
  LineRaster(const Frame& frame, double samples, std::vector<PlacedFragment>& fragments)
      : frame_(frame), samples_(samples), fragments_(fragments) {}

  void draw(const OpaqueLine& line) {
    half_width_ = std::max(0.5, 0.5 * line.width * samples_);
    // Thinner than a pixel: a pixel's width, and as much less of it.
    strength_ = std::min(1.0, line.width * samples_);
    color_ = floats(line.color);
    Eigen::Vector3d from = frame_.to_camera(line.from);
    Eigen::Vector3d to = frame_.to_camera(line.to);
    if (!clip(from, to)) return;
    const Eigen::Vector2d a = pixel(from);
    const Eigen::Vector2d b = pixel(to);
    // A line through the eye has no direction in the picture.
    if (!a.allFinite() || !b.allFinite()) return;
    walk(a, b, depth_measure(from.z()), depth_measure(to.z()));
  }

 private:
  /// What is linear along a line in the picture.
  [[nodiscard]] double depth_measure(double depth) const {
    return frame_.parallel() ? depth : 1 / depth;
  }

  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector3d& p) const {
    return frame_.pixel(frame_.parallel() ? p.head<2>().eval() : (p.head<2>() / p.z()).eval());
  }

  /// Cuts the line to what can touch the picture; false where nothing is left. The sides are planes
  /// through the eye, so that nothing behind it is left either.
  [[nodiscard]] bool clip(Eigen::Vector3d& from, Eigen::Vector3d& to) const {
    const double rim = half_width_ + 1;
    const Eigen::Vector2d low = frame_.image_plane(-rim - 0.5, frame_.height() + rim - 0.5);
    const Eigen::Vector2d high = frame_.image_plane(frame_.width() + rim - 0.5, -rim - 0.5);
    double t0 = 0;
    double t1 = 1;
    for (int axis = 0; axis < 2; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        const auto inside = [&](const Eigen::Vector3d& p) {
          return side * ((side < 0 ? low : high)[axis] * (frame_.parallel() ? 1 : p.z()) - p[axis]);
        };
        const double a = inside(from);
        const double b = inside(to);
        if (a < 0 && b < 0) return false;
        if (a < 0) t0 = std::max(t0, a / (a - b));
        if (b < 0) t1 = std::min(t1, a / (a - b));
      }
    }
    if (!(t0 <= t1)) return false;
    const Eigen::Vector3d start = from;
    const Eigen::Vector3d step = to - from;
    from = start + t0 * step;
    to = start + t1 * step;
    return true;
  }

  /// All pixels within reach of the line from a to b, column by column or row by row.
  void walk(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double depth_a, double depth_b) {
    const Eigen::Vector2d step = b - a;
    const double square = step.squaredNorm();
    const int along = std::abs(step.x()) >= std::abs(step.y()) ? 0 : 1;
    const int across = 1 - along;
    const std::array<int, 2> size = {frame_.width(), frame_.height()};
    const double reach = half_width_ + 0.5;
    const auto first_pixel = [](double x) { return static_cast<int>(std::ceil(std::max(x, 0.0))); };
    const auto last_pixel = [](double x, int count) {
      return static_cast<int>(std::floor(std::min(x, count - 1.0)));
    };
    const int last =
        last_pixel(std::max(a[along], b[along]) + reach, size[static_cast<std::size_t>(along)]);
    for (int i = first_pixel(std::min(a[along], b[along]) - reach); i <= last; ++i) {
      const double part = step[along] == 0 ? 0 : (i - a[along]) / step[along];
      const double middle = a[across] + std::clamp(part, 0.0, 1.0) * step[across];
      const double side = std::numbers::sqrt2 * reach;  // the line is steeper than 45 degrees
      const int end = last_pixel(middle + side, size[static_cast<std::size_t>(across)]);
      for (int j = first_pixel(middle - side); j <= end; ++j) {
        Eigen::Vector2d p;
        p[along] = i;
        p[across] = j;
        const double t = square > 0 ? std::clamp((p - a).dot(step) / square, 0.0, 1.0) : 0;
        const double distance = (p - (a + t * step)).norm();
        const double coverage = strength_ * std::clamp(reach - distance, 0.0, 1.0);
        if (coverage > 0) add(p, depth_a + t * (depth_b - depth_a), coverage);
      }
    }
  }

  void add(const Eigen::Vector2d& p, double measure, double coverage) {
    PlacedFragment placed;
    placed.pixel = static_cast<std::size_t>(p.y()) * static_cast<std::size_t>(frame_.width()) +
                   static_cast<std::size_t>(p.x());
    const double depth = depth_measure(measure);
    placed.extent = 2 * half_width_ * frame_.pitch() * (frame_.parallel() ? 1 : depth);
    placed.fragment = {depth, color_, static_cast<float>(coverage)};
    fragments_.push_back(placed);
  }

  const Frame& frame_;
  double samples_;
  std::vector<PlacedFragment>& fragments_;
  double half_width_ = 1;
  double strength_ = 1;
  std::array<float, 3> color_ = {};
};

/// Finds the nearest triangle of each pixel.
class TriangleRaster {
 public:
  TriangleRaster(const Frame& frame, std::span<const OpaqueSurface> surfaces)
      : frame_(frame), surfaces_(surfaces), nearest_(pixels()) {
    for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
      std::vector<Eigen::Vector3d> seen;
      seen.reserve(surfaces[s].points.size());
      for (const Eigen::Vector3d& p : surfaces[s].points) seen.push_back(frame.to_camera(p));
      for (std::uint32_t t = 0; t < surfaces[s].triangles.size(); ++t) draw(s, t, seen);
    }
  }

  /// What is seen, lit.
  void add_fragments(const std::optional<Lights>& lights,
                     std::vector<PlacedFragment>& fragments) const {
    const std::size_t before = fragments.size();
    for (std::size_t pixel = 0; pixel < nearest_.size(); ++pixel) {
      const double depth = nearest_[pixel].depth;
      if (depth < kInfinity) fragments.push_back({pixel, 0, {depth, {}, 1}});
    }
    constexpr std::size_t kGrain = 1024;  // some 200 us of work
    const std::size_t count = fragments.size() - before;
    base::parallel_ranges(count, kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = before + begin; i < before + end; ++i) {
        fragments[i].fragment.color = floats(lit(lights, fragments[i].pixel));
      }
    });
  }

 private:
  struct Seen {
    double depth = kInfinity;
    std::uint32_t surface = 0;
    std::uint32_t triangle = 0;
  };

  [[nodiscard]] std::size_t pixels() const {
    return static_cast<std::size_t>(frame_.width()) * static_cast<std::size_t>(frame_.height());
  }

  /// Homogeneous, so that no triangle has to be cut at the plane of the eye (Olano and Greer, 1997,
  /// "Triangle Scan Conversion using 2D Homogeneous Coordinates").
  [[nodiscard]] Eigen::Vector3d projective(const Eigen::Vector3d& p) const {
    return frame_.parallel() ? Eigen::Vector3d(p.x(), p.y(), 1) : p;
  }

  /// The plane of an edge and the eye, the same for both triangles at it but for its sign.
  [[nodiscard]] static Eigen::Vector3d edge(std::uint32_t i, const Eigen::Vector3d& p,
                                            std::uint32_t j, const Eigen::Vector3d& q) {
    return i < j ? p.cross(q).eval() : (-q.cross(p)).eval();
  }

  /// The pixels whose centres the triangle can cover.
  [[nodiscard]] Eigen::AlignedBox2d bounds(const std::array<Eigen::Vector3d, 3>& corners) const {
    const Eigen::AlignedBox2d picture(Eigen::Vector2d(0, 0),
                                      Eigen::Vector2d(frame_.width() - 1, frame_.height() - 1));
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector3d& p : corners) {
      if (!frame_.parallel() && !(p.z() > 0)) return picture;
      box.extend(
          frame_.pixel(frame_.parallel() ? p.head<2>().eval() : (p.head<2>() / p.z()).eval()));
    }
    // A pixel more on each side for the rounding of what is far outside of the picture.
    box.min().array() -= 1;
    box.max().array() += 1;
    return box.intersection(picture);
  }

  /// Row i: of the side across from corner i.
  [[nodiscard]] Eigen::Matrix3d edges_of(const std::array<std::uint32_t, 3>& v,
                                         const std::array<Eigen::Vector3d, 3>& p) const {
    Eigen::Matrix3d edges;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      edges.row(static_cast<Eigen::Index>(i)) =
          edge(v[j], projective(p[j]), v[k], projective(p[k])).transpose();
    }
    return edges;
  }

  void draw(std::uint32_t s, std::uint32_t t, const std::vector<Eigen::Vector3d>& seen) {
    const std::array<std::uint32_t, 3>& v = surfaces_[s].triangles[t];
    const std::array<Eigen::Vector3d, 3> p = {seen[v[0]], seen[v[1]], seen[v[2]]};
    if (!frame_.parallel() && p[0].z() <= 0 && p[1].z() <= 0 && p[2].z() <= 0) return;
    const Eigen::AlignedBox2d box = bounds(p);
    if (box.isEmpty() || !box.min().allFinite() || !box.max().allFinite()) return;
    const Eigen::Matrix3d edges = edges_of(v, p);
    for (int y = static_cast<int>(std::ceil(box.min().y())); y <= box.max().y(); ++y) {
      for (int x = static_cast<int>(std::ceil(box.min().x())); x <= box.max().x(); ++x) {
        const Eigen::Vector2d plane = frame_.image_plane(x, y);
        const Eigen::Vector3d sides = edges * Eigen::Vector3d(plane.x(), plane.y(), 1);
        const bool inside = (sides.array() >= 0).all() || (sides.array() <= 0).all();
        const double sum = sides.sum();
        if (!inside || sum == 0) continue;
        const Eigen::Vector3d weights = sides / sum;
        const double depth = weights[0] * p[0].z() + weights[1] * p[1].z() + weights[2] * p[2].z();
        if (!frame_.parallel() && !(depth > 0)) continue;
        Seen& nearest =
            nearest_[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_.width()) +
                     static_cast<std::size_t>(x)];
        if (depth < nearest.depth) nearest = {depth, s, t};
      }
    }
  }

  /// The color of the nearest triangle of a pixel.
  [[nodiscard]] preint::Color lit(const std::optional<Lights>& lights, std::size_t pixel) const {
    const auto width = static_cast<std::size_t>(frame_.width());
    const Eigen::Vector2d plane =
        frame_.image_plane(static_cast<double>(pixel % width), static_cast<double>(pixel / width));
    const OpaqueSurface& surface = surfaces_[nearest_[pixel].surface];
    const std::size_t t = nearest_[pixel].triangle;
    const std::array<std::uint32_t, 3>& v = surface.triangles[t];
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = frame_.to_camera(surface.points[v[i]]);
    const Eigen::Vector3d sides = edges_of(v, p) * Eigen::Vector3d(plane.x(), plane.y(), 1);
    const Eigen::Vector3d weights = sides / sides.sum();
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      const double weight = weights[static_cast<Eigen::Index>(i)];
      normal += weight * surface.normals[3 * t + i].stableNormalized();
      point += weight * surface.points[v[i]];
    }
    const Eigen::Vector3d to_viewer =
        -(frame_.axes().transpose() * frame_.ray_direction(plane)).normalized();
    return shade(lights, surface.color, preint::Material{}, point, normal, to_viewer);
  }

  const Frame& frame_;
  std::span<const OpaqueSurface> surfaces_;
  std::vector<Seen> nearest_;
};

/// The fragments of one pixel, nearest first: makes one of what is one line after another at the
/// same place, and leaves out what is behind something solid.
void merge(std::span<const PlacedFragment> placed, std::vector<OpaqueFragment>& result) {
  double extent = 0;
  const std::size_t first = result.size();
  for (const PlacedFragment& next : placed) {
    const bool alone = result.size() == first;
    if (!alone && next.extent > 0 && next.fragment.depth - result.back().depth <= extent) {
      if (next.fragment.coverage > result.back().coverage) result.back() = next.fragment;
      continue;
    }
    if (!alone && result.back().coverage >= 1) return;
    result.push_back(next.fragment);
    extent = next.extent;
  }
}

}  // namespace

OpaqueLayers::OpaqueLayers(const OpaqueGeometry& geometry, const std::optional<Lights>& lights,
                           const Frame& frame, int samples)
    : width_(frame.width()), height_(frame.height()) {
  find_fragments(geometry, lights, frame, samples);
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const std::span<const OpaqueFragment> fragments = covering(i);
    const bool solid = fragments.back().coverage >= 1;
    partial_layers_ = std::max(partial_layers_, fragments.size() - (solid ? 1 : 0));
  }
}

void OpaqueLayers::find_fragments(const OpaqueGeometry& geometry,
                                  const std::optional<Lights>& lights, const Frame& frame,
                                  int samples) {
  std::vector<PlacedFragment> placed;
  LineRaster raster(frame, samples, placed);
  for (const OpaqueLine& line : geometry.lines) raster.draw(line);
  if (!geometry.surfaces.empty()) {
    const TriangleRaster triangles(frame, geometry.surfaces);
    triangles.add_fragments(lights, placed);
  }
  std::stable_sort(
      placed.begin(), placed.end(), [](const PlacedFragment& a, const PlacedFragment& b) {
        return a.pixel != b.pixel ? a.pixel < b.pixel : a.fragment.depth < b.fragment.depth;
      });
  for (std::size_t first = 0; first < placed.size();) {
    const std::size_t pixel = placed[first].pixel;
    std::size_t end = first + 1;
    while (end < placed.size() && placed[end].pixel == pixel) ++end;
    pixels_.push_back(pixel);
    starts_.push_back(fragments_.size());
    merge(std::span(placed).subspan(first, end - first), fragments_);
    first = end;
  }
  starts_.push_back(fragments_.size());
}

std::span<const OpaqueFragment> OpaqueLayers::fragments(int x, int y) const {
  const std::size_t pixel =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  const auto found = std::lower_bound(pixels_.begin(), pixels_.end(), pixel);
  if (found == pixels_.end() || *found != pixel) return {};
  return covering(static_cast<std::size_t>(found - pixels_.begin()));
}

std::vector<double> OpaqueLayers::all(double end) const {
  return std::vector<double>(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                             end);
}

std::vector<double> OpaqueLayers::solid_ends() const {
  std::vector<double> ends;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const OpaqueFragment& last = covering(i).back();
    if (last.coverage < 1) continue;
    if (ends.empty()) ends = all(kInfinity);
    ends[pixels_[i]] = last.depth;
  }
  return ends;
}

std::vector<double> OpaqueLayers::partial_ends(std::size_t layer) const {
  std::vector<double> ends = all(-kInfinity);
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const std::span<const OpaqueFragment> fragments = covering(i);
    if (layer < fragments.size() && fragments[layer].coverage < 1)
      ends[pixels_[i]] = fragments[layer].depth;
  }
  return ends;
}

Image OpaqueLayers::compose(const std::function<Image(RayEnds)>& draw) const {
  Image image = draw(solid_ends());
  const auto over = [](const float* front, const OpaqueFragment& behind) {
    const float through = 1 - front[3];
    std::array<float, 4> rgba{};
    for (std::size_t c = 0; c < 3; ++c) rgba[c] = front[c] + through * behind.color[c];
    rgba[3] = front[3] + through;
    return rgba;
  };
  // Of each covered pixel what it still shows behind the layers in work, and the sum of those in
  // front.
  std::vector<float> left(pixels_.size(), 1);
  std::vector<std::array<float, 4>> sums(pixels_.size(), std::array<float, 4>{});
  for (std::size_t layer = 0; layer < partial_layers_; ++layer) {
    const Image front = draw(partial_ends(layer));
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const std::span<const OpaqueFragment> fragments = covering(i);
      if (layer >= fragments.size() || fragments[layer].coverage >= 1) continue;
      const std::array<float, 4> rgba = over(front.rgba.data() + 4 * pixels_[i], fragments[layer]);
      const float coverage = fragments[layer].coverage;
      for (std::size_t c = 0; c < 4; ++c) sums[i][c] += left[i] * coverage * rgba[c];
      left[i] *= 1 - coverage;
    }
  }
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    float* out = image.rgba.data() + 4 * pixels_[i];
    const OpaqueFragment& last = covering(i).back();
    std::array<float, 4> rest = {out[0], out[1], out[2], out[3]};
    if (last.coverage >= 1) rest = over(out, last);
    for (std::size_t c = 0; c < 4; ++c) out[c] = sums[i][c] + left[i] * rest[c];
  }
  return image;
}

}  // namespace tetraglass::project
