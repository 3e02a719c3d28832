#include "apps/described_commands.h"

#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace tetraglass::apps {
namespace {

std::string without_parentheses(const std::string& text) {
  std::string result;
  int depth = 0;
  for (const char c : text) {
    if (c == '(') ++depth;
    if (depth == 0) result += c;
    if (c == ')' && depth > 0) --depth;
  }
  return result;
}

std::vector<std::string> split(const std::string& text, std::string_view separator) {
  std::vector<std::string> parts;
  std::size_t start = 0;
  for (std::size_t end = text.find(separator); end != std::string::npos;
       end = text.find(separator, start)) {
    parts.push_back(text.substr(start, end - start));
    start = end + separator.size();
  }
  parts.push_back(text.substr(start));
  return parts;
}

/// The words of a text, without the punctuation behind them.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (std::string& word : split(text, " ")) {
    while (!word.empty() && std::string_view(".,:;").find(word.back()) != std::string_view::npos)
      word.pop_back();
    if (!word.empty()) words.push_back(std::move(word));
  }
  return words;
}

DescribedOption describe_option(const CLI::Option& option) {
  DescribedOption result;
  result.argument = option.nonpositional() ? false : option.get_positional();
  if (result.argument) result.names.push_back(option.get_name(true));
  for (const std::string& name : option.get_snames())
    result.names.push_back(fmt::format("-{}", name));
  for (const std::string& name : option.get_lnames())
    result.names.push_back(fmt::format("--{}", name));
  const bool flag = option.get_expected_max() == 0;
  if (!flag) result.value = option.get_type_name().substr(0, option.get_type_name().find(':'));
  if (result.value == "TEXT" || result.value == "FLOAT") result.value = "VALUE";
  result.file = result.value.ends_with("FILE");
  result.required = option.get_required();
  result.text = option.get_description();
  if (!flag) result.choices = offered_words(result.text);
  if (!flag && !option.get_default_str().empty() &&
      result.text.find("efault") == std::string::npos) {
    result.text += fmt::format(". Default: {}", option.get_default_str());
  }
  for (const CLI::Option* other : option.get_excludes())
    result.text += ". Not with " + other->get_name();
  for (const CLI::Option* other : option.get_needs())
    result.text += ". Only with " + other->get_name();
  return result;
}

DescribedCommand describe_command(const CLI::App& app, const std::string& name) {
  DescribedCommand command;
  command.name = name;
  command.text = app.get_description();
  constexpr std::string_view kUsage = "usage: ";
  std::string footer = app.get_footer();
  if (footer.starts_with(kUsage)) footer.erase(0, kUsage.size());
  const std::size_t end = footer.find('\n');
  command.usage = footer.substr(0, end);
  if (end != std::string::npos) {
    command.notes = footer.substr(end + 1);
    command.notes.erase(0, command.notes.find_first_not_of('\n'));
  }
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_group().empty()) command.options.push_back(describe_option(*option));
  }
  return command;
}

}  // namespace

std::vector<std::string> offered_words(const std::string& text) {
  const std::string plain = without_parentheses(text);
  const std::vector<std::string> parts = split(plain, " | ");
  std::vector<std::string> offered;
  if (parts.size() > 1) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::vector<std::string> words = words_of(parts[i]);
      if (words.empty()) continue;
      // Beside each bar stands a word; between two bars these may be two.
      if (i > 0) offered.push_back(words.front());
      if (i == 0 || (i + 1 < parts.size() && words.size() > 1)) offered.push_back(words.back());
    }
    return offered;
  }
  for (const std::string_view start : {"one of: ", "One of: ", "one of "}) {
    const std::size_t found = plain.find(start);
    if (found != std::string::npos) return words_of(plain.substr(found + start.size()));
  }
  return {};
}

std::vector<DescribedCommand> describe(const CLI::App& program) {
  std::vector<DescribedCommand> commands = {describe_command(program, "")};
  for (const CLI::App* sub : program.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(describe_command(*sub, sub->get_name()));
  }
  return commands;
}

}  // namespace tetraglass::apps
