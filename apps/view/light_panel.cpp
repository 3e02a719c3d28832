#include "apps/view/light_panel.h"

#include <array>
#include <optional>
#include <utility>
#include <variant>

#include <imgui.h>

#include "apps/view/widgets.h"

namespace tetraglass::apps::view {
namespace {

using project::Lights;
using Light = std::variant<project::DirectionalLight, project::PointLight, project::RectangleLight>;

/// Three numbers, to type or to drag: `speed` for each pixel.
bool edit_vector(const char* label, Eigen::Vector3d& vector, double speed) {
  Eigen::Vector3d edited = vector;
  if (!ImGui::DragScalarN(label, ImGuiDataType_Double, edited.data(), 3, static_cast<float>(speed),
                          nullptr, nullptr, "%.3g") ||
      !edited.allFinite())
    return false;
  vector = edited;
  return true;
}

/// As a headlight shines.
Eigen::Vector3d gaze(const Viewer& viewer) {
  return (viewer.camera()->target - viewer.camera()->eye).normalized();
}

bool edit_place(const Viewer& viewer, project::DirectionalLight& light) {
  Eigen::Vector3d direction = light.direction;
  bool changed = edit_vector("direction", direction, 0.01) && direction.stableNorm() > 0;
  if (ImGui::SmallButton("from the eye")) {
    direction = gaze(viewer);
    changed = true;
  }
  if (changed) light.direction = direction;
  return changed;
}

bool edit_place(const Viewer& viewer, project::PointLight& light) {
  bool changed =
      edit_vector("position", light.position, viewer.facts()->box.diagonal().norm() / 500);
  if (ImGui::SmallButton("at the eye")) {
    light.position = viewer.camera()->eye;
    changed = true;
  }
  return changed;
}

bool edit_place(const Viewer& viewer, project::RectangleLight& light) {
  const double speed = viewer.facts()->box.diagonal().norm() / 500;
  const bool corner = edit_vector("corner", light.corner, speed);
  const bool first = edit_vector("edge 1", light.edges[0], speed);
  const bool second = edit_vector("edge 2", light.edges[1], speed);
  return corner || first || second;
}

/// A color up to white, and how many times as bright; whether it changed.
bool edit_light_color(const char* label, preint::Color& color) {
  const double largest = color.maxCoeff();
  double intensity = largest > 0 ? largest : 1;
  preint::Color hue = color / intensity;
  ImGui::PushID(label);
  bool changed = edit_color(label, hue);
  ImGui::SameLine();
  constexpr double kLeast = 0;
  constexpr double kMost = 4;
  ImGui::SetNextItemWidth(6 * ImGui::GetFontSize());
  changed = ImGui::SliderScalar("##intensity", ImGuiDataType_Double, &intensity, &kLeast, &kMost,
                                "x %.2f", ImGuiSliderFlags_AlwaysClamp) ||
            changed;
  ImGui::PopID();
  if (changed) color = intensity * hue;
  return changed;
}

const char* name_of(const Light& light) {
  constexpr std::array kNames = {"directional", "point", "rectangle"};
  return kNames[light.index()];
}

/// Whether it changed; `removed` where it is to go.
bool edit_light(const Viewer& viewer, Light& light, bool& removed) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(name_of(light));
  ImGui::SameLine();
  removed = ImGui::SmallButton("-");
  return std::visit(
      [&](auto& of_kind) {
        const bool place = edit_place(viewer, of_kind);
        return edit_light_color("color", of_kind.color) || place;
      },
      light);
}

/// Whether something was added.
bool add_light(const Viewer& viewer, Lights& lights) {
  bool added = false;
  if (ImGui::SmallButton("+ directional")) {
    lights.lights.emplace_back(project::DirectionalLight{gaze(viewer)});
    added = true;
  }
  ImGui::SameLine();
  if (ImGui::SmallButton("+ point")) {
    lights.lights.emplace_back(project::PointLight{viewer.camera()->eye});
    added = true;
  }
  return added;
}

}  // namespace

void draw_light_panel(Viewer& viewer) {
  if (viewer.facts() == nullptr || !viewer.camera()) return;
  if (viewer.facts()->shading == project::Shading::none) {
    ImGui::TextDisabled("Nothing is lit: choose a shading (modes iso and full).");
    return;
  }
  const std::optional<Lights>& shown =
      viewer.arguments().own_lights ? viewer.arguments().own_lights : viewer.facts()->lights;
  Lights lights = shown.value_or(Lights{});
  bool changed = false;
  if (!shown) {
    ImGui::TextDisabled("a headlight");
  } else {
    changed = edit_light_color("ambient", lights.ambient);
    std::optional<std::size_t> gone;
    for (std::size_t i = 0; i < lights.lights.size(); ++i) {
      ImGui::PushID(static_cast<int>(i));
      bool removed = false;
      changed = edit_light(viewer, lights.lights[i], removed) || changed;
      if (removed) gone = i;
      ImGui::PopID();
    }
    if (gone) lights.lights.erase(lights.lights.begin() + static_cast<std::ptrdiff_t>(*gone));
    changed = changed || gone;
  }
  changed = add_light(viewer, lights) || changed;
  if (shown) {
    ImGui::SameLine();
    if (ImGui::SmallButton("headlight")) return viewer.set_lights(std::nullopt);
  }
  if (changed) viewer.set_lights(std::move(lights));
}

}  // namespace tetraglass::apps::view
