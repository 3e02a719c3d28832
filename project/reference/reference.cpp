#include "project/reference/reference.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <optional>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "base/progress.h"
#include "base/stopwatch.h"
#include "mesh/gradients.h"
#include "preint/segment_integral.h"
#include "project/reference/ray_cells.h"
#include "project/shading.h"

namespace tetraglass::project {
namespace {

using Rgba = Eigen::Array4d;

/// Everything that stays the same from ray to ray.
class Tracer {
 public:
  explicit Tracer(const Scene& scene) : scene_(scene), cells_(scene) {
    if (scene.mode != Mode::iso) return;
    if (scene.shading == Shading::smooth)
      gradients_ = mesh::vertex_gradients(*scene.mesh, scene.field);
    if (scene.shading == Shading::flat) gradients_ = mesh::cell_gradients(*scene.mesh, scene.field);
  }

  [[nodiscard]] const Frame& frame() const { return cells_.frame(); }

  /// The color of pixel (x, y); `segments` is scratch space and holds the ray's segments
  /// afterwards.
  [[nodiscard]] Rgba trace(int x, int y, std::vector<RaySegment>& segments) const {
    cells_.segments(x, y, segments);
    if (!scene_.clip.empty()) clip(x, y, segments);
    if (segments.empty()) return Rgba::Zero();
    const Eigen::Vector3d ray = cells_.frame().ray_direction(cells_.frame().image_plane(x, y));
    switch (scene_.mode) {
      case Mode::full:
        return full(segments, ray.norm());
      case Mode::emission:
        return emission(segments, ray.norm());
      case Mode::absorption:
        return absorption(segments, ray.norm());
      case Mode::mip:
        return mip(segments);
      case Mode::iso:
        return iso(segments, -(cells_.frame().axes().transpose() * ray).normalized());
      case Mode::thickness:
        return thickness(segments, ray.norm());
    }
    return Rgba::Zero();
  }

 private:
  /// Cuts the segments where the scene's planes do, and drops those of which nothing is left.
  void clip(int x, int y, std::vector<RaySegment>& segments) const {
    const DepthRange kept =
        clipped_ray(scene_.clip, cells_.frame(), cells_.frame().image_plane(x, y));
    std::erase_if(segments, [&](RaySegment& s) {
      const double near = std::max(s.entry, kept.near);
      const double far = std::min(s.exit, kept.far);
      if (!(near < far)) return true;
      const double t0 = (near - s.entry) / (s.exit - s.entry);
      const double t1 = (far - s.entry) / (s.exit - s.entry);
      const double rise = s.back - s.front;
      const Eigen::Vector4d turn = s.exit_weights - s.entry_weights;
      s.back = s.front + t1 * rise;
      s.front += t0 * rise;
      s.exit_weights = s.entry_weights + t1 * turn;
      s.entry_weights += t0 * turn;
      s.entry = near;
      s.exit = far;
      return false;
    });
  }

  /// `stretch` is the world length of a unit of depth.
  static preint::Segment piece(const RaySegment& s, double stretch) {
    return {s.front, s.back, (s.exit - s.entry) * stretch};
  }
  static Rgba rgba(const preint::Color& color, double alpha) {
    return {color.x(), color.y(), color.z(), alpha};
  }

  [[nodiscard]] Rgba full(const std::vector<RaySegment>& segments, double stretch) const {
    preint::Color color = preint::Color::Zero();
    double transmittance = 1;
    for (const RaySegment& segment : segments) {
      const preint::Radiance radiance =
          integrate_full(scene_.transfer_function, piece(segment, stretch));
      color += transmittance * radiance.color;
      transmittance *= radiance.transmittance;
    }
    return rgba(color, 1 - transmittance);
  }

  [[nodiscard]] Rgba emission(const std::vector<RaySegment>& segments, double stretch) const {
    preint::Color color = preint::Color::Zero();
    for (const RaySegment& segment : segments) {
      color += integrate_emission(scene_.transfer_function, piece(segment, stretch));
    }
    return rgba(color, 0);
  }

  [[nodiscard]] Rgba absorption(const std::vector<RaySegment>& segments, double stretch) const {
    double depth = 0;
    for (const RaySegment& segment : segments) {
      depth += optical_depth(scene_.transfer_function, piece(segment, stretch));
    }
    return {0, 0, 0, -std::expm1(-depth)};
  }

