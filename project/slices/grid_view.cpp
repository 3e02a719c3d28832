#include "project/slices/grid_view.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace tetraglass::project::slices {

GridView::GridView(const Scene& scene, const gl::Normalization& normalization, const Frame& frame,
                   double focus)
    : parallel_(frame.parallel()),
      focus_(focus),
      pitch_(frame.parallel() ? frame.pitch() / normalization.radius : frame.pitch()),
      middle_(frame.middle()) {
  const mesh::RectilinearGrid& grid = *scene.grid;
  Eigen::Vector3d half;
  for (std::size_t k = 0; k < 3; ++k) {
    half[static_cast<Eigen::Index>(k)] = 0.5 * grid.coordinates[k].back();
  }
  const Eigen::Matrix3d to_half = half.cwiseInverse().asDiagonal() * grid.axes.inverse();
  to_box_ = normalization.radius * to_half * frame.axes().transpose();
  to_camera_ = to_box_.inverse();
  eye_ = to_half * (frame.eye() - grid.origin) - Eigen::Vector3d::Ones();
  // The planes across an axis have the normal to_box_.row(axis).
  const Eigen::Vector3d cosines = to_box_.col(2).cwiseAbs().cwiseQuotient(steepest());
  cosines.maxCoeff(&stack_axis_);
  if (parallel_) return;
  for (const int x : {0, frame.width() - 1}) {
    for (const int y : {0, frame.height() - 1}) {
      most_stretch_ = std::max(most_stretch_, frame.ray_direction(frame.image_plane(x, y)).norm());
    }
  }
}

std::array<Eigen::Vector3d, 8> GridView::corners(const GridBox& box) const {
  std::array<Eigen::Vector3d, 8> result;
  for (std::size_t i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner((i & 1) != 0 ? box.high.x() : box.low.x(),
                                 (i & 2) != 0 ? box.high.y() : box.low.y(),
                                 (i & 4) != 0 ? box.high.z() : box.low.z());
    result[i] = to_camera_ * (corner - eye_);
  }
  return result;
}

Eigen::Vector2d GridView::pixel(const Eigen::Vector3d& camera) const {
  const double scale = 1 / (parallel_ ? pitch_ : camera.z() * pitch_);
  return middle_ + Eigen::Vector2d(camera.x(), -camera.y()) * scale;
}

void GridView::set(const gl::Program& program) const {
  const auto column = [&](int i) { return Eigen::Vector3f(to_box_.col(i).cast<float>()); };
  program.set("grid_right", column(0));
  program.set("grid_up", column(1));
  program.set("grid_away", column(2));
  program.set("grid_start", Eigen::Vector3f(to_box({0, 0, focus_}).cast<float>()));
  // Of a ray in an outer face of the grid, as if moved to the right and, less, up.
  Eigen::Vector3f drift;
  for (int k = 0; k < 3; ++k) {
    drift[k] = static_cast<float>(to_box_(k, 0) != 0 ? to_box_(k, 0) : to_box_(k, 1));
  }
  program.set("grid_drift", drift);
}

}  // namespace tetraglass::project::slices
