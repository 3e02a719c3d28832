#pragma once

#include <string>

namespace CLI {
class App;
}

namespace tetraglass::apps {

/// Gives the options of a subcommand that were not typed the values that a scene file has for them:
/// a JSON object whose keys are the long names of the options without their dashes, and "input".
/// Values are texts, numbers, true for flags, lists of numbers for what is typed with commas, and
/// lists for what may be repeated. Names of files are relative to the folder of the scene file.
/// Throws ReadError for keys that are no options, with the nearest right ones, and for values that
/// cannot be.
void apply_scene_file(CLI::App& app, const std::string& file);

/// Writes such a file of the options that were given, by either. Throws WriteError.
void save_scene_file(const CLI::App& app, const std::string& file);

}  // namespace tetraglass::apps
