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
#include "project/light/phong.h"
#include "project/modulation.h"
#include "project/opaque_layers.h"
#include "project/reference/lit_segment.h"
#include "project/reference/ray_cells.h"

namespace tetraglass::project {
namespace {

using Rgba = Eigen::Array4d;

/// Everything that stays the same from ray to ray.
class Tracer {
 public:
  explicit Tracer(const Scene& scene) : scene_(scene), cells_(scene) {
    if (scene.shading != Shading::none) {
      gradients_ = has_cell_normals(scene) ? mesh::cell_gradients(*scene.mesh, scene.field)
                                           : mesh::vertex_gradients(*scene.mesh, scene.field);
    }
    if (scene.modulation) densities_ = cell_densities(scene);
    if (!scene.opaque.empty()) {
      opaque_.emplace(scene.opaque, scene.lights, cells_.frame(), scene.samples);
    }
  }

  [[nodiscard]] const Frame& frame() const { return cells_.frame(); }

  /// The color of pixel (x, y); `segments` is scratch space and holds the ray's segments
  /// afterwards.
  [[nodiscard]] Rgba trace(int x, int y, std::vector<RaySegment>& segments) const {
    cells_.segments(x, y, segments);
    if (!scene_.clip.empty()) {
      clip(clipped_ray(scene_.clip, cells_.frame(), cells_.frame().image_plane(x, y)), segments);
    }
    const Ray ray(cells_.frame(), x, y);
    if (!opaque_) return volume(ray, segments);
    Rgba sum = Rgba::Zero();
    double left = 1;
    for (const OpaqueFragment& fragment : opaque_->fragments(x, y)) {
      std::vector<RaySegment> before = segments;
      clip({-std::numeric_limits<double>::infinity(), fragment.depth}, before);
      const Rgba front = volume(ray, before);
      const Rgba behind(fragment.color[0], fragment.color[1], fragment.color[2], 1);
      const double coverage = fragment.coverage;
      sum += left * coverage * (front + (1 - front.w()) * behind);
      left *= 1 - coverage;
    }
    return left > 0 ? (sum + left * volume(ray, segments)).eval() : sum;
  }

 private:
  struct Ray;

  /// The color of the ray by its segments alone.
  [[nodiscard]] Rgba volume(const Ray& ray, const std::vector<RaySegment>& segments) const {
    if (segments.empty()) return Rgba::Zero();
    switch (scene_.mode) {
      case Mode::full:
        return scene_.shading == Shading::none ? full(segments, ray) : lit(segments, ray);
      case Mode::emission:
        return emission(segments, ray);
      case Mode::absorption:
        return absorption(segments, ray);
      case Mode::mip:
        return mip(segments);
      case Mode::iso:
        return iso(segments, ray);
      case Mode::thickness:
        return thickness(segments, ray);
    }
    return Rgba::Zero();
  }

  /// A pixel's ray in the mesh's coordinates.
  struct Ray {
    Ray(const Frame& frame, int x, int y) {
      const Eigen::Vector2d plane = frame.image_plane(x, y);
      start = frame.eye() + frame.axes().transpose() * frame.ray_origin(plane);
      step = frame.axes().transpose() * frame.ray_direction(plane);
      stretch = step.norm();
      to_viewer = -step / stretch;
    }
    /// At a depth along the view axis.
    [[nodiscard]] Eigen::Vector3d at(double depth) const { return start + depth * step; }

    Eigen::Vector3d start;  ///< at depth 0
    Eigen::Vector3d step;   ///< for a unit of depth
    Eigen::Vector3d to_viewer;
    double stretch;  ///< the length of a unit of depth
  };

