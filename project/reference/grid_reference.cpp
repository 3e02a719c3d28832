#include "project/reference/grid_reference.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <Eigen/LU>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "base/progress.h"
#include "base/stopwatch.h"
#include "preint/gauss.h"
#include "preint/segment_integral.h"
#include "project/light/phong.h"
#include "project/reference/ray_voxels.h"

namespace tetraglass::project {
namespace {

using preint::Color;
using Rgba = Eigen::Array4d;

constexpr double kTolerance = 1e-12;
// Of lit media, whose normals and highlights have edges.
constexpr double kLitTolerance = 1e-8;
// Of modulated media, whose extinction has edges where the density reaches 1.
constexpr double kModulatedTolerance = 1e-8;
constexpr int kMostHalvings = 40;

/// The part [begin, end] of a piece where the transfer function is linear in the value.
struct LinearPart {
  const preint::TransferFunction* tf;
  std::size_t interval;
  const MonotonePiece* piece;
  double length;  ///< of the whole piece
  /// What the extinction at a position is multiplied by; empty: nothing.
  std::function<double(double)> density = {};

  [[nodiscard]] preint::Medium at(double t) const {
    preint::Medium medium = tf->in_interval(interval, piece->value(t));
    if (density) medium.extinction *= density(t);
    return medium;
  }
  /// The optical depth between two positions: extinction is a cubic, for which four nodes are
  /// exact.
  [[nodiscard]] double depth(double begin, double end) const {
    return std::max(
        0.0, sum(begin, end, [](const preint::Medium& medium) { return medium.extinction; }));
  }
  /// What is emitted: of degree 6, exact with four nodes.
  [[nodiscard]] Color emission(double begin, double end) const {
    return {sum(begin, end, [](const preint::Medium& m) { return m.extinction * m.color.x(); }),
            sum(begin, end, [](const preint::Medium& m) { return m.extinction * m.color.y(); }),
            sum(begin, end, [](const preint::Medium& m) { return m.extinction * m.color.z(); })};
  }
  /// The integral of what four nodes are exact for.
  template <class F>
  [[nodiscard]] double by_one_rule(double begin, double end, const F& of) const {
    double sum = 0;
    for (const preint::GaussNode& node : preint::kGauss4) {
      sum += node.weight * of(at(begin + node.x * (end - begin)));
    }
    return sum * (end - begin) * length;
  }
  /// The integral of what four nodes are exact for but for a density: halved then until it is.
  template <class F>
  [[nodiscard]] double sum(double begin, double end, const F& of,
                           int halvings = kMostHalvings) const {
    const double whole = by_one_rule(begin, end, of);
    if (!density) return whole;
    const double middle = 0.5 * (begin + end);
    const double halves = by_one_rule(begin, middle, of) + by_one_rule(middle, end, of);
    if (halvings == 0 || std::abs(whole - halves) <= kModulatedTolerance) return halves;
    return sum(begin, middle, of, halvings - 1) + sum(middle, end, of, halvings - 1);
  }
  /// `color_of(t, Medium)`: the color at a position, lit or not.
  template <class F>
  [[nodiscard]] Color light_by_one_rule(double begin, double end, const F& color_of) const {
    Color sum = Color::Zero();
    double depth = 0;
    double last = begin;
    for (const preint::GaussNode& node : preint::kGauss10) {
      const double t = begin + node.x * (end - begin);
      const preint::Medium medium = at(t);
      depth += by_one_rule(last, t, [](const preint::Medium& m) { return m.extinction; });
      last = t;
      sum += node.weight * medium.extinction * std::exp(-depth) * color_of(t, medium);
    }
    return sum * (end - begin) * length;
  }
  /// What reaches `begin` of it.
  template <class F>
  [[nodiscard]] Color light(double begin, double end, double tolerance, const F& color_of,
                            int halvings = kMostHalvings) const {
    const double middle = 0.5 * (begin + end);
    const double first_depth = depth(begin, middle);
    const Color whole = light_by_one_rule(begin, end, color_of);
    const Color halves = light_by_one_rule(begin, middle, color_of) +
                         std::exp(-first_depth) * light_by_one_rule(middle, end, color_of);
    if (halvings == 0 || (whole - halves).abs().maxCoeff() <= tolerance) return halves;
    return light(begin, middle, tolerance, color_of, halvings - 1) +
           std::exp(-first_depth) * light(middle, end, tolerance, color_of, halvings - 1);
  }
};

class Tracer {
 public:
  explicit Tracer(const Scene& scene) : scene_(scene), voxels_(scene) {}