  [[nodiscard]] Rgba mip(const std::vector<RaySegment>& segments) const {
    if (scene_.mip_of == MipOf::transfer) {
      preint::Color color = preint::Color::Zero();
      for (const RaySegment& segment : segments) {
        color = color.max(max_color(scene_.transfer_function, segment.front, segment.back));
      }
      return rgba(color, 1);
    }
    double largest = -std::numeric_limits<double>::infinity();
    for (const RaySegment& segment : segments)
      largest = std::max({largest, segment.front, segment.back});
    return rgba(scene_.transfer_function.at(largest).color, 1);
  }

  [[nodiscard]] Rgba iso(const std::vector<RaySegment>& segments,
                         const Eigen::Vector3d& to_viewer) const {
    preint::Color color = preint::Color::Zero();
    double transmittance = 1;
    for (const RaySegment& segment : segments) {
      for (const std::size_t i : preint::crossed(scene_.isosurfaces, segment.front, segment.back)) {
        const preint::Isosurface& surface = scene_.isosurfaces[i];
        const double t = (surface.value - segment.front) / (segment.back - segment.front);
        const preint::Color shaded =
            intensity(segment, t) * shade_headlight(surface.color, gradient(segment, t), to_viewer);
        color += transmittance * surface.opacity * shaded;
        transmittance *= 1 - surface.opacity;
      }
    }
    return rgba(color, 1 - transmittance);
  }

  /// Of a surface at the part t of the segment, by the scene's depth cue.
  [[nodiscard]] double intensity(const RaySegment& segment, double t) const {
    if (!scene_.depth_cue) return 1;
    return scene_.depth_cue->intensity(segment.entry + t * (segment.exit - segment.entry));
  }

  [[nodiscard]] static Rgba thickness(const std::vector<RaySegment>& segments, double stretch) {
    double length = 0;
    for (const RaySegment& segment : segments) length += (segment.exit - segment.entry) * stretch;
    return rgba(preint::Color::Constant(length), length > 0 ? 1 : 0);
  }

  /// The field's gradient at the part t of the segment; zero (unshaded) where the scene has no
  /// shading.
  [[nodiscard]] Eigen::Vector3d gradient(const RaySegment& segment, double t) const {
    if (scene_.shading == Shading::none) return Eigen::Vector3d::Zero();
    if (scene_.shading == Shading::flat) return gradients_[segment.cell];
    const mesh::Cell& cell = scene_.mesh->cells[segment.cell];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < 4; ++i) {
      const double weight =
          segment.entry_weights[i] + t * (segment.exit_weights[i] - segment.entry_weights[i]);
      sum += weight * gradients_[cell[static_cast<std::size_t>(i)]];
    }
    return sum;
  }

  const Scene& scene_;
  RayCells cells_;
  std::vector<Eigen::Vector3d> gradients_;  // per vertex (smooth) or per cell (flat)
};

}  // namespace

Image render_reference(const Scene& scene, Stats& stats) {
  const base::Stopwatch clock;
  const Tracer tracer(scene);
  const Frame& frame = tracer.frame();
  Image image(frame.width(), frame.height());
  std::atomic<std::uint64_t> fragments{0};
  base::Progress progress("reference", static_cast<std::uint64_t>(frame.height()));
  tbb::enumerable_thread_specific<std::vector<RaySegment>> scratch;
  tbb::parallel_for(0, frame.height(), [&](int y) {
    std::vector<RaySegment>& segments = scratch.local();
    std::uint64_t row_fragments = 0;
    for (int x = 0; x < frame.width(); ++x) {
      Eigen::Map<Eigen::Array4f>(image.pixel(x, y)) = tracer.trace(x, y, segments).cast<float>();
      row_fragments += segments.size();
    }
    fragments += row_fragments;
    progress.advance();
  });
  stats.fragments += fragments;
  stats.project_ms += clock.milliseconds();
  stats.threads = tbb::this_task_arena::max_concurrency();
  stats.sort_method = "fragments";
  stats.sort_exact = true;
  return image;
}

std::vector<Eigen::Array4d> reference_pixels(const Scene& scene,
                                             std::span<const Eigen::Vector2i> pixels) {
  const Tracer tracer(scene);
  std::vector<Eigen::Array4d> result(pixels.size());
  base::Progress progress("verify", pixels.size());
  tbb::enumerable_thread_specific<std::vector<RaySegment>> scratch;
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
