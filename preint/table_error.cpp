#include "preint/table_error.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/errors.h"
#include "preint/segment_integral.h"
#include "preint/table_axis.h"

namespace tetraglass::preint {
namespace {

constexpr std::size_t kSmallest = 16;   // samples per axis to begin with
constexpr std::size_t kSnapped = 1024;  // places to find out which axis is the coarser one

std::size_t bytes(std::size_t n, std::size_t m) {
  return 4 * sizeof(float) * n * n * m;
}

/// Between two samples of an axis.
struct Position {
  std::size_t lower = 0;
  double fraction = 0;
};

Position position(double coordinate, int samples, bool& clamped) {
  const double last = samples - 1;
  if (!(coordinate >= 0) || coordinate > last) clamped = true;
  const double inside = std::min(std::max(0.0, coordinate), last);
  const auto lower =
      std::min(static_cast<std::size_t>(inside), static_cast<std::size_t>(samples - 2));
  return {lower, inside - static_cast<double>(lower)};
}

double value_coordinate(double low, double high, int n, double value) {
  return (value - low) / (high - low) * (n - 1);
}

Eigen::Array4d bilinear(const float* slice, std::size_t n, const Position& front,
                        const Position& back) {
  const auto entry = [&](std::size_t f, std::size_t b) {
    return Eigen::Map<const Eigen::Array4f>(slice + 4 * ((back.lower + b) * n + front.lower + f))
        .cast<double>()
        .eval();
  };
  const double x = front.fraction, y = back.fraction;
  return (1 - y) * ((1 - x) * entry(0, 0) + x * entry(1, 0)) +
         y * ((1 - x) * entry(0, 1) + x * entry(1, 1));
}

double difference(const Eigen::Array4d& rgba, const Radiance& exact) {
  return std::max((rgba.head<3>() - exact.color).abs().maxCoeff(),
                  std::abs(rgba[3] - (1 - exact.transmittance)));
}

/// Which coordinates are moved to the nearest sample, to see the error of the others alone.
enum class Snap { nothing, values, length };

double on_sample(double x, int samples, bool snap) {
  return snap ? std::round(x * (samples - 1)) / (samples - 1) : x;
}

double measure(const Table3D& table, const TransferFunction& tf, const LengthRange& lengths,
               std::size_t samples, Snap snap) {
  const auto coordinate = [&](double length) {
    return length_coordinate(table.axis, table.max_length, table.m, length) / (table.m - 1);
  };
  const double shortest = coordinate(lengths.shortest);
  const double longest = std::min(1.0, coordinate(lengths.longest));
  double worst = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    const auto [x, y, z] = evenly_spread(i);
    const auto value = [&](double t) {
      const double s = on_sample(t, table.n, snap == Snap::values);
      return table.low * (1 - s) + table.high * s;
    };
    // Evenly over the samples of the axis, and so over what the axis resolves.
    const double l = on_sample(shortest * (1 - z) + longest * z, table.m, snap == Snap::length);
    const double length = length_at(table.axis, table.max_length, table.m, l * (table.m - 1));
    const Segment segment{value(x), value(y), length};
    const Lookup found = lookup(table, segment.front, segment.back, length);
    worst = std::max(worst, difference(found.rgba, integrate_full(tf, segment, kFloatTolerance)));
  }
  return worst;
}

}  // namespace

// Multiples of 1/g, 1/g^2, 1/g^3 modulo 1 with g^4 = g + 1.
std::array<double, 3> evenly_spread(std::size_t i) {
  constexpr double kG = 1.2207440846057596;
  std::array<double, 3> result{};
  double step = 1;
  for (double& x : result) {
    step /= kG;
    const double turns = 0.5 + step * static_cast<double>(i);
    x = turns - std::floor(turns);
  }
  return result;
}

