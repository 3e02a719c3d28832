#include "mesh/read_collection.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include <fmt/format.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include "base/errors.h"
#include "mesh/append.h"
#include "mesh/file_name.h"
#include "mesh/number_text.h"
#include "mesh/read_vtk.h"
#include "mesh/time_step.h"
#include "mesh/vtk_messages.h"

namespace tetraglass::mesh {
namespace {

struct Entry {
  double time = 0;
  std::string file;
};

/// All elements DataSet below, however deep they lie in blocks.
void find_entries(vtkXMLDataElement& element, const std::string& collection,
                  std::vector<Entry>& entries) {
  for (int i = 0; i < element.GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement& nested = *element.GetNestedElement(i);
    find_entries(nested, collection, entries);
    const char* name = nested.GetAttribute("file");
    if (nested.GetName() == nullptr || std::string_view(nested.GetName()) != "DataSet" ||
        name == nullptr) {
      continue;
    }
    const char* time = nested.GetAttribute("timestep");
    const auto value = time != nullptr ? parse_number(time) : 0.0;
    if (!value) {
      throw base::ReadError(collection, fmt::format("the time step '{}' is no number", time));
    }
    entries.push_back({*value, std::filesystem::path(collection).replace_filename(name).string()});
  }
}

std::vector<Entry> read_entries(const std::string& file) {
  std::vector<Entry> entries;
  const VtkMessages messages;
  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
  if (root == nullptr || root->GetName() == nullptr ||
      std::string_view(root->GetName()) != "VTKFile") {
    throw base::ReadError(file, "is no collection: it is not whole XML with the element VTKFile");
  }
  find_entries(*root, file, entries);
  if (entries.empty()) throw base::ReadError(file, "names no files (elements DataSet)");
  return entries;
}

}  // namespace

MeshData read_collection(const std::string& file, const std::string& time) {
  const std::vector<Entry> entries = read_entries(file);
  std::vector<double> times;
  for (const Entry& entry : entries) times.push_back(entry.time);
  std::ranges::sort(times);
  times.erase(std::ranges::unique(times).begin(), times.end());
  const std::size_t step = find_time_step(time, times);
  std::vector<MeshData> parts;
  for (const Entry& entry : entries) {
    if (entry.time != times[step]) continue;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(entry.file, ignored)) {
      throw base::ReadError(file, fmt::format("names the file {}, which is missing", entry.file));
    }
    const std::string extension = extension_of(entry.file);
    if (!extension.starts_with(".vt") && !extension.starts_with(".pvt")) {
      throw base::ReadError(
          file, fmt::format("names the file {}, which is not one of VTK's formats", entry.file));
    }
    parts.push_back(read_vtk(entry.file));
  }
  MeshData mesh = append_meshes(std::move(parts));
  note_time_step(mesh.notes, step, times);
  return mesh;
}

}  // namespace tetraglass::mesh
