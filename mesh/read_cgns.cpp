#include "mesh/read_cgns.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <vtkCGNSReader.h>
#include <vtkCompositeDataIterator.h>
#include <vtkDataSet.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include "base/errors.h"
#include "mesh/append.h"
#include "mesh/read_apart.h"
#include "mesh/time_step.h"
#include "mesh/vtk_dataset.h"
#include "mesh/vtk_messages.h"

namespace tetraglass::mesh {
namespace {

constexpr unsigned kSeconds = 600;

void check(const std::string& file, const VtkMessages& messages) {
  if (!messages.errors().empty()) {
    throw base::ReadError(file, "is damaged or not complete: " + messages.errors().front());
  }
}

/// Pyramids of 13 points, which VTK 9.1 hands over as cells of no type, get it. The triangles of
/// wedges are exchanged: those of CGNS have the first one seen from inside, VTK's from outside. The
/// points on their sides: bottom, top, upright; those on the upright squares stay.
void mend_cells(MeshData& mesh) {
  constexpr auto kEmpty = static_cast<CellType>(0);
  constexpr std::size_t kPyramid = 13;
  for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
    CellType& type = mesh.types[i];
    if (type == kEmpty && mesh.cell(i).size() == kPyramid) type = CellType::quadratic_pyramid;
    if (type != CellType::wedge && type != CellType::quadratic_wedge &&
        type != CellType::biquadratic_quadratic_wedge) {
      continue;
    }
    const auto first = mesh.connectivity.begin() + static_cast<std::ptrdiff_t>(mesh.offsets[i]);
    std::swap_ranges(first, first + 3, first + 3);
    if (type != CellType::wedge) std::swap_ranges(first + 6, first + 9, first + 9);
  }
}

MeshData read_zones(const std::string& file, const std::string& time) {
  const VtkMessages messages;
  vtkNew<vtkCGNSReader> reader;
  reader->SetController(nullptr);
  reader->SetFileName(file.c_str());
  reader->SetDoublePrecisionMesh(1);
  reader->UpdateInformation();
  check(file, messages);
  reader->EnableAllBases();
  reader->EnableAllFamilies();
  reader->EnableAllPointArrays();
  reader->EnableAllCellArrays();
  std::vector<double> times;
  vtkInformation* information = reader->GetOutputInformation(0);
  vtkInformationDoubleVectorKey* const steps = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
  if (information->Has(steps) != 0) {
    const double* first = information->Get(steps);
    times.assign(first, first + information->Length(steps));
  }
  if (times.empty()) {
    reader->Update();
  } else {
    reader->UpdateTimeStep(times[find_time_step(time, times)]);
  }
  check(file, messages);
  std::vector<MeshData> parts;
  vtkMultiBlockDataSet* blocks = reader->GetOutput();
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem()) {
    auto* data = vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject());
    if (data != nullptr && data->GetNumberOfCells() > 0) parts.push_back(mesh_data(*data));
  }
  if (parts.empty()) throw base::ReadError(file, "holds no cells");
  MeshData mesh = append_meshes(std::move(parts));
  mend_cells(mesh);
  if (times.size() > 1) {
    const std::size_t step = find_time_step(time, times);
    mesh.notes.push_back(
        fmt::format("time step {} of {} (time {:g})", step, times.size(), times[step]));
  }
  for (const std::string& warning : messages.warnings()) mesh.notes.push_back("VTK: " + warning);
  return mesh;
}

}  // namespace

MeshData read_cgns(const std::string& file, const std::string& time) {
  return read_apart(
      file, [&] { return read_zones(file, time); }, kSeconds);
}

}  // namespace tetraglass::mesh
