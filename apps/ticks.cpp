#include "apps/ticks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace tetraglass::apps {
namespace {

// Labels longer than this many digits are divided by a power of ten.
constexpr int kMostDigits = 5;

std::string with_minus_sign(std::string text) {
  constexpr std::string_view kMinus = "\u2212";
  for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at)) {
    text.replace(at, 1, kMinus);
  }
  return text;
}

/// 1, 2 or 5 times a power of ten.
struct Step {
  int mantissa = 1;
  int exponent = 0;
};

/// From one step to the next larger one.
Step larger(const Step& step) {
  if (step.mantissa == 1) return {2, step.exponent};
  if (step.mantissa == 2) return {5, step.exponent};
  return {1, step.exponent + 1};
}

/// k steps, rounded once: the double nearest to the number that is written.
double multiple(double k, const Step& step) {
  const double m = k * step.mantissa;
  return step.exponent < 0 ? m / std::pow(10.0, -step.exponent) : m * std::pow(10.0, step.exponent);
}

void write_labels(const Step& step, Ticks& ticks) {
  double largest = 0;
  for (const double value : ticks.values) largest = std::max(largest, std::abs(value));
  const int magnitude = largest > 0 ? static_cast<int>(std::floor(std::log10(largest))) : 0;
  const bool long_labels = magnitude >= kMostDigits || step.exponent < -kMostDigits + 1;
  ticks.exponent = long_labels ? magnitude : 0;
  const int decimals = std::max(0, ticks.exponent - step.exponent);
  for (const double value : ticks.values) {
    const double shown = ticks.exponent < 0 ? value * std::pow(10.0, -ticks.exponent)
                                            : value / std::pow(10.0, ticks.exponent);
    ticks.labels.push_back(with_minus_sign(fmt::format("{:.{}f}", shown + 0.0, decimals)));
  }
}

}  // namespace

Ticks linear_ticks(double low, double high, int most) {
  Ticks ticks;
  const double span = high - low;
  if (!(span > 0) || !std::isfinite(span)) {
    ticks.values = {low};
    ticks.labels = {number_text(low)};
    return ticks;
  }
  Step step{1, static_cast<int>(std::floor(std::log10(span / most)))};
  // Ends that are meant to be on a step may miss it by a rounding of their own.
  const double slack = 1e-9 * span;
  while (true) {
    const double width = multiple(1, step);
    const double first = std::ceil((low - slack) / width);
    const double last = std::floor((high + slack) / width);
    if (last - first + 1 <= most) {
      for (double i = 0; first + i <= last && i < most; ++i) {
        const double value = std::clamp(multiple(first + i, step), low, high);
        // Far from 0, compared with the span, neighbouring multiples may be one number.
        if (ticks.values.empty() || value > ticks.values.back()) ticks.values.push_back(value);
      }
      break;
    }
    if (!std::isfinite(last - first)) break;
    step = larger(step);
  }
  if (ticks.values.empty()) {
    ticks.values = {low};
    ticks.labels = {number_text(low)};
    return ticks;
  }
  write_labels(step, ticks);
  return ticks;
}

Ticks logarithmic_ticks(double low, double high, int most) {
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::ceil(std::log10(high)));
  Ticks ticks;
  const auto collect = [&](const std::vector<int>& mantissas, int stride) {
    ticks = {};
    for (int exponent = first; exponent <= last; ++exponent) {
      if (exponent % stride != 0) continue;
      for (const int mantissa : mantissas) {
        const double value = multiple(1, {mantissa, exponent});
        if (value < low * (1 - 1e-9) || value > high * (1 + 1e-9)) continue;
        ticks.values.push_back(std::clamp(value, low, high));
        const bool plain = exponent >= -3 && exponent < kMostDigits;
        ticks.labels.push_back(plain ? number_text(multiple(1, {mantissa, exponent}))
                               : mantissa == 1
                                   ? power_of_ten(exponent)
                                   : fmt::format("{}·{}", mantissa, power_of_ten(exponent)));
      }
    }
    return ticks.values.size();
  };
  const auto room = static_cast<std::size_t>(std::max(most, 2));
  if (collect({1, 2, 5}, 1) <= room) {
    return ticks.values.size() < 3 ? linear_ticks(low, high, most) : ticks;
  }
  for (int stride = 1; collect({1}, stride) > room; ++stride) {
  }
  return ticks;
}

std::string number_text(double value, int digits) {
  std::string text = fmt::format("{:.{}g}", value + 0.0, digits);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return with_minus_sign(text);
  const int exponent = std::stoi(text.substr(e + 1));
  return with_minus_sign(text.substr(0, e)) + "·" + power_of_ten(exponent);
}

std::string power_of_ten(int exponent) {
  constexpr std::array<std::string_view, 10> kRaised = {"⁰", "¹", "²", "³", "⁴",
                                                        "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = "10";
  for (const char digit : std::to_string(exponent)) {
    text += digit == '-' ? "⁻" : kRaised[static_cast<std::size_t>(digit - '0')];
  }
  return text;
}

}  // namespace tetraglass::apps
