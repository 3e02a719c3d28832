#include "mesh/write.h"

#include <algorithm>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "base/errors.h"
#include "base/output_file.h"
#include "mesh/file_name.h"
#include "mesh/mesh_data.h"
#include "mesh/vtk_messages.h"

namespace tetraglass::mesh {
namespace {

vtkSmartPointer<vtkUnstructuredGrid> vtk_grid(const TetMesh& mesh) {
  const auto point_count = static_cast<vtkIdType>(mesh.points.size());
  const auto cell_count = static_cast<vtkIdType>(mesh.cells.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(point_count);
  for (vtkIdType i = 0; i < point_count; ++i) {
    points->SetPoint(i, mesh.points[static_cast<std::size_t>(i)].data());
  }
  vtkNew<vtkTypeInt64Array> offsets;
  vtkNew<vtkTypeInt64Array> connectivity;
  offsets->SetNumberOfValues(cell_count + 1);
  connectivity->SetNumberOfValues(4 * cell_count);
  for (vtkIdType i = 0; i <= cell_count; ++i) offsets->SetValue(i, 4 * i);
  for (vtkIdType i = 0; i < cell_count; ++i) {
    const Cell& cell = mesh.cells[static_cast<std::size_t>(i)];
    for (vtkIdType k = 0; k < 4; ++k) {
      connectivity->SetValue(4 * i + k, cell[static_cast<std::size_t>(k)]);
    }
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  grid->SetCells(static_cast<int>(CellType::tetra), cells);
  for (const Field& field : mesh.fields) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(field.name.c_str());
    array->SetNumberOfComponents(field.components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(field.tuples()));
    std::ranges::copy(field.values, array->GetPointer(0));
    if (field.location == Location::point) {
      grid->GetPointData()->AddArray(array);
    } else {
      grid->GetCellData()->AddArray(array);
    }
  }
  return grid;
}

}  // namespace

void write_vtu(const TetMesh& mesh, const std::string& file) {
  if (extension_of(file) != ".vtu") {
    throw base::WriteError(file, "meshes are written as .vtu; give a name that ends so");
  }
  base::OutputFile output(file);
  VtkMessages messages;
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(output.temporary_path().c_str());
  writer->SetInputData(vtk_grid(mesh));
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetHeaderTypeToUInt64();
  if (writer->Write() == 0 || !messages.errors().empty()) {
    throw base::WriteError(
        file, "cannot be written" +
                  (messages.errors().empty() ? std::string() : ": " + messages.errors().front()));
  }
  output.commit();
}

}  // namespace tetraglass::mesh
