#include "apps/options.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include <fmt/format.h>

namespace tetraglass::apps {
namespace {

constexpr int kLargestSide = 65536;  // pixels: 64 GiB for a square picture

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

double parse_whole(std::string_view text, std::string_view option, double least, double most) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole =
      error == std::errc() && end == text.data() + text.size() && value == std::floor(value);
  if (!whole || value < least) {
    throw base::UsageError(
        fmt::format("{} needs a whole number of at least {}, not '{}'", option, least, text));
  }
  if (value > most) {
    throw base::UsageError(
        fmt::format("{} can be no more than {:.0f}, and not '{}'", option, most, text));
  }
  return value;
}

}  // namespace

double parse_number(std::string_view text, std::string_view option) {
  std::string_view digits = text;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) {
    throw base::UsageError(fmt::format("{} needs a finite number, not '{}'", option, text));
  }
  return value;
}

int parse_count(std::string_view text, std::string_view option, int least) {
  return static_cast<int>(parse_whole(text, option, least, std::numeric_limits<int>::max()));
}

std::size_t parse_bytes(std::string_view text, std::string_view option) {
  constexpr double kMost = 9007199254740992;  // 2^53: doubles hold all whole numbers up to it
  return static_cast<std::size_t>(parse_whole(text, option, 1, kMost));
}

std::vector<double> parse_numbers(std::string_view text, std::string_view option, std::size_t least,
                                  std::size_t most) {
  std::vector<double> values;
  const std::vector<std::string_view> parts = split(text, ',');
  if (parts.size() < least || parts.size() > most) {
    throw base::UsageError(fmt::format(
        "{} needs {} numbers with commas between them, not '{}'", option,
        least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most), text));
  }
  values.reserve(parts.size());
  for (const std::string_view part : parts) values.push_back(parse_number(part, option));
  return values;
}

Eigen::Vector3d parse_vector(std::string_view text, std::string_view option) {
  const std::vector<double> v = parse_numbers(text, option, 3, 3);
  return {v[0], v[1], v[2]};
}

Eigen::Vector3d parse_direction(std::string_view text, std::string_view option) {
  std::string_view axis = text;
  double sign = 1;
  if (!axis.empty() && (axis.front() == '+' || axis.front() == '-')) {
    sign = axis.front() == '-' ? -1 : 1;
    axis.remove_prefix(1);
  }
  if (axis == "x") return {sign, 0, 0};
  if (axis == "y") return {0, sign, 0};
  if (axis == "z") return {0, 0, sign};
  if (text.find(',') == std::string_view::npos) {
    throw base::UsageError(fmt::format(
        "{} needs a direction: +x, -x, +y, -y, +z, -z or X,Y,Z, not '{}'", option, text));
  }
  Eigen::Vector3d direction = parse_vector(text, option);
  if (!(direction.stableNorm() > 0))
    throw base::UsageError(fmt::format("{} needs a direction that is not 0,0,0", option));
  return direction;
}

std::pair<int, int> parse_size(std::string_view text, std::string_view option) {
  const std::vector<std::string_view> parts = split(text, 'x');
  if (parts.size() != 2)
    throw base::UsageError(fmt::format("{} needs WIDTHxHEIGHT, not '{}'", option, text));
  const int width = parse_count(parts[0], option, 1);
  const int height = parse_count(parts[1], option, 1);
  if (width > kLargestSide || height > kLargestSide) {
    throw base::UsageError(
        fmt::format("{} can be at most {} pixels each way", option, kLargestSide));
  }
  return {width, height};
}

void check_side(int pixels, int samples) {
  if (pixels > kLargestSide / samples) {
    throw base::UsageError(fmt::format("{0} pixels of {1} x {1} samples each way are more than {2}",
                                       pixels, samples, kLargestSide));
  }
}

std::pair<double, double> parse_range(std::string_view text, std::string_view option) {
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() != 2)
    throw base::UsageError(fmt::format("{} needs LOW:HIGH, not '{}'", option, text));
  const double low = parse_number(parts[0], option);
  const double high = parse_number(parts[1], option);
  if (low > high) throw base::UsageError(fmt::format("{}: {} lies above {}", option, low, high));
  return {low, high};
}

}  // namespace tetraglass::apps
