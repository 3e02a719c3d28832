#include "project/gl/mesh_buffers.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "mesh/gradients.h"
#include "mesh/predicates.h"
#include "project/modulation.h"

namespace tetraglass::project::gl {
namespace {

constexpr std::uint32_t kNegative = 0x80000000U;

// Cells or vertices that a task takes at least: some 10 us of work.
constexpr std::size_t kGrain = 4096;

template <class F>
void for_all(std::size_t count, const F& f) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) f(i);
  });
}

// Its vertices in ascending order, the last with the sign.
mesh::Cell sorted_cell(const mesh::TetMesh& mesh, std::size_t index) {
  mesh::Cell cell = mesh.cells[index];
  std::sort(cell.begin(), cell.end());
  const auto point = [&](std::size_t k) -> const Eigen::Vector3d& { return mesh.points[cell[k]]; };
  const bool finite =
      point(0).allFinite() && point(1).allFinite() && point(2).allFinite() && point(3).allFinite();
  if (finite && mesh::orientation(point(0), point(1), point(2), point(3)) < 0) {
    cell[3] |= kNegative;
  }
  return cell;
}

// Position and value. What is not finite belongs to cells that are not drawn.
Eigen::Vector4f placed_vertex(const Scene& scene, const Normalization& normalization,
                              std::size_t i) {
  Eigen::Vector4f result = Eigen::Vector4f::Zero();
  const Eigen::Vector3d& point = scene.mesh->points[i];
  if (point.allFinite()) result.head<3>() = normalization.point(point);
  if (scene.field.location == mesh::Location::point && std::isfinite(scene.field.values[i])) {
    result.w() = normalization.value(scene.field.values[i]);
  }
  return result;
}

float cell_value(const Scene& scene, const Normalization& normalization, std::size_t i) {
  const double value = scene.field.values[i];
  return std::isfinite(value) ? normalization.value(value) : 0.0F;
}

// f(i) for 0 <= i < count.
template <class F>
auto made(std::size_t count, const F& f) {
  std::vector<decltype(f(std::size_t{0}))> result(count);
  for_all(count, [&](std::size_t i) { result[i] = f(i); });
  return result;
}

// Only their directions matter: in units of the largest component of all.
std::vector<Eigen::Vector4f> vertex_gradients(const Scene& scene) {
  const std::vector<Eigen::Vector3d> gradients = mesh::vertex_gradients(*scene.mesh, scene.field);
  double largest = 0;
  for (const Eigen::Vector3d& g : gradients) {
    if (g.allFinite()) largest = std::max(largest, g.cwiseAbs().maxCoeff());
  }
  std::vector<Eigen::Vector4f> result(gradients.size(), Eigen::Vector4f::Zero());
  if (largest == 0) return result;
  for_all(result.size(), [&](std::size_t i) {
    if (gradients[i].allFinite()) result[i].head<3>() = (gradients[i] / largest).cast<float>();
  });
  return result;
}

}  // namespace

bool needs_vertex_gradients(const Scene& scene, const Plan& plan) {
  return plan.gradients && !has_cell_normals(scene);
}

void set_mesh_units(const Program& program) {
  program.set("cells", Units::kCells);
  program.set("vertices", Units::kVertices);
  program.set("cell_values", Units::kCellValues);
  program.set("densities", Units::kDensities);
  program.set("gradients", Units::kGradients);
}

MeshBuffers::MeshBuffers(const Context& context, const Scene& scene,
                         const Normalization& normalization, bool gradients)
    : scene_(scene),
      normalization_(normalization),
      cells_(context, Texel::rgba32ui),
      vertices_(context, Texel::rgba32f) {
  if (scene.field.location == mesh::Location::cell) cell_values_.emplace(context, Texel::r32f);
  if (scene.modulation) {
    densities_.emplace(context, Texel::r32f);
    const std::vector<double> densities = cell_densities(scene);
    cell_densities_.assign(densities.begin(), densities.end());
  }
  if (gradients) {
    gradients_.emplace(context, Texel::rgba32f);
    vertex_gradients_ = vertex_gradients(scene);
  }
}

std::size_t MeshBuffers::cell_bytes(const Scene& scene) {
  return texel_bytes(Texel::rgba32ui) +
         (scene.field.location == mesh::Location::cell ? texel_bytes(Texel::r32f) : 0) +
         (scene.modulation ? texel_bytes(Texel::r32f) : 0);
}

std::size_t MeshBuffers::point_bytes(bool gradients) {
  return texel_bytes(Texel::rgba32f) * (gradients ? 2 : 1);
}

void MeshBuffers::load() {
  const mesh::TetMesh& mesh = *scene_.mesh;
  cells_.upload(made(mesh.cells.size(), [&](std::size_t i) { return sorted_cell(mesh, i); }),
                "cells");
  vertices_.upload(made(mesh.points.size(),
                        [&](std::size_t i) { return placed_vertex(scene_, normalization_, i); }),
                   "points");
  if (cell_values_) {
    cell_values_->upload(made(mesh.cells.size(),
                              [&](std::size_t i) { return cell_value(scene_, normalization_, i); }),
                         "cell values");
  }
  if (densities_) {
    densities_->upload(cell_densities_, "densities");
    cell_densities_ = {};
  }
  if (gradients_) {
    gradients_->upload(vertex_gradients_, "gradients");
    vertex_gradients_ = {};
  }
}

void MeshBuffers::load(std::span<const std::uint32_t> cells, const CellCutter& cutter) {
  const mesh::TetMesh& mesh = *scene_.mesh;
  const std::vector<std::uint32_t>& points = cutter.points();
  // The points keep their order: nothing is computed otherwise than for the whole mesh.
  const auto renumbered = [&](std::size_t k) {
    mesh::Cell cell = sorted_cell(mesh, cells[k]);
    const std::uint32_t sign = cell[3] & kNegative;
    cell[3] &= ~kNegative;
    for (std::uint32_t& point : cell) point = cutter.place(point);
    cell[3] |= sign;
    return cell;
  };
  cells_.upload(made(cells.size(), renumbered), "cells");
  vertices_.upload(
      made(points.size(),
           [&](std::size_t i) { return placed_vertex(scene_, normalization_, points[i]); }),
      "points");
  if (cell_values_) {
    cell_values_->upload(
        made(cells.size(),
             [&](std::size_t k) { return cell_value(scene_, normalization_, cells[k]); }),
        "cell values");
  }
  if (densities_) {
    densities_->upload(made(cells.size(), [&](std::size_t k) { return cell_densities_[cells[k]]; }),
                       "densities");
  }
  if (gradients_) {
    gradients_->upload(
        made(points.size(), [&](std::size_t i) { return vertex_gradients_[points[i]]; }),
        "gradients");
  }
}

void MeshBuffers::bind() const {
  cells_.bind(Units::kCells);
  vertices_.bind(Units::kVertices);
  if (cell_values_) cell_values_->bind(Units::kCellValues);
  if (densities_) densities_->bind(Units::kDensities);
  if (gradients_) gradients_->bind(Units::kGradients);
}

std::size_t MeshBuffers::bytes() const {
  return cells_.bytes() + vertices_.bytes() + (cell_values_ ? cell_values_->bytes() : 0) +
         density_bytes() + gradient_bytes();
}

}  // namespace tetraglass::project::gl
