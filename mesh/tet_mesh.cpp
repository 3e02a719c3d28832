#include "mesh/tet_mesh.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "base/errors.h"
#include "base/suggest.h"
#include "mesh/predicates.h"

namespace tetraglass::mesh {
namespace {

using Range = tbb::blocked_range<std::size_t>;

// How many points or cells a task takes at least: some 10 us of work.
constexpr std::size_t kGrain = 8192;

// What a spec asks of a field: one component, or the length of all.
struct Part {
  bool magnitude = true;
  int component = 0;
};

const Field* find_field(const TetMesh& mesh, std::string_view name,
                        std::optional<Location> location = std::nullopt) {
  const Field* found = nullptr;
  for (const Field& field : mesh.fields) {
    if (field.name != name || (location && field.location != *location)) continue;
    if (field.location == Location::point) return &field;
    if (found == nullptr) found = &field;
  }
  return found;
}

// A field by NAME, NAME@point or NAME@cell.
const Field* find_located(const TetMesh& mesh, std::string_view name) {
  if (const Field* field = find_field(mesh, name)) return field;
  const std::size_t at = name.rfind('@');
  if (at == std::string_view::npos) return nullptr;
  const std::string_view location = name.substr(at + 1);
  if (location == "point") return find_field(mesh, name.substr(0, at), Location::point);
  if (location == "cell") return find_field(mesh, name.substr(0, at), Location::cell);
  return nullptr;
}

[[noreturn]] void throw_no_component(const Field& field, std::string_view asked) {
  std::string known;
  for (int i = 0; i < std::min(field.components, 3); ++i) known += fmt::format("{}, ", "xyz"[i]);
  throw base::InputError(fmt::format(
      "the field '{}' has no component '{}'; there are: {}magnitude, and the numbers 0 to {}",
      field.name, asked, known, field.components - 1));
}

Part parse_part(const Field& field, std::string_view text) {
  if (text == "magnitude") return {true, 0};
  int component = -1;
  if (text == "x" || text == "y" || text == "z") {
    component = text[0] - 'x';
  } else {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), component);
    if (error != std::errc() || end != text.data() + text.size()) component = -1;
  }
  if (component < 0 || component >= field.components) throw_no_component(field, text);
  return {false, component};
}

void find_range(ScalarField& field) {
  struct Extent {
    double min = std::numeric_limits<double>::infinity();
    double max = -std::numeric_limits<double>::infinity();
  };
  const Extent extent = tbb::parallel_reduce(
      Range(0, field.values.size(), kGrain), Extent{},
      [&](const Range& range, Extent so_far) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          const double value = field.values[i];
          if (!std::isfinite(value)) continue;
          so_far.min = std::min(so_far.min, value);
          so_far.max = std::max(so_far.max, value);
        }
        return so_far;
      },
      [](const Extent& a, const Extent& b) {
        return Extent{std::min(a.min, b.min), std::max(a.max, b.max)};
      });
  const bool any = extent.min <= extent.max;
  field.min = any ? extent.min : 0;
  field.max = any ? extent.max : 0;
}

// The length of a vector of any number of components, without overflow on the way.
double length(const double* values, int components) {
  if (components == 2) return std::hypot(values[0], values[1]);
  if (components == 3) return std::hypot(values[0], values[1], values[2]);
  return Eigen::Map<const Eigen::VectorXd>(values, components).stableNorm();
}

ScalarField take(const TetMesh& mesh, const Field& field, Part part, const std::string& name) {
  const bool at_points = field.location == Location::point;
  const std::size_t count = at_points ? mesh.points.size() : mesh.cells.size();
  const auto components = static_cast<std::size_t>(field.components);
  if (field.components < 1 || field.values.size() != count * components) {
    throw base::InputError(
        fmt::format("the {} field '{}' has {} values; {} components for each of {} {} would be {}",
                    at_points ? "point" : "cell", field.name, field.values.size(), field.components,
                    count, at_points ? "points" : "cells", count * components));
  }
  ScalarField result{name, field.location, {}, 0, 0};
  if (components == 1 && !part.magnitude) {
    result.values = field.values;
  } else {
    result.values.resize(count);
    tbb::parallel_for(Range(0, count, kGrain), [&](const Range& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const double* tuple = field.values.data() + i * components;
        result.values[i] = part.magnitude ? length(tuple, field.components) : tuple[part.component];
      }
    });
  }
  find_range(result);
  return result;
}

// The values themselves of a scalar field, the magnitude of any other.
Part whole(const Field& field) {
  return {field.components != 1, 0};
}

