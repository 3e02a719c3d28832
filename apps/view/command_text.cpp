#include "apps/view/command_text.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tetraglass::apps::view {
namespace {

struct OneValue {
  std::string_view name;
  std::string RenderArguments::*value;
};

struct Values {
  std::string_view name;
  std::vector<std::string> RenderArguments::*values;
};

// What the window changes.
constexpr std::array kOneValue = {
    OneValue{"--size", &RenderArguments::size},
    OneValue{"--samples", &RenderArguments::samples},
    OneValue{"--field", &RenderArguments::field},
    OneValue{"--mode", &RenderArguments::mode},
    OneValue{"--iso-opacity", &RenderArguments::iso_opacity},
    OneValue{"--shading", &RenderArguments::shading},
    OneValue{"--tf", &RenderArguments::transfer_function},
    OneValue{"--opacity", &RenderArguments::opacity},
    OneValue{"--opacity-scale", &RenderArguments::opacity_scale},
    OneValue{"--range", &RenderArguments::range},
    OneValue{"--projector", &RenderArguments::projector},
    OneValue{"--sort", &RenderArguments::sort},
    OneValue{"--integrator", &RenderArguments::integrator},
    OneValue{"--lights", &RenderArguments::lights},
    OneValue{"--background", &RenderArguments::background},
    OneValue{"--eye", &RenderArguments::eye},
    OneValue{"--target", &RenderArguments::target},
    OneValue{"--up", &RenderArguments::up},
    OneValue{"--fov", &RenderArguments::fov},
    OneValue{"--ortho", &RenderArguments::ortho},
    OneValue{"--view", &RenderArguments::view},
    OneValue{"--camera", &RenderArguments::file},
};

constexpr std::array kValues = {
    Values{"--isovalue", &RenderArguments::isovalues},
    Values{"--iso-color", &RenderArguments::iso_colors},
    Values{"--clip", &RenderArguments::clip},
};

struct FigureFlag {
  std::string_view name;
  bool FigureArguments::*value;
};

constexpr std::array kFigureFlags = {
    FigureFlag{"--outline", &FigureArguments::outline},
    FigureFlag{"--axes", &FigureArguments::axes},
    FigureFlag{"--legend", &FigureArguments::legend},
};

constexpr std::string_view kTitle = "--title";
constexpr std::string_view kLog = "--log";
constexpr std::string_view kTime = "--time";

bool is_changed_by_window(const std::string& name) {
  const auto is_it = [&](const auto& option) { return option.name == name; };
  return name == kLog || name == kTime || name == kTitle ||
         std::any_of(kFigureFlags.begin(), kFigureFlags.end(), is_it) ||
         std::any_of(kOneValue.begin(), kOneValue.end(), is_it) ||
         std::any_of(kValues.begin(), kValues.end(), is_it);
}

/// A value that begins with a dash would be read as an option.
void add_option(std::vector<std::string>& words, std::string_view name, const std::string& value) {
  if (value.starts_with('-')) {
    words.push_back(fmt::format("{}={}", name, value));
  } else {
    words.emplace_back(name);
    words.push_back(value);
  }
}

std::string quoted(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  return result + "'";
}

}  // namespace

std::vector<TypedOption> typed_options(const CLI::App& app) {
  std::vector<TypedOption> typed;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0 || option->get_lnames().empty()) continue;
    const bool flag = option->get_expected_max() == 0;
    typed.push_back({"--" + option->get_lnames().front(),
                     flag ? std::vector<std::string>{} : option->results(), flag});
  }
  return typed;
}

std::vector<std::string> render_words(const RenderArguments& arguments,
                                      const std::vector<TypedOption>& typed,
                                      const std::string& output) {
  static const RenderArguments kDefaults;
  std::vector<std::string> words = {"render"};
  words.push_back(arguments.input.starts_with('-') ? "./" + arguments.input : arguments.input);
  for (const OneValue& option : kOneValue) {
    const std::string& value = arguments.*option.value;
    if (value != kDefaults.*option.value) add_option(words, option.name, value);
  }
  for (const Values& option : kValues) {
    for (const std::string& value : arguments.*option.values) {
      add_option(words, option.name, value);
    }
  }
  if (arguments.logarithmic) words.emplace_back(kLog);
  for (const FigureFlag& flag : kFigureFlags) {
    if (arguments.figure.*flag.value) words.emplace_back(flag.name);
  }
  if (!arguments.figure.title.empty()) add_option(words, kTitle, arguments.figure.title);
  if (!arguments.import.time.empty()) add_option(words, kTime, arguments.import.time);
  for (const TypedOption& option : typed) {
    if (is_changed_by_window(option.name)) continue;
    if (option.flag) words.push_back(option.name);
    for (const std::string& value : option.values) add_option(words, option.name, value);
  }
  add_option(words, "-o", output.starts_with('-') ? "./" + output : output);
  return words;
}

std::string shell_line(const std::vector<std::string>& words) {
  std::vector<std::string> quoted_words = {"tetraglass"};
  for (const std::string& word : words) quoted_words.push_back(quoted(word));
  return fmt::format("{}", fmt::join(quoted_words, " "));
}

}  // namespace tetraglass::apps::view
