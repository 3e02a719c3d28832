#include "project/gl/mesh_buffers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "base/errors.h"
#include "mesh/gradients.h"
#include "mesh/predicates.h"

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

std::vector<mesh::Cell> sorted_cells(const mesh::TetMesh& mesh) {
  std::vector<mesh::Cell> result(mesh.cells.size());
  for_all(result.size(), [&](std::size_t i) {
    mesh::Cell cell = mesh.cells[i];
    std::sort(cell.begin(), cell.end());
    const auto point = [&](std::size_t k) -> const Eigen::Vector3d& {
      return mesh.points[cell[k]];
    };
    const bool finite = point(0).allFinite() && point(1).allFinite() && point(2).allFinite() &&
                        point(3).allFinite();
    if (finite && mesh::orientation(point(0), point(1), point(2), point(3)) < 0) {
      cell[3] |= kNegative;
    }
    result[i] = cell;
  });
  return result;
}

// Position and value of each vertex. What is not finite belongs to cells that are not drawn.
std::vector<Eigen::Vector4f> placed_vertices(const Scene& scene,
                                             const Normalization& normalization) {
  const mesh::TetMesh& mesh = *scene.mesh;
  const bool values = scene.field.location == mesh::Location::point;
  std::vector<Eigen::Vector4f> result(mesh.points.size(), Eigen::Vector4f::Zero());
  for_all(result.size(), [&](std::size_t i) {
    if (mesh.points[i].allFinite()) result[i].head<3>() = normalization.point(mesh.points[i]);
    if (values && std::isfinite(scene.field.values[i])) {
      result[i].w() = normalization.value(scene.field.values[i]);
    }
  });
  return result;
}

std::vector<float> normalized_values(const mesh::ScalarField& field,
                                     const Normalization& normalization) {
  std::vector<float> result(field.values.size(), 0.0F);
  for_all(result.size(), [&](std::size_t i) {
    if (std::isfinite(field.values[i])) result[i] = normalization.value(field.values[i]);
  });
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

MeshBuffers::MeshBuffers(const Context& context, const Scene& scene,
                         const Normalization& normalization, bool gradients)
    : cells_(context, Texel::rgba32ui), vertices_(context, Texel::rgba32f) {
  // The largest id has to leave the top bit free, and vertices are numbered 4 per cell in an int.
  const std::size_t most = std::min<std::size_t>(context.limits().texture_buffer_texels,
                                                 std::numeric_limits<std::int32_t>::max() / 4);
  if (scene.mesh->cells.size() > most || scene.mesh->points.size() > most) {
    throw base::UnavailableError("the mesh has more cells or points than this OpenGL can hold (" +
                                 std::to_string(most) + "); use another --projector");
  }
  cells_.upload(sorted_cells(*scene.mesh), "cells");
  vertices_.upload(placed_vertices(scene, normalization), "points");
  if (scene.field.location == mesh::Location::cell) {
    cell_values_.emplace(context, Texel::r32f);
    cell_values_->upload(normalized_values(scene.field, normalization), "cell values");
  }
  if (gradients) {
    gradients_.emplace(context, Texel::rgba32f);
    gradients_->upload(vertex_gradients(scene), "gradients");
  }
}

void MeshBuffers::bind() const {
  cells_.bind(Units::kCells);
  vertices_.bind(Units::kVertices);
  if (cell_values_) cell_values_->bind(Units::kCellValues);
  if (gradients_) gradients_->bind(Units::kGradients);
}

std::size_t MeshBuffers::bytes() const {
  return cells_.bytes() + vertices_.bytes() + (cell_values_ ? cell_values_->bytes() : 0) +
         gradient_bytes();
}

}  // namespace tetraglass::project::gl
