#include "apps/built_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/errors.h"
#include "preint/psi_table.h"
#include "preint/ramped_table.h"
#include "preint/segment_integral.h"
#include "preint/table_error.h"

namespace tetraglass::apps {
namespace {

using preint::TransferFunction;

constexpr std::size_t kCheckedEntries = 65536;

std::vector<double> rgba(const preint::Color& color, double alpha) {
  return {color.x(), color.y(), color.z(), alpha};
}

std::vector<double> exact_full(const TableTask& task, const preint::Segment& segment) {
  const preint::Radiance light = integrate_full(task.tf, segment);
  return rgba(light.color, 1 - light.transmittance);
}

std::vector<double> exact_weighted(const TableTask& task, const preint::Segment& segment,
                                   bool back) {
  const preint::RampedRadiance light = integrate_ramped(task.tf, segment);
  return back ? rgba(light.back, light.white_back) : rgba(light.front, 1 - light.transmittance);
}

std::vector<double> exact_material(const TableTask& task, preint::Segment segment) {
  // The entries of length 0 are the limit for short segments.
  if (segment.length == 0) segment.length = std::ldexp(task.length, -100);
  const TransferFunction materials = materials_as_colors(task.tf);
  const preint::RampedRadiance r = integrate_ramped(materials, segment);
  const double opacity = r.white_front + r.white_back;
  if (opacity > 0) return rgba((r.front + r.back) / opacity, r.white_back / opacity);
  return rgba((materials.at(segment.front).color + materials.at(segment.back).color) / 2, 0.5);
}

std::vector<double> exact_iso(const TableTask& task, double front, double back) {
  preint::Color color = preint::Color::Zero();
  double transmittance = 1;
  std::vector<preint::Isosurface> met = task.surfaces;
  const bool rising = front < back;
  std::stable_sort(met.begin(), met.end(), [&](const auto& a, const auto& b) {
    return rising ? a.value < b.value : a.value > b.value;
  });
  for (const preint::Isosurface& surface : met) {
    const double v = surface.value;
    const bool near = std::min(front, back) <= v + task.thickening &&
                      std::max(front, back) >= v - task.thickening;
    if (task.thickening > 0 ? !near : !preint::crosses(front, back, v)) continue;
    color += transmittance * surface.opacity * surface.color;
    transmittance *= 1 - surface.opacity;
  }
  return rgba(color, 1 - transmittance);
}

// gamma = k / (k + 1): infinite depths at 1.
double exact_psi(double front_gamma, double back_gamma) {
  const auto k = [](double gamma) { return gamma / (1 - gamma); };
  return preint::psi(k(front_gamma), k(back_gamma));
}

/// What a table holds exactly, `back_weighted` in the second one of the weighted kind. The axes of
/// psi are gamma.
std::vector<double> exact_at(const TableTask& task, double front, double back, double length,
                             bool back_weighted) {
  switch (task.kind) {
    case TableKind::emission:
      return rgba(integrate_emission(task.tf, {front, back, 1}),
                  optical_depth(task.tf, {front, back, 1}));
    case TableKind::mip:
      return rgba(task.mip_of == preint::MipOf::field ? task.tf.at(std::max(front, back)).color
                                                      : max_color(task.tf, front, back),
                  1);
    case TableKind::iso:
      return exact_iso(task, front, back);
    case TableKind::full2d:
    case TableKind::full3d:
      return exact_full(task, {front, back, length});
    case TableKind::weighted:
      return exact_weighted(task, {front, back, length}, back_weighted);
    case TableKind::material:
      return exact_material(task, {front, back, length});
    case TableKind::psi:
      return {exact_psi(front, back)};
  }
  return {};
}

/// The exact entry i: over (front, back), the lengths if there are several, and the two tables of
/// the weighted kind.
std::vector<double> exact_entry(const TableTask& task, std::size_t i) {
  const auto n = static_cast<std::size_t>(task.n);
  const auto node = [&](std::size_t k) {
    return task.kind == TableKind::psi
               ? static_cast<double>(k) / static_cast<double>(n - 1)
               : preint::table_node(task.low, task.high, task.n, static_cast<int>(k));
  };
  const auto lengths = static_cast<std::size_t>(std::max(task.m, 1));
  const auto l = static_cast<double>(i / (n * n) % lengths);
  const double length =
      task.m == 0 ? task.length : preint::length_at(task.axis, task.length, task.m, l);
  return exact_at(task, node(i % n), node(i / n % n), length, i / (n * n * lengths) == 1);
}

/// One part as a table to look up; of one channel in red.
class LookupTable {
 public:
  LookupTable(const TableTask& task, const BuiltTable& built, std::size_t part)
      : low_(task.kind == TableKind::psi ? 0 : task.low),
        high_(task.kind == TableKind::psi ? 1 : task.high),
        has_lengths_(task.m > 0) {
    const preint::Entries& from = built.parts[part];
    preint::Entries rgba(from.size() / built.channels * 4, 0.0F);
    for (std::size_t i = 0; i < from.size(); ++i) {
      rgba[i / built.channels * 4 + i % built.channels] = from[i];
    }
    if (has_lengths_) {
      cube_ = {task.n, task.m, low_, high_, task.length, std::move(rgba), task.axis};
    } else {
      square_ = {task.n, low_, high_, std::move(rgba)};
    }
  }

  [[nodiscard]] double value(double t) const { return low_ * (1 - t) + high_ * t; }
  [[nodiscard]] Eigen::Array4d at(double front, double back, double length) const {
    return (has_lengths_ ? lookup(cube_, front, back, length) : lookup(square_, front, back)).rgba;
  }

