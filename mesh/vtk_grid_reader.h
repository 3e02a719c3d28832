#pragma once

template <class T>
class vtkSmartPointer;
class vtkXMLReader;

namespace tetraglass::mesh {

/// VTK's readers of unstructured grids in XML (one file; parallel), which first check that the
/// lists of polyhedra's faces agree with their sizes: where they do not, VTK 9.1 reads beyond its
/// arrays.
[[nodiscard]] vtkSmartPointer<vtkXMLReader> checked_grid_reader();
[[nodiscard]] vtkSmartPointer<vtkXMLReader> checked_parallel_grid_reader();

}  // namespace tetraglass::mesh
