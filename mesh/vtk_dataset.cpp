#include "mesh/vtk_dataset.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "base/errors.h"
#include "mesh/append.h"
#include "mesh/memory.h"

namespace tetraglass::mesh {
namespace {

std::vector<double> values_of(vtkDataArray& array) {
  vtkNew<vtkDoubleArray> doubles;
  doubles->DeepCopy(&array);
  const double* first = doubles->GetPointer(0);
  return {first, first + doubles->GetNumberOfValues()};
}

class Converter {
 public:
  explicit Converter(vtkDataSet& data) : data_(data) {}

  MeshData convert() {
    const auto points = static_cast<std::size_t>(data_.GetNumberOfPoints());
    const auto cells = static_cast<std::size_t>(data_.GetNumberOfCells());
    check_mesh_fits(points, cells);
    take_points();
    ghosts_ = data_.GetCellGhostArray();
    if (ghosts_ != nullptr && ghosts_->GetNumberOfTuples() != data_.GetNumberOfCells()) {
      throw base::InputError("the array of ghost marks does not have one value per cell");
    }
    out_.types.reserve(cells);
    out_.offsets.reserve(cells + 1);
    if (auto* grid = vtkUnstructuredGrid::SafeDownCast(&data_)) {
      take_unstructured(*grid);
    } else if (auto* surface = vtkPolyData::SafeDownCast(&data_)) {
      take_polygons(*surface);
    } else {
      take_structured();
    }
    if (kept_.size() < cells) {
      out_.notes.push_back(fmt::format("{} of {} cells are blanked or ghosts and left out",
                                       cells - kept_.size(), cells));
    }
    take_fields(*data_.GetPointData(), Location::point, points);
    take_fields(*data_.GetCellData(), Location::cell, cells);
    // Numbers of points and cells are no fields to look at first.
    std::ranges::stable_partition(out_.fields, [&](const Field& field) {
      return std::ranges::find(ids_, field.name) == ids_.end();
    });
    return std::move(out_);
  }

 private:
  void take_points() {
    const vtkIdType count = data_.GetNumberOfPoints();
    out_.points.resize(static_cast<std::size_t>(count));
    auto* set = vtkPointSet::SafeDownCast(&data_);
    if (set != nullptr && set->GetPoints() != nullptr) {
      const std::vector<double> values = values_of(*set->GetPoints()->GetData());
      for (std::size_t i = 0; i < out_.points.size(); ++i) {
        out_.points[i] = Eigen::Vector3d(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
      }
      return;
    }
    for (vtkIdType i = 0; i < count; ++i) {
      data_.GetPoint(i, out_.points[static_cast<std::size_t>(i)].data());
    }
  }

  [[nodiscard]] bool is_ghost(vtkIdType cell) const {
    constexpr unsigned char kLeftOut =
        vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
    return ghosts_ != nullptr && (ghosts_->GetValue(cell) & kLeftOut) != 0;
  }

  void add(vtkIdType cell, int type, vtkIdType size, const vtkIdType* points) {
    for (vtkIdType i = 0; i < size; ++i) push_index(cell, points[i]);
    close(cell, type);
  }

  void push_index(vtkIdType cell, vtkIdType index) {
    if (index < 0 || index >= data_.GetNumberOfPoints()) {
      throw base::InputError(fmt::format("cell {} names point {}, but there are {} points", cell,
                                         index, data_.GetNumberOfPoints()));
    }
    out_.connectivity.push_back(static_cast<std::uint32_t>(index));
  }

  void close(vtkIdType cell, int type) {
    out_.types.push_back(static_cast<CellType>(type));
    out_.offsets.push_back(out_.connectivity.size());
    kept_.push_back(static_cast<std::size_t>(cell));
  }

  void take_unstructured(vtkUnstructuredGrid& grid) {
    vtkCellArray* cells = grid.GetCells();
    if (grid.GetNumberOfCells() == 0 || cells == nullptr) return;
    vtkUnsignedCharArray* types = grid.GetCellTypesArray();
    if (types == nullptr || types->GetNumberOfValues() != cells->GetNumberOfCells()) {
      throw base::InputError("the cells and the cell types differ in number");
    }
    for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i) {
      const int type = types->GetValue(i);
      if (is_ghost(i)) continue;
      if (type == static_cast<int>(CellType::polyhedron)) {
        add_polyhedron(grid, i);
        continue;
      }
      vtkIdType size = 0;
      const vtkIdType* points = nullptr;
      cells->GetCellAtId(i, size, points);
      add(i, type, size, points);
    }
  }

