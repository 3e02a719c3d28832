// Grids drawn by their trilinear field: --projector slices and grid-reference.
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace tetraglass::tests {
namespace {

class SlicesCommand : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    const std::string path = folder_.file(name);
    std::ofstream(path) << text;
    return path;
  }

  /// 4 x 3 x 3 points.
  std::string nrrd() {
    return write("ramp.nrrd",
                 "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 3 3\nspacings: 1 2 1.5\n"
                 "encoding: ascii\n\n" +
                     values());
  }
  std::string rectilinear() {
    return write("uneven.vtk",
                 "# vtk DataFile Version 3.0\nx\nASCII\nDATASET RECTILINEAR_GRID\n"
                 "DIMENSIONS 4 3 3\nX_COORDINATES 4 float\n0 1 3 3.5\nY_COORDINATES 3 float\n"
                 "0 2 3\nZ_COORDINATES 3 float\n-1 0 2\nPOINT_DATA 36\nSCALARS s float 1\n"
                 "LOOKUP_TABLE default\n" +
                     values());
  }
  std::string curvilinear() {
    std::string points;
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 4; ++i) {
          points += std::to_string(i) + ' ' + std::to_string(j + 0.1 * i * i) + ' ' +
                    std::to_string(k) + '\n';
        }
      }
    }
    return write("bent.vtk",
                 "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_GRID\n"
                 "DIMENSIONS 4 3 3\nPOINTS 36 float\n" +
                     points + "POINT_DATA 36\nSCALARS s float 1\nLOOKUP_TABLE default\n" +
                     values());
  }
  static std::string values() {
    std::string text;
    for (int i = 0; i < 36; ++i) text += std::to_string(i * 7 % 20) + ' ';
    return text + '\n';
  }

  /// The largest error that --verify found.
  double largest_error(const std::string& options) {
    const std::string stats = folder_.file("stats.json");
    const ProgramRun run = run_program("render " + options + " --size 40x30 --verify 200 --stats " +
                                       stats + " -o " + folder_.file("a.npy"));
    EXPECT_EQ(run.status, 0) << run.err;
    if (run.status != 0) return 1;
    const auto json = nlohmann::json::parse(std::ifstream(stats));
    EXPECT_NE(json["projector"], "cpu");
    return json["verified"]["max_error"];
  }

  void expect_refused(const std::string& options, int status, const std::string& advice) {
    const ProgramRun run = run_program("render " + options + " -o " + folder_.file("b.npy"));
    EXPECT_EQ(run.status, status) << options;
    EXPECT_NE(run.err.find(advice), std::string::npos) << run.err;
  }

  TemporaryFolder folder_;
};

TEST_F(SlicesCommand, DrawsUniformAndRectilinearGrids) {
  EXPECT_LT(largest_error(rectilinear() + " --projector grid-reference"), 1e-6);
  for (const std::string way : {" --stack 2d", " --classify post", " --brick 300"}) {
    EXPECT_LT(largest_error(rectilinear() + " --projector slices --slices 800" + way), 2e-3) << way;
  }
  EXPECT_LT(largest_error(nrrd() + " --projector slices --mode thickness --slice-distance 0.1"),
            1e-4);
}

TEST_F(SlicesCommand, RefusesWhatSlicesLackAndSaysWhatToDo) {
  const std::string grid = nrrd();
  expect_refused(curvilinear() + " --projector slices", 1, "draw its cells (--projector auto)");
  expect_refused(grid + " --slices 100", 2, "--projector slices");
  expect_refused(grid + " --projector slices --slice-distance -1", 2, "--slice-distance");
  expect_refused(grid + " --projector slices --stack 4d", 2, "did you mean '3d'");
  expect_refused(grid + " --projector slices --texel-bits 10", 2, "12");
  expect_refused(grid + " --projector slices --compress on", 2, "--stack 2d");
  expect_refused(grid + " --projector slices --stack 2d --brick 100", 2, "--stack 3d");
  expect_refused(grid + " --projector slices --brick 10", 1, "larger bricks");
  expect_refused(grid + " --projector slices --classify pre --mode mip", 2, "--mode full");
}

}  // namespace
}  // namespace tetraglass::tests
