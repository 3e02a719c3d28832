#include "apps/view/style.h"

#include <filesystem>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

namespace tetraglass::apps::view {
namespace {

constexpr float kFontPixels = 15;

void set_font(float scale) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  std::error_code ignored;
  // ImGui's own font is small and made of single pixels: for where this one was removed.
  if (std::filesystem::exists(TETRAGLASS_FONT, ignored) &&
      fonts.AddFontFromFileTTF(TETRAGLASS_FONT, scale * kFontPixels) != nullptr) {
    return;
  }
  ImFontConfig config;
  config.SizePixels = scale * kFontPixels;
  fonts.AddFontDefault(&config);
}

}  // namespace

float font_size(const GlWindow& window) {
  float scale = 1;
  glfwGetWindowContentScale(window.handle(), &scale, nullptr);
  return scale * kFontPixels;
}

void set_style(const GlWindow& window) {
  const float scale = font_size(window) / kFontPixels;
  set_font(scale);
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowPadding = {12, 12};
  style.FramePadding = {7, 4};
  style.ItemSpacing = {8, 7};
  style.FrameRounding = 4;
  style.GrabRounding = 4;
  style.WindowRounding = 0;
  style.WindowBorderSize = 0;
  style.PopupRounding = 4;
  style.ScrollbarSize = 12;
  const auto grey = [](float value) { return ImVec4(value, value, value + 0.01F, 1); };
  const auto accent = [](float strength) { return ImVec4(0.24F, 0.52F, 0.78F, strength); };
  ImVec4* colors = style.Colors;
  colors[ImGuiCol_Text] = grey(0.90F);
  colors[ImGuiCol_TextDisabled] = grey(0.58F);
  colors[ImGuiCol_WindowBg] = grey(0.13F);
  colors[ImGuiCol_PopupBg] = grey(0.16F);
  colors[ImGuiCol_TitleBg] = grey(0.18F);
  colors[ImGuiCol_TitleBgActive] = grey(0.20F);
  colors[ImGuiCol_FrameBg] = grey(0.20F);
  colors[ImGuiCol_FrameBgHovered] = grey(0.25F);
  colors[ImGuiCol_FrameBgActive] = grey(0.28F);
  colors[ImGuiCol_Header] = grey(0.13F);
  colors[ImGuiCol_HeaderHovered] = grey(0.20F);
  colors[ImGuiCol_HeaderActive] = grey(0.24F);
  colors[ImGuiCol_Button] = grey(0.24F);
  colors[ImGuiCol_ButtonHovered] = accent(0.8F);
  colors[ImGuiCol_ButtonActive] = accent(1);
  colors[ImGuiCol_SliderGrab] = accent(0.9F);
  colors[ImGuiCol_SliderGrabActive] = accent(1);
  colors[ImGuiCol_CheckMark] = accent(1);
  style.ScaleAllSizes(scale);
}

}  // namespace tetraglass::apps::view
