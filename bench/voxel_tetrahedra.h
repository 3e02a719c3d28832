#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/tet_mesh.h"

namespace tetraglass::bench {

/// The voxels of a grid of n^3 points over [-1, 1]^3 as 5 (turned in every other voxel, so that
/// neighbours agree), 6 (around the main diagonal) or 24 tetrahedra (around added points: the
/// middles of the voxels and of their faces). `values` has one value for each point of the grid;
/// added points get the mean of the corners, which is the trilinear field's value there.
class VoxelTetrahedra {
 public:
  VoxelTetrahedra(int n, const std::vector<double>& values, int per_voxel) : n_(n) {
    mesh::Field field{"value", mesh::Location::point, 1, values};
    for (int k = 0; k < n; ++k) {
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          mesh_.points.emplace_back(2.0 * i / (n - 1) - 1, 2.0 * j / (n - 1) - 1,
                                    2.0 * k / (n - 1) - 1);
        }
      }
    }
    mesh_.fields.push_back(std::move(field));
    face_middles_.assign(3 * values.size(), 0);
    for (int k = 0; k + 1 < n; ++k) {
      for (int j = 0; j + 1 < n; ++j) {
        for (int i = 0; i + 1 < n; ++i) {
          if (per_voxel == 5) add_5(i, j, k);
          if (per_voxel == 6) add_6(i, j, k);
          if (per_voxel == 24) add_24(i, j, k);
        }
      }
    }
  }

  [[nodiscard]] mesh::TetMesh take() { return std::move(mesh_); }

 private:
  [[nodiscard]] std::uint32_t at(int i, int j, int k) const {
    return static_cast<std::uint32_t>((k * n_ + j) * n_ + i);
  }
  /// Corner c of the voxel: bit 0 along x, 1 along y, 2 along z.
  [[nodiscard]] std::uint32_t corner(int i, int j, int k, int c) const {
    return at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1));
  }
  void add(mesh::Cell cell) {
    const Eigen::Vector3d& a = mesh_.points[cell[0]];
    const double volume =
        (mesh_.points[cell[1]] - a).cross(mesh_.points[cell[2]] - a).dot(mesh_.points[cell[3]] - a);
    if (volume < 0) std::swap(cell[2], cell[3]);
    mesh_.cells.push_back(cell);
  }
  void add_5(int i, int j, int k) {
    const int turn = (i + j + k) % 2 == 0 ? 0 : 1;  // mirrored along x
    constexpr std::array<std::array<int, 4>, 5> kParts = {
        {{0, 3, 5, 6}, {1, 0, 3, 5}, {2, 0, 3, 6}, {4, 0, 5, 6}, {7, 3, 5, 6}}};
    for (const auto& part : kParts) {
      mesh::Cell cell{};
      for (std::size_t v = 0; v < 4; ++v) cell[v] = corner(i, j, k, part[v] ^ turn);
      add(cell);
    }
  }
  void add_6(int i, int j, int k) {
    constexpr std::array<std::array<int, 2>, 6> kPaths = {
        {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}}};
    for (const auto& path : kPaths) {
      add({corner(i, j, k, 0), corner(i, j, k, path[0]), corner(i, j, k, path[1]),
           corner(i, j, k, 7)});
    }
  }
  std::uint32_t add_middle(const std::vector<std::uint32_t>& corners) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    double value = 0;
    std::vector<double>& values = mesh_.fields[0].values;
    for (const std::uint32_t c : corners) {
      middle += mesh_.points[c] / static_cast<double>(corners.size());
      value += values[c] / static_cast<double>(corners.size());
    }
    mesh_.points.push_back(middle);
    values.push_back(value);
    return static_cast<std::uint32_t>(mesh_.points.size() - 1);
  }
  void add_24(int i, int j, int k) {
    std::vector<std::uint32_t> all;
    for (int c = 0; c < 8; ++c) all.push_back(corner(i, j, k, c));
    const std::uint32_t middle = add_middle(all);
    for (int axis = 0; axis < 3; ++axis) {
      const int u = 1 << (axis + 1) % 3;
      const int v = 1 << (axis + 2) % 3;
      for (int side = 0; side < 2; ++side) {
        const int first = side << axis;
        const std::array<int, 4> ring = {first, first | u, first | u | v, first | v};
        std::vector<std::uint32_t> face;
        for (const int c : ring) face.push_back(corner(i, j, k, c));
        // Kept with the first corner of the face: its neighbour finds it there.
        std::uint32_t& kept = face_middles_[3 * face[0] + static_cast<std::size_t>(axis)];
        if (kept == 0) kept = add_middle(face);
        for (std::size_t e = 0; e < 4; ++e) add({middle, kept, face[e], face[(e + 1) % 4]});
      }
    }
  }

  int n_;
  mesh::TetMesh mesh_;
  std::vector<std::uint32_t> face_middles_;  // 0: not made yet
};

}  // namespace tetraglass::bench
