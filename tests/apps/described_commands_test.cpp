// The man page and what shells complete are made of the program's help: every option is in them.
#include "apps/described_commands.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/program.h"

namespace tetraglass::tests {
namespace {

using testing::ElementsAre;
using Words = std::vector<std::string>;

TEST(OfferedWords, StandBesideBars) {
  using apps::offered_words;
  EXPECT_THAT(offered_words("full | iso"), ElementsAre("full", "iso"));
  EXPECT_THAT(offered_words("on (default; a | b) | off, for faces12"), ElementsAre("on", "off"));
  EXPECT_THAT(offered_words("For this: field | cell: of cells; and of grids central | sobel"),
              ElementsAre("field", "cell", "central", "sobel"));
  EXPECT_THAT(offered_words("A file, or one of a, b-c, d"), ElementsAre("a", "b-c", "d"));
  EXPECT_THAT(offered_words("One of: a, b"), ElementsAre("a", "b"));
  EXPECT_THAT(offered_words("min(1, |gradient| / G), NAME:x|y"), ElementsAre());
}

Words matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern, std::regex::multiline);
  Words found;
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i)
    found.push_back((*i)[1]);
  return found;
}

/// The options of each subcommand, as its own help lists them.
std::map<std::string, Words> options_of_help() {
  std::map<std::string, Words> options;
  const std::string help = run_program("--help").out;
  const std::string commands = help.substr(help.find("Subcommands:"));
  for (const std::string& name : matches(commands, "^  ([a-z]+) ")) {
    options[name] = matches(run_program(name + " --help").out, "^  (?:-[a-z],)?(--[a-z0-9-]+)");
  }
  return options;
}

/// What stands between the heading of a subcommand and the next heading.
std::string part(const std::string& text, const std::string& start, const std::string& end) {
  const std::size_t first = text.find(start);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find(end, first + start.size()) - first);
}

TEST(ManPage, HasEveryOptionOfEverySubcommand) {
  std::string page = run_program("--man-page").out;
  page.erase(std::remove(page.begin(), page.end(), '\\'), page.end());
  const auto options = options_of_help();
  ASSERT_GE(options.size(), 9U);
  for (const auto& [command, names] : options) {
    const std::string section = part(page, "\n.SS " + command + "\n", "\n.S");
    ASSERT_GE(names.size(), 2U) << command;
    for (const std::string& name : names)
      EXPECT_NE(section.find("fB" + name + "fR"), std::string::npos) << command << " " << name;
  }
}

TEST(ManPage, IsSoundRoff) {
  if (std::system("man --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "man is not installed";
  const TemporaryFolder folder;
  const std::string page = folder.file("tetraglass.1");
  ASSERT_EQ(std::system(fmt::format("'{}' --man-page >'{}'", TETRAGLASS_PROGRAM, page).c_str()), 0);
  ASSERT_EQ(std::system(fmt::format("LC_ALL=C MANWIDTH=80 man --warnings -E ascii -l '{0}' "
                                    ">'{0}.text' 2>'{0}.complaints'",
                                    page)
                            .c_str()),
            0);
  EXPECT_EQ(read_text(page + ".complaints"), "");
  EXPECT_NE(read_text(page + ".text").find("--depth-cue VALUE"), std::string::npos);
}

TEST(ShellCompletion, HasEveryOptionOfEverySubcommand) {
  const std::string bash = run_program("--completion bash").out;
  const std::string zsh = run_program("--completion zsh").out;
  const std::string fish = run_program("--completion fish").out;
  for (const auto& [command, names] : options_of_help()) {
    const std::string of_bash =
        fmt::format(" {} ", part(bash, "    " + command + ") options='", "\n"));
    const std::string of_zsh = part(zsh, "    " + command + ")\n", "      ;;\n");
    for (const std::string& name : names) {
      EXPECT_TRUE(std::regex_search(of_bash, std::regex("[ ']" + name + "[ ']"))) << name;
      EXPECT_NE(of_zsh.find("'*" + name + "["), std::string::npos) << command << " " << name;
      EXPECT_TRUE(std::regex_search(fish, std::regex("seen_subcommand_from " + command +
                                                     "'[^\n]* -l " + name.substr(2) + " ")))
          << command << " " << name;
    }
  }
  const ProgramRun wrong = run_program("--completion bsh");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("did you mean 'bash'"), std::string::npos) << wrong.err;
}

class BashCompletion : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("bash -c true") != 0) GTEST_SKIP() << "bash is not installed";
    ASSERT_EQ(std::system(fmt::format("'{}' --completion bash >'{}'", TETRAGLASS_PROGRAM,
                                      folder_.file("completion"))
                              .c_str()),
              0);
  }

  /// What a bash offers for the last of these words (as COMP_WORDS has them).
  Words complete(const std::string& words) {
    const std::string script = fmt::format(
        "cd '{0}' && source ./completion && complete -p tetraglass >registered && "
        "COMP_WORDS=({1}) && COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)) && _tetraglass && "
        "printf '%s\\n' \"${{COMPREPLY[@]}}\" >reply",
        folder_.file(""), words);
    std::ofstream(folder_.file("script")) << script;
    EXPECT_EQ(std::system(("bash '" + folder_.file("script") + "'").c_str()), 0) << script;
    std::istringstream lines(read_text(folder_.file("reply")));
    Words replies;
    for (std::string line; std::getline(lines, line);) {
      if (!line.empty()) replies.push_back(line);
    }
    return replies;
  }

  TemporaryFolder folder_;
};

