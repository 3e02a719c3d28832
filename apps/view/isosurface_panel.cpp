#include "apps/view/isosurface_panel.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "apps/options.h"
#include "apps/view/widgets.h"

namespace tetraglass::apps::view {

void draw_isosurface_panel(Viewer& viewer) {
  const SceneFacts& facts = *viewer.facts();
  std::vector<std::string> values = viewer.arguments().isovalues;
  std::vector<preint::Color> colors;
  for (const preint::Isosurface& surface : facts.isosurfaces) colors.push_back(surface.color);
  colors.resize(std::min(colors.size(), values.size()));
  bool changed = false;
  bool changed_colors = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    // Until the picture with this surface is there, nothing is known of its color.
    if (i < colors.size()) {
      changed_colors = edit_color("color", colors[i], false) || changed_colors;
      ImGui::SameLine();
      ImGui::SetNextItemWidth(ImGui::CalcItemWidth() - ImGui::GetFrameHeight() -
                              ImGui::GetStyle().ItemSpacing.x);
    }
    double value = parse_number(values[i], "--isovalue");
    if (slider(i == 0 ? "isovalue" : "##isovalue", value, facts.low, facts.high)) {
      values[i] = fmt::format("{}", value);
      changed = true;
    }
    if (values.size() > 1) {
      ImGui::SameLine();
      if (ImGui::SmallButton("-")) {
        values.erase(values.begin() + static_cast<std::ptrdiff_t>(i));
        if (i < colors.size()) colors.erase(colors.begin() + static_cast<std::ptrdiff_t>(i));
        changed = true;
        changed_colors = !viewer.arguments().iso_colors.empty();
      }
    }
    ImGui::PopID();
  }
  if (ImGui::SmallButton("+ isosurface")) {
    values.push_back(fmt::format("{}", 0.25 * facts.low + 0.75 * facts.high));
    changed = true;
  }
  double opacity = viewer.arguments().iso_opacity.empty()
                       ? 1
                       : parse_number(viewer.arguments().iso_opacity, "--iso-opacity");
  if (slider("opacity", opacity, 0, 1, "%.2f")) {
    viewer.change_scene().iso_opacity = fmt::format("{}", opacity);
  }
  if (changed) viewer.change_scene().isovalues = values;
  if (changed_colors) {
    std::vector<std::string>& texts = viewer.change_scene().iso_colors;
    texts.clear();
    for (const preint::Color& color : colors) texts.push_back(to_text(color.matrix()));
  }
}

}  // namespace tetraglass::apps::view
