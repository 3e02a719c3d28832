#include "apps/view/transfer_function_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include <fmt/format.h>
#include <imgui.h>

#include "project/image_file.h"

namespace tetraglass::apps::view {
namespace {

/// From values and extinctions to the window's coordinates.
struct Axes {
  ImVec2 corner;
  ImVec2 size;
  double low = 0;
  double high = 1;
  double top = 1;

  [[nodiscard]] float x(double value) const {
    return corner.x + size.x * static_cast<float>((value - low) / (high - low));
  }
  [[nodiscard]] float y(double extinction) const {
    return corner.y + size.y * static_cast<float>(1 - std::clamp(extinction / top, 0.0, 1.0));
  }
  [[nodiscard]] double value(float at) const {
    return low + (high - low) * std::clamp((at - corner.x) / size.x, 0.0F, 1.0F);
  }
  [[nodiscard]] double extinction(float at) const {
    return top * std::clamp(1 - (at - corner.y) / size.y, 0.0F, 1.0F);
  }
};

double largest_extinction(const TransferFunctionEditor& editor) {
  double most = 0;
  for (const preint::ControlPoint& point : editor.points()) most = std::max(most, point.extinction);
  return most;
}

Axes make_axes(const Viewer& viewer, const TransferFunctionEditor& editor, double top,
               const ImVec2& corner, const ImVec2& size) {
  Axes axes{corner, size, viewer.facts()->low, viewer.facts()->high, top};
  axes.low = std::min(axes.low, editor.points().front().value);
  axes.high = std::max(axes.high, editor.points().back().value);
  if (!(axes.low < axes.high)) {  // one value: somewhere around it
    const double around = std::max(1.0, std::abs(axes.low)) / 2;
    axes.low -= around;
    axes.high += around;
  }
  return axes;
}

ImU32 shown_color(const preint::Color& color, int alpha) {
  const auto channel = [](double linear) {
    return static_cast<int>(std::lround(255 * project::srgb_encode(std::clamp(linear, 0.0, 1.0))));
  };
  return IM_COL32(channel(color[0]), channel(color[1]), channel(color[2]), alpha);
}

/// Counts on a logarithmic scale: rare values show.
void draw_histogram(ImDrawList& list, const Axes& axes, const preint::Histogram& histogram) {
  std::uint64_t most = 0;
  for (const std::uint64_t count : histogram.counts) most = std::max(most, count);
  if (most == 0) return;
  const double width =
      (histogram.high - histogram.low) / static_cast<double>(histogram.counts.size());
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    const double share = std::log1p(static_cast<double>(histogram.counts[i])) /
                         std::log1p(static_cast<double>(most));
    const double left = histogram.low + width * static_cast<double>(i);
    list.AddRectFilled({axes.x(left), axes.y(0.95 * share * axes.top)},
                       {axes.x(left + width), axes.y(0)}, IM_COL32(62, 64, 68, 255));
  }
}

void draw_function(ImDrawList& list, const Axes& axes, const TransferFunctionEditor& editor) {
  const preint::TransferFunction tf = editor.function();
  const float floor = axes.corner.y + axes.size.y;
  for (float x = 0; x < axes.size.x; x += 2) {
    const preint::Medium medium = tf.at(axes.value(axes.corner.x + x + 1));
    list.AddRectFilled({axes.corner.x + x, axes.y(medium.extinction)},
                       {std::min(axes.corner.x + x + 2, axes.corner.x + axes.size.x), floor},
                       shown_color(medium.color, 200));
  }
  const auto& points = editor.points();
  const ImU32 line = IM_COL32(225, 225, 225, 255);
  ImVec2 last(axes.corner.x, axes.y(points.front().extinction));
  for (const preint::ControlPoint& point : points) {
    const ImVec2 next(axes.x(point.value), axes.y(point.extinction));
    list.AddLine(last, next, line, 1.5F);
    last = next;
  }
  list.AddLine(last, {axes.corner.x + axes.size.x, last.y}, line, 1.5F);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ImVec2 place(axes.x(points[i].value), axes.y(points[i].extinction));
    const float radius = 0.33F * ImGui::GetFontSize();
    list.AddCircleFilled(place, radius + 1.5F, IM_COL32(20, 20, 20, 255));
    list.AddCircleFilled(place, radius, IM_COL32(255, 255, 255, 255));
    if (i == editor.selected())
      list.AddCircleFilled(place, 0.5F * radius, IM_COL32(61, 133, 199, 255));
  }
}

/// The point under the mouse, the nearest of them.
std::optional<std::size_t> point_at(const Axes& axes, const TransferFunctionEditor& editor,
                                    const ImVec2& mouse) {
  float nearest = 0.7F * ImGui::GetFontSize();
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < editor.points().size(); ++i) {
    const preint::ControlPoint& point = editor.points()[i];
    const float distance =
        std::hypot(axes.x(point.value) - mouse.x, axes.y(point.extinction) - mouse.y);
    if (distance < nearest) {
      nearest = distance;
      found = i;
    }
  }
  return found;
}

