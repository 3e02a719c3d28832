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
#include "apps/view/isosurface_panel.h"
#include "apps/view/light_panel.h"
#include "apps/view/widgets.h"

namespace tetraglass::apps::view {
namespace {

using Names = std::vector<std::string>;

/// A list to choose an option of the scene from.
void choose_option(Viewer& viewer, const char* label, const Names& names,
                   std::string RenderArguments::*option) {
  std::string chosen = viewer.arguments().*option;
  if (choose(label, names, chosen)) viewer.change_scene().*option = chosen;
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

void set_opacity_scale(Viewer& viewer) {
  const std::string& text = viewer.arguments().opacity_scale;
  double scale = text.empty() ? 1 : parse_number(text, "--opacity-scale");
  if (slider("opacity x", scale, 0.01, 100, "%.3g", true)) {
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
  if (mode == "iso") draw_isosurface_panel(viewer);
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

void set_samples(Viewer& viewer) {
  std::string samples = viewer.arguments().samples.empty() ? "1" : viewer.arguments().samples;
  Names choices = {"1", "4", "9", "16"};
  if (std::ranges::find(choices, samples) == choices.end()) choices.push_back(samples);
  if (choose("samples", choices, samples)) {
    viewer.change_scene().samples = samples == "1" ? "" : samples;
  }
}

void set_background(Viewer& viewer) {
  const project::Background background = make_background(viewer.arguments(), viewer.facts()->mode);
  preint::Color color(background.rgb[0], background.rgb[1], background.rgb[2]);
  if (!edit_color("background", color)) return;
  std::string text = to_text(color.matrix());
  if (background.alpha != 1) text += fmt::format(",{}", background.alpha);
  viewer.change_scene().background = text;
}

void show_camera(Viewer& viewer, std::vector<Action>& actions) {
  if (!viewer.camera()) return;
  bool parallel = viewer.camera()->parallel;
  if (ImGui::Checkbox("parallel", &parallel)) viewer.set_parallel(parallel);
  ImGui::SameLine();
  if (ImGui::Button("see all")) actions.push_back(Action::frame);
  if (viewer.facts() == nullptr) return;
  set_samples(viewer);
  set_background(viewer);
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
  if (section("Light", false)) draw_light_panel(viewer);
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