 private:
  double low_;
  double high_;
  bool has_lengths_;
  preint::Table2D square_;
  preint::Table3D cube_;
};

preint::Entries build_material(const TableTask& t) {
  if (t.m > 0) {
    return material_table_3d(t.tf, t.low, t.high, t.length, t.n, t.m, t.method, t.axis).rgba;
  }
  return material_table(t.tf, t.low, t.high, t.length, t.n, t.method).rgba;
}

std::vector<preint::Entries> build_weighted(const TableTask& t) {
  std::vector<preint::Entries> parts;
  if (t.m > 0) {
    auto tables = ramped_tables_3d(t.tf, t.low, t.high, t.length, t.n, t.m, t.method, t.axis);
    parts.push_back(std::move(tables.front.rgba));
    parts.push_back(std::move(tables.back.rgba));
  } else {
    auto tables = ramped_tables(t.tf, t.low, t.high, t.length, t.n, t.method);
    parts.push_back(std::move(tables.front.rgba));
    parts.push_back(std::move(tables.back.rgba));
  }
  return parts;
}

/// Of all kinds with one table.
preint::Entries build_entries(const TableTask& t) {
  switch (t.kind) {
    case TableKind::emission:
      return emission_table(t.tf, t.low, t.high, t.n, t.method).rgba;
    case TableKind::mip:
      return mip_table(t.tf, t.low, t.high, t.n, t.method, t.mip_of).rgba;
    case TableKind::iso:
      return iso_table(t.surfaces, t.low, t.high, t.n, t.thickening, t.method).rgba;
    case TableKind::full2d:
      return slab_table(t.tf, t.low, t.high, t.length, t.n, t.method).rgba;
    case TableKind::full3d:
      return full_table(t.tf, t.low, t.high, t.length, t.n, t.m, t.method, t.axis).rgba;
    case TableKind::weighted:
      break;
    case TableKind::material:
      return build_material(t);
    case TableKind::psi: {
      const preint::PsiTable table = preint::psi_table(t.n);
      return {table.psi.begin(), table.psi.end()};
    }
  }
  return {};
}

}  // namespace

BuiltTable build(const TableTask& task) {
  const auto n = static_cast<std::size_t>(task.n);
  BuiltTable result;
  if (task.kind == TableKind::weighted) {
    result.parts = build_weighted(task);
  } else {
    result.parts.push_back(build_entries(task));
  }
  result.shape = {n, n};
  if (task.m > 0) result.shape.insert(result.shape.begin(), static_cast<std::size_t>(task.m));
  if (task.kind == TableKind::weighted) result.shape.insert(result.shape.begin(), 2);
  if (task.kind == TableKind::psi) {
    result.channels = 1;
  } else {
    result.shape.push_back(4);
  }
  return result;
}

double choose_size(TableTask& task, double max_error) {
  double error = 0;
  if (task.kind == TableKind::full3d) {
    const preint::Table3D table =
        choose_full_table(task.tf, task.low, task.high, {task.shortest, task.length}, max_error);
    task.n = table.n;
    task.m = table.m;
    task.axis = table.axis;
    error = table.max_error.value();
  } else {
    const preint::Table2D table =
        choose_slab_table(task.tf, task.low, task.high, task.length, max_error);
    task.n = table.n;
    error = table.max_error.value();
  }
  if (error > max_error) {
    throw base::InputError(
        fmt::format("no table of at most 256 MiB has errors below {:.3g}: the best has {:.3g}; "
                    "integrate without a table, or raise --max-error",
                    max_error, error));
  }
  return error;
}

double largest_error(const TableTask& task, const BuiltTable& table) {
  const std::size_t entries = table.entries();
  const std::size_t step =
      entries <= kCheckedEntries ? 1 : (entries / kCheckedEntries) | 1U;  // odd: meets all rows
  double largest = 0;
  for (std::size_t i = 0; i < entries; i += step) {
    const std::vector<double> expected = exact_entry(task, i);
    const std::size_t at = i * table.channels;
    const preint::Entries& part = table.parts[at / table.parts[0].size()];
    for (std::size_t c = 0; c < table.channels; ++c) {
      const double value = part[at % table.parts[0].size() + c];
      largest = std::max(largest, std::abs(value - expected[c]));
    }
  }
  return largest;
}

double largest_lookup_error(const TableTask& task, const BuiltTable& table) {
  constexpr std::size_t kPlaces = 4096;
  const auto nearest = [&](double t) { return std::round(t * (task.n - 1)) / (task.n - 1); };
  double largest = 0;
  for (std::size_t part = 0; part < table.parts.size(); ++part) {
    const LookupTable lookups(task, table, part);
    for (std::size_t i = 0; i < kPlaces; ++i) {
      const auto [x, y, z] = preint::evenly_spread(i);
      const double length =
          task.m == 0 ? task.length
                      : preint::length_at(task.axis, task.length, task.m, z * (task.m - 1));
      const std::vector<double> expected =
          exact_at(task, lookups.value(x), lookups.value(y), length, part == 1);
      const bool snap = task.kind == TableKind::iso;
      const Eigen::Array4d found = lookups.at(lookups.value(snap ? nearest(x) : x),
                                              lookups.value(snap ? nearest(y) : y), length);
      for (std::size_t c = 0; c < table.channels; ++c) {
        largest = std::max(largest, std::abs(found[static_cast<Eigen::Index>(c)] - expected[c]));
      }
    }
  }
  return largest;
}

}  // namespace tetraglass::apps