/// Whether the function changed.
bool follow_mouse(const Axes& axes, TransferFunctionEditor& editor, PlotState& state) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool over = ImGui::IsItemHovered();
  const std::optional<std::size_t> point = point_at(axes, editor, mouse);
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) state.dragging = false;
  if (state.dragging) {
    const ImVec2 moved = ImGui::GetIO().MouseDelta;
    if (moved.x == 0 && moved.y == 0) return false;
    editor.move(axes.value(mouse.x), axes.extinction(mouse.y));
    return true;
  }
  if (!over) return false;
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && !point) {
    editor.begin();
    editor.add(axes.value(mouse.x));
    editor.move(axes.value(mouse.x), axes.extinction(mouse.y));
    return true;
  }
  if (!point) return false;
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    editor.begin();
    editor.select(*point);
    state.dragging = true;
  } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
    editor.begin();
    editor.select(*point);
    editor.remove();
    return true;
  }
  return false;
}

/// The selected point by numbers. Whether it changed.
bool edit_point(TransferFunctionEditor& editor) {
  const preint::ControlPoint& point = editor.points()[editor.selected()];
  std::array<float, 3> color{};
  for (int c = 0; c < 3; ++c) {
    color[static_cast<std::size_t>(c)] =
        static_cast<float>(project::srgb_encode(std::clamp(point.color[c], 0.0, 1.0)));
  }
  bool changed = false;
  if (ImGui::ColorEdit3("##color", color.data(),
                        ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel)) {
    preint::Color linear;
    for (int c = 0; c < 3; ++c)
      linear[c] = project::srgb_decode(color[static_cast<std::size_t>(c)]);
    editor.set_color(linear);
    changed = true;
  }
  if (ImGui::IsItemActivated()) editor.begin();
  ImGui::SameLine();
  double value = point.value;
  double extinction = point.extinction;
  const float width = 5 * ImGui::GetFontSize();
  const auto number = [&](const char* label, double& of) {
    ImGui::SetNextItemWidth(width);
    if (ImGui::InputScalar(label, ImGuiDataType_Double, &of, nullptr, nullptr, "%.5g",
                           ImGuiInputTextFlags_EnterReturnsTrue)) {
      editor.begin();
      editor.move(value, extinction);
      changed = true;
    }
  };
  number("##value", value);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("value of the selected point");
  ImGui::SameLine();
  number("##extinction", extinction);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("its extinction, per unit of length");
  return changed;
}

/// Whether the function changed.
bool undo_buttons(TransferFunctionEditor& editor) {
  bool changed = false;
  const auto button = [&](const char* label, bool possible, void (TransferFunctionEditor::*way)()) {
    ImGui::SameLine();
    ImGui::BeginDisabled(!possible);
    if (ImGui::Button(label)) {
      (editor.*way)();
      changed = true;
    }
    ImGui::EndDisabled();
  };
  button("undo", editor.can_undo(), &TransferFunctionEditor::undo);
  button("redo", editor.can_redo(), &TransferFunctionEditor::redo);
  return changed;
}

}  // namespace

void draw_transfer_function(Viewer& viewer, PlotState& state) {
  TransferFunctionEditor& editor = viewer.editor();
  // Half a point's width is left at both sides.
  const float margin = 0.5F * ImGui::GetFontSize();
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + margin);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x - margin, 8 * ImGui::GetFontSize());
  if (size.x < 2 * margin) return;
  ImGui::InvisibleButton("transfer function", size,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
  const bool help = ImGui::IsItemHovered() && !state.dragging && ImGui::GetIO().MouseDelta.x == 0;
  if (!state.dragging) {
    const double most = largest_extinction(editor);
    state.top = most > 0 ? 1.2 * most : 1;
  }
  const Axes axes = make_axes(viewer, editor, state.top, corner, size);
  bool changed = follow_mouse(axes, editor, state);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, IM_COL32(22, 22, 24, 255));
  list.PushClipRect({corner.x - 8, corner.y - 8}, {corner.x + size.x + 8, corner.y + size.y + 8},
                    true);
  draw_histogram(list, axes, viewer.facts()->histogram);
  draw_function(list, axes, editor);
  list.PopClipRect();
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + margin);
  ImGui::TextDisabled("%.5g", axes.low);
  const std::string high = fmt::format("{:.5g}", axes.high);
  ImGui::SameLine(margin + size.x - ImGui::CalcTextSize(high.c_str()).x);
  ImGui::TextDisabled("%s", high.c_str());
  if (edit_point(editor)) changed = true;
  if (undo_buttons(editor)) changed = true;
  if (help) {
    ImGui::SetTooltip(
        "Extinction over the field's values, on their histogram (logarithmic).\n"
        "Drag a point; double click adds one; right click removes it.");
  }
  if (changed) viewer.apply_edit();
}

}  // namespace tetraglass::apps::view
