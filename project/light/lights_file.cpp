#include "project/light/lights_file.h"

#include <variant>

#include <fmt/format.h>

#include "base/output_file.h"

namespace tetraglass::project {
namespace {

template <class Three>
std::string numbers(const Three& v) {
  return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]);
}

std::string place(const DirectionalLight& light) {
  return fmt::format("\"type\": \"directional\", \"direction\": {}", numbers(light.direction));
}

std::string place(const PointLight& light) {
  return fmt::format("\"type\": \"point\", \"position\": {}", numbers(light.position));
}

std::string place(const RectangleLight& light) {
  return fmt::format("\"type\": \"rectangle\", \"corner\": {}, \"edges\": [{}, {}]",
                     numbers(light.corner), numbers(light.edges[0]), numbers(light.edges[1]));
}

}  // namespace

void write_lights(const Lights& lights, const std::string& file) {
  std::string text = fmt::format("{{\"ambient\": {},\n \"lights\": [", numbers(lights.ambient));
  std::string separator = "\n";
  for (const auto& light : lights.lights) {
    text += std::visit(
        [&](const auto& of_kind) {
          return fmt::format("{}  {{{}, \"color\": {}}}", separator, place(of_kind),
                             numbers(of_kind.color));
        },
        light);
    separator = ",\n";
  }
  base::OutputFile output(file);
  output.write(text + "]}\n");
  output.commit();
}

}  // namespace tetraglass::project
