#include "mesh/read_cgns.h"

#include <algorithm>
#include <vector>

#include <vtkCGNSReader.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include "base/errors.h"
#include "mesh/read_apart.h"
#include "mesh/time_step.h"
#include "mesh/vtk_dataset.h"
#include "mesh/vtk_messages.h"

namespace tetraglass::mesh {
namespace {

constexpr unsigned kSeconds = 600;

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
  messages.refuse_damage(file);
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
  messages.refuse_damage(file);
  MeshData mesh = mesh_data(*reader->GetOutput());
  if (mesh.points.empty()) throw base::ReadError(file, "holds no cells");
  mend_cells(mesh);
  if (!times.empty()) note_time_step(mesh.notes, find_time_step(time, times), times);
  for (const std::string& warning : messages.warnings()) mesh.notes.push_back("VTK: " + warning);
  return mesh;
}

}  // namespace

MeshData read_cgns(const std::string& file, const std::string& time) {
  return read_apart(
      file, [&] { return read_zones(file, time); }, kSeconds);
}

}  // namespace tetraglass::mesh
