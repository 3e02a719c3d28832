#include "mesh/med_fields.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <med.h>

#include "base/errors.h"
#include "mesh/time_step.h"

namespace tetraglass::mesh {
namespace {

using Name = std::array<char, MED_NAME_SIZE + 1>;

class MedFields {
 public:
  MedFields(med_idt id, const std::string& file, const char* mesh_name,
            std::span<const MedRun> runs, MeshData& mesh)
      : id_(id), file_(file), mesh_name_(mesh_name), runs_(runs), mesh_(mesh) {}

  void read(const std::string& time);

 private:
  struct Step {
    med_int number;
    med_int iteration;
    double time;
  };
  /// A field of the mesh that is read.
  struct Variable {
    std::string name;
    med_field_type type;
    std::size_t components;
    std::vector<Step> steps;
  };

  void check(med_err status, const std::string& what) const {
    if (status < 0) throw base::ReadError(file_, "is damaged: its " + what + " cannot be read");
  }
  [[nodiscard]] std::vector<Variable> variables() const;
  void read_field(const Variable& variable, const Step& step);
  bool read_values(const Variable& variable, const Step& step, med_entity_type entity,
                   med_geometry_type type, std::span<double> values);
  [[nodiscard]] std::vector<double> stored_values(const Variable& variable, const Step& step,
                                                  med_entity_type entity, med_geometry_type type,
                                                  const char* profile, std::size_t size) const;

