#include "mesh/read_ensight.h"

#include <algorithm>
#include <vector>

#include <vtkDataArray.h>
#include <vtkDataArrayCollection.h>
#include <vtkGenericEnSightReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>

#include "base/errors.h"
#include "mesh/read_apart.h"
#include "mesh/time_step.h"
#include "mesh/vtk_dataset.h"
#include "mesh/vtk_messages.h"

namespace tetraglass::mesh {
namespace {

constexpr unsigned kSeconds = 600;

MeshData read_case(const std::string& file, const std::string& time) {
  const VtkMessages messages;
  vtkNew<vtkGenericEnSightReader> reader;
  reader->SetCaseFileName(file.c_str());
  reader->ReadAllVariablesOn();
  reader->UpdateInformation();
  messages.refuse_damage(file);
  std::vector<double> times;
  if (vtkDataArrayCollection* sets = reader->GetTimeSets(); sets != nullptr) {
    for (int i = 0; i < sets->GetNumberOfItems(); ++i) {
      vtkDataArray* set = sets->GetItem(i);
      for (vtkIdType k = 0; k < set->GetNumberOfTuples(); ++k) times.push_back(set->GetTuple1(k));
    }
  }
  std::ranges::sort(times);
  times.erase(std::ranges::unique(times).begin(), times.end());
  if (!times.empty()) reader->SetTimeValue(times[find_time_step(time, times)]);
  reader->Update();
  messages.refuse_damage(file);
  MeshData mesh = mesh_data(*reader->GetOutput());
  if (mesh.points.empty()) throw base::ReadError(file, "holds no cells");
  if (!times.empty()) note_time_step(mesh.notes, find_time_step(time, times), times);
  return mesh;
}

}  // namespace

MeshData read_ensight(const std::string& file, const std::string& time) {
  return read_apart(
      file, [&] { return read_case(file, time); }, kSeconds);
}

}  // namespace tetraglass::mesh