  [[nodiscard]] const Frame& frame() const { return voxels_.frame(); }

  [[nodiscard]] Rgba trace(int x, int y, std::vector<MonotonePiece>& pieces) const {
    voxels_.pieces(x, y, pieces);
    if (pieces.empty()) return Rgba::Zero();
    const Eigen::Vector2d plane = frame().image_plane(x, y);
    const double stretch = frame().ray_direction(plane).norm();
    switch (scene_.mode) {
      case Mode::full:
        return full(pieces, plane, stretch);
      case Mode::emission:
        return emission(pieces, plane, stretch);
      case Mode::absorption:
        return absorption(pieces, plane, stretch);
      case Mode::mip:
        return mip(pieces);
      case Mode::iso:
        return iso(pieces, plane);
      case Mode::thickness:
        return thickness(pieces, stretch);
    }
    return Rgba::Zero();
  }

 private:
  static Rgba rgba(const Color& color, double alpha) {
    return {color.x(), color.y(), color.z(), alpha};
  }

  /// Calls visit(part, begin, end) for the parts of a piece between control points, front to back.
  template <class Visit>
  void visit_parts(const MonotonePiece& piece, const Eigen::Vector2d& plane, double stretch,
                   Visit visit) const {
    const preint::TransferFunction& tf = scene_.transfer_function;
    const double front = piece.value(0);
    const double back = piece.value(1);
    const bool rising = back >= front;
    const std::size_t last = rising ? tf.interval_below(back) : tf.interval_above(back);
    std::size_t interval = rising ? tf.interval_above(front) : tf.interval_below(front);
    double begin = 0;
    for (;;) {
      const bool ends = rising ? interval >= last : interval <= last;
      // The control point where the interval is left.
      const double end =
          ends ? 1 : piece.position(tf.points()[rising ? interval : interval - 1].value);
      LinearPart part{&tf, interval, &piece, (piece.exit - piece.entry) * stretch};
      if (scene_.modulation) part.density = [&](double t) { return density(piece, t, plane); };
      if (end > begin) visit(part, begin, end);
      if (ends) return;
      begin = std::max(begin, end);
      interval += rising ? 1 : -1;
    }
  }

  [[nodiscard]] Rgba full(const std::vector<MonotonePiece>& pieces, const Eigen::Vector2d& plane,
                          double stretch) const {
    const bool lit = is_lit_medium(scene_);
    const double tolerance = scene_.modulation ? kLitTolerance : kTolerance;
    Color color = Color::Zero();
    double depth = 0;
    for (const MonotonePiece& piece : pieces) {
      visit_parts(piece, plane, stretch, [&](const LinearPart& part, double begin, double end) {
        const Color light =
            lit ? part.light(begin, end, kLitTolerance,
                             [&](double t, const preint::Medium& medium) {
                               return lit_color(piece, t, plane, medium.color);
                             })
                : part.light(begin, end, tolerance,
                             [](double, const preint::Medium& medium) { return medium.color; });
        color += std::exp(-depth) * light;
        depth += part.depth(begin, end);
      });
    }
    return rgba(color, -std::expm1(-depth));
  }

