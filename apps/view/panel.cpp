#include "apps/view/panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "apps/options.h"
#include "apps/transfer_function_input.h"

namespace tetraglass::apps::view {
namespace {

using Names = std::vector<std::string>;

/// A list to choose from; whether another name was chosen.
bool choose(const char* label, const Names& names, std::string& chosen) {
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

/// The same for an option of the scene.
void choose_option(Viewer& viewer, const char* label, const Names& names,
                   std::string RenderArguments::*option) {
  std::string chosen = viewer.arguments().*option;
  if (choose(label, names, chosen)) viewer.change_scene().*option = chosen;
}

bool slider(const char* label, double& value, double low, double high, const char* format = "%.5g",
            ImGuiSliderFlags flags = 0) {
  return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format, flags);
}

void show_text(const std::string& text) {
  ImGui::TextUnformatted(text.c_str());
}

void show_file(const Viewer& viewer) {
  const std::string name = std::filesystem::path(viewer.arguments().input).filename().string();
  show_text(name);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s\nDrop another file on the window to open it.",
                      viewer.arguments().input.c_str());
  }
  const SceneFacts* facts = viewer.facts();
  if (facts == nullptr) return;
  ImGui::TextDisabled(
      "%s", fmt::format("{} cells{}", facts->cells,
                        facts->not_drawn > 0 ? fmt::format(", {} not drawn", facts->not_drawn) : "")
                .c_str());
  if (!facts->notes.empty() && ImGui::IsItemHovered()) {
    std::string notes;
    for (const std::string& note : facts->notes) notes += note + "\n";
    ImGui::SetTooltip("%s", notes.c_str());
  }
}

void choose_time(Viewer& viewer, PanelState& state) {
  const SceneFacts* facts = viewer.facts();
  if (facts == nullptr || !facts->time_step) return;
  const mesh::NotedTimeStep& noted = *facts->time_step;
  int step = static_cast<int>(noted.step);
  const int last = static_cast<int>(noted.count) - 1;
  ImGui::SetNextItemWidth(ImGui::CalcItemWidth() - 4 * ImGui::GetFontSize());
  if (ImGui::SliderInt("##time", &step, 0, last, "step %d")) {
    viewer.set_time_step(static_cast<std::size_t>(step));
  }
  ImGui::SameLine();
  if (ImGui::Button(state.playing ? "stop" : "play", {3.4F * ImGui::GetFontSize(), 0}))
    state.playing = !state.playing;
  ImGui::SameLine();
  show_text("time " + noted.time);
}

void choose_field(Viewer& viewer) {
  const SceneFacts* facts = viewer.facts();
  if (facts == nullptr) return;
  std::string field = facts->field;
  if (choose("field", facts->fields, field)) viewer.set_field(field);
}

