#include "apps/man_page.h"

#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tetraglass::apps {
namespace {

/// As roff reads it: text, not requests; a dash is what is typed.
std::string roff(const std::string& text) {
  std::string result;
  bool line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\'')) result += "\\&";
    line_start = c == '\n';
    switch (c) {
      case '\\':
        result += "\\e";
        break;
      case '-':
        result += "\\-";
        break;
      case '\'':
        result += "\\(aq";
        break;
      case '^':
        result += "\\(ha";
        break;
      case '~':
        result += "\\(ti";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string option_entry(const DescribedOption& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) {
    names.push_back(option.argument ? fmt::format("\\fI{}\\fR", roff(name))
                                    : fmt::format("\\fB{}\\fR", roff(name)));
  }
  std::string head = fmt::format("{}", fmt::join(names, ", "));
  if (!option.argument && !option.value.empty())
    head += fmt::format(" \\fI{}\\fR", roff(option.value));
  return fmt::format(".TP\n{}\n{}{}\n", head, roff(option.text),
                     option.required ? " (required)" : "");
}

std::string command_section(const DescribedCommand& command) {
  std::string text = fmt::format(".SS {}\n{}.\n.PP\n\\fB{}\\fR\n", roff(command.name),
                                 roff(command.text), roff(command.usage));
  if (!command.notes.empty()) text += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(command.notes));
  for (const DescribedOption& option : command.options) text += option_entry(option);
  return text;
}

}  // namespace

std::string man_page(const std::vector<DescribedCommand>& commands, const std::string& version) {
  const DescribedCommand& program = commands.front();
  std::string text = fmt::format(
      ".TH TETRAGLASS 1 \"\" \"tetraglass {}\" \"User Commands\"\n"
      ".SH NAME\ntetraglass \\- looks into tetrahedral meshes\n"
      ".SH SYNOPSIS\n\\fB{}\\fR\n"
      ".SH DESCRIPTION\n{}\n.PP\nThe subcommands:\n",
      roff(version), roff(program.usage.substr(0, program.usage.find("   "))), roff(program.text));
  for (const DescribedCommand& command : commands) {
    if (command.name.empty()) continue;
    text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(command.name), roff(command.text));
  }
  text += ".SH OPTIONS\n";
  for (const DescribedOption& option : program.options) text += option_entry(option);
  text += ".SH SUBCOMMANDS\n";
  for (const DescribedCommand& command : commands) {
    if (!command.name.empty()) text += command_section(command);
  }
  text +=
      ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\nit could not be done; one line on standard error "
      "says "
      "which file, what and why\n.TP\n2\nwrong usage\n"
      ".SH EXAMPLES\n.nf\n"
      "tetraglass info result.vtu\n"
      "tetraglass render result.vtu \\-o picture.png \\-\\-field Temp\n"
      "tetraglass view result.vtu\n"
      ".fi\n";
  return text;
}

}  // namespace tetraglass::apps
