#include "mesh/read_exodus.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <vtk_exodusII.h>
#include <vtk_netcdf.h>

#include "base/errors.h"
#include "mesh/cell_shapes.h"
#include "mesh/memory.h"
#include "mesh/netcdf_size.h"
#include "mesh/time_step.h"

namespace tetraglass::mesh {
namespace {

/// An element shape by its name in the file and its number of nodes, and where each point of the
/// cell stands among the nodes of the element (in order, if empty).
struct ElementShape {
  std::string_view name;  ///< the file's may be longer (HEX8, TETRA4) or the same
  int nodes;
  CellType type;
  std::vector<int> order;
};

// Exodus numbers the edges of its solids bottom, upright, top, VTK bottom, top, upright; its wedge
// has the first triangle seen from inside, VTK's from outside, so top and bottom are exchanged.
const std::vector<ElementShape>& element_shapes() {
  static const std::vector<ElementShape> kTable = {
      {"TETRA", 4, CellType::tetra, {}},
      {"TET", 4, CellType::tetra, {}},
      {"TETRA", 10, CellType::quadratic_tetra, {}},
      {"TET", 10, CellType::quadratic_tetra, {}},
      {"HEX", 8, CellType::hexahedron, {}},
      {"HEX", 20, CellType::quadratic_hexahedron, {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,
                                                   10, 11, 16, 17, 18, 19, 12, 13, 14, 15}},
      {"HEX", 27, CellType::triquadratic_hexahedron, {0,  1,  2,  3,  4,  5,  6,  7,  8,
                                                      9,  10, 11, 16, 17, 18, 19, 12, 13,
                                                      14, 15, 23, 24, 25, 26, 21, 22, 20}},
      {"WEDGE", 6, CellType::wedge, {3, 4, 5, 0, 1, 2}},
      {"WEDGE", 15, CellType::quadratic_wedge, {3, 4, 5, 0, 1, 2, 12, 13, 14, 6, 7, 8, 9, 10, 11}},
      {"PYRAMID", 5, CellType::pyramid, {}},
      {"PYRAMID", 13, CellType::quadratic_pyramid, {}},
      {"TRI", 3, CellType::triangle, {}},
      {"TRI", 6, CellType::quadratic_triangle, {}},
      {"SHELL", 3, CellType::triangle, {}},
      {"QUAD", 4, CellType::quad, {}},
      {"SHELL", 4, CellType::quad, {}},
      {"QUAD", 8, CellType::quadratic_quad, {}},
      {"QUAD", 9, CellType::biquadratic_quad, {}},
      {"BAR", 2, CellType::line, {}},
      {"BEAM", 2, CellType::line, {}},
      {"TRUSS", 2, CellType::line, {}},
      {"EDGE", 2, CellType::line, {}},
      {"SPHERE", 1, CellType::vertex, {}},
      {"CIRCLE", 1, CellType::vertex, {}},
      {"NODE", 1, CellType::vertex, {}},
  };
  return kTable;
}

/// Solids with more nodes than are known above: those on the edges come after the corners, and both
/// before all others.
const std::vector<ElementShape>& corner_shapes() {
  static const std::vector<ElementShape> kTable = {
      {"TET", 10, CellType::quadratic_tetra, {}}, {"TET", 4, CellType::tetra, {}},
      {"HEX", 8, CellType::hexahedron, {}},       {"WEDGE", 6, CellType::wedge, {3, 4, 5, 0, 1, 2}},
      {"PYRAMID", 5, CellType::pyramid, {}},
  };
  return kTable;
}

class ExodusFile {
 public:
  explicit ExodusFile(const std::string& file) : file_(file) {
    if (const auto size = netcdf_size(file); size && *size > std::filesystem::file_size(file)) {
      throw base::ReadError(file, fmt::format("is cut off: its head tells of {} bytes, it has {}",
                                              *size, std::filesystem::file_size(file)));
    }
    // The Exodus library prints what it finds wrong while opening a file; netCDF's does not.
    int trial = 0;
    if (const int status = nc_open(file.c_str(), NC_NOWRITE, &trial); status != NC_NOERR) {
      throw base::ReadError(file,
                            fmt::format("is not a complete Exodus file: {}", nc_strerror(status)));
    }
    nc_close(trial);
    ex_opts(EX_DEFAULT);  // after that, nothing is printed
    int computing_size = sizeof(double);
    int stored_size = 0;
    float version = 0;
    id_ = ex_open(file.c_str(), EX_READ, &computing_size, &stored_size, &version);
    if (id_ < 0) fail("is not a complete Exodus file");
    ex_set_int64_status(id_, EX_ALL_INT64_API);
    ex_set_max_name_length(id_,
                           static_cast<int>(ex_inquire_int(id_, EX_INQ_DB_MAX_USED_NAME_LENGTH)));
  }
  ~ExodusFile() {
    if (id_ >= 0) ex_close(id_);
  }
  ExodusFile(const ExodusFile&) = delete;
  ExodusFile& operator=(const ExodusFile&) = delete;

