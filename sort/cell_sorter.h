#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mesh/tet_mesh.h"
#include "sort/order.h"

namespace tetraglass::sort {

/// How cells are brought into an order. `fragments` is none of cells: every pixel sorts its own
/// pieces (fragments.h).
enum class Method { none, centroid, power, mpvo, fragments };

[[nodiscard]] std::string to_string(Method method);

/// Sorts the cells of one mesh for any number of views, by a method that orders cells:
/// centroid, power or mpvo. What does not depend on the view is computed once.
class CellSorter {
 public:
  /// `cells` are indices into mesh.cells of cells with finite coordinates; only these are sorted.
  /// `weights` are for `power` on a regular triangulation: one number per point, or none. The mesh
  /// and the weights outlive this. Throws InputError where the method does not suit the mesh (power
  /// on one that is not Delaunay), UsageError for a method that does not order cells.
  CellSorter(Method method, const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
             std::span<const double> weights = {});
  CellSorter(CellSorter&&) noexcept;
  CellSorter& operator=(CellSorter&&) noexcept;
  ~CellSorter();

  /// Farthest first. Valid until the next call.
  [[nodiscard]] const Order& sort(const View& view);

 private:
  struct Sorter;
  std::unique_ptr<Sorter> sorter_;
};

}  // namespace tetraglass::sort
