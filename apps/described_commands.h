#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tetraglass::apps {

/// An option, or an argument without dashes, as its help tells it.
struct DescribedOption {
  std::vector<std::string> names;  ///< "-o", "--output"; of an argument "INPUT"
  bool argument = false;           ///< has no dashes
  std::string value;               ///< what stands for its value; empty for flags
  bool file = false;               ///< its value may be the name of a file
  bool required = false;
  std::vector<std::string> choices;  ///< the words that its value may be, where the help lists them
  std::string text;
};

/// A subcommand, or the program itself, whose name is empty.
struct DescribedCommand {
  std::string name;
  std::string text;
  std::string usage;  ///< "tetraglass render INPUT -o ..."
  std::string notes;  ///< lines below the usage, with their own line breaks
  std::vector<DescribedOption> options;
};

/// The program and its subcommands, read from what `--help` prints; hidden options are left out.
[[nodiscard]] std::vector<DescribedCommand> describe(const CLI::App& program);

/// The words that a help text offers: "auto | cpu (fast) | gl: why" or "one of a, b, c". Text in
/// parentheses does not count.
[[nodiscard]] std::vector<std::string> offered_words(const std::string& text);

}  // namespace tetraglass::apps