  MeshData read(const std::string& time);

 private:
  struct Block {
    ex_block parameters{};
    std::size_t first_cell = 0;
    const ElementShape* shape = nullptr;
  };

  [[noreturn]] void fail(const std::string& what) const {
    const char* message = nullptr;
    const char* function = nullptr;
    int number = 0;
    ex_get_err(&message, &function, &number);
    const char* reason = number != 0 ? ex_strerror(number) : nullptr;
    throw base::ReadError(file_, reason != nullptr ? fmt::format("{}: {}", what, reason) : what);
  }
  void check(int status, std::string_view what) const {
    if (status < 0) fail(fmt::format("is damaged: its {} cannot be read", what));
  }
  std::size_t checked_count(std::int64_t count, std::string_view what) const;
  void read_points();
  void find_blocks();
  void read_cells(const Block& block);
  [[nodiscard]] std::vector<std::string> variable_names(ex_entity_type kind) const;
  void read_point_fields(int step);
  void read_cell_fields(int step);
  void join_vectors();

  std::string file_;
  int id_ = -1;
  ex_init_params sizes_{};
  std::vector<Block> blocks_;
  MeshData mesh_;
};

/// A count that a file may claim: every entity takes at least a byte of it.
std::size_t ExodusFile::checked_count(std::int64_t count, std::string_view what) const {
  if (count < 0 || static_cast<std::uintmax_t>(count) > std::filesystem::file_size(file_)) {
    throw base::ReadError(file_, fmt::format("is damaged: it claims {} {}", count, what));
  }
  return static_cast<std::size_t>(count);
}

MeshData ExodusFile::read(const std::string& time) {
  check(ex_get_init_ext(id_, &sizes_), "sizes");
  const std::size_t points = checked_count(sizes_.num_nodes, "nodes");
  const std::size_t cells = checked_count(sizes_.num_elem, "elements");
  check_mesh_fits(points, cells);
  read_points();
  find_blocks();
  for (const Block& block : blocks_) read_cells(block);
  const auto steps = checked_count(ex_inquire_int(id_, EX_INQ_TIME), "time steps");
  if (steps > 0) {
    std::vector<double> times(steps);
    check(ex_get_all_times(id_, times.data()), "times");
    const std::size_t step = find_time_step(time, times);
    note_time_step(mesh_.notes, step, times);
    read_point_fields(static_cast<int>(step) + 1);
    read_cell_fields(static_cast<int>(step) + 1);
    join_vectors();
  }
  if (blocks_.size() > 1) {
    Field number{"block", Location::cell, 1, {}};
    for (const Block& block : blocks_) {
      number.values.insert(number.values.end(),
                           static_cast<std::size_t>(block.parameters.num_entry),
                           static_cast<double>(block.parameters.id));
    }
    mesh_.fields.push_back(std::move(number));
  }
  return std::move(mesh_);
}

void ExodusFile::read_points() {
  const auto count = static_cast<std::size_t>(sizes_.num_nodes);
  std::array<std::vector<double>, 3> axes;
  for (auto& axis : axes) axis.resize(count);
  check(ex_get_coord(id_, axes[0].data(), sizes_.num_dim > 1 ? axes[1].data() : nullptr,
                     sizes_.num_dim > 2 ? axes[2].data() : nullptr),
        "coordinates");
  mesh_.points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    mesh_.points.emplace_back(axes[0][i], axes[1][i], axes[2][i]);
  }
}

const ElementShape* find_element(const std::string& name, std::int64_t nodes) {
  const auto fits = [&](const ElementShape& shape) {
    return name.starts_with(shape.name) && nodes == shape.nodes;
  };
  const auto found = std::ranges::find_if(element_shapes(), fits);
  if (found != element_shapes().end()) return &*found;
  const auto corners = std::ranges::find_if(corner_shapes(), [&](const ElementShape& shape) {
    return name.starts_with(shape.name) && nodes > shape.nodes;
  });
  return corners != corner_shapes().end() ? &*corners : nullptr;
}

void ExodusFile::find_blocks() {
  std::vector<std::int64_t> ids(checked_count(sizes_.num_elem_blk, "element blocks"));
  if (ids.empty()) return;
  check(ex_get_ids(id_, EX_ELEM_BLOCK, ids.data()), "element blocks");
  std::size_t cells = 0;
  std::map<std::string, std::size_t> reduced;  // elements of which the corners are used, by type
  for (const std::int64_t id : ids) {
    Block block;
    block.parameters.id = id;
    block.parameters.type = EX_ELEM_BLOCK;
    check(ex_get_block_param(id_, &block.parameters), "element blocks");
    const std::size_t count = checked_count(block.parameters.num_entry, "elements in a block");
    block.first_cell = cells;
    cells += count;
    std::string name = block.parameters.topology;
    std::ranges::transform(name, name.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    if (name.starts_with("PENTA")) name.replace(0, 5, "WEDGE");
    block.shape = find_element(name, block.parameters.num_nodes_per_entry);
    if (block.shape == nullptr && count > 0) {
      mesh_.notes.push_back(
          fmt::format("block {}: {} elements of type '{}' with {} nodes are not "
                      "known and left out",
                      id, count, block.parameters.topology, block.parameters.num_nodes_per_entry));
    } else if (block.shape != nullptr &&
               block.shape->nodes < block.parameters.num_nodes_per_entry) {
      reduced[block.parameters.topology] += count;
    }
    blocks_.push_back(block);
  }
  for (const auto& [type, count] : reduced) {
    mesh_.notes.push_back(fmt::format("of {} elements '{}' not all nodes are used", count, type));
  }
  if (cells != static_cast<std::size_t>(sizes_.num_elem)) {
    throw base::ReadError(file_, fmt::format("is damaged: its blocks have {} elements, its head "
                                             "says {}",
                                             cells, sizes_.num_elem));
  }
}

void ExodusFile::read_cells(const Block& block) {
  const auto count = static_cast<std::size_t>(block.parameters.num_entry);
  if (block.shape == nullptr) {
    // They keep their place, so that the element variables keep theirs.
    constexpr auto kUnknown = static_cast<CellType>(0);
    for (std::size_t i = 0; i < count; ++i) mesh_.add_cell(kUnknown, {});
    return;
  }
  const auto nodes = checked_count(block.parameters.num_nodes_per_entry, "nodes per element");
  checked_count(static_cast<std::int64_t>(count * nodes), "nodes in a block");
  std::vector<std::int64_t> connectivity(count * nodes);
  if (connectivity.empty()) return;
  check(ex_get_conn(id_, EX_ELEM_BLOCK, block.parameters.id, connectivity.data(), nullptr, nullptr),
        "connectivity");
  std::vector<std::uint32_t> cell(static_cast<std::size_t>(block.shape->nodes));
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < cell.size(); ++k) {
      const std::size_t at =
          block.shape->order.empty() ? k : static_cast<std::size_t>(block.shape->order[k]);
      const std::int64_t node = connectivity[i * nodes + at];
      if (node < 1 || node > sizes_.num_nodes) {
        throw base::ReadError(file_,
                              fmt::format("element {} of block {} names node {}, but there "
                                          "are nodes 1 to {}",
                                          i + 1, block.parameters.id, node, sizes_.num_nodes));
      }
      cell[k] = static_cast<std::uint32_t>(node - 1);
    }
    mesh_.add_cell(block.shape->type, cell);
  }
}

