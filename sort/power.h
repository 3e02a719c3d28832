#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"
#include "sort/cell_links.h"
#include "sort/face_planes.h"
#include "sort/hiding_graph.h"
#include "sort/key_sort.h"
#include "sort/order.h"
#include "sort/power_keys.h"
#include "sort/power_spheres.h"
#include "sort/sphere_groups.h"

namespace tetraglass::sort {

/// The order by the power of the eye with respect to the circumspheres, the largest first: exact
/// for cells of a Delaunay triangulation, convex or not, and with weights for those of a regular
/// one (Edelsbrunner 1990, "An acyclicity theorem for cell complexes in d dimension"). Cells
/// without volume come first.
///
/// Powers are sorted by keys of 32 bits, from spheres of 16 bytes. Where keys are too near to each
/// other to be certain, powers in double with bounds of their errors decide; cells whose powers may
/// be equal even so are put in order by the faces between them, decided exactly, and across gaps of
/// the mesh by powers in exact numbers. Cells of one sphere that meet at faces, as those of a
/// voxel, are sorted as one, and among themselves by their faces. Keeps what does not depend on the
/// view (about 100 bytes per cell).
class PowerSorter {
 public:
  /// `cells` are indices into mesh.cells of cells with finite coordinates; only these are sorted.
  /// `weights` holds one number per point (it may be negative), or is empty. The mesh and the
  /// weights outlive this. Throws InputError where the cells are not part of a Delaunay (regular)
  /// triangulation of their vertices, which is decided exactly, saying where.
  PowerSorter(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
              std::span<const double> weights = {});

  /// Valid until the next call. Cost: linear, but n log n in cells of nearly equal power; in
  /// parallel.
  [[nodiscard]] const Order& sort(const View& view);

 private:
  // What the sorting of one view needs, and what it finds.
  struct Frame {
    const View& view;
    PowerOfEye power;
    KeyedSpheres::Keys keys;
    EyeSides sides;
    std::vector<KeyRange> doubtful;  // of far spheres
    std::vector<Run> runs;           // of groups of uncertain order
    std::mutex mutex;
  };
  using Entries = std::span<const KeyedItem>;

  Entries sort_groups(Frame& frame);
  void key_far_spheres(std::size_t begin, std::size_t count, KeyedItem* target, Frame& frame) const;
  void take_sorted(Entries entries, std::size_t begin, Frame& frame);
  void find_runs(Entries entries, Frame& frame) const;
  [[nodiscard]] std::uint32_t group_of(KeyedItem entry) const;
  void write_groups(Entries entries, Frame& frame);
  void write_chunk(Entries entries, std::size_t begin, std::size_t end, std::size_t place,
                   Frame& frame);
  void write_group(std::uint32_t group, std::size_t place, Frame& frame);
  void write_run(Entries run, std::size_t place, Frame& frame);
  void write_by_faces(std::span<const std::uint32_t> groups, std::size_t place, Frame& frame);
  void relate_across_gaps(std::span<const std::uint32_t> cells, const View& view,
                          std::size_t& nodes, std::vector<Relation>& relations) const;

  const mesh::TetMesh& mesh_;
  std::span<const double> weights_;
  CellLinks links_;
  Eigen::Vector3d middle_;
  double radius_ = 0;
  bool convex_ = false;               // no cell sees another one across a gap
  std::vector<PowerSphere> spheres_;  // of each group
  KeyedSpheres keyed_;                // the same; items are groups, or cells if each is one
  std::optional<SphereGroups> groups_;
  KeySorter sorter_;
  Order order_;
};

}  // namespace tetraglass::sort