  /// min(1, |gradient| / modulation) at a position of a piece.
  [[nodiscard]] double density(const MonotonePiece& piece, double t,
                               const Eigen::Vector2d& plane) const {
    const Eigen::Vector3d at =
        voxels_.coordinate(plane, piece.entry + t * (piece.exit - piece.entry));
    return std::min(1.0,
                    grid_gradient(scene_, scene_.grid->index_at(at)).norm() / *scene_.modulation);
  }

  /// At a position of a piece.
  [[nodiscard]] Color lit_color(const MonotonePiece& piece, double t, const Eigen::Vector2d& plane,
                                const Color& color) const {
    const Eigen::Vector3d ray = frame().ray_direction(plane);
    const Eigen::Vector3d at =
        voxels_.coordinate(plane, piece.entry + t * (piece.exit - piece.entry));
    return shade(scene_.lights, color, scene_.transfer_function.material_at(piece.value(t)),
                 scene_.grid->origin + scene_.grid->axes * at,
                 grid_gradient(scene_, scene_.grid->index_at(at)),
                 -(frame().axes().transpose() * ray).normalized());
  }

  [[nodiscard]] Rgba emission(const std::vector<MonotonePiece>& pieces,
                              const Eigen::Vector2d& plane, double stretch) const {
    Color color = Color::Zero();
    for (const MonotonePiece& piece : pieces) {
      visit_parts(piece, plane, stretch, [&](const LinearPart& part, double begin, double end) {
        color += part.emission(begin, end);
      });
    }
    return rgba(color, 0);
  }

  [[nodiscard]] Rgba absorption(const std::vector<MonotonePiece>& pieces,
                                const Eigen::Vector2d& plane, double stretch) const {
    double depth = 0;
    for (const MonotonePiece& piece : pieces) {
      visit_parts(piece, plane, stretch, [&](const LinearPart& part, double begin, double end) {
        depth += part.depth(begin, end);
      });
    }
    return {0, 0, 0, -std::expm1(-depth)};
  }

  [[nodiscard]] Rgba mip(const std::vector<MonotonePiece>& pieces) const {
    Color color = Color::Zero();
    double largest = -std::numeric_limits<double>::infinity();
    for (const MonotonePiece& piece : pieces) {
      const double front = piece.value(0);
      const double back = piece.value(1);
      largest = std::max({largest, front, back});
      if (scene_.mip_of == MipOf::transfer) {
        color = color.max(max_color(scene_.transfer_function, front, back));
      }
    }
    return rgba(
        scene_.mip_of == MipOf::transfer ? color : scene_.transfer_function.at(largest).color, 1);
  }

  [[nodiscard]] Rgba iso(const std::vector<MonotonePiece>& pieces,
                         const Eigen::Vector2d& plane) const {
    Color color = Color::Zero();
    double transmittance = 1;
    // Pieces follow each other: each goes on from the value at which the last one ended, so that
    // none of the crossings falls between their roundings.
    double front = pieces.front().value(0);
    for (const MonotonePiece& piece : pieces) {
      const double back = piece.value(1);
      for (const std::size_t i : preint::crossed(scene_.isosurfaces, front, back)) {
        const preint::Isosurface& surface = scene_.isosurfaces[i];
        Color lit = surface.color;
        if (scene_.shading != Shading::none) {
          lit = lit_color(piece, piece.position(surface.value), plane, lit);
        }
        color += transmittance * surface.opacity * lit;
        transmittance *= 1 - surface.opacity;
      }
      front = back;
    }
    return rgba(color, 1 - transmittance);
  }

  [[nodiscard]] static Rgba thickness(const std::vector<MonotonePiece>& pieces, double stretch) {
    double length = 0;
    for (const MonotonePiece& piece : pieces) length += (piece.exit - piece.entry) * stretch;
    return rgba(Color::Constant(length), length > 0 ? 1 : 0);
  }

