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

#include "apps/program.h"
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

/// Runs the program in this process, where it starts at once. Returns what it says on stderr.
std::string run_here(Words words) {
  words.insert(words.begin(), "tetraglass");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  (void)apps::run(static_cast<int>(pointers.size()), pointers.data());
  (void)testing::internal::GetCapturedStdout();
  return testing::internal::GetCapturedStderr();
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
      const std::string complaints =
          run_here({"render", mesh, "--size", "4x4", "-o", folder_.file("o.npy"), option, word});
      EXPECT_EQ(complaints.find("cannot be '"), std::string::npos) << option << complaints;
      ++tried;
    }
  }
  EXPECT_NE(run_here({"render", mesh, "-o", folder_.file("o.npy"), "--mode", "nothing"})
                .find("cannot be '"),
            std::string::npos);
  EXPECT_GE(tried, 30U);
}

/// What completion offers after lines as a person types them, by the shell itself.
class OtherShells : public testing::Test {
 protected:
  /// Skips where the shell is not installed.
  void need(const std::string& shell) {
    if (std::system((shell + " -c true >/dev/null 2>&1").c_str()) != 0)
      GTEST_SKIP() << shell << " is not installed (scripts/setup does it)";
  }

  void save_completion(const std::string& shell, const std::string& file) {
    ASSERT_EQ(std::system(fmt::format("'{}' --completion {} >'{}'", TETRAGLASS_PROGRAM, shell,
                                      folder_.file(file))
                              .c_str()),
              0);
  }

  /// Runs a script in the folder, with the lines as its arguments. It prints "== LINE", and below
  /// what is offered.
  std::map<std::string, Words> ask(const std::string& command, const Words& lines) {
    std::string script = fmt::format("cd '{}' && timeout 50 {}", folder_.file(""), command);
    for (const std::string& line : lines) script += fmt::format(" '{}'", line);
    EXPECT_EQ(std::system((script + " >replies 2>complaints").c_str()), 0)
        << script << read_text(folder_.file("complaints"));
    std::istringstream replies(read_text(folder_.file("replies")));
    std::map<std::string, Words> found;
    std::string line;
    for (std::string reply; std::getline(replies, reply);) {
      if (reply.starts_with("== ")) {
        line = reply.substr(3);
      } else if (!reply.empty()) {
        found[line].push_back(reply);
      }
    }
    return found;
  }

  /// The same is expected of both.
  void check(const std::string& command) {
    write_text(folder_.file("mesh.vtu"), "");
    write_text(folder_.file("virtue.json"), "");
    const std::string mode = "tetraglass render mesh.vtu --mode ";
    auto offered = ask(
        command, {"tetraglass re", "tetraglass render --mod", mode, "tetraglass sample sph",
                  "tetraglass info me", "tetraglass render --tf vir", "tetraglass render --size ",
                  "tetraglass render mesh.vtu -o me", "tetraglass view mesh.vtu --shad"});
    EXPECT_THAT(offered["tetraglass re"], ElementsAre("render"));
    EXPECT_THAT(offered["tetraglass render --mod"], ElementsAre("--mode", "--modulate"));
    EXPECT_THAT(offered[mode], testing::UnorderedElementsAre("full", "emission", "absorption",
                                                             "mip", "iso", "thickness"));
    EXPECT_THAT(offered["tetraglass sample sph"], ElementsAre("sphere"));
    EXPECT_THAT(offered["tetraglass info me"], ElementsAre("mesh.vtu"));
    EXPECT_THAT(offered["tetraglass render --tf vir"], ElementsAre("viridis", "virtue.json"));
    EXPECT_THAT(offered["tetraglass render --size "], ElementsAre());
    EXPECT_THAT(offered["tetraglass render mesh.vtu -o me"], ElementsAre("mesh.vtu"));
    EXPECT_THAT(offered["tetraglass view mesh.vtu --shad"], ElementsAre("--shading"));
  }

  TemporaryFolder folder_;
};

TEST_F(OtherShells, Fish) {
  ASSERT_NO_FATAL_FAILURE(need("fish"));
  if (IsSkipped()) return;
  ASSERT_NO_FATAL_FAILURE(save_completion("fish", "completion"));
  // What stands behind a word, after a tab, is its description.
  write_text(folder_.file("script"),
             "set -x HOME (pwd)\nsource completion\nfor line in $argv\n  echo \"== $line\"\n"
             "  complete -C $line | string replace -r '\\t.*' ''\nend\n");
  check("fish -N script");
}

// On a terminal of its own, as completion in zsh is part of its line editor.
TEST_F(OtherShells, Zsh) {
  ASSERT_NO_FATAL_FAILURE(need("zsh"));
  if (IsSkipped()) return;
  if (!has_terminals()) GTEST_SKIP() << "this machine gives no terminals (/dev/pts)";
  ASSERT_NO_FATAL_FAILURE(save_completion("zsh", "_tetraglass"));
  write_text(folder_.file("inside"), R"(PROMPT= ; RPROMPT=
fpath=($PWD $fpath)
autoload -Uz compinit
compinit -u -D
# What is added to the list is printed; calls that only ask for what fits are not.
compadd() {
  if (( ! ${@[(I)-[OAD]*]} )); then
    local -a fitting
    builtin compadd -A fitting "$@"
    print -r -- ''
    print -rl -- '<'$^fitting'>'
  fi
  builtin compadd "$@"
}
show() {
  zle complete-word
  print -r -- ''
  print -r -- '<end>'
}
zle -N show
bindkey '^T' show
)");
  write_text(folder_.file("script"), R"(zmodload zsh/zpty
export TERM=dumb
zpty -b terminal zsh -f -i
zpty -w terminal 'source ./inside'
for line in "$@"; do
  print -r -- "== $line"
  zpty -n -w terminal $'\C-u'"$line"$'\C-t'
  all=
  for try in {1..1000}; do
    zpty -r -t terminal part && all+=$part || sleep 0.01
    [[ $all == *'<end>'* ]] && break
  done
  print -r -- "$all" | tr -d '\r' | sed -n '/^<end>/d; s/^<\(.*\)>$/\1/p'
done
zpty -d terminal
)");
  check("zsh -f script");
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
