// Options of reading and meshing, by running the built program.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"

namespace tetraglass::tests {
namespace {

using Json = nlohmann::json;

Json info(const std::string& arguments) {
  const ProgramRun run = run_program("info --json " + arguments);
  EXPECT_EQ(run.status, 0) << run.err;
  return Json::parse(run.out, nullptr, false);
}

/// The largest value of the field `step`.
double step_of(const std::string& arguments) {
  const Json told = info(arguments);
  for (const Json& field : told["fields"]) {
    if (field["name"] == "step") return field["max"];
  }
  return std::nan("");
}

void write_cube(const std::string& file) {
  write_text(file,
             "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n4 0 3 2 1\n"
             "4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
}

TEST(ImportCommand, TimeChoosesAStep) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program("sample linear --cells 500 -o " + folder.file("a.vtu")).status, 0);
  std::string steps;
  for (int i = 0; i < 3; ++i) {
    const std::string name = fmt::format("s{}.vtu", i);
    ASSERT_EQ(run_program("import " + folder.file("a.vtu") + " -o " + folder.file(name) +
                          " --add-field 'step=100+x*0+" + std::to_string(i) + "'")
                  .status,
              0);
    steps += "<DataSet timestep='" + std::to_string(0.5 * i * i) + "' file='" + name + "'/>";
  }
  const std::string series = folder.file("series.pvd");
  write_text(series, "<VTKFile type='Collection' version='0.1'><Collection>" + steps +
                         "</Collection></VTKFile>");
  EXPECT_EQ(step_of(series), 102);
  EXPECT_EQ(step_of(series + " --time last"), 102);
  EXPECT_EQ(step_of(series + " --time 0.6"), 101);  // the nearest of 0, 0.5 and 2
  EXPECT_EQ(step_of(series + " --time index:0"), 100);
  const std::string written = folder.file("b.vtu");
  ASSERT_EQ(run_program("import " + series + " --time index:1 -o " + written).status, 0);
  EXPECT_EQ(step_of(written), 101);
  for (const char* wrong : {"index:3", "index:-1", "soon", "nan"}) {
    const ProgramRun run = run_program("info " + series + " --time " + wrong);
    EXPECT_EQ(run.status, 2) << wrong << run.err;
    EXPECT_NE(run.err.find(wrong), std::string::npos) << run.err;
  }
  // A picture of a step is that of its file, and not that of another step.
  const auto render = [&](const std::string& input, const std::string& output) {
    const ProgramRun run = run_program("render " + input + " -o " + folder.file(output) +
                                       " --size 16x16 --field step --range 99:103");
    ASSERT_EQ(run.status, 0) << run.err;
  };
  const auto difference = [&](const std::string& a, const std::string& b) {
    const ProgramRun run = run_program("compare --json " + folder.file(a) + " " + folder.file(b));
    return Json::parse(run.out, nullptr, false)["max"].get<double>();
  };
  render(series + " --time 0.5", "chosen.npy");
  render(folder.file("s1.vtu"), "right.npy");
  render(folder.file("s2.vtu"), "wrong.npy");
  EXPECT_EQ(difference("chosen.npy", "right.npy"), 0);
  EXPECT_GT(difference("chosen.npy", "wrong.npy"), 0.01);
}

TEST(ImportCommand, RefineQuadraticCutsAlongAllPoints) {
  const TemporaryFolder folder;
  const std::string file = folder.file("q.vtk");
  write_text(file,
             "# vtk DataFile Version 3.0\nq\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 10 double\n"
             "0 0 0 2 0 0 0 2 0 0 0 2 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 0 1 1\nCELLS 1 11\n"
             "10 0 1 2 3 4 5 6 7 8 9\nCELL_TYPES 1\n24\nPOINT_DATA 10\nSCALARS s double 1\n"
             "LOOKUP_TABLE default\n0 1 2 3 4 5 6 7 8 9\n");
  const Json corners = info(file);
  EXPECT_EQ(corners["cells"], Json({{"quadratic_tetra", 1}}));
  EXPECT_EQ(corners["tetrahedra"], 1);
  EXPECT_NE(run_program("info " + file).err.find("1 cells of higher order are drawn by their"),
            std::string::npos);
  const Json fine = info(file + " --refine-quadratic");
  EXPECT_EQ(fine["tetrahedra"], 8);
  EXPECT_EQ(fine["fields"][0]["max"], 9);
  EXPECT_NE(run_program("info --refine-quadratic " + file).err.find("are cut into 8 linear ones"),
            std::string::npos);
}

TEST(ImportCommand, MaxVolumeBoundsTetrahedraAndTellsTheLargest) {
  const TemporaryFolder folder;
  const std::string cube = folder.file("cube.off");
  write_cube(cube);
  const std::string phrase = "the largest tetrahedron has a volume of ";
  const auto largest = [&](const std::string& options) {
    const ProgramRun run = run_program("import " + cube + " -o " + folder.file("cube.vtu") +
                                       " --max-volume 0.001 " + options);
    const std::size_t at = run.err.find(phrase);
    if (run.status != 0 || at == std::string::npos) {
      ADD_FAILURE() << run.status << run.err;
      return 0.0;
    }
    const double told = std::stod(run.err.substr(at + phrase.size()));
    const bool warned = run.err.find("more than the 0.001 asked for") != std::string::npos;
    EXPECT_EQ(warned, told > 0.001) << run.err;
    const Json mesh = info(folder.file("cube.vtu"));
    EXPECT_GE(mesh["tetrahedra"].get<double>() * told, 0.999) << "as many as fill the cube";
    return told;
  };
#ifdef TETRAGLASS_WITH_TETGEN
  EXPECT_LE(largest("--tetrahedralize tetgen"), 0.001);
#endif
#ifdef TETRAGLASS_WITH_CGAL
  EXPECT_LE(largest("--tetrahedralize cgal"), 0.0014);
#endif
}

#if defined(TETRAGLASS_WITH_TETGEN) || defined(TETRAGLASS_WITH_CGAL)

/// What the command prints on a terminal.
std::string on_terminal(const std::string& arguments) {
  const TemporaryFolder folder;
  const std::string command = "script -qefc \"'" TETRAGLASS_PROGRAM "' " + arguments + "\" '" +
                              folder.file("typescript") + "' >/dev/null 2>&1 </dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  return read_text(folder.file("typescript"));
}

/// Fills a cube, which takes over a second.
void expect_bar_on_a_terminal_alone(const std::string& options, const std::string& label) {
  const TemporaryFolder folder;
  const std::string cube = folder.file("cube.off");
  write_cube(cube);
  const std::string work = "import " + cube + " " + options + " -o " + folder.file("cube.vtu");
  const std::string shown = on_terminal(work);
  EXPECT_NE(shown.find("\r\033[K" + label), std::string::npos) << shown;
  const ProgramRun quiet = run_program(work);
  EXPECT_EQ(quiet.status, 0) << quiet.err;
  EXPECT_EQ(quiet.err.find('\r'), std::string::npos) << quiet.err;
  EXPECT_EQ(quiet.err.find('\033'), std::string::npos) << quiet.err;
}

TEST(ImportCommand, LongWorkShowsABarOnATerminalAlone) {
  if (std::system("script --version >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "the program 'script', which makes a terminal, is not there";
  }
  if (!has_terminals()) GTEST_SKIP() << "this machine gives no terminals (/dev/pts)";
#ifdef TETRAGLASS_WITH_TETGEN
  expect_bar_on_a_terminal_alone("--max-volume 4e-6", "TetGen");
#endif
#ifdef TETRAGLASS_WITH_CGAL
  expect_bar_on_a_terminal_alone("--tetrahedralize cgal --max-volume 1e-4", "CGAL");
#endif
}

#endif

}  // namespace
}  // namespace tetraglass::tests