std::vector<std::string> ExodusFile::variable_names(ex_entity_type kind) const {
  int count = 0;
  check(ex_get_variable_param(id_, kind, &count), "variables");
  checked_count(count, "variables");
  const auto length = static_cast<std::size_t>(
      std::max<std::int64_t>(ex_inquire_int(id_, EX_INQ_DB_MAX_USED_NAME_LENGTH), 32));
  std::vector<std::string> names(static_cast<std::size_t>(count), std::string(length + 1, '\0'));
  std::vector<char*> pointers;
  for (std::string& name : names) pointers.push_back(name.data());
  if (count > 0) check(ex_get_variable_names(id_, kind, count, pointers.data()), "variable names");
  for (std::string& name : names) {
    name.resize(name.find('\0') == std::string::npos ? length : name.find('\0'));
    name.erase(name.find_last_not_of(' ') + 1);
  }
  return names;
}

void ExodusFile::read_point_fields(int step) {
  if (mesh_.points.empty()) return;
  const std::vector<std::string> names = variable_names(EX_NODAL);
  for (std::size_t v = 0; v < names.size(); ++v) {
    Field field{names[v], Location::point, 1, std::vector<double>(mesh_.points.size())};
    check(ex_get_var(id_, step, EX_NODAL, static_cast<int>(v) + 1, 1, sizes_.num_nodes,
                     field.values.data()),
          fmt::format("variable '{}'", names[v]));
    mesh_.fields.push_back(std::move(field));
  }
}

