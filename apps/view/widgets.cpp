#include "apps/view/widgets.h"

#include <algorithm>
#include <array>

#include <imgui.h>

#include "project/image_file.h"

namespace tetraglass::apps::view {

bool choose(const char* label, const std::vector<std::string>& names, std::string& chosen) {
  bool changed = false;
  if (!ImGui::BeginCombo(label, chosen.empty() ? "default" : chosen.c_str())) return false;
  for (const std::string& name : names) {
    if (ImGui::Selectable(name.empty() ? "default" : name.c_str(), name == chosen) &&
        name != chosen) {
      chosen = name;
      changed = true;
    }
  }
  ImGui::EndCombo();
  return changed;
}

bool slider(const char* label, double& value, double low, double high, const char* format,
            bool logarithmic) {
  return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format,
                             logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
}

bool edit_color(const char* label, preint::Color& color, bool with_label) {
  std::array<float, 3> shown{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double channel = color[static_cast<Eigen::Index>(i)];
    shown[i] = static_cast<float>(project::srgb_encode(std::clamp(channel, 0.0, 1.0)));
  }
  if (!ImGui::ColorEdit3(
          label, shown.data(),
          ImGuiColorEditFlags_NoInputs | (with_label ? 0 : ImGuiColorEditFlags_NoLabel)))
    return false;
  for (std::size_t i = 0; i < 3; ++i) {
    color[static_cast<Eigen::Index>(i)] = project::srgb_decode(static_cast<double>(shown[i]));
  }
  return true;
}

}  // namespace tetraglass::apps::view
