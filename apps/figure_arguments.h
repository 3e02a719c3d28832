#pragma once

#include <string>
#include <vector>

namespace tetraglass::apps {

/// What is asked for around the picture and among the volume, as typed; empty where not given.
struct FigureArguments {
  bool outline = false;
  bool axes = false;
  bool legend = false;
  std::string legend_title;
  std::string title;
  std::vector<std::string> surfaces;
  std::string surface_color;

  /// Whether the picture gets anything around it or over it.
  [[nodiscard]] bool any() const { return axes || legend || !title.empty(); }
};

}  // namespace tetraglass::apps
