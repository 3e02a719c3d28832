#pragma once

#include <array>
#include <cstddef>

#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include "mesh/tet_mesh.h"

namespace tetraglass::bench {

/// The points and cells as VTK has them, without fields.
inline vtkNew<vtkUnstructuredGrid> vtk_grid(const mesh::TetMesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    points->SetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->AllocateEstimate(static_cast<vtkIdType>(mesh.cells.size()), 4);
  for (const mesh::Cell& cell : mesh.cells) {
    const std::array<vtkIdType, 4> ids{cell[0], cell[1], cell[2], cell[3]};
    grid->InsertNextCell(10 /* VTK_TETRA */, 4, ids.data());
  }
  return grid;
}

}  // namespace tetraglass::bench
