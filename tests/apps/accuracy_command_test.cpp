// `tetraglass accuracy` and `render --max-error`, by running the built program.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"

namespace tetraglass::tests {
namespace {

using Json = nlohmann::json;

class AccuracyCommand : public testing::Test {
 protected:
  void SetUp() override {
    const ProgramRun made = run_program("sample sphere --cells 1e3 -o " + mesh());
    ASSERT_EQ(made.status, 0) << made.err;
  }
  [[nodiscard]] std::string mesh() const { return folder_.file("sphere.vtu"); }

  TemporaryFolder folder_;
};

TEST_F(AccuracyCommand, PageIsWholeAndLoadsNothing) {
  const ProgramRun run = run_program("accuracy " + mesh() + " -o " + folder_.file("page.html") +
                                     " --size 24x18 --mode emission");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, folder_.file("page.html") + "\n" + folder_.file("page.csv") + "\n");
  const std::string page = read_text(folder_.file("page.html"));
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_NE(page.find("</html>"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_NE(page.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
  const std::string csv = read_text(folder_.file("page.csv"));
  EXPECT_EQ(csv.substr(0, 5), "knob,");
  EXPECT_NE(csv.find("\"cpu\""), std::string::npos);
  EXPECT_NE(csv.find("\"reference\""), std::string::npos);
  // A picture and a difference of each, and a line.
  std::size_t images = 0;
  for (std::size_t at = page.find("<img"); at != std::string::npos;
       at = page.find("<img", at + 1)) {
    ++images;
  }
  const auto lines = static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n'));
  EXPECT_EQ(images, 2 * (lines - 1));
}

TEST_F(AccuracyCommand, WrongUseIsRefusedBeforeTheWork) {
  EXPECT_EQ(run_program("accuracy " + mesh()).status, 2);
  EXPECT_EQ(run_program("accuracy " + mesh() + " -o " + folder_.file("page.csv")).status, 2);
  EXPECT_EQ(run_program("accuracy " + mesh() + " -o " + folder_.file("no/page.html")).status, 1);
  EXPECT_EQ(
      run_program("accuracy " + mesh() + " --quick --full -o " + folder_.file("p.html")).status, 2);
  EXPECT_EQ(run_program("render " + mesh() + " --max-error 0 -o " + folder_.file("p.npy")).status,
            2);
  EXPECT_EQ(run_program("render " + mesh() + " --max-error x -o " + folder_.file("p.npy")).status,
            2);
}

TEST_F(AccuracyCommand, MaxErrorIsVerified) {
  for (const std::string projector : {"auto", "gl"}) {
    const ProgramRun run = run_program("render " + mesh() + " --size 48x36 --max-error 2e-3 -o " +
                                       folder_.file("p.npy") + " --projector " + projector +
                                       " --explain --stats " + folder_.file("stats.json"));
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("error: "), std::string::npos) << run.out;
    const Json stats = Json::parse(read_text(folder_.file("stats.json")));
    EXPECT_EQ(stats.at("verified").at("pixels"), 500);
    EXPECT_LE(stats.at("verified").at("max_error").get<double>(), 2e-3);
  }
}

// What a forced way cannot do is told.
TEST_F(AccuracyCommand, ErrorThatIsNotMetIsAWarning) {
  const ProgramRun run = run_program("render " + mesh() +
                                     " --size 48x36 --max-error 1e-6 --projector gl --integrator "
                                     "linear -o " +
                                     folder_.file("p.npy"));
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.err.find("is not met"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace tetraglass::tests