Lookup lookup(const Table2D& table, double front, double back) {
  Lookup result;
  const auto axis = [&](double v) {
    return position(value_coordinate(table.low, table.high, table.n, v), table.n, result.clamped);
  };
  const Position f = axis(front), b = axis(back);
  result.rgba = bilinear(table.rgba.data(), static_cast<std::size_t>(table.n), f, b);
  return result;
}

Lookup lookup(const Table3D& table, double front, double back, double length) {
  Lookup result;
  const auto axis = [&](double v) {
    return position(value_coordinate(table.low, table.high, table.n, v), table.n, result.clamped);
  };
  const Position f = axis(front), b = axis(back);
  const Position l = position(length_coordinate(table.axis, table.max_length, table.m, length),
                              table.m, result.clamped);
  const auto n = static_cast<std::size_t>(table.n);
  const float* slice = table.rgba.data() + 4 * l.lower * n * n;
  result.rgba = (1 - l.fraction) * bilinear(slice, n, f, b) +
                l.fraction * bilinear(slice + 4 * n * n, n, f, b);
  return result;
}

double slab_table_error(const Table2D& table, const TransferFunction& tf, double length,
                        std::size_t samples) {
  double worst = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    const auto [x, y, unused] = evenly_spread(i);
    const Segment segment{table.low * (1 - x) + table.high * x,
                          table.low * (1 - y) + table.high * y, length};
    const Lookup found = lookup(table, segment.front, segment.back);
    worst = std::max(worst, difference(found.rgba, integrate_full(tf, segment, kFloatTolerance)));
  }
  return worst;
}

double full_table_error(const Table3D& table, const TransferFunction& tf, std::size_t samples) {
  return full_table_error(table, tf, {0, table.max_length}, samples);
}

double full_table_error(const Table3D& table, const TransferFunction& tf,
                        const LengthRange& lengths, std::size_t samples) {
  return measure(table, tf, lengths, samples, Snap::nothing);
}

Table2D choose_slab_table(const TransferFunction& tf, double low, double high, double length,
                          double max_error, std::size_t max_bytes) {
  std::optional<Table2D> best;
  for (std::size_t n = kSmallest; !best || bytes(n, 1) <= max_bytes; n *= 2) {
    Table2D table = slab_table(tf, low, high, length, static_cast<int>(n));
    table.max_error = slab_table_error(table, tf, length);
    if (!best || *table.max_error < *best->max_error) best = std::move(table);
    if (*best->max_error <= max_error) break;
  }
  return *std::move(best);
}

Table3D choose_full_table(const TransferFunction& tf, double low, double high,
                          const LengthRange& lengths, double max_error, std::size_t max_bytes) {
  if (!(0 <= lengths.shortest && lengths.shortest <= lengths.longest)) {
    throw base::UsageError(
        fmt::format("lengths from {} to {} are no range", lengths.shortest, lengths.longest));
  }
  std::size_t n = kSmallest, m = kSmallest;
  const auto make = [&](LengthAxis axis) {
    Table3D table = full_table(tf, low, high, lengths.longest, static_cast<int>(n),
                               static_cast<int>(m), TableMethod::incremental, axis);
    table.max_error = full_table_error(table, tf, lengths);
    return table;
  };
  const auto length_error = [&](const Table3D& t) {
    return measure(t, tf, lengths, kSnapped, Snap::values);
  };
  Table3D table = make(LengthAxis::linear);
  {
    Table3D other = make(LengthAxis::logarithmic);
    if (length_error(other) < length_error(table)) table = std::move(other);
  }
  Table3D best = table;
  while (*best.max_error > max_error) {
    const bool finer_lengths =
        length_error(table) > measure(table, tf, lengths, kSnapped, Snap::length);
    (finer_lengths ? m : n) *= 2;
    if (bytes(n, m) > max_bytes) break;
    table = make(table.axis);
    if (*table.max_error < *best.max_error) best = table;
  }
  return best;
}

}  // namespace tetraglass::preint