std::optional<ScalarField> generate(const TetMesh& mesh, const std::string& name) {
  const bool radius = name == "radius";
  if (!radius && name != "x" && name != "y" && name != "z") return std::nullopt;
  const Box box = bounds(mesh);
  const Eigen::Vector3d center =
      box.isEmpty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(box.center());
  ScalarField result{name, Location::point, std::vector<double>(mesh.points.size()), 0, 0};
  tbb::parallel_for(Range(0, mesh.points.size(), kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Eigen::Vector3d& p = mesh.points[i];
      result.values[i] = radius ? (p - center).stableNorm() : p[name[0] - 'x'];
    }
  });
  find_range(result);
  return result;
}

ScalarField select_default(const TetMesh& mesh) {
  if (mesh.fields.empty()) return *generate(mesh, "z");
  for (const Field& field : mesh.fields) {
    if (field.components == 1) return take(mesh, field, whole(field), field.name);
  }
  const Field& first = mesh.fields.front();
  return take(mesh, first, whole(first), first.name + ":magnitude");
}

[[noreturn]] void throw_no_field(const TetMesh& mesh, const std::string& spec) {
  std::vector<std::string> known;
  for (const Field& field : mesh.fields) {
    if (std::find(known.begin(), known.end(), field.name) == known.end())
      known.push_back(field.name);
  }
  if (known.empty()) known = {"x", "y", "z", "radius"};
  throw base::InputError(fmt::format("no field '{}'{}", spec, base::suggestion(spec, known)));
}

enum class CellState : std::uint8_t { drawable, degenerate, nan };

CellState state_of(const TetMesh& mesh, const ScalarField& field, std::size_t index) {
  const Cell& cell = mesh.cells[index];
  bool finite = field.location == Location::point || std::isfinite(field.values[index]);
  for (const std::uint32_t vertex : cell) {
    finite = finite && mesh.points[vertex].allFinite();
    if (field.location == Location::point) finite = finite && std::isfinite(field.values[vertex]);
  }
  if (!finite) return CellState::nan;
  const int sign = orientation(mesh.points[cell[0]], mesh.points[cell[1]], mesh.points[cell[2]],
                               mesh.points[cell[3]]);
  return sign == 0 ? CellState::degenerate : CellState::drawable;
}

}  // namespace

Box bounds(const TetMesh& mesh) {
  if (mesh.cells.empty()) {
    Box box;
    for (const Eigen::Vector3d& point : mesh.points) {
      if (point.allFinite()) box.extend(point);
    }
    return box;
  }
  return tbb::parallel_reduce(
      Range(0, mesh.cells.size(), kGrain), Box(),
      [&](const Range& range, Box so_far) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          for (const std::uint32_t vertex : mesh.cells[i]) {
            if (mesh.points[vertex].allFinite()) so_far.extend(mesh.points[vertex]);
          }
        }
        return so_far;
      },
      [](const Box& a, const Box& b) { return a.merged(b); });
}

ScalarField select_scalar(const TetMesh& mesh, const std::string& spec) {
  if (spec.empty()) return select_default(mesh);
  if (const Field* field = find_located(mesh, spec)) return take(mesh, *field, whole(*field), spec);
  const std::size_t colon = spec.rfind(':');
  if (colon != std::string::npos) {
    const std::string_view name = std::string_view(spec).substr(0, colon);
    if (const Field* field = find_located(mesh, name)) {
      const Part part = parse_part(*field, std::string_view(spec).substr(colon + 1));
      return take(mesh, *field, part, spec);
    }
  }
  if (std::optional<ScalarField> generated = generate(mesh, spec)) return *std::move(generated);
  throw_no_field(mesh, spec);
}

Drawable find_drawable(const TetMesh& mesh, const ScalarField& field) {
  const std::size_t count = mesh.cells.size();
  const std::size_t chunks = (count + kGrain - 1) / kGrain;
  std::vector<CellState> states(count);
  std::vector<std::size_t> starts(chunks + 1, 0);  // starts[i + 1]: first the number in chunk i
  std::vector<std::size_t> degenerate(chunks, 0);
  std::vector<std::size_t> nan(chunks, 0);
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kGrain; i < std::min(count, (chunk + 1) * kGrain); ++i) {
      states[i] = state_of(mesh, field, i);
      if (states[i] == CellState::drawable) ++starts[chunk + 1];
      if (states[i] == CellState::degenerate) ++degenerate[chunk];
      if (states[i] == CellState::nan) ++nan[chunk];
    }
  });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  Drawable result;
  result.degenerate = std::accumulate(degenerate.begin(), degenerate.end(), std::size_t{0});
  result.nan = std::accumulate(nan.begin(), nan.end(), std::size_t{0});
  result.cells.resize(starts[chunks]);
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
    std::size_t next = starts[chunk];
    for (std::size_t i = chunk * kGrain; i < std::min(count, (chunk + 1) * kGrain); ++i) {
      if (states[i] == CellState::drawable) result.cells[next++] = static_cast<std::uint32_t>(i);
    }
  });
  return result;
}

}  // namespace tetraglass::mesh
