#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"
#include "sort/cell_links.h"
#include "sort/order.h"
#include "sort/power_spheres.h"

namespace tetraglass::sort {

/// The order by the power of the eye with respect to the circumspheres, the largest first: exact
/// for cells of a Delaunay triangulation, convex or not, and with weights for those of a regular
/// one (Edelsbrunner 1990, "An acyclicity theorem for cell complexes in d dimension"). Powers are
/// computed in double with bounds of their errors; runs of cells whose powers are not certain to
/// differ (cells of one sphere, as in a grid, among them) are put in order by the faces between
/// them, decided exactly, and across gaps of the mesh by powers in exact numbers. Cells without
/// volume come first. Keeps what does not depend on the view (48 bytes per cell, and links).
class PowerSorter {
 public:
  /// `cells` are indices into mesh.cells of cells with finite coordinates; only these are sorted.
  /// `weights` holds one number per point (it may be negative), or is empty. The mesh and the
  /// weights outlive this. Throws InputError where the cells are not part of a Delaunay (regular)
  /// triangulation of their vertices, which is decided exactly, saying where.
  PowerSorter(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
              std::span<const double> weights = {});

  /// Cost: n log n, in parallel.
  [[nodiscard]] Order sort(const View& view);

 private:
  struct Entry {
    double low;   // the power is at least this
    double high;  // ... and at most this
    std::uint32_t cell;
  };
  struct Run {
    std::size_t begin;
    std::size_t end;
  };

  void write_powers(const View& view);
  void find_runs();
  void order_run(const Run& run, const View& view, Order& order) const;

  const mesh::TetMesh& mesh_;
  std::span<const double> weights_;
  CellLinks links_;
  Eigen::Vector3d middle_;
  bool convex_ = false;  // no cell sees another one across a gap
  std::vector<PowerSphere> spheres_;
  std::vector<Entry> entries_;
  std::vector<Run> runs_;
};

}  // namespace tetraglass::sort
