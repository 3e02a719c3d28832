#include "apps/transfer_function_input.h"

#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "preint/paraview_color_map.h"

namespace tetraglass::apps {
namespace {

/// ParaView's files name their colors so; ours has "points".
bool is_paraview_color_map(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return text.find("\"RGBPoints\"") != std::string::npos ||
         text.find("<ColorMap") != std::string::npos;
}

}  // namespace

bool is_preset_name(const std::string& name) {
  return name.find('.') == std::string::npos && name.find('/') == std::string::npos;
}

bool has_own_values(const std::string& name) {
  return !is_preset_name(name) && !is_paraview_color_map(name);
}

preint::TransferFunction read_named_transfer_function(const std::string& name, double low,
                                                      double high, double diagonal) {
  if (is_preset_name(name)) return preint::preset(name, low, high, diagonal);
  if (is_paraview_color_map(name))
    return preint::read_paraview_color_map(name, "", low, high, diagonal);
  return preint::read_transfer_function(name);
}

std::string transfer_function_help() {
  return fmt::format(
      "Transfer function: FILE.json, a color map exported by ParaView (.json, .xml), or one of {}",
      fmt::join(preint::preset_names(), ", "));
}

}  // namespace tetraglass::apps
