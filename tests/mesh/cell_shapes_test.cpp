#include "mesh/cell_shapes.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkGenericCell.h>
#include <vtkHigherOrderHexahedron.h>
#include <vtkHigherOrderTetra.h>
#include <vtkHigherOrderWedge.h>
#include <vtkIdList.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>

#include "base/errors.h"
#include "mesh/import.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"
#include "support/total_volume.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

/// The points of a solid as VTK places them in its parameter space; none where VTK has no class.
std::vector<Vector3d> reference_points(CellType type, std::size_t count) {
  const auto cell =
      vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(static_cast<int>(type)));
  if (cell == nullptr) return {};
  const auto size = static_cast<vtkIdType>(count);
  // Those of any order look at how many points they have.
  cell->GetPoints()->SetNumberOfPoints(size);
  cell->GetPointIds()->SetNumberOfIds(size);
  if (auto* box = vtkHigherOrderHexahedron::SafeDownCast(cell)) {
    box->SetUniformOrderFromNumPoints(size);
  } else if (auto* wedge = vtkHigherOrderWedge::SafeDownCast(cell)) {
    wedge->SetUniformOrderFromNumPoints(size);
  } else if (auto* tetra = vtkHigherOrderTetra::SafeDownCast(cell)) {
    tetra->Initialize();
  }
  const double* at = cell->GetParametricCoords();
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(at[3 * i], at[3 * i + 1], at[3 * i + 2]);
  return points;
}

/// A file of one cell of a type, and a tetrahedron of volume 1 / 6 far from it.
std::string one_cell_file(const tests::TemporaryFolder& folder, CellType type,
                          const std::vector<Vector3d>& points, const std::string& faces) {
  std::string places;
  std::string connectivity;
  std::size_t at = 0;
  for (const Vector3d& p : points) {
    places += fmt::format("{:.17g} {:.17g} {:.17g} ", p.x(), p.y(), p.z());
    connectivity += fmt::format("{} ", at++);
  }
  places += "9 0 0  10 0 0  9 1 0  9 0 1";
  connectivity += fmt::format("{} {} {} {}", at, at + 1, at + 2, at + 3);
  const std::string file = folder.file("cell.vtu");
  tests::write_text(file,
                    fmt::format(
                        R"(<VTKFile type="UnstructuredGrid" version="2.2" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="{}" NumberOfCells="2">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{}</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">{}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{} {}</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">{} 10</DataArray>{}</Cells>
</Piece></UnstructuredGrid></VTKFile>)",
                        at + 4, places, connectivity, at, at + 4, static_cast<int>(type), faces));
  return file;
}

struct Known {
  int type;
  std::size_t points;
  double volume;       // 0 where it is no solid
  std::size_t pieces;  // linear ones that it is cut into by --refine-quadratic; 0 where it is not
  bool always_cut = false;
};

// Every type that VTK's file formats number, in parameter space: VTK's quadratic pyramid of 19
// points is half as high as its others.
const std::vector<Known> kTypes = {{1, 1, 0, 0},
                                   {2, 3, 0, 0},
                                   {3, 2, 0, 0},
                                   {4, 4, 0, 0},
                                   {5, 3, 0, 0},
                                   {6, 5, 0, 0},
                                   {7, 5, 0, 0},
                                   {8, 4, 0, 0},
                                   {9, 4, 0, 0},
                                   {10, 4, 1.0 / 6, 0},
                                   {11, 8, 1, 0},
                                   {12, 8, 1, 0},
                                   {13, 6, 0.5, 0},
                                   {14, 5, 1.0 / 3, 0},
                                   {15, 10, -1, 0},
                                   {16, 12, -1, 0},
                                   {21, 3, 0, 0},
                                   {22, 6, 0, 0},
                                   {23, 8, 0, 0},
                                   {24, 10, 1.0 / 6, 8},
                                   {25, 20, 1, 8},
                                   {26, 15, 0.5, 8},
                                   {27, 13, 1.0 / 3, 10},
                                   {28, 9, 0, 0},
                                   {29, 27, 1, 8},
                                   {30, 6, 0, 0},
                                   {31, 12, 0.5, 4},
                                   {32, 18, 0.5, 8},
                                   {33, 24, 1, 8},
                                   {34, 7, 0, 0},

                                   {37, 19, 1.0 / 6, 10},
                                   {68, 3, 0, 0},
                                   {69, 6, 0, 0},
                                   {70, 9, 0, 0},
                                   {71, 10, 1.0 / 6, 8, true},
                                   {71, 20, 1.0 / 6, 27, true},
                                   {72, 27, 1, 8, true},
                                   {72, 64, 1, 27, true},
                                   {73, 18, 0.5, 8, true},
                                   {73, 40, 0.5, 27, true},
                                   {74, 14, 1.0 / 3, 0},
                                   {75, 3, 0, 0},
                                   {76, 6, 0, 0},
                                   {77, 9, 0, 0},
                                   {78, 10, 1.0 / 6, 0},
                                   {79, 27, 1, 0},
                                   {80, 18, 0.5, 0},
                                   {81, 14, 1.0 / 3, 0}};