  /// VTK stores (n faces, (n points, points) per face) for polyhedra, all in one array.
  void add_polyhedron(vtkUnstructuredGrid& grid, vtkIdType cell) {
    vtkIdTypeArray* faces = grid.GetFaces();
    vtkIdTypeArray* locations = grid.GetFaceLocations();
    vtkIdType at = locations != nullptr && cell < locations->GetNumberOfValues()
                       ? locations->GetValue(cell)
                       : -1;
    const vtkIdType end = faces != nullptr ? faces->GetNumberOfValues() : 0;
    const auto next = [&] {
      if (at < 0 || at >= end) {
        throw base::InputError(fmt::format("the faces of cell {} (polyhedron) are cut off", cell));
      }
      return faces->GetValue(at++);
    };
    const vtkIdType face_count = next();
    const auto push_count = [&](vtkIdType count) {
      if (count < 0 || count > end - at) {
        throw base::InputError(fmt::format("the faces of cell {} (polyhedron) are cut off", cell));
      }
      out_.connectivity.push_back(static_cast<std::uint32_t>(count));
    };
    push_count(face_count);
    for (vtkIdType face = 0; face < face_count; ++face) {
      const vtkIdType size = next();
      push_count(size);
      for (vtkIdType i = 0; i < size; ++i) push_index(cell, next());
    }
    close(cell, static_cast<int>(CellType::polyhedron));
  }

  void take_polygons(vtkPolyData& surface) {
    // In the order of the cell data.
    vtkIdType cell = 0;
    take_array(surface.GetVerts(), cell,
               [](vtkIdType n) { return n == 1 ? CellType::vertex : CellType::poly_vertex; });
    take_array(surface.GetLines(), cell,
               [](vtkIdType n) { return n == 2 ? CellType::line : CellType::poly_line; });
    take_array(surface.GetPolys(), cell, [](vtkIdType n) {
      return n == 3 ? CellType::triangle : n == 4 ? CellType::quad : CellType::polygon;
    });
    take_array(surface.GetStrips(), cell, [](vtkIdType) { return CellType::triangle_strip; });
  }

  template <typename TypeOf>
  void take_array(vtkCellArray* cells, vtkIdType& cell, TypeOf type_of) {
    if (cells == nullptr) return;
    for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i, ++cell) {
      if (is_ghost(cell)) continue;
      vtkIdType size = 0;
      const vtkIdType* points = nullptr;
      cells->GetCellAtId(i, size, points);
      add(cell, static_cast<int>(type_of(size)), size, points);
    }
  }

  void take_structured() {
    vtkNew<vtkIdList> points;
    for (vtkIdType i = 0; i < data_.GetNumberOfCells(); ++i) {
      const int type = data_.GetCellType(i);  // 0 (empty) where the cell is blanked
      if (type == 0 || is_ghost(i)) continue;
      data_.GetCellPoints(i, points);
      add(i, type, points->GetNumberOfIds(), points->GetPointer(0));
    }
  }

  void take_fields(vtkDataSetAttributes& arrays, Location location, std::size_t places) {
    for (int i = 0; i < arrays.GetNumberOfArrays(); ++i) {
      vtkAbstractArray* any = arrays.GetAbstractArray(i);
      const std::string name = any->GetName() != nullptr && *any->GetName() != '\0'
                                   ? any->GetName()
                                   : fmt::format("field {}", out_.fields.size());
      if (name == vtkDataSetAttributes::GhostArrayName()) continue;
      auto* array = vtkDataArray::SafeDownCast(any);
      if (array == nullptr) {
        out_.notes.push_back(fmt::format("the array '{}' is not numeric and left out", name));
        continue;
      }
      if (static_cast<std::size_t>(array->GetNumberOfTuples()) != places ||
          array->GetNumberOfComponents() < 1) {
        throw base::InputError(fmt::format("the array '{}' has {} values for {} {}", name,
                                           array->GetNumberOfTuples(), places,
                                           location == Location::point ? "points" : "cells"));
      }
      if (arrays.IsArrayAnAttribute(i) == vtkDataSetAttributes::GLOBALIDS ||
          arrays.IsArrayAnAttribute(i) == vtkDataSetAttributes::PEDIGREEIDS) {
        ids_.push_back(name);
      }
      Field field{name, location, array->GetNumberOfComponents(), values_of(*array)};
      if (location == Location::cell && kept_.size() < places) keep_only(field);
      out_.fields.push_back(std::move(field));
    }
  }

  /// `kept_` ascends, so the values can be moved down in place.
  void keep_only(Field& field) const {
    const auto n = static_cast<std::size_t>(field.components);
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      std::copy_n(field.values.begin() + static_cast<std::ptrdiff_t>(kept_[i] * n), n,
                  field.values.begin() + static_cast<std::ptrdiff_t>(i * n));
    }
    field.values.resize(kept_.size() * n);
  }

  vtkDataSet& data_;
  MeshData out_;
  vtkUnsignedCharArray* ghosts_ = nullptr;
  std::vector<std::size_t> kept_;  ///< the cells that are not left out
  std::vector<std::string> ids_;   ///< fields that number things
};

}  // namespace

MeshData mesh_data(vtkDataSet& data) {
  return Converter(data).convert();
}

MeshData mesh_data(vtkCompositeDataSet& blocks) {
  std::vector<MeshData> parts;
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks.NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem()) {
    auto* data = vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject());
    if (data != nullptr && data->GetNumberOfCells() > 0) parts.push_back(mesh_data(*data));
  }
  return parts.empty() ? MeshData() : append_meshes(std::move(parts));
}

}  // namespace tetraglass::mesh
