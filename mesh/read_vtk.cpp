#include "mesh/read_vtk.h"

#include <algorithm>
#include <fstream>
#include <string_view>

#include <fmt/format.h>
#include <vtkDataObject.h>
#include <vtkDataSet.h>
#include <vtkDataSetReader.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUpdateCellsV8toV9.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPImageDataReader.h>
#include <vtkXMLPPolyDataReader.h>
#include <vtkXMLPRectilinearGridReader.h>
#include <vtkXMLPStructuredGridReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLReader.h>
#include <vtkXMLRectilinearGridReader.h>
#include <vtkXMLStructuredGridReader.h>

#include "base/errors.h"
#include "mesh/file_name.h"
#include "mesh/legacy_vtk_check.h"
#include "mesh/vtk_dataset.h"
#include "mesh/vtk_grid_reader.h"
#include "mesh/vtk_messages.h"

namespace tetraglass::mesh {
namespace {

/// The reader for an extension of VTK's XML formats; null for any other.
vtkSmartPointer<vtkXMLReader> xml_reader(const std::string& extension) {
  if (extension == ".vtu") return checked_grid_reader();
  if (extension == ".vti") return vtkSmartPointer<vtkXMLImageDataReader>::New();
  if (extension == ".vts") return vtkSmartPointer<vtkXMLStructuredGridReader>::New();
  if (extension == ".vtr") return vtkSmartPointer<vtkXMLRectilinearGridReader>::New();
  if (extension == ".vtp") return vtkSmartPointer<vtkXMLPolyDataReader>::New();
  if (extension == ".pvtu") return checked_parallel_grid_reader();
  if (extension == ".pvti") return vtkSmartPointer<vtkXMLPImageDataReader>::New();
  if (extension == ".pvts") return vtkSmartPointer<vtkXMLPStructuredGridReader>::New();
  if (extension == ".pvtr") return vtkSmartPointer<vtkXMLPRectilinearGridReader>::New();
  if (extension == ".pvtp") return vtkSmartPointer<vtkXMLPPolyDataReader>::New();
  return nullptr;
}

/// What the reader has read, once it is sure that VTK had nothing to say against it.
MeshData result(const std::string& file, vtkDataObject* output, const VtkMessages& messages,
                bool has_old_numbers = false) {
  // The first message names the cause, the others what came of it.
  std::vector<std::string> lost_fields;
  for (const std::string& error : messages.errors()) {
    // Said of the head of a section of fields, when the cells have been read in full.
    if (error != "Number of cells don't match!" && error != "Number of points don't match!") {
      throw base::ReadError(file, "is damaged or not complete: " + messages.errors().front());
    }
    lost_fields.push_back("the fields are left out: " + error);
  }
  auto* data = vtkDataSet::SafeDownCast(output);
  if (data == nullptr) throw base::ReadError(file, "does not hold a mesh, a grid or an image");
  // Polygonal data may be points alone; a grid without cells is one that they have been lost from.
  if (data->GetNumberOfCells() == 0 && vtkPolyData::SafeDownCast(data) == nullptr) {
    throw base::ReadError(file,
                          fmt::format("holds {} points, but no cells", data->GetNumberOfPoints()));
  }
  // Hexahedra of higher order are numbered anew by VTK, but not where it gives up the fields.
  auto* grid = vtkUnstructuredGrid::SafeDownCast(output);
  if (has_old_numbers && !lost_fields.empty() && grid != nullptr) vtkUpdateCellsV8toV9(grid);
  MeshData mesh = mesh_data(*data);
  mesh.notes.insert(mesh.notes.end(), lost_fields.begin(), lost_fields.end());
  for (const std::string& warning : messages.warnings()) {
    // Remarks of other programs on their arrays, of no meaning here.
    if (warning.find("Could not locate key") != std::string::npos) continue;
    // So VTK tells of values that are missing at the end of a file.
    if (warning.find("Error reading") != std::string::npos) {
      throw base::ReadError(file, "is damaged or not complete: " + warning);
    }
    const std::string note = "VTK: " + warning;
    if (std::ranges::find(mesh.notes, note) == mesh.notes.end()) mesh.notes.push_back(note);
  }
  return mesh;
}

/// Whether the last element is closed: values in binary at the end may be cut off unseen by VTK.
bool has_xml_end(const std::string& file) {
  constexpr std::string_view kEnd = "</VTKFile>";
  constexpr std::streamoff kTail = 1024;
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream.tellg();
  const std::streamoff start = std::max<std::streamoff>(size - kTail, 0);
  std::string tail(static_cast<std::size_t>(size - start), ' ');
  stream.seekg(start);
  stream.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  return tail.find(kEnd) != std::string::npos;
}

MeshData read_xml(const std::string& file, vtkXMLReader& reader) {
  VtkMessages messages;
  if (reader.CanReadFile(file.c_str()) == 0) {
    throw base::ReadError(file, fmt::format("is not a VTK XML file of the kind that its extension "
                                            "'{}' says",
                                            extension_of(file)));
  }
  if (!has_xml_end(file))
    throw base::ReadError(file, "is cut off: it does not end with </VTKFile>");
  reader.SetFileName(file.c_str());
  reader.Update();
  return result(file, reader.GetOutputDataObject(0), messages);
}

MeshData read_legacy(const std::string& file) {
  check_legacy_vtk(file);
  VtkMessages messages;
  vtkNew<vtkDataSetReader> reader;
  reader->SetFileName(file.c_str());
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllColorScalarsOn();
  reader->ReadAllTCoordsOn();
  reader->ReadAllFieldsOn();
  reader->Update();
  constexpr int kFirstOfNewNumbers = 5;
  return result(file, reader->GetOutput(), messages,
                reader->GetFileMajorVersion() < kFirstOfNewNumbers);
}

}  // namespace

MeshData read_vtk(const std::string& file) {
  const vtkSmartPointer<vtkXMLReader> xml = xml_reader(extension_of(file));
  return xml != nullptr ? read_xml(file, *xml) : read_legacy(file);
}

}  // namespace tetraglass::mesh