  /// Cuts the segments to the part of the ray, and drops those of which nothing is left.
  static void clip(const DepthRange& kept, std::vector<RaySegment>& segments) {
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

  /// What is integrated: shorter than it is where the extinction is modulated, which comes to the
  /// same.
  [[nodiscard]] preint::Segment piece(const RaySegment& s, const Ray& ray) const {
    const double length = (s.exit - s.entry) * ray.stretch;
    return {s.front, s.back, scene_.modulation ? length * densities_[s.cell] : length};
  }
  static Rgba rgba(const preint::Color& color, double alpha) {
    return {color.x(), color.y(), color.z(), alpha};
  }

  [[nodiscard]] Rgba full(const std::vector<RaySegment>& segments, const Ray& ray) const {
    preint::Color color = preint::Color::Zero();
    double transmittance = 1;
    for (const RaySegment& segment : segments) {
      const preint::Radiance radiance =
          integrate_full(scene_.transfer_function, piece(segment, ray));
      color += transmittance * radiance.color;
      transmittance *= radiance.transmittance;
    }
    return rgba(color, 1 - transmittance);
  }

  [[nodiscard]] Rgba emission(const std::vector<RaySegment>& segments, const Ray& ray) const {
    preint::Color color = preint::Color::Zero();
    for (const RaySegment& segment : segments) {
      color += integrate_emission(scene_.transfer_function, piece(segment, ray));
    }
    return rgba(color, 0);
  }

  [[nodiscard]] Rgba absorption(const std::vector<RaySegment>& segments, const Ray& ray) const {
    double depth = 0;
    for (const RaySegment& segment : segments) {
      depth += optical_depth(scene_.transfer_function, piece(segment, ray));
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

  [[nodiscard]] Rgba iso(const std::vector<RaySegment>& segments, const Ray& ray) const {
    preint::Color color = preint::Color::Zero();
    double transmittance = 1;
    for (const RaySegment& segment : segments) {
      for (const std::size_t i : preint::crossed(scene_.isosurfaces, segment.front, segment.back)) {
        const preint::Isosurface& surface = scene_.isosurfaces[i];
        const double t = (surface.value - segment.front) / (segment.back - segment.front);
        const preint::Color shaded =
            intensity(segment, t) * lit_color(segment, t, ray, surface.color,
                                              scene_.transfer_function.material_at(surface.value));
        color += transmittance * surface.opacity * shaded;
        transmittance *= 1 - surface.opacity;
      }
    }
    return rgba(color, 1 - transmittance);
  }

  [[nodiscard]] Rgba lit(const std::vector<RaySegment>& segments, const Ray& ray) const {
    preint::Color color = preint::Color::Zero();
    double transmittance = 1;
    for (const RaySegment& segment : segments) {
      const preint::Radiance radiance = integrate_lit(
          scene_.transfer_function, piece(segment, ray),
          [&](double t, double value, const preint::Color& unlit) {
            return lit_color(segment, t, ray, unlit, scene_.transfer_function.material_at(value));
          });
      color += transmittance * radiance.color;
      transmittance *= radiance.transmittance;
    }
    return rgba(color, 1 - transmittance);
  }

  /// At the part t of the segment.
  [[nodiscard]] preint::Color lit_color(const RaySegment& segment, double t, const Ray& ray,
                                        const preint::Color& color,
                                        const preint::Material& material) const {
    const double depth = segment.entry + t * (segment.exit - segment.entry);
    return shade(scene_.lights, color, material, ray.at(depth), gradient(segment, t),
                 ray.to_viewer);
  }

  /// Of a surface at the part t of the segment, by the scene's depth cue.
  [[nodiscard]] double intensity(const RaySegment& segment, double t) const {
    if (!scene_.depth_cue) return 1;
    return scene_.depth_cue->intensity(segment.entry + t * (segment.exit - segment.entry));
  }

  [[nodiscard]] static Rgba thickness(const std::vector<RaySegment>& segments, const Ray& ray) {
    double length = 0;
    for (const RaySegment& segment : segments)
      length += (segment.exit - segment.entry) * ray.stretch;
    return rgba(preint::Color::Constant(length), length > 0 ? 1 : 0);
  }

  /// The field's gradient at the part t of the segment; zero (unshaded) where the scene has no
  /// shading.
  [[nodiscard]] Eigen::Vector3d gradient(const RaySegment& segment, double t) const {
    if (scene_.shading == Shading::none) return Eigen::Vector3d::Zero();
    if (has_cell_normals(scene_)) return gradients_[segment.cell];
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
  std::vector<Eigen::Vector3d> gradients_;  // per vertex or per cell; empty without shading
  std::vector<double> densities_;           // per cell; empty without modulation
  std::optional<OpaqueLayers> opaque_;
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
