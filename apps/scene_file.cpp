#include "apps/scene_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/transfer_function_input.h"
#include "base/errors.h"
#include "base/json_file.h"
#include "base/output_file.h"

namespace tetraglass::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 7> kFiles = {"input", "output",  "tf",    "lights",
                                                    "stats", "surface", "camera"};

/// The name of an option in a scene file; empty for what says nothing of a scene.
std::string key_of(const CLI::Option& option) {
  if (option.get_positional()) return "input";
  if (option.get_lnames().empty()) return "";
  const std::string& name = option.get_lnames().front();
  return name == "help" || name == "scene" || name == "save-scene" ? "" : name;
}

bool is_file(const std::string& key, const std::string& value) {
  if (std::find(kFiles.begin(), kFiles.end(), key) == kFiles.end()) return false;
  return key != "tf" || !is_preset_name(value);
}

bool is_flag(const CLI::Option& option) {
  return option.get_expected_max() == 0;
}

bool is_repeatable(const CLI::Option& option) {
  return option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
}

/// One value as it would be typed: the numbers of a list with commas between them.
std::string typed(const base::JsonValue& value, const std::string& key, const fs::path& folder) {
  std::string text;
  if (const auto elements = value.elements()) {
    for (const base::JsonValue& element : *elements) {
      text += (text.empty() ? "" : ",") + element.word();
    }
    if (text.empty()) value.fail("must not be an empty list");
    return text;
  }
  text = value.word();
  return is_file(key, text) && fs::path(text).is_relative() ? (folder / text).string() : text;
}

void apply(CLI::Option& option, const std::string& key, const base::JsonValue& value,
           const fs::path& folder) {
  if (is_flag(option)) {
    const std::string word = value.word();
    if (word != "true" && word != "false") value.fail("must be true or false");
    if (word == "false") return;
    option.add_result(word);
  } else if (const auto elements = value.elements(); elements && is_repeatable(option)) {
    // [1, 2] are two values, [[0, 0, 1, 5]] is one, and so is [0, 0, 1, 5] where four numbers make
    // one value: then it is written as a list in a list.
    for (const base::JsonValue& element : *elements) {
      option.add_result(typed(element, key, folder));
    }
    if (elements->empty()) return;
  } else {
    option.add_result(typed(value, key, folder));
  }
  try {
    option.run_callback();
  } catch (const CLI::Error& error) {
    value.fail(error.what());
  }
}

nlohmann::ordered_json as_json(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size() && nlohmann::json::accept(text)) {
    return nlohmann::ordered_json::parse(text);
  }
  return text;
}

}  // namespace

void apply_scene_file(CLI::App& app, const std::string& file) {
  const base::JsonValue scene = base::JsonValue::read(file);
  std::vector<std::string> keys;
  for (const CLI::Option* option : app.get_options()) {
    if (const std::string key = key_of(*option); !key.empty()) keys.push_back(key);
  }
  scene.allow_only(keys);
  const fs::path folder = fs::path(file).parent_path();
  for (CLI::Option* option : app.get_options()) {
    const std::string key = key_of(*option);
    if (key.empty() || option->count() > 0) continue;
    if (const auto value = scene.find(key)) apply(*option, key, *value, folder);
  }
}

void save_scene_file(const CLI::App& app, const std::string& file) {
  const fs::path folder = fs::absolute(file).parent_path();
  nlohmann::ordered_json scene = nlohmann::ordered_json::object();
  for (const CLI::Option* option : app.get_options()) {
    const std::string key = key_of(*option);
    if (key.empty() || option->count() == 0) continue;
    nlohmann::ordered_json values = nlohmann::ordered_json::array();
    for (const std::string& value : option->results()) {
      values.push_back(
          is_file(key, value)
              ? nlohmann::ordered_json(fs::absolute(value).lexically_relative(folder).string())
              : as_json(value));
    }
    if (is_flag(*option)) {
      scene[key] = true;
    } else if (is_repeatable(*option)) {
      scene[key] = values;
    } else {
      scene[key] = values.back();
    }
  }
  base::OutputFile output(file);
  output.write(scene.dump(2) + "\n");
  output.commit();
}

}  // namespace tetraglass::apps
