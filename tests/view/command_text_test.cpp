#include "apps/view/command_text.h"

#include <algorithm>
#include <set>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "apps/view/controls.h"
#include "tests/support/program.h"

namespace tetraglass::apps::view {
namespace {

struct Parsed {
  RenderArguments arguments;
  std::vector<TypedOption> typed;
};

/// As `view` reads them.
Parsed parse(const std::vector<std::string>& words) {
  CLI::App app;
  Parsed parsed;
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  app.add_option("INPUT", parsed.arguments.input);
  app.add_option("-o", parsed.arguments.outputs);
  add_scene_options(&app, parsed.arguments);
  add_figure_options(&app, parsed.arguments.figure);
  add_camera_options(&app, parsed.arguments);
  add_method_options(&app, parsed.arguments);
  std::vector<std::string> reversed(words.rbegin(), words.rend());
  app.parse(reversed);
  parsed.typed = typed_options(app);
  return parsed;
}

std::vector<std::string> again(const std::vector<std::string>& words) {
  const Parsed parsed = parse(words);
  std::vector<std::string> result = render_words(parsed.arguments, parsed.typed, "out.png");
  EXPECT_EQ(result.front(), "render");
  result.erase(result.begin());
  return result;
}

// Whatever is typed comes out again, once, and reads as the same.
TEST(CommandText, EveryOptionOfASceneSurvives) {
  CLI::App app;
  RenderArguments arguments;
  add_scene_options(&app, arguments);
  add_figure_options(&app, arguments.figure);
  add_camera_options(&app, arguments);
  add_method_options(&app, arguments);
  // Options that check what they are given.
  const std::map<std::string, std::string> values = {
      {"tetrahedralize", "cgal"}, {"quality", "1.5:10"}, {"max-volume", "0.5"},  {"hole", "-1,2,3"},
      {"weld", "1e-5"},           {"surface-at", "3"},   {"largest-hole", "0.5"}};
  std::size_t tested = 0;
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_lnames().empty() ? "" : option->get_lnames().front();
    if (name.empty() || name == "help") continue;
    std::vector<std::string> typed = {"mesh.vtu"};
    if (name == "largest-hole") typed.emplace_back("--repair");
    const bool flag = option->get_expected_max() == 0;
    const auto found = values.find(name);
    typed.push_back(flag ? "--" + name
                         : "--" + name + "=" + (found == values.end() ? "-1 'x'" : found->second));
    const std::vector<std::string> once = again(typed);
    EXPECT_EQ(std::ranges::count_if(once,
                                    [&](const std::string& word) {
                                      return word == "--" + name ||
                                             word.starts_with("--" + name + "=");
                                    }),
              1)
        << name;
    if (!flag) {
      const std::string& value = typed.back().substr(name.size() + 3);
      EXPECT_TRUE(std::ranges::any_of(once, [&](const std::string& word) {
        return word.ends_with(value);
      })) << name;
    }
    EXPECT_EQ(again(once), once) << name;
    ++tested;
  }
  EXPECT_GT(tested, 50U);
}

TEST(CommandText, RepeatedOptionsKeepTheirOrder) {
  const std::vector<std::string> words = again(
      {"mesh.vtu", "--isovalue", "2", "--isovalue=-1", "--clip", "1,0,0,0", "--clip", "0,1,0,0.5"});
  EXPECT_EQ(words,
            (std::vector<std::string>{"mesh.vtu", "--isovalue", "2", "--isovalue=-1", "--clip",
                                      "1,0,0,0", "--clip", "0,1,0,0.5", "-o", "out.png"}));
}

TEST(CommandText, DefaultsAreNotSaid) {
  EXPECT_EQ(again({"mesh.vtu"}), (std::vector<std::string>{"mesh.vtu", "-o", "out.png"}));
}

// The shell gives the words back.
TEST(CommandText, AShellReadsTheSameWords) {
  const std::vector<std::string> words = {"plain-1.5e-3", "it's",    "a b",       "$HOME", "",
                                          "\"q\"",        "a;b|c&d", "new\nline", "*",     "\\",
                                          "#x",           "~"};
  std::string line = shell_line(words);
  ASSERT_TRUE(line.starts_with("tetraglass "));
  line.replace(0, 10, "printf '%s\\0'");
  const tests::TemporaryFolder folder;
  ASSERT_EQ(std::system((line + " >'" + folder.file("words") + "'").c_str()), 0);
  std::string expected;
  for (const std::string& word : words) expected += word + '\0';
  EXPECT_EQ(tests::read_text(folder.file("words")), expected);
}

TEST(Controls, HelpAndGuideTellAllOfThem) {
  const std::string help = tests::run_program("view --help").out;
  const std::string guide = tests::read_text(TETRAGLASS_SOURCE_DIR "/docs/viewing.md");
  for (const Control& control : controls()) {
    for (const std::string& text : {help, guide}) {
      EXPECT_NE(text.find(control.input), std::string::npos) << control.input;
      EXPECT_NE(text.find(control.effect), std::string::npos) << control.effect;
    }
  }
}

TEST(Controls, NoKeyMeansTwoThings) {
  std::set<std::pair<int, bool>> keys;
  for (const Control& control : controls()) {
    if (control.key != 0) {
      EXPECT_TRUE(keys.emplace(control.key, control.control).second) << control.input;
    }
  }
}

}  // namespace
}  // namespace tetraglass::apps::view
