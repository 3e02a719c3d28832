#include "mesh/time_step.h"

#include <charconv>
#include <cmath>
#include <regex>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/number_text.h"

namespace tetraglass::mesh {

std::size_t find_time_step(const std::string& wanted, std::span<const double> times) {
  if (wanted.empty() || wanted == "last") return times.size() - 1;
  constexpr std::string_view kIndex = "index:";
  if (wanted.starts_with(kIndex)) {
    std::size_t index = 0;
    const char* first = wanted.data() + kIndex.size();
    const char* end = wanted.data() + wanted.size();
    const auto [stop, error] = std::from_chars(first, end, index);
    if (error != std::errc() || stop != end || index >= times.size()) {
      throw NoTimeStepError(fmt::format("there is no time step '{}'; there are index:0 to index:{}",
                                        wanted, times.size() - 1),
                            times.size());
    }
    return index;
  }
  const auto value = parse_number(wanted);
  if (!value || !std::isfinite(*value)) {
    throw base::UsageError(
        fmt::format("'{}' is no time; give 'last', a time value or 'index:N'", wanted));
  }
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (std::abs(times[i] - *value) < std::abs(times[nearest] - *value)) nearest = i;
  }
  return nearest;
}

void note_time_step(std::vector<std::string>& notes, std::size_t step,
                    std::span<const double> times, const std::string& of) {
  if (times.size() < 2) return;
  notes.push_back(
      fmt::format("{}time step {} of {} (time {:g})", of, step, times.size(), times[step]));
}

std::optional<NotedTimeStep> noted_time_step(std::span<const std::string> notes) {
  static const std::regex kNote(R"((?:^|: )time step (\d+) of (\d+) \(time (\S+)\)$)");
  for (const std::string& note : notes) {
    std::smatch match;
    if (!std::regex_search(note, match, kNote)) continue;
    return NotedTimeStep{std::stoul(match[1]), std::stoul(match[2]), match[3]};
  }
  return std::nullopt;
}

}  // namespace tetraglass::mesh
