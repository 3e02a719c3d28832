#include "mesh/gmsh_elements.h"

#include <array>
#include <map>

#include <gmsh.h>
#include <gtest/gtest.h>

namespace tetraglass::mesh {
namespace {

using Means = std::vector<std::vector<std::size_t>>;

/// Of each point after the corners, the corners that it lies in the middle of.
/// Source: VTK's cell classes (vtkQuadraticTetra.h and so on).
std::map<CellType, Means> middles() {
  const Means hexahedron = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                            {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  const Means wedge = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
  Means full_hexahedron = hexahedron;
  for (const std::vector<std::size_t>& face : Means{{0, 3, 7, 4},
                                                    {1, 2, 6, 5},
                                                    {0, 1, 5, 4},
                                                    {3, 2, 6, 7},
                                                    {0, 1, 2, 3},
                                                    {4, 5, 6, 7},
                                                    {0, 1, 2, 3, 4, 5, 6, 7}}) {
    full_hexahedron.push_back(face);
  }
  Means full_wedge = wedge;
  for (const std::vector<std::size_t>& face : Means{{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}) {
    full_wedge.push_back(face);
  }
  return {{CellType::quadratic_tetra, {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}},
          {CellType::quadratic_hexahedron, hexahedron},
          {CellType::triquadratic_hexahedron, full_hexahedron},
          {CellType::quadratic_wedge, wedge},
          {CellType::biquadratic_quadratic_wedge, full_wedge},
          {CellType::quadratic_pyramid,
           {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}},
          {CellType::quadratic_triangle, {{0, 1}, {1, 2}, {2, 0}}},
          {CellType::quadratic_quad, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
          {CellType::biquadratic_quad, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 1, 2, 3}}}};
}

TEST(GmshElements, AreInTheOrderOfVtkByTheCoordinatesOfGmshItself) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  std::size_t checked = 0;
  for (int number = 1; number < 120; ++number) {
    const GmshElement* element = find_gmsh_element(number);
    if (element == nullptr) continue;
    SCOPED_TRACE(number);
    std::string name;
    int dimension = 0;
    int order = 0;
    int nodes = 0;
    int corners = 0;
    std::vector<double> local;
    try {
      gmsh::model::mesh::getElementProperties(number, name, dimension, order, nodes, local,
                                              corners);
    } catch (...) {
      continue;  // prisms of high order, whose points Gmsh 4.8 does not tell
    }
    EXPECT_EQ(element->nodes, nodes);
    EXPECT_EQ(mesh::dimension(element->type), dimension);
    MeshData mesh;
    std::vector<std::uint32_t> points;
    for (int i = 0; i < nodes; ++i) {
      const auto at = static_cast<std::size_t>(i * dimension);
      mesh.points.emplace_back(dimension > 0 ? local[at] : 0, dimension > 1 ? local[at + 1] : 0,
                               dimension > 2 ? local[at + 2] : 0);
      points.push_back(static_cast<std::uint32_t>(i));
    }
    add_gmsh_element(mesh, *element, points.data());
    const auto known = middles();
    const auto found = known.find(element->type);
    if (found == known.end()) continue;
    const auto at = [&](std::size_t i) { return mesh.points[mesh.cell(0)[i]]; };
    for (std::size_t i = 0; i < found->second.size(); ++i) {
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      for (const std::size_t corner : found->second[i]) mean += at(corner);
      mean /= static_cast<double>(found->second[i].size());
      const auto k = static_cast<std::size_t>(corners) + i;
      EXPECT_LT((at(k) - mean).norm(), 1e-14) << "point " << k;
    }
    ++checked;
  }
  gmsh::finalize();
  EXPECT_EQ(checked, 10U);
}

TEST(GmshElements, UnknownNumbersHaveNone) {
  EXPECT_EQ(find_gmsh_element(0), nullptr);
  EXPECT_EQ(find_gmsh_element(1000), nullptr);
}

}  // namespace
}  // namespace tetraglass::mesh