void ExodusFile::read_cell_fields(int step) {
  const std::vector<std::string> names = variable_names(EX_ELEM_BLOCK);
  if (names.empty() || blocks_.empty()) return;
  std::vector<int> present(names.size() * blocks_.size());
  check(ex_get_truth_table(id_, EX_ELEM_BLOCK, static_cast<int>(blocks_.size()),
                           static_cast<int>(names.size()), present.data()),
        "table of element variables");
  for (std::size_t v = 0; v < names.size(); ++v) {
    Field field{names[v], Location::cell, 1,
                std::vector<double>(mesh_.cell_count(), std::numeric_limits<double>::quiet_NaN())};
    std::size_t missing = 0;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const Block& block = blocks_[b];
      if (block.parameters.num_entry == 0) continue;
      if (present[b * names.size() + v] == 0) {
        ++missing;
        continue;
      }
      check(ex_get_var(id_, step, EX_ELEM_BLOCK, static_cast<int>(v) + 1, block.parameters.id,
                       block.parameters.num_entry, field.values.data() + block.first_cell),
            fmt::format("variable '{}'", names[v]));
    }
    if (missing > 0) {
      mesh_.notes.push_back(fmt::format("'{}' is absent in {} of {} blocks; its value there is NaN",
                                        names[v], missing, blocks_.size()));
    }
    mesh_.fields.push_back(std::move(field));
  }
}

/// The name of the vector whose first component `x` may be; empty if none.
std::string vector_name(const std::vector<Field>& fields, std::size_t x) {
  if (x + 2 >= fields.size()) return {};
  std::string stem = fields[x].name;
  if (stem.size() < 2) return {};
  const char last = stem.back();
  if (last != 'x' && last != 'X') return {};
  stem.pop_back();
  for (std::size_t i = 1; i < 3; ++i) {
    const Field& next = fields[x + i];
    const auto axis = static_cast<char>(last + static_cast<char>(i));
    if (next.name != stem + axis || next.location != fields[x].location) return {};
  }
  if (stem.size() > 1 && stem.ends_with('_')) stem.pop_back();
  return stem;
}

void ExodusFile::join_vectors() {
  std::vector<Field> joined;
  std::vector<Field>& fields = mesh_.fields;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string name = vector_name(fields, i);
    if (name.empty()) {
      joined.push_back(std::move(fields[i]));
      continue;
    }
    Field vector{name, fields[i].location, 3, {}};
    for (std::size_t k = 0; k < fields[i].values.size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) vector.values.push_back(fields[i + c].values[k]);
    }
    joined.push_back(std::move(vector));
    i += 2;
  }
  fields = std::move(joined);
}

}  // namespace

MeshData read_exodus(const std::string& file, const std::string& time) {
  return ExodusFile(file).read(time);
}

}  // namespace tetraglass::mesh
