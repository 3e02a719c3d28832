#include "mesh/read_gmsh.h"

#include "base/errors.h"

#ifdef TETRAGLASS_WITH_GMSH

#include <algorithm>
#include <filesystem>
#include <limits>
#include <mutex>
#include <vector>

#include <fmt/format.h>
#include <gmsh.h>

#include "mesh/file_name.h"
#include "mesh/gmsh_elements.h"
#include "mesh/memory.h"
#include "mesh/read_apart.h"
#include "mesh/tag_map.h"
#include "mesh/time_step.h"

namespace tetraglass::mesh {
namespace {

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
  TagMap nodes_;
  std::vector<std::uint64_t> element_tags_;
  std::size_t left_out_ = 0;  ///< elements of unknown type
  std::size_t reduced_ = 0;   ///< elements of which only the corners are used
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
    if (left_out_ > 0) {
      mesh_.notes.push_back(fmt::format("{} elements of unknown type are left out", left_out_));
    }
    if (reduced_ > 0) {
      mesh_.notes.push_back(
          fmt::format("of {} elements of high order the corners are used", reduced_));
    }
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
  for (std::size_t i = 0; i < tags.size(); ++i) mesh_.points.emplace_back(&coordinates[3 * i]);
  nodes_ = TagMap(std::vector<std::uint64_t>(tags.begin(), tags.end()));
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
  const GmshElement* element = find_gmsh_element(type);
  if (element == nullptr) {
    left_out_ += tags.size();
    return;
  }
  if (is_reduced(*element)) reduced_ += tags.size();
  const auto size = static_cast<std::size_t>(element->nodes);
  std::vector<std::uint32_t> points(size);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    for (std::size_t k = 0; k < size; ++k) {
      points[k] = nodes_.find(nodes[i * size + k]);
      if (points[k] == TagMap::kAbsent) {
        throw base::InputError(fmt::format("element {} names node {}, which is not in the file",
                                           tags[i], nodes[i * size + k]));
      }
    }
    add_gmsh_element(mesh_, *element, points.data());
    element_tags_.push_back(tags[i]);
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
  note_time_step(mesh_.notes, step, times, "'" + name + "': ");
  const bool at_points = kind == "NodeData";
  if ((!at_points && kind != "ElementData") || components < 1) {
    mesh_.notes.push_back(fmt::format("the view '{}' of kind '{}' is left out", name, kind));
    return;
  }
  const auto n = static_cast<std::size_t>(components);
  const std::size_t places = at_points ? mesh_.points.size() : mesh_.cell_count();
  Field field{name, at_points ? Location::point : Location::cell, components,
              std::vector<double>(places * n, std::numeric_limits<double>::quiet_NaN())};
  const TagMap elements = at_points ? TagMap() : TagMap(element_tags_);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const std::uint32_t place = (at_points ? nodes_ : elements).find(tags[i]);
    if (place == TagMap::kAbsent || data[i].size() < n) continue;
    std::ranges::copy_n(data[i].begin(), components,
                        field.values.begin() + static_cast<std::ptrdiff_t>(place * n));
  }
  mesh_.fields.push_back(std::move(field));
}

}  // namespace

MeshData read_gmsh(const std::string& file, const std::string& time) {
  // A file of any other extension is run as a program of Gmsh's language.
  if (std::filesystem::path(file).extension().string() != extension_of(file)) {
    throw base::ReadError(file, "its extension has to be in small letters for Gmsh's library");
  }
  constexpr unsigned kSeconds = 600;
  return read_apart(
      file, [&] { return GmshReader().read(file, time); }, kSeconds);
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
