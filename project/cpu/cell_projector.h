#pragma once

#include <optional>
#include <vector>

#include "project/camera.h"
#include "project/cpu/drawn_cells.h"
#include "project/cpu/lighting.h"
#include "project/cpu/lookup_table.h"
#include "project/cpu/medium.h"
#include "project/cpu/surfaces.h"
#include "project/cpu/tile_bins.h"
#include "project/cpu/tile_kernel.h"
#include "project/cpu/view_points.h"
#include "project/image.h"
#include "project/plan.h"
#include "project/stats.h"
#include "sort/cell_sorter.h"

namespace tetraglass::project::cpu {

/// Draws one scene from any number of views without GL: cells are binned to tiles of pixels, tiles
/// are drawn at once by all threads, blocks of pixels at once by vectors. What does not depend on
/// the view is set up once and kept. The picture does not depend on the number of threads.
///
/// A ray meets a cell from the last of its front faces to the first of its back faces; a face is a
/// plane over the picture, set up in double precision from its three vertices alone, in ascending
/// order: both cells at it get the same numbers, and the segments of a ray join without gap or
/// overlap whatever the rounding.
class CellProjector {
 public:
  /// The scene (and its mesh) outlives this.
  CellProjector(const Scene& scene, const Plan& plan);

  /// To be called after the scene's field, transfer function, isosurfaces, lights or modulation
  /// have changed. Its mesh, its mode and what its plan depends on may not; what depends on the
  /// mesh alone is kept.
  void update();

  /// The picture from one view; adds times, fragments and the order to `stats`. The scene's camera
  /// and size do not matter. Throws UsageError for a plan that this projector lacks.
  [[nodiscard]] Image draw(const Frame& frame, Stats& stats);

 private:
  void set_up();
  void set_up_light();
  void set_up_medium();
  void set_up_table();
  /// Puts the drawn cells in the plan's order for one view, the nearest first; none without one.
  void order_cells(const Frame& frame, Stats& stats);
  [[nodiscard]] Picture picture(const Frame& frame, const Projection& projection) const;
  /// Draws what is binned.
  [[nodiscard]] Image draw_tiles(const Picture& shared, Stats& stats);

  const Scene& scene_;
  Plan plan_;
  DrawnCells cells_;
  double radius_ = 1;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  std::optional<Medium> medium_;
  std::optional<LookupTable> table_;
  std::vector<IntervalRange> intervals_;
  std::vector<Surface> surfaces_;
  std::optional<Lighting> lighting_;
  Stats set_up_;  // what all views have in common took, until it is told
  std::optional<sort::CellSorter> sorter_;
  std::vector<std::uint32_t> sorted_cells_;   // where cells are sorted: those of the sorter
  std::vector<std::uint32_t> drawn_of_cell_;  // ... and where they are among the drawn ones
  std::vector<std::uint32_t> order_;          // of drawn cells, where they are not drawn in theirs
  ViewPoints points_;
  TileBins bins_;
};

}  // namespace tetraglass::project::cpu
