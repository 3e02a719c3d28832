#include "mesh/read_points.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/file_name.h"
#include "mesh/number_text.h"

namespace tetraglass::mesh {
namespace {

/// The next line that is not empty, without its remark; nothing at the end.
std::optional<std::string_view> next_line(std::string_view& text, std::size_t& number) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t\r,;") != std::string_view::npos) return line;
  }
  return std::nullopt;
}

std::vector<std::string> names_of(std::string_view line) {
  std::vector<std::string> names;
  constexpr std::string_view kBetween = " \t\r,;\"";
  for (std::size_t start = line.find_first_not_of(kBetween); start != std::string_view::npos;) {
    const std::size_t stop = std::min(line.find_first_of(kBetween, start), line.size());
    names.emplace_back(line.substr(start, stop - start));
    start = line.find_first_not_of(kBetween, stop);
  }
  return names;
}

/// Whether the numbers are a grid of PLOT3D: its sizes (after the number of grids, if there are
/// several), then three coordinates of each point, perhaps with a mark.
bool is_plot3d(const std::vector<double>& numbers) {
  const auto is_size = [](double value) {
    constexpr double kMost = 1e9;
    return value >= 1 && value <= kMost && value == std::floor(value);
  };
  const auto fits = [&](std::size_t first, std::size_t grids) {
    if (numbers.size() < first + 3 * grids) return false;
    double points = 0;
    for (std::size_t i = first; i < first + 3 * grids; i += 3) {
      if (!is_size(numbers[i]) || !is_size(numbers[i + 1]) || !is_size(numbers[i + 2]))
        return false;
      points += numbers[i] * numbers[i + 1] * numbers[i + 2];
    }
    const auto rest = static_cast<double>(numbers.size() - first - 3 * grids);
    return rest == 3 * points || rest == 4 * points;
  };
  if (numbers.empty() || !is_size(numbers[0])) return false;
  return fits(0, 1) || (numbers[0] < static_cast<double>(numbers.size()) &&
                        fits(1, static_cast<std::size_t>(numbers[0])));
}

}  // namespace

bool is_point_list(const std::string& file) {
  const std::string content = content_of(file);
  if (!is_text(content)) return false;
  std::string_view text = content;
  std::size_t line_number = 0;
  std::size_t columns = 0;
  bool first = true;
  while (const auto line = next_line(text, line_number)) {
    const auto numbers = parse_numbers(*line);
    if (!numbers && !first) return false;
    first = false;
    if (!numbers) continue;  // names
    if (columns == 0) columns = numbers->size();
    if (columns < 3 || numbers->size() != columns) return false;
  }
  if (columns == 0) return false;
  const auto all = parse_numbers(content);
  return !all || !is_plot3d(*all);
}

MeshData read_points(const std::string& file) {
  const std::string content = content_of(file);
  std::string_view text = content;
  std::size_t line_number = 0;
  MeshData mesh;
  std::vector<std::string> names;
  const auto fail = [&](const std::string& what) {
    throw base::ReadError(file, fmt::format("line {}: {}", line_number, what));
  };
  while (const auto line = next_line(text, line_number)) {
    const auto numbers = parse_numbers(*line);
    if (!numbers && mesh.points.empty() && names.empty()) {
      names = names_of(*line);
      continue;
    }
    if (!numbers || numbers->size() < 3) fail("is not three coordinates and values");
    if (mesh.points.empty()) {
      for (std::size_t i = 3; i < numbers->size(); ++i) {
        const bool has_name = names.size() == numbers->size();
        mesh.fields.push_back(
            {has_name ? names[i] : fmt::format("column {}", i), Location::point, 1, {}});
      }
    }
    if (numbers->size() != 3 + mesh.fields.size()) {
      fail(fmt::format("has {} numbers, the lines before {}", numbers->size(),
                       3 + mesh.fields.size()));
    }
    mesh.points.emplace_back(numbers->data());
    for (std::size_t i = 3; i < numbers->size(); ++i) {
      mesh.fields[i - 3].values.push_back((*numbers)[i]);
    }
  }
  return mesh;
}

}  // namespace tetraglass::mesh
