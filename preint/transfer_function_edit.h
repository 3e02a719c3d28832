#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "preint/transfer_function.h"

/// Transfer functions made from others, from isovalues and from the distribution of a field's
/// values.
namespace tetraglass::preint {

/// All extinctions times `factor`. Throws UsageError unless it is finite and >= 0.
[[nodiscard]] TransferFunction scale_extinction(const TransferFunction& tf, double factor);

/// The colors and materials of one function with the extinction of another: control points where
/// either has some, jumps where either jumps.
[[nodiscard]] TransferFunction with_extinction_of(const TransferFunction& colors,
                                                  const TransferFunction& extinction);

/// The function with its first to last value spread over the same range logarithmically: for fields
/// over many orders of magnitude. v takes what `tf` has at low + (high - low) log(v / low) /
/// log(high / low). Control points are added so that color and extinction differ from that by at
/// most 1/1024 of their change between two control points of `tf`. Throws InputError where the
/// first value is not positive.
[[nodiscard]] TransferFunction with_logarithmic_values(const TransferFunction& tf);

/// Soft isosurfaces: extinction that rises linearly from 0 to a peak at each isovalue and falls
/// again, 0 elsewhere. A tent reaches `half_width` (in the field's unit) to both sides, less where
/// the neighbouring tent would overlap. A ray on which the field runs once from `low` to `high`
/// over the whole `diagonal` loses the fraction `opacity` in each tent. Colors: those of the preset
/// `colors` over [low, high]. Throws UsageError for no isovalue, an isovalue that is not finite,
/// half_width <= 0, opacity outside [0, 1), and as `preset` does.
[[nodiscard]] TransferFunction tents(std::vector<double> isovalues, double half_width,
                                     double opacity, const std::string& colors, double low,
                                     double high, double diagonal);

/// How often values occur: counts of equal bins from `low` to `high`.
struct Histogram {
  double low = 0;
  double high = 1;
  std::vector<std::uint64_t> counts;
};

/// Values outside [low, high] and NaN are not counted. Throws UsageError unless low < high and bins
/// > 0.
[[nodiscard]] Histogram histogram(std::span<const double> values, double low, double high,
                                  std::size_t bins);

/// The colors of `tf` with an extinction that hides what is common and shows what is rare:
/// proportional to 1 / (1 + p bins), p the share of the bin, linear between the centres of bins.
/// Scaled so that a ray along the `diagonal` that meets the values as often as the histogram has
/// the optical depth `mean_depth`. Throws InputError for an empty histogram, UsageError for a depth
/// or diagonal that is not positive.
[[nodiscard]] TransferFunction automatic_extinction(const TransferFunction& tf,
                                                    const Histogram& histogram, double mean_depth,
                                                    double diagonal);

}  // namespace tetraglass::preint