TEST_F(BashCompletion, OffersCommandsOptionsWordsAndFiles) {
  EXPECT_THAT(complete("tetraglass re"), ElementsAre("render"));
  EXPECT_EQ(read_text(folder_.file("registered")), "complete -F _tetraglass tetraglass\n");
  EXPECT_THAT(complete("tetraglass render --mod"), ElementsAre("--mode", "--modulate"));
  EXPECT_THAT(complete("tetraglass render --mode ''"),
              ElementsAre("full", "emission", "absorption", "mip", "iso", "thickness"));
  EXPECT_THAT(complete("tetraglass render --mode = e"), ElementsAre("emission"));
  EXPECT_THAT(complete("tetraglass sample sph"), ElementsAre("sphere"));
  std::ofstream(folder_.file("a file.vtu")) << "";
  EXPECT_THAT(complete("tetraglass info 'a f'"), ElementsAre("a file.vtu"));
  EXPECT_THAT(complete("tetraglass render x -o 'a f'"), ElementsAre("a file.vtu"));
  EXPECT_THAT(complete("tetraglass render --size ''"), ElementsAre());
  EXPECT_THAT(complete("tetraglass render --tf vir"), ElementsAre("viridis"));
}

// No word that is offered is refused as unknown.
TEST_F(BashCompletion, OfferedWordsAreKnown) {
  const std::string mesh = folder_.file("sphere.vtu");
  ASSERT_EQ(run_program("sample sphere --cells 100 -o '" + mesh + "'").status, 0);
  const std::string help = run_program("render --help").out;
  std::size_t tried = 0;
  for (const std::string& option : matches(help, "^  (--[a-z-]+) .* \\| ")) {
    const Words words = complete("tetraglass render " + option + " ''");
    ASSERT_GE(words.size(), 2U) << option;
    // Those that are told from the text around them.
    for (const std::string& word : {words.front(), words.back()}) {
      const ProgramRun run = run_program(fmt::format("render '{}' --size 4x4 -o '{}' {} {}", mesh,
                                                     folder_.file("o.npy"), option, word));
      EXPECT_EQ(run.err.find("cannot be '"), std::string::npos) << option << run.err;
      ++tried;
    }
  }
  EXPECT_GE(tried, 30U);
}

TEST(ShellCompletion, IsSoundInEachShell) {
  const TemporaryFolder folder;
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    if (std::system((shell + " -c true >/dev/null 2>&1").c_str()) != 0) continue;
    const std::string file = folder.file(shell);
    EXPECT_EQ(std::system(fmt::format("'{0}' --completion {1} >'{2}' && {1} -n '{2}'",
                                      TETRAGLASS_PROGRAM, shell, file)
                              .c_str()),
              0)
        << shell;
  }
}

}  // namespace
}  // namespace tetraglass::tests