void set_isovalues(Viewer& viewer) {
  const SceneFacts& facts = *viewer.facts();
  Names values = viewer.arguments().isovalues;
  bool changed = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    double value = parse_number(values[i], "--isovalue");
    if (slider(i == 0 ? "isovalue" : "##isovalue", value, facts.low, facts.high)) {
      values[i] = fmt::format("{}", value);
      changed = true;
    }
    if (values.size() > 1) {
      ImGui::SameLine();
      if (ImGui::SmallButton("-")) {
        values.erase(values.begin() + static_cast<std::ptrdiff_t>(i));
        changed = true;
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
}

void set_opacity_scale(Viewer& viewer) {
  const std::string& text = viewer.arguments().opacity_scale;
  double scale = text.empty() ? 1 : parse_number(text, "--opacity-scale");
  if (slider("opacity x", scale, 0.01, 100, "%.3g", ImGuiSliderFlags_Logarithmic)) {
    viewer.change_scene().opacity_scale = fmt::format("{}", scale);
  }
}

void set_range(Viewer& viewer) {
  const SceneFacts& facts = *viewer.facts();
  if (!(facts.low < facts.high)) return;
  std::array<double, 2> range = {facts.low, facts.high};
  if (!viewer.arguments().range.empty()) {
    std::tie(range[0], range[1]) = parse_range(viewer.arguments().range, "--range");
  }
  const auto speed = static_cast<float>((facts.high - facts.low) / 500);
  if (ImGui::DragScalarN("range", ImGuiDataType_Double, range.data(), 2, speed, nullptr, nullptr,
                         "%.5g") &&
      range[0] < range[1]) {
    viewer.change_scene().range = fmt::format("{}:{}", range[0], range[1]);
  }
}

void set_clip_planes(Viewer& viewer) {
  const mesh::Box& box = viewer.facts()->box;
  Names planes = viewer.arguments().clip;
  bool changed = false;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const std::vector<double> numbers = parse_numbers(planes[i], "--clip", 4, 4);
    const Eigen::Vector3d normal(numbers[0], numbers[1], numbers[2]);
    const double middle = normal.dot(box.center());
    const double half = 0.5 * normal.cwiseAbs().dot(box.sizes());
    double distance = numbers[3];
    if (slider(fmt::format("({:g}, {:g}, {:g})", normal.x(), normal.y(), normal.z()).c_str(),
               distance, middle - half, middle + half)) {
      planes[i] = fmt::format("{},{}", to_text(normal), distance);
      changed = true;
    }
    ImGui::SameLine();
    if (ImGui::SmallButton("-")) {
      planes.erase(planes.begin() + static_cast<std::ptrdiff_t>(i));
      changed = true;
    }
    ImGui::PopID();
  }
  const std::array<std::pair<const char*, Eigen::Vector3d>, 6> sides = {{{"+x", {1, 0, 0}},
                                                                         {"-x", {-1, 0, 0}},
                                                                         {"+y", {0, 1, 0}},
                                                                         {"-y", {0, -1, 0}},
                                                                         {"+z", {0, 0, 1}},
                                                                         {"-z", {0, 0, -1}}}};
  ImGui::AlignTextToFramePadding();
  show_text("cut off");
  for (const auto& [label, normal] : sides) {
    ImGui::SameLine();
    if (ImGui::SmallButton(label)) {
      planes.push_back(fmt::format("{},{}", to_text(normal), normal.dot(box.center())));
      changed = true;
    }
  }
  if (changed) viewer.change_scene().clip = planes;
}

void show_scene(Viewer& viewer, PanelState& state) {
  choose_time(viewer, state);
  choose_field(viewer);
  std::string chosen = viewer.arguments().mode;
  if (choose("mode", {mode_names().begin(), mode_names().end()}, chosen)) viewer.set_mode(chosen);
  if (viewer.facts() == nullptr) return;
  // What belongs to the picture's mode; a change of the mode takes effect with the next picture.
  const std::string& mode = viewer.arguments().mode;
  if (mode != to_string(viewer.facts()->mode)) return;
  if (mode == "iso") set_isovalues(viewer);
  if (mode == "iso" || mode == "full") {
    choose_option(viewer, "shading",
                  mode == "iso" ? Names{"", "none", "flat", "smooth"}
                                : Names{"", "none", "flat", "smooth", "single", "weighted",
                                        "interpolated", "surface"},
                  &RenderArguments::shading);
  }
}

void show_figure(Viewer& viewer) {
  const auto flag = [&](const char* label, bool FigureArguments::*member) {
    bool value = viewer.arguments().figure.*member;
    if (ImGui::Checkbox(label, &value)) viewer.change_figure().*member = value;
  };
  flag("outline", &FigureArguments::outline);
  ImGui::SameLine();
  flag("axes", &FigureArguments::axes);
  ImGui::SameLine();
  flag("legend", &FigureArguments::legend);
  std::array<char, 256> title{};
  viewer.arguments().figure.title.copy(title.data(), title.size() - 1);
  if (ImGui::InputText("title", title.data(), title.size())) {
    viewer.change_figure().title = title.data();
  }
}

void show_colors(Viewer& viewer, PlotState& plot) {
  if (viewer.facts() == nullptr) return;
  Names presets = preint::preset_names();
  std::string name = viewer.arguments().transfer_function;
  if (!is_preset_name(name)) presets.push_back(name);
  const bool edited = viewer.arguments().own_transfer_function.has_value();
  if (edited) {
    // Choosing the preset again is a way back.
    std::string chosen = name + ", edited";
    if (choose("colors", presets, chosen)) viewer.set_transfer_function(chosen);
  } else if (choose("colors", presets, name)) {
    viewer.set_transfer_function(name);
  }
  draw_transfer_function(viewer, plot);
  if (!edited && !has_own_values(name)) set_range(viewer);
  set_opacity_scale(viewer);
}

void show_method(Viewer& viewer) {
  std::string projector = viewer.arguments().projector;
  Names projectors = {"auto", "cpu", "gl", "reference"};
  if (draws_grid(viewer.arguments())) projectors.push_back(projector);
  if (choose("projector", projectors, projector)) viewer.set_projector(projector);
  choose_option(viewer, "sort", {"auto", "none", "centroid", "power", "mpvo", "fragments"},
                &RenderArguments::sort);
  choose_option(viewer, "integrator", {"auto", "exact", "table2d", "table3d", "psi", "linear"},
                &RenderArguments::integrator);
}

void show_numbers(const Viewer& viewer, std::vector<Action>& actions) {
  const Drawn* picture = viewer.picture();
  if (picture == nullptr) return;
  const SceneFacts& facts = *picture->facts;
  std::string stages = fmt::format("project {:.0f}", picture->stats.project_ms);
  if (picture->stats.sort_ms > 0) stages += fmt::format(", sort {:.0f}", picture->stats.sort_ms);
  if (picture->stats.tables_ms > 0)
    stages += fmt::format(", tables {:.0f}", picture->stats.tables_ms);
  if (picture->scene_ms > 0) stages += fmt::format(", scene {:.0f}", picture->scene_ms);
  ImGui::TextDisabled("%s ms", stages.c_str());
  ImGui::TextDisabled("%s", fmt::format("{:.3g} fragments, {} x {} pixels",
                                        static_cast<double>(picture->stats.fragments),
                                        picture->width, picture->height)
                                .c_str());
  if (ImGui::Button("verify")) actions.push_back(Action::verify);
  ImGui::SameLine();
  if (viewer.verified()) {
    show_text(fmt::format("{} pixels: {:.1e} at most", viewer.verified()->pixels,
                          viewer.verified()->max_error));
  } else {
    ImGui::TextDisabled("against the reference");
  }
  if (ImGui::TreeNode("plan")) {
    for (const std::string& line : facts.plan) ImGui::TextWrapped("%s", line.c_str());
    ImGui::TreePop();
  }
}

/// The speed in a line.
void show_speed(const Viewer& viewer) {
  const Drawn* picture = viewer.picture();
  if (picture == nullptr) return ImGui::TextDisabled("reading ...");
  std::string text =
      fmt::format("{:.0f} ms, {:.2g} million cells/s", picture->draw_ms,
                  static_cast<double>(picture->facts->cells) / picture->draw_ms / 1000);
  if (const auto rate = viewer.moving_rate()) text += fmt::format("; moving: {:.1f}/s", *rate);
  ImGui::TextDisabled("%s", text.c_str());
}

void show_camera(Viewer& viewer, std::vector<Action>& actions) {
  if (!viewer.camera()) return;
  bool parallel = viewer.camera()->parallel;
  if (ImGui::Checkbox("parallel", &parallel)) viewer.set_parallel(parallel);
  ImGui::SameLine();
  if (ImGui::Button("see all")) actions.push_back(Action::frame);
}

bool section(const char* label, bool open) {
  return ImGui::CollapsingHeader(label, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

}  // namespace

float panel_width(const PanelState& state) {
  return state.shown ? kPanelWidth * ImGui::GetFontSize() : 0;
}

std::vector<Action> draw_panel(Viewer& viewer, PanelState& state) {
  std::vector<Action> actions;
  if (!state.shown) return actions;
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize({panel_width(state), ImGui::GetIO().DisplaySize.y});
  ImGui::Begin("panel", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
  const float buttons = ImGui::GetFrameHeightWithSpacing() + ImGui::GetTextLineHeightWithSpacing();
  ImGui::BeginChild("sections", {0, -buttons});
  ImGui::PushItemWidth(-6 * ImGui::GetFontSize());
  show_file(viewer);
  if (section("Scene", true)) show_scene(viewer, state);
  if (section("Colors", true)) show_colors(viewer, state.plot);
  if (section("View", true)) show_camera(viewer, actions);
  if (section("Figure", false)) show_figure(viewer);
  if (viewer.facts() != nullptr && section("Cut", false)) set_clip_planes(viewer);
  if (section("Method", false)) show_method(viewer);
  if (section("Numbers", false)) show_numbers(viewer, actions);
  ImGui::PopItemWidth();
  ImGui::EndChild();
  show_speed(viewer);
  if (ImGui::Button("save picture")) actions.push_back(Action::save_picture);
  ImGui::SameLine();
  if (ImGui::Button("copy command")) actions.push_back(Action::copy_command);
  ImGui::SameLine();
  if (ImGui::Button("help")) actions.push_back(Action::help);
  ImGui::SameLine();
  if (ImGui::Button("hide")) actions.push_back(Action::toggle_panel);
  ImGui::End();
  return actions;
}

void draw_help(PanelState& state) {
  if (!state.help) return;
  const ImVec2 middle = ImGui::GetMainViewport()->GetCenter();
  ImGui::SetNextWindowPos(middle, ImGuiCond_Appearing, {0.5F, 0.5F});
  if (ImGui::Begin("Mouse and keys", &state.help,
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                       ImGuiWindowFlags_NoSavedSettings)) {
    if (ImGui::BeginTable("controls", 2, ImGuiTableFlags_SizingFixedFit)) {
      for (const Control& control : controls()) {
        if (control.input.empty()) continue;
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(control.input.data(), control.input.data() + control.input.size());
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(control.effect.data(),
                               control.effect.data() + control.effect.size());
      }
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

}  // namespace tetraglass::apps::view
