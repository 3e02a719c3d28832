#include "mesh/vtk_grid_reader.h"

#include <algorithm>
#include <filesystem>
#include <string>

#include <vtkDataArray.h>
#include <vtkIdTypeArray.h>
#include <vtkObjectFactory.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace tetraglass::mesh {
namespace {

// VTK's names.  NOLINTBEGIN(readability-identifier-naming)
class CheckedGridReader : public vtkXMLUnstructuredGridReader {
 public:
  static CheckedGridReader* New();
  vtkTypeMacro(CheckedGridReader, vtkXMLUnstructuredGridReader)

      protected : int ReadPieceData() override {
    if (!faces_fit()) {
      vtkErrorMacro("The faces of the polyhedra do not agree with their offsets");
      this->DataError = 1;
      return 0;
    }
    return Superclass::ReadPieceData();
  }

 private:
  /// The first `size` values of the array; null if they cannot be read.
  vtkSmartPointer<vtkIdTypeArray> values(vtkXMLDataElement* element, vtkIdType size) {
    auto array = vtkSmartPointer<vtkAbstractArray>::Take(this->CreateArray(element));
    auto* numbers = vtkDataArray::SafeDownCast(array);
    if (numbers == nullptr || numbers->GetNumberOfComponents() != 1) return nullptr;
    numbers->SetNumberOfTuples(size);
    if (this->ReadArrayValues(element, 0, numbers, 0, size) == 0) return nullptr;
    auto ids = vtkSmartPointer<vtkIdTypeArray>::New();
    ids->DeepCopy(numbers);
    return ids;
  }

  /// Whether each polyhedron's (n faces, (n points, points) per face) ends where its offset says.
  bool faces_fit() {
    vtkXMLDataElement* cells = this->CellElements[this->Piece];
    const vtkIdType count = this->NumberOfCells[this->Piece];
    if (cells == nullptr || count < 1) return true;
    vtkXMLDataElement* offset_element = this->FindDataArrayWithName(cells, "faceoffsets");
    vtkXMLDataElement* face_element = this->FindDataArrayWithName(cells, "faces");
    if (offset_element == nullptr) return true;
    if (face_element == nullptr) return false;
    const auto ends = values(offset_element, count);  // negative where a cell is no polyhedron
    if (ends == nullptr) return false;
    const vtkIdType* end = ends->GetPointer(0);
    const vtkIdType size = std::max<vtkIdType>(*std::max_element(end, end + count), 0);
    if (size == 0) return true;
    // Zlib packs at most about a thousand bytes into one.
    std::error_code ignored;
    const std::uintmax_t bytes = std::filesystem::file_size(this->FileName, ignored);
    if (static_cast<std::uintmax_t>(size) > 1100 * bytes) return false;
    const auto faces = values(face_element, size);
    if (faces == nullptr) return false;
    vtkIdType at = 0;
    for (vtkIdType i = 0; i < count; ++i) {
      if (end[i] < 0) continue;
      const auto next = [&](vtkIdType& value) {
        if (at >= end[i]) return false;
        value = faces->GetValue(at++);
        return value >= 0;
      };
      vtkIdType face_count = 0;
      if (!next(face_count)) return false;
      for (vtkIdType face = 0; face < face_count; ++face) {
        vtkIdType points = 0;
        if (!next(points) || points > end[i] - at) return false;
        at += points;
      }
      if (at != end[i]) return false;
    }
    return true;
  }
};

class CheckedParallelGridReader : public vtkXMLPUnstructuredGridReader {
 public:
  static CheckedParallelGridReader* New();
  vtkTypeMacro(CheckedParallelGridReader, vtkXMLPUnstructuredGridReader)

      protected : vtkXMLDataReader* CreatePieceReader() override {
    return CheckedGridReader::New();
  }
};
// NOLINTEND(readability-identifier-naming)

vtkStandardNewMacro(CheckedGridReader) vtkStandardNewMacro(CheckedParallelGridReader)

}  // namespace

vtkSmartPointer<vtkXMLReader> checked_grid_reader() {
  return vtkSmartPointer<CheckedGridReader>::New();
}

vtkSmartPointer<vtkXMLReader> checked_parallel_grid_reader() {
  return vtkSmartPointer<CheckedParallelGridReader>::New();
}

}  // namespace tetraglass::mesh