  med_idt id_;
  const std::string& file_;
  const char* mesh_name_;
  std::span<const MedRun> runs_;
  MeshData& mesh_;
  bool averaged_ = false;  ///< values at integration points of the field being read
};

std::vector<MedFields::Variable> MedFields::variables() const {
  std::vector<Variable> all;
  const med_int fields = std::max<med_int>(MEDnField(id_), 0);
  for (int i = 1; i <= fields; ++i) {
    const med_int components = MEDfieldnComponent(id_, i);
    constexpr med_int kMost = 100'000;
    if (components < 1 || components > kMost) {
      throw base::ReadError(file_, "is damaged: a field has no components");
    }
    const auto n = static_cast<std::size_t>(components);
    std::vector<char> names(n * MED_SNAME_SIZE + 1);
    std::vector<char> units(n * MED_SNAME_SIZE + 1);
    std::array<char, MED_SNAME_SIZE + 1> time_unit{};
    Name name{};
    Name mesh{};
    med_bool is_local = MED_TRUE;
    med_int steps = 0;
    Variable variable{{}, MED_FLOAT64, n, {}};
    check(MEDfieldInfo(id_, i, name.data(), mesh.data(), &is_local, &variable.type, names.data(),
                       units.data(), time_unit.data(), &steps),
          "fields");
    if (std::strncmp(mesh.data(), mesh_name_, MED_NAME_SIZE) != 0) continue;
    variable.name = name.data();  // as stored, with the blanks that the library wants
    for (int k = 1; k <= steps; ++k) {
      Step step{};
      check(
          MEDfieldComputingStepInfo(id_, name.data(), k, &step.number, &step.iteration, &step.time),
          "time steps");
      variable.steps.push_back(step);
    }
    all.push_back(std::move(variable));
  }
  return all;
}

void MedFields::read(const std::string& time) {
  const std::vector<Variable> all = variables();
  std::vector<double> times;
  for (const Variable& variable : all) {
    for (const Step& step : variable.steps) {
      if (step.number != MED_NO_DT) times.push_back(step.time);
    }
  }
  std::ranges::sort(times);
  times.erase(std::ranges::unique(times).begin(), times.end());
  std::optional<double> wanted;
  if (!times.empty()) {
    const std::size_t step = find_time_step(time, times);
    wanted = times[step];
    note_time_step(mesh_.notes, step, times);
  }
  for (const Variable& variable : all) {
    // Of several iterations of one step the last one counts.
    const auto found =
        std::find_if(variable.steps.rbegin(), variable.steps.rend(), [&](const Step& step) {
          return step.number == MED_NO_DT || (wanted && step.time == *wanted);
        });
    if (found != variable.steps.rend()) {
      read_field(variable, *found);
    } else {
      mesh_.notes.push_back(fmt::format("'{}' has no values at that time and is left out",
                                        med_text(variable.name.data(), variable.name.size())));
    }
  }
}

void MedFields::read_field(const Variable& variable, const Step& step) {
  const std::size_t n = variable.components;
  const std::string name = med_text(variable.name.data(), variable.name.size());
  const auto empty = [&](Location location, std::size_t places) {
    return Field{name, location, static_cast<int>(n),
                 std::vector<double>(places * n, std::numeric_limits<double>::quiet_NaN())};
  };
  averaged_ = false;
  bool any = false;
  Field at_points = empty(Location::point, mesh_.points.size());
  if (read_values(variable, step, MED_NODE, MED_NONE, at_points.values)) {
    mesh_.fields.push_back(std::move(at_points));
    any = true;
  }
  Field in_cells = empty(Location::cell, mesh_.cell_count());
  bool any_cell = false;
  for (const MedRun& run : runs_) {
    const auto part = std::span(in_cells.values).subspan(run.first * n, run.count * n);
    if (read_values(variable, step, MED_CELL, static_cast<med_geometry_type>(run.type), part))
      any_cell = true;
  }
  if (any_cell) mesh_.fields.push_back(std::move(in_cells));
  if (averaged_) {
    mesh_.notes.push_back(
        fmt::format("'{}': of values at integration points the mean of each cell", name));
  }
  if (!any && !any_cell) {
    mesh_.notes.push_back(
        fmt::format("'{}' is neither at nodes nor in cells and is left out", name));
  }
}

/// Whether there are values of these entities; those without one keep theirs.
bool MedFields::read_values(const Variable& variable, const Step& step, med_entity_type entity,
                            med_geometry_type type, std::span<double> values) {
  Name profile{};
  Name localization{};
  const med_int profiles = MEDfieldnProfile(id_, variable.name.c_str(), step.number, step.iteration,
                                            entity, type, profile.data(), localization.data());
  const std::size_t n = variable.components;
  const std::size_t places = values.size() / n;
  for (int i = 1; i <= profiles; ++i) {
    med_int size = 0;
    med_int points = 0;
    const med_int count = MEDfieldnValueWithProfile(
        id_, variable.name.c_str(), step.number, step.iteration, entity, type, i,
        MED_COMPACT_STMODE, profile.data(), &size, localization.data(), &points);
    if (count < 1) continue;
    const std::string what =
        fmt::format("field '{}'", med_text(variable.name.data(), MED_NAME_SIZE));
    const auto tuples = static_cast<std::size_t>(count);
    const auto each = static_cast<std::size_t>(std::max<med_int>(points, 1));
    std::vector<med_int> at;
    if (med_text(profile.data(), MED_NAME_SIZE).empty()) {
      if (tuples != places) check(-1, what);
    } else {
      at.resize(tuples);
      if (size != count || MEDprofileSizeByName(id_, profile.data()) != size) check(-1, what);
      check(MEDprofileRd(id_, profile.data(), at.data()), what);
    }
    const std::vector<double> stored =
        stored_values(variable, step, entity, type, profile.data(), tuples * each * n);
    for (std::size_t k = 0; k < tuples; ++k) {
      const std::size_t place = at.empty() ? k : static_cast<std::size_t>(at[k]) - 1;
      if (place >= places) check(-1, what);
      for (std::size_t c = 0; c < n; ++c) {
        double sum = 0;
        for (std::size_t g = 0; g < each; ++g) sum += stored[(k * each + g) * n + c];
        values[place * n + c] = sum / static_cast<double>(each);
      }
    }
    averaged_ = averaged_ || each > 1;
  }
  return profiles > 0;
}

std::vector<double> MedFields::stored_values(const Variable& variable, const Step& step,
                                             med_entity_type entity, med_geometry_type type,
                                             const char* profile, std::size_t size) const {
  const auto get = [&](auto zero) {
    std::vector<decltype(zero)> values(size);
    check(MEDfieldValueWithProfileRd(id_, variable.name.c_str(), step.number, step.iteration,
                                     entity, type, MED_COMPACT_STMODE, profile, MED_FULL_INTERLACE,
                                     MED_ALL_CONSTITUENT,
                                     reinterpret_cast<unsigned char*>(values.data())),
          fmt::format("field '{}'", med_text(variable.name.data(), MED_NAME_SIZE)));
    return std::vector<double>(values.begin(), values.end());
  };
  switch (variable.type) {
    case MED_FLOAT32:
      return get(float{});
    case MED_INT32:
      return get(std::int32_t{});
    case MED_INT64:
      return get(std::int64_t{});
    case MED_INT:
      return get(med_int{});
    default:
      return get(double{});
  }
}

}  // namespace

std::string med_text(const char* first, std::size_t size) {
  std::string name(first, ::strnlen(first, size));
  name.erase(name.find_last_not_of(' ') + 1);
  return name;
}

void read_med_fields(std::int64_t id, const std::string& file, const char* mesh_name,
                     std::span<const MedRun> runs, const std::string& time, MeshData& mesh) {
  MedFields(id, file, mesh_name, runs, mesh).read(time);
}

}  // namespace tetraglass::mesh
