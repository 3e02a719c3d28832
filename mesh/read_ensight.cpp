#include "mesh/read_ensight.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <vtkCompositeDataIterator.h>
#include <vtkDataArray.h>
#include <vtkDataArrayCollection.h>
#include <vtkDataSet.h>
#include <vtkGenericEnSightReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

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

MeshData read_case(const std::string& file, const std::string& time) {
  const VtkMessages messages;
  vtkNew<vtkGenericEnSightReader> reader;
  reader->SetCaseFileName(file.c_str());
  reader->ReadAllVariablesOn();
  reader->UpdateInformation();
  check(file, messages);
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
  if (times.size() > 1) {
    const std::size_t step = find_time_step(time, times);
    mesh.notes.push_back(
        fmt::format("time step {} of {} (time {:g})", step, times.size(), times[step]));
  }
  return mesh;
}

}  // namespace

MeshData read_ensight(const std::string& file, const std::string& time) {
  return read_apart(
      file, [&] { return read_case(file, time); }, kSeconds);
}

}  // namespace tetraglass::mesh