bool has_note(const ImportReport& report, const std::string& text) {
  return std::ranges::any_of(
      report.notes, [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

std::vector<Vector3d> points_for(const Known& known, CellType type) {
  const std::vector<Vector3d> pyramid = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<Vector3d> points;
  if (type == CellType::quadratic_pyramid) {
    // Its parameter space is that of a collapsed hexahedron.
    points = pyramid;
    for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 1},
                               {1, 2},
                               {2, 3},
                               {3, 0},
                               {0, 4},
                               {1, 4},
                               {2, 4},
                               {3, 4}}) {
      points.emplace_back((pyramid[a] + pyramid[b]) / 2);
    }
    return points;
  }
  if (known.volume != 0) points = reference_points(type, known.points);
  if (!points.empty()) return points;
  // No solid, or a pyramid of which only the corners count.
  points.assign(known.points, Vector3d(0.5, 0.5, 0.25));
  std::ranges::copy(std::span(pyramid).first(std::min(points.size(), pyramid.size())),
                    points.begin());
  return points;
}

TEST(CellShapes, EveryTypeOfVtkComesInAndIsCounted) {
  const tests::TemporaryFolder folder;
  for (const Known& known : kTypes) {
    const auto type = static_cast<CellType>(known.type);
    SCOPED_TRACE(fmt::format("{} ({}), {} points", known.type, to_string(type), known.points));
    const CellShape* shape = find_shape(type);
    ASSERT_NE(shape, nullptr);
    EXPECT_EQ(shape->dimension == 3, known.volume != 0);
    if (shape->points != 0) {
      EXPECT_EQ(static_cast<std::size_t>(shape->points), known.points);
    }
    const std::string file = one_cell_file(folder, type, points_for(known, type), "");
    for (const bool refine : {false, true}) {
      ImportOptions options;
      options.refine_quadratic = refine;
      const Import import = import_mesh(file, options);
      const std::size_t same = type == CellType::tetra ? 2 : 1;
      EXPECT_EQ(import.report.input_cells.at(type), same);
      EXPECT_EQ(import.report.skipped, known.volume == 0 ? 1U : 0U);
      const double volume = tests::total_volume(import.mesh) - 1.0 / 6;
      if (known.volume >= 0) {
        EXPECT_NEAR(volume, known.volume, 1e-14);
      }
      if (known.volume < 0) {
        EXPECT_GT(volume, 0.5);  // a prism within the unit cube
      }
      const bool cut = known.always_cut || (refine && known.pieces > 0);
      EXPECT_EQ(has_note(import.report,
                         fmt::format("1 cells of higher order are cut into {} ", known.pieces)),
                cut);
      const bool curved = known.type > 20 && known.volume > 0;
      EXPECT_EQ(has_note(import.report,
                         fmt::format("1 cells of higher order are drawn by their corners: 1 {}",
                                     to_string(type))),
                curved && !cut)
          << fmt::format("{}", fmt::join(import.report.notes, "; "));
      EXPECT_EQ(has_note(import.report, "5 points within triangles and pyramids"),
                refine && type == CellType::triquadratic_pyramid);
    }
  }
}

TEST(CellShapes, PolyhedraComeInAndTypesWithoutAShapeAreToldAndLeftOut) {
  const tests::TemporaryFolder folder;
  const std::vector<Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::string faces =
      "<DataArray type=\"Int64\" Name=\"faces\" format=\"ascii\">"
      "4 3 0 2 1 3 0 1 3 3 1 2 3 3 0 3 2</DataArray>"
      "<DataArray type=\"Int64\" Name=\"faceoffsets\" format=\"ascii\">17 -1</DataArray>";
  const Import polyhedron =
      import_mesh(one_cell_file(folder, CellType::polyhedron, corners, faces));
  EXPECT_EQ(polyhedron.report.input_cells.at(CellType::polyhedron), 1U);
  EXPECT_NEAR(tests::total_volume(polyhedron.mesh), 2.0 / 6, 1e-15);
  // The empty cell, the cubic line, the quadratic polygon, the convex set of points, and numbers
  // that VTK gives to classes without a layout in files.
  for (const int type : {0, 35, 36, 41, 51, 64, 67, 99, 255}) {
    SCOPED_TRACE(type);
    const auto unknown = static_cast<CellType>(type);
    const Import import = import_mesh(one_cell_file(folder, unknown, corners, ""));
    EXPECT_EQ(import.report.input_cells.at(unknown), 1U);
    EXPECT_TRUE(has_note(import.report, "1 cells of an unknown type are left out"));
    EXPECT_NEAR(tests::total_volume(import.mesh), 1.0 / 6, 1e-15);
  }
}

}  // namespace
}  // namespace tetraglass::mesh