  const Scene& scene_;
  RayVoxels voxels_;
};

}  // namespace

namespace {

/// The mean over the places one point up and down the axes other than `axis`, weights (1, 2, 1) / 4
/// along each.
double smoothed_value(const Scene& scene, const Eigen::Vector3d& index, Eigen::Index axis) {
  const mesh::RectilinearGrid& grid = *scene.grid;
  double sum = 0;
  for (const int i : {-1, 0, 1}) {
    for (const int j : {-1, 0, 1}) {
      Eigen::Vector3d at = index;
      for (const auto& [other, step] : {std::pair((axis + 1) % 3, i), {(axis + 2) % 3, j}}) {
        const auto last = static_cast<double>(grid.size(static_cast<std::size_t>(other)) - 1);
        at[other] = std::clamp(at[other] + step, 0.0, last);
      }
      sum += (2 - std::abs(i)) * (2 - std::abs(j)) * interpolate(grid, scene.field.values, at);
    }
  }
  return sum / 16;
}

}  // namespace

Eigen::Vector3d grid_gradient(const Scene& scene, const Eigen::Vector3d& index) {
  const mesh::RectilinearGrid& grid = *scene.grid;
  const auto coordinate = [&](std::size_t axis, double at) {
    const std::vector<double>& row = grid.coordinates[axis];
    const std::size_t low = std::min(static_cast<std::size_t>(at), row.size() - 2);
    return row[low] + (at - static_cast<double>(low)) * (row[low + 1] - row[low]);
  };
  const auto value = [&](const Eigen::Vector3d& at, Eigen::Index axis) {
    return scene.gradient == GradientOf::sobel ? smoothed_value(scene, at, axis)
                                               : interpolate(grid, scene.field.values, at);
  };
  Eigen::Vector3d slope;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    Eigen::Vector3d up = index;
    Eigen::Vector3d down = index;
    up[axis] = std::min(index[axis] + 1, static_cast<double>(grid.size(k) - 1));
    down[axis] = std::max(index[axis] - 1, 0.0);
    slope[axis] = (value(up, axis) - value(down, axis)) /
                  (coordinate(k, up[axis]) - coordinate(k, down[axis]));
  }
  return grid.axes.inverse().transpose() * slope;
}

Image render_grid_reference(const Scene& scene, Stats& stats) {
  const base::Stopwatch clock;
  const Tracer tracer(scene);
  Image image(tracer.frame().width(), tracer.frame().height());
  std::atomic<std::uint64_t> fragments{0};
  base::Progress progress("grid-reference", static_cast<std::uint64_t>(image.height));
  tbb::enumerable_thread_specific<std::vector<MonotonePiece>> scratch;
  tbb::parallel_for(0, image.height, [&](int y) {
    std::vector<MonotonePiece>& pieces = scratch.local();
    std::uint64_t row_fragments = 0;
    for (int x = 0; x < image.width; ++x) {
      Eigen::Map<Eigen::Array4f>(image.pixel(x, y)) = tracer.trace(x, y, pieces).cast<float>();
      row_fragments += pieces.size();
    }
    fragments += row_fragments;
    progress.advance();
  });
  stats.fragments += fragments;
  stats.project_ms += clock.milliseconds();
  stats.threads = tbb::this_task_arena::max_concurrency();
  stats.sort_exact = true;
  return image;
}

std::vector<Eigen::Array4d> grid_reference_pixels(const Scene& scene,
                                                  std::span<const Eigen::Vector2i> pixels) {
  const Tracer tracer(scene);
  std::vector<Eigen::Array4d> result(pixels.size());
  base::Progress progress("verify", pixels.size());
  tbb::enumerable_thread_specific<std::vector<MonotonePiece>> scratch;
  tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t i) {
    const int n = scene.samples;
    Eigen::Array4d sum = Eigen::Array4d::Zero();
    for (int sample = 0; sample < n * n; ++sample) {
      sum += tracer.trace(n * pixels[i].x() + sample % n, n * pixels[i].y() + sample / n,
                          scratch.local());
    }
    result[i] = sum / (n * n);
    progress.advance();
  });
  return result;
}

}  // namespace tetraglass::project
