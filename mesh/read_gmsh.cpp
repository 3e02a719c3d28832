#include "mesh/read_gmsh.h"

#include "base/errors.h"

#ifdef TETRAGLASS_WITH_GMSH

#include <algorithm>
#include <limits>
#include <mutex>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>
#include <gmsh.h>

#include "mesh/cell_shapes.h"
#include "mesh/memory.h"
#include "mesh/time_step.h"

namespace tetraglass::mesh {
namespace {

/// Gmsh's number of an element type, and where each point of the cell stands among the nodes of the
/// element (in order, if empty). Gmsh numbers the edges of an element by their corners; its prism
/// has the first triangle seen from inside, VTK's wedge from outside, so top and bottom are
/// exchanged. Source: Gmsh reference manual, "Node ordering".
struct ElementShape {
  int number;
  CellType type;
  std::vector<std::size_t> order;
};

const std::vector<ElementShape>& element_shapes() {
  static const std::vector<ElementShape> kTable = {
      {1, CellType::line, {}},
      {2, CellType::triangle, {}},
      {3, CellType::quad, {}},
      {4, CellType::tetra, {}},
      {5, CellType::hexahedron, {}},
      {6, CellType::wedge, {3, 4, 5, 0, 1, 2}},
      {7, CellType::pyramid, {}},
      {8, CellType::quadratic_edge, {}},
      {9, CellType::quadratic_triangle, {}},
      {10, CellType::biquadratic_quad, {}},
      {11, CellType::quadratic_tetra, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
      {12, CellType::triquadratic_hexahedron, {0,  1,  2,  3,  4,  5,  6,  7,  8,
                                               11, 13, 9,  16, 18, 19, 17, 10, 12,
                                               14, 15, 22, 23, 21, 24, 20, 25, 26}},
      {13,
       CellType::biquadratic_quadratic_wedge,
       {3, 4, 5, 0, 1, 2, 12, 14, 13, 6, 9, 7, 8, 10, 11, 15, 17, 16}},
      {14, CellType::quadratic_pyramid, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}},
      {15, CellType::vertex, {}},
      {16, CellType::quadratic_quad, {}},
      {17, CellType::quadratic_hexahedron, {0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                            13, 9, 16, 18, 19, 17, 10, 12, 14, 15}},
      {18, CellType::quadratic_wedge, {3, 4, 5, 0, 1, 2, 12, 14, 13, 6, 9, 7, 8, 10, 11}},
      {19, CellType::quadratic_pyramid, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}},
  };
  return kTable;
}

/// The shapes of elements of any order, by their number of corners.
const ElementShape* corner_shape(int dimension, int corners) {
  static const std::vector<ElementShape> kSolids = {{0, CellType::tetra, {}},
                                                    {0, CellType::pyramid, {}},
                                                    {0, CellType::wedge, {3, 4, 5, 0, 1, 2}},
                                                    {0, CellType::hexahedron, {}}};
  static const std::vector<ElementShape> kFaces = {{0, CellType::triangle, {}},
                                                   {0, CellType::quad, {}}};
  static const std::vector<ElementShape> kNone;
  for (const ElementShape& shape : dimension == 3 ? kSolids : dimension == 2 ? kFaces : kNone) {
    if (find_shape(shape.type)->corners == corners) return &shape;
  }
  return nullptr;
}

/// Gmsh's library holds one state for the whole program: open from construction to destruction.
class Session {
 public:
  Session() : lock_(mutex()) {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.AbortOnError", 2);  // throw instead of going on
    gmsh::logger::start();
  }
  ~Session() { gmsh::finalize(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// What Gmsh said first against the file; empty if nothing.
  [[nodiscard]] static std::string first_error() {
    std::vector<std::string> log;
    gmsh::logger::get(log);
    constexpr std::string_view kError = "Error: ";
    for (const std::string& line : log) {
      if (line.starts_with(kError)) return line.substr(kError.size());
    }
    return {};
  }

 private:
  static std::mutex& mutex() {
    static std::mutex the_mutex;
    return the_mutex;
  }
  std::lock_guard<std::mutex> lock_;
};

class GmshReader {
 public:
  MeshData read(const std::string& file, const std::string& time);

 private:
  void read_points();
  void read_entity(int dimension, int tag);
  void add_elements(int type, const std::vector<std::size_t>& tags,
                    const std::vector<std::size_t>& nodes, double physical);
  void read_view(int tag, const std::string& time);

  Session session_;
  MeshData mesh_;
  std::unordered_map<std::size_t, std::uint32_t> point_of_;  ///< by the tag of the node
  std::unordered_map<std::size_t, std::size_t> cell_of_;     ///< by the tag of the element
  Field physical_{"physical", Location::cell, 1, {}};
  bool has_physical_ = false;
};

MeshData GmshReader::read(const std::string& file, const std::string& time) {
  try {
    gmsh::open(file);
    if (const std::string error = Session::first_error(); !error.empty()) {
      throw base::ReadError(file, "is damaged or not complete: " + error);
    }
    read_points();
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities);
    for (const auto& [dimension, tag] : entities) read_entity(dimension, tag);
    if (has_physical_) mesh_.fields.push_back(std::move(physical_));
    std::vector<int> views;
    gmsh::view::getTags(views);
    for (const int view : views) read_view(view, time);
  } catch (const std::string& error) {  // Gmsh throws these
    const std::string first = Session::first_error();
    throw base::ReadError(file, "is damaged or not complete: " + (first.empty() ? error : first));
  } catch (int code) {
    const std::string first = Session::first_error();
    throw base::ReadError(file, first.empty() ? fmt::format("Gmsh ended with code {}", code)
                                              : "is damaged or not complete: " + first);
  }
  return std::move(mesh_);
}

void GmshReader::read_points() {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates;
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
  check_mesh_fits(tags.size(), 0);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    // A node on the border of entities may be told more than once.
    const bool is_new =
        point_of_.try_emplace(tags[i], static_cast<std::uint32_t>(mesh_.points.size())).second;
    if (is_new) mesh_.points.emplace_back(coordinates.data() + 3 * i);
  }
}

void GmshReader::read_entity(int dimension, int tag) {
  std::vector<int> groups;
  gmsh::model::getPhysicalGroupsForEntity(dimension, tag, groups);
  has_physical_ = has_physical_ || (dimension == 3 && !groups.empty());
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags;
  std::vector<std::vector<std::size_t>> nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension, tag);
  for (std::size_t i = 0; i < types.size(); ++i) {
    add_elements(types[i], tags[i], nodes[i], groups.empty() ? 0 : groups[0]);
  }
}

