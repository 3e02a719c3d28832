#include "apps/shell_completion.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/options.h"

namespace tetraglass::apps {
namespace {

/// In single quotes, as all three shells read it; `quote`: how a single quote is written in them.
std::string quoted(const std::string& text, std::string_view quote) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += quote;
    } else {
      result += c;
    }
  }
  return result + "'";
}

std::vector<std::string> subcommand_names(const std::vector<DescribedCommand>& commands) {
  std::vector<std::string> names;
  for (const DescribedCommand& command : commands) {
    if (!command.name.empty()) names.push_back(command.name);
  }
  return names;
}

/// The first sentence of what an option does: there is one line for it.
std::string first_sentence(const std::string& text) {
  const std::size_t end = std::min(text.find(". "), text.find("; "));
  return text.substr(0, end);
}

std::vector<std::string> all_names(const DescribedCommand& command) {
  std::vector<std::string> names;
  for (const DescribedOption& option : command.options) {
    if (!option.argument) names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

std::string bash(const std::vector<DescribedCommand>& commands) {
  std::string options;
  std::string values;
  std::string arguments;
  for (const DescribedCommand& command : commands) {
    options += fmt::format("    {}) options={} ;;\n", command.name.empty() ? "''" : command.name,
                           quoted(fmt::format("{}", fmt::join(all_names(command), " ")), "'\\''"));
    for (const DescribedOption& option : command.options) {
      if (option.value.empty()) continue;
      const std::string words = quoted(fmt::format("{}", fmt::join(option.choices, " ")), "'\\''");
      const std::string what = fmt::format("words={} files={}", words, option.file ? 1 : 0);
      if (option.argument) {
        if (arguments.find("    " + command.name + ")") == std::string::npos)
          arguments += fmt::format("    {}) {} ;;\n", command.name, what);
      } else {
        std::vector<std::string> keys;
        for (const std::string& name : option.names)
          keys.push_back(fmt::format("{}:{}", command.name, name));
        values += fmt::format("    {}) {} value=1 ;;\n", fmt::join(keys, "|"), what);
      }
    }
  }
  return fmt::format(
      R"(# bash completion for tetraglass, made by 'tetraglass --completion bash'
_tetraglass() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
  local command='' options='' words='' files=0 value=0
  [ "$COMP_CWORD" -gt 1 ] && command=${{COMP_WORDS[1]}}
  # --option=value comes as three words.
  if [ "$current" = = ]; then
    current=''
  elif [ "$previous" = = ] && [ "$COMP_CWORD" -gt 2 ]; then
    previous=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  COMPREPLY=()
  case "$command" in
{}  esac
  case "$command:$previous" in
{}  esac
  if [ "$value" = 0 ]; then
    if [ -z "$command" ]; then
      words="{} $options"
    elif [[ $current == -* ]]; then
      words=$options
    else
      case "$command" in
{}      esac
    fi
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  if [ "$files" = 1 ]; then
    compopt -o filenames 2>/dev/null
    local found
    mapfile -t found < <(compgen -f -- "$current")
    COMPREPLY+=("${{found[@]}}")
  fi
}}
complete -F _tetraglass tetraglass
)",
      options, values, fmt::join(subcommand_names(commands), " "), arguments);
}

/// What zsh's _arguments takes in an option's text and in its list of words.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_value(const DescribedOption& option) {
  if (option.value.empty()) return "";
  std::string action = " ";
  if (!option.choices.empty()) action = fmt::format("({})", fmt::join(option.choices, " "));
  // Words and files: an alternative of both.
  if (option.file && !option.choices.empty()) {
    action = fmt::format("{{_alternative \"words\\:word\\:({})\" \"files\\:file\\:_files\"}}",
                         fmt::join(option.choices, " "));
  } else if (option.file) {
    action = "_files";
  }
  return fmt::format(":{}:{}", zsh_text(option.names.back()), action);
}

std::string zsh(const std::vector<DescribedCommand>& commands) {
  std::string names;
  std::string cases;
  for (const DescribedCommand& command : commands) {
    if (command.name.empty()) continue;
    names += fmt::format("    {}\n", quoted(command.name + ":" + command.text, "'\\''"));
    cases += fmt::format("    {})\n      _arguments", command.name);
    int place = 0;
    for (const DescribedOption& option : command.options) {
      if (option.argument) {
        cases += fmt::format(" \\\n        {}",
                             quoted(fmt::format("{}{}", ++place, zsh_value(option)), "'\\''"));
      }
      for (const std::string& name : option.names) {
        if (option.argument) continue;
        cases +=
            fmt::format(" \\\n        {}",
                        quoted(fmt::format("*{}[{}]{}", name, zsh_text(first_sentence(option.text)),
                                           zsh_value(option)),
                               "'\\''"));
      }
    }
    cases += "\n      ;;\n";
  }
  std::string own;
  for (const std::string& name : all_names(commands.front()))
    own += fmt::format(" {}", quoted(name, "'\\''"));
  return fmt::format(
      R"(#compdef tetraglass
# zsh completion for tetraglass, made by 'tetraglass --completion zsh'
_tetraglass() {{
  local -a subcommands
  subcommands=(
{}  )
  if (( CURRENT == 2 )); then
    _describe -t commands subcommand subcommands
    compadd --{}
    return
  fi
  local subcommand=$words[2]
  shift words
  (( CURRENT-- ))
  case $subcommand in
{}  esac
}}
_tetraglass "$@"
)",
      names, own, cases);
}

std::string fish(const std::vector<DescribedCommand>& commands) {
  std::string text =
      "# fish completion for tetraglass, made by 'tetraglass --completion fish'\n"
      "complete -c tetraglass -f\n";
  for (const DescribedCommand& command : commands) {
    const std::string when = command.name.empty()
                                 ? "__fish_use_subcommand"
                                 : fmt::format("'__fish_seen_subcommand_from {}'", command.name);
    if (!command.name.empty()) {
      text += fmt::format("complete -c tetraglass -n __fish_use_subcommand -a {} -d {}\n",
                          command.name, quoted(command.text, "\\'"));
    }
    for (const DescribedOption& option : command.options) {
      std::string line = "complete -c tetraglass -n " + when;
      for (const std::string& name : option.names) {
        if (option.argument) continue;
        const bool is_long = name.starts_with("--");
        line += fmt::format(" {} {}", is_long ? "-l" : "-s", name.substr(is_long ? 2 : 1));
      }
      if (!option.value.empty() && !option.argument) line += option.file ? " -r" : " -x";
      // The text is of the option, not of each word: what would stand beside them is empty.
      if (!option.choices.empty())
        line += fmt::format(" -a '{}\\t'", fmt::join(option.choices, "\\t "));
      if (option.file) line += " -F";
      text += line + fmt::format(" -d {}\n", quoted(first_sentence(option.text), "\\'"));
    }
  }
  return text;
}

}  // namespace

std::string shell_completion(const std::vector<DescribedCommand>& commands,
                             const std::string& shell) {
  using Script = std::string (*)(const std::vector<DescribedCommand>&);
  return parse_choice<Script>(shell, "--completion",
                              {{"bash", bash}, {"zsh", zsh}, {"fish", fish}})(commands);
}

}  // namespace tetraglass::apps