void GmshReader::add_elements(int type, const std::vector<std::size_t>& tags,
                              const std::vector<std::size_t>& nodes, double physical) {
  std::string name;
  int dimension = 0;
  int order = 0;
  int node_count = 0;
  int corners = 0;
  std::vector<double> local;
  gmsh::model::mesh::getElementProperties(type, name, dimension, order, node_count, local, corners);
  const auto found = std::ranges::find(element_shapes(), type, &ElementShape::number);
  const ElementShape* shape =
      found != element_shapes().end() ? &*found : corner_shape(dimension, corners);
  if (shape == nullptr) {
    mesh_.notes.push_back(fmt::format("{} elements '{}' are left out", tags.size(), name));
    return;
  }
  const CellShape& cell_shape = *find_shape(shape->type);
  if (cell_shape.points < node_count && cell_shape.points == cell_shape.corners) {
    mesh_.notes.push_back(fmt::format("of the {} nodes of {} elements '{}' the corners are used",
                                      node_count, tags.size(), name));
  }
  std::vector<std::uint32_t> cell(static_cast<std::size_t>(cell_shape.points));
  for (std::size_t i = 0; i < tags.size(); ++i) {
    for (std::size_t k = 0; k < cell.size(); ++k) {
      const std::size_t at = shape->order.empty() ? k : shape->order[k];
      const std::size_t node = nodes[i * static_cast<std::size_t>(node_count) + at];
      const auto point = point_of_.find(node);
      if (point == point_of_.end()) {
        throw base::InputError(
            fmt::format("element {} names node {}, which is not in the file", tags[i], node));
      }
      cell[k] = point->second;
    }
    cell_of_[tags[i]] = mesh_.cell_count();
    mesh_.add_cell(shape->type, cell);
    physical_.values.push_back(physical);
  }
}

void GmshReader::read_view(int tag, const std::string& time) {
  const std::string option = fmt::format("View[{}].", gmsh::view::getIndex(tag));
  std::string name;
  double step_count = 0;
  gmsh::option::getString(option + "Name", name);
  gmsh::option::getNumber(option + "NbTimeStep", step_count);
  std::string kind;
  std::vector<std::size_t> tags;
  std::vector<std::vector<double>> data;
  std::vector<double> times(static_cast<std::size_t>(std::max(step_count, 1.0)));
  int components = 0;
  const auto get = [&](std::size_t step) {
    gmsh::view::getModelData(tag, static_cast<int>(step), kind, tags, data, times[step],
                             components);
  };
  for (std::size_t i = 0; i < times.size(); ++i) get(i);
  const std::size_t step = find_time_step(time, times);
  get(step);
  if (times.size() > 1) {
    mesh_.notes.push_back(
        fmt::format("'{}': time step {} of {} (time {:g})", name, step, times.size(), times[step]));
  }
  const bool at_points = kind == "NodeData";
  if ((!at_points && kind != "ElementData") || components < 1) {
    mesh_.notes.push_back(fmt::format("the view '{}' of kind '{}' is left out", name, kind));
    return;
  }
  const auto n = static_cast<std::size_t>(components);
  const std::size_t places = at_points ? mesh_.points.size() : mesh_.cell_count();
  Field field{name, at_points ? Location::point : Location::cell, components,
              std::vector<double>(places * n, std::numeric_limits<double>::quiet_NaN())};
  for (std::size_t i = 0; i < tags.size(); ++i) {
    std::size_t place = places;
    if (at_points) {
      const auto point = point_of_.find(tags[i]);
      if (point != point_of_.end()) place = point->second;
    } else {
      const auto cell = cell_of_.find(tags[i]);
      if (cell != cell_of_.end()) place = cell->second;
    }
    if (place == places || data[i].size() < n) continue;
    std::copy_n(data[i].begin(), n, field.values.begin() + static_cast<std::ptrdiff_t>(place * n));
  }
  mesh_.fields.push_back(std::move(field));
}

}  // namespace

MeshData read_gmsh(const std::string& file, const std::string& time) {
  return GmshReader().read(file, time);
}

}  // namespace tetraglass::mesh

#else

namespace tetraglass::mesh {

MeshData read_gmsh(const std::string& /*file*/, const std::string& /*time*/) {
  throw base::UnavailableError(
      "this format needs Gmsh's library, which this build lacks (TETRAGLASS_WITH_GMSH)");
}

}  // namespace tetraglass::mesh

#endif
