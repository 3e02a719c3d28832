// The command line's contract, by running the built program.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "project/image_file.h"
#include "project/npy.h"
#include "tests/support/data.h"
#include "tests/support/program.h"

namespace tetraglass::tests {
namespace {

using Json = nlohmann::json;

class CommandLine : public testing::Test {
 protected:
  /// A small sphere sample, made once.
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const ProgramRun made =
        run_program("sample sphere --cells 3e3 -o " + folder_->file("sphere.vtu"));
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_EQ(made.out, folder_->file("sphere.vtu") + "\n");
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static std::string sphere() { return folder_->file("sphere.vtu"); }

  static std::ptrdiff_t lines_of(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
  }

  /// The program fails with this status and one line that holds `part`.
  static void expect_error(const std::string& arguments, int status, const std::string& part) {
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.status, status) << arguments << "\n" << run.err;
    const std::string prefix = "tetraglass: error: ";
    const std::size_t start = run.err.find(prefix);
    ASSERT_NE(start, std::string::npos) << arguments << "\n" << run.err;
    const std::string line = run.err.substr(start, run.err.find('\n', start) - start);
    EXPECT_NE(line.find(part), std::string::npos) << arguments << "\n" << run.err;
    if (status == 1) {
      EXPECT_EQ(lines_of(run.err), 1) << run.err;
    }
    EXPECT_EQ(run.out, "") << arguments;
  }

  TemporaryFolder output_;

 private:
  static TemporaryFolder* folder_;
};

TemporaryFolder* CommandLine::folder_ = nullptr;

TEST_F(CommandLine, RendersEveryModeToEveryFormat) {
  for (const std::string mode : {"full", "emission", "absorption", "mip", "iso", "thickness"}) {
    const std::string base = output_.file(mode);
    const ProgramRun run = run_program("render " + sphere() + " --size 48x40 --mode " + mode +
                                       " -o " + base + ".png -o " + base + ".exr -o " + base +
                                       ".npy --stats " + base + ".json --verify 50");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, base + ".png\n" + base + ".exr\n" + base + ".npy\n");
    const project::ReadImage exr = project::read_image(base + ".exr");
    const project::ReadImage npy = project::read_image(base + ".npy");
    EXPECT_EQ(exr.image.width, 48);
    EXPECT_EQ(exr.image.height, 40);
    EXPECT_EQ(exr.image.rgba, npy.image.rgba);
    EXPECT_TRUE(project::read_image(base + ".png").encoded);
    EXPECT_TRUE(std::any_of(npy.image.rgba.begin(), npy.image.rgba.end(), [](float v) {
      return v != 0;
    })) << mode;
    EXPECT_TRUE(std::all_of(npy.image.rgba.begin(), npy.image.rgba.end(),
                            [](float v) { return std::isfinite(v); }));
    const Json stats = Json::parse(read_text(base + ".json"));
    for (const std::string stage : {"read", "decompose", "tables", "sort", "project", "write"}) {
      EXPECT_TRUE(stats["stages_ms"][stage].is_number()) << stage;
    }
    for (const std::string key : {"cells", "fragments", "threads", "peak_bytes"}) {
      EXPECT_GT(stats[key].get<double>(), 0) << key;
    }
    EXPECT_EQ(stats["cells_skipped"]["degenerate"], 0);
    EXPECT_EQ(stats["cells_skipped"]["nan"], 0);
    EXPECT_EQ(stats["sort"]["method"], mode == "full" ? "fragments" : "none");
    EXPECT_EQ(stats["sort"]["exact"], true);
    EXPECT_EQ(stats["projector"], "cpu");
    EXPECT_TRUE(stats["plan"].is_array());
    EXPECT_EQ(stats["verified"]["pixels"], 50);
    EXPECT_LT(stats["verified"]["max_error"].get<double>(), 1e-4) << mode;
  }
}

TEST_F(CommandLine, CompareMeasuresTwoPictures) {
  const std::string a = output_.file("a.npy");
  const std::string b = output_.file("b.npy");
  ASSERT_EQ(run_program("render " + sphere() + " --size 32x32 -o " + a).status, 0);
  ASSERT_EQ(
      run_program("render " + sphere() + " --size 32x32 --projector reference -o " + b).status, 0);
  const ProgramRun run =
      run_program("compare " + a + " " + b + " --json -o " + output_.file("d.png"));
  ASSERT_EQ(run.status, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["pixels"], 32 * 32);
  EXPECT_GT(json["max"].get<double>(), 0);
  EXPECT_GE(json["max"].get<double>(), json["rms"].get<double>());
  EXPECT_TRUE(json["worst"]["x"].is_number_integer());
  const Json same = Json::parse(run_program("compare " + a + " " + a + " --json").out);
  EXPECT_EQ(same["max"], 0);
  expect_error("compare " + a + " " + sphere(), 1, "is not known; there are: .png .exr .npy");
  expect_error("compare " + a + " nothing.png", 1, "nothing.png");
}

TEST_F(CommandLine, ImportAndInfoAgree) {
  const std::string copy = output_.file("copy.vtu");
  const ProgramRun imported = run_program("import " + sphere() + " -o " + copy);
  ASSERT_EQ(imported.status, 0) << imported.err;
  EXPECT_EQ(imported.out, copy + "\n");
  const Json a = Json::parse(run_program("info --json " + sphere()).out);
  Json b = Json::parse(run_program("info --json " + copy).out);
  EXPECT_EQ(a, b);
  EXPECT_EQ(a["cells"]["tetra"], a["tetrahedra"]);
  for (const std::string key :
       {"points", "fields", "bounds", "degenerate", "inverted", "nan_values", "parts",
        "boundary_faces", "convex", "delaunay", "quality"}) {
    EXPECT_TRUE(a.contains(key)) << key;
  }
  EXPECT_EQ(a["convex"], true);
  EXPECT_EQ(a["parts"], 1);
  EXPECT_EQ(a["bounds"].size(), 6U);
  EXPECT_EQ(a["fields"][0]["location"], "point");
  EXPECT_GT(a["quality"]["min_dihedral_deg"].get<double>(), 0);
  EXPECT_NE(run_program("info " + sphere()).out.find("tetrahedra"), std::string::npos);
}

TEST_F(CommandLine, ImportAddsFieldsFromExpressions) {
  const std::string copy = output_.file("copy.vtu");
  const ProgramRun run = run_program("import " + sphere() + " -o " + copy +
                                     " --add-field 'half = sphere / 2' --add-field 'n=2*iHat'");
  ASSERT_EQ(run.status, 0) << run.err;
  const Json info = Json::parse(run_program("info --json " + copy).out);
  ASSERT_EQ(info["fields"].size(), 3U);
  EXPECT_NEAR(info["fields"][1]["max"].get<double>(), info["fields"][0]["max"].get<double>() / 2,
              1e-12);
  EXPECT_EQ(info["fields"][1]["name"], "half");
  EXPECT_EQ(info["fields"][2]["components"], 3);
  expect_error("import " + sphere() + " -o " + copy + " --add-field half", 2, "NAME=EXPRESSION");
  expect_error("import " + sphere() + " -o " + copy + " --add-field 'a=unknown+1'", 2, "unknown");
}

// By the library's measure where it chooses the size: the same for the table of that size.
TEST_F(CommandLine, TablesTellTheErrorOfLookups) {
  const auto print = [](const std::string& arguments) {
    return Json::parse(run_program("table --json --kind " + arguments).out);
  };
  for (const std::string kind : {"full2d", "full3d"}) {
    SCOPED_TRACE(kind);
    const Json chosen = print(kind + " --max-error 0.02");
    EXPECT_LE(chosen["lookup_error"].get<double>(), 0.02);
    Json same = print(kind + " --size " + chosen["size"].get<std::string>());
    if (kind == "full3d" && same["lookup_error"] != chosen["lookup_error"]) {
      same = print(kind + " --length-axis logarithmic --size " + chosen["size"].get<std::string>());
    }
    EXPECT_DOUBLE_EQ(same["lookup_error"].get<double>(), chosen["lookup_error"].get<double>());
  }
  EXPECT_GT(print("psi --size 17")["lookup_error"].get<double>(),
            1.5 * print("psi --size 65")["lookup_error"].get<double>());
}

// Every kind and method of the contract, with entries that agree with the exact integral to the
// rounding of floats.
TEST_F(CommandLine, TablesAreBuiltTimedAndChecked) {
  const std::string out = output_.file("t.npy");
  const std::vector<std::pair<std::string, std::size_t>> tables = {
      {"emission --size 33", 3},
      {"mip --size 33", 3},
      {"mip --size 33 --mip-of transfer", 3},
      {"iso --size 33 --isovalue 0.3 --isovalue 0.7 --iso-color 1,0,0 --iso-opacity 0.5", 3},
      {"iso --size 33 --thickening 0.03", 3},
      {"full2d --size 33", 3},
      {"full3d --size 17x9", 4},
      {"full3d --size 17x9 --length-axis logarithmic --length 20", 4},
      {"weighted --size 33", 4},
      {"weighted --size 17x9", 5},
      {"material --size 33", 3},
      {"material --size 17x9", 4},
      {"psi --size 33", 2}};
  for (const auto& [kind, rank] : tables) {
    const bool plain = std::count(kind.begin(), kind.end(), ' ') == 2;  // other options: once
    for (const std::string method : {"incremental", "brute-force", "exact"}) {
      if (!plain && method != "incremental") continue;
      SCOPED_TRACE(kind + ' ' + method);
      const std::string arguments =
          "table --kind " + kind + " --method " + method + " -o " + out + " --json";
      if (kind == "psi --size 33" && method == "incremental") {
        expect_error(arguments, 2, "psi");
        continue;
      }
      const ProgramRun run = run_program(arguments);
      ASSERT_EQ(run.status, 0) << run.err;
      const Json json = Json::parse(run.out);
      EXPECT_EQ(json["kind"], kind.substr(0, kind.find(' ')));
      EXPECT_EQ(json["method"], method);
      EXPECT_GT(json["entries_per_s"].get<double>(), 0);
      EXPECT_LT(json["max_error"].get<double>(), 2e-6);
      EXPECT_GT(json["lookup_error"].get<double>(), 0);
      EXPECT_LE(json["lookup_error"].get<double>(), 1);  // the jump at an isovalue
      const project::NpyArray table = project::parse_npy(read_text(out), out);
      EXPECT_EQ(table.shape.size(), rank);
    }
  }
  expect_error("table --kind full2d --size 32x8", 2, "NxM");
  expect_error("table --kind full3d --size 32", 2, "NxM");
  expect_error("table --kind fulll2d --size 32", 2, "'full2d'");
  expect_error("table --kind psi --max-error 1e-2", 2, "full2d and full3d");
  expect_error("table --kind full2d --max-error 1e-2 --size 32", 2, "leave out --size");
  expect_error("table --kind full2d --max-error 0", 2, "positive");
  expect_error("table --kind full3d --max-error 1e-2 --length 2:1", 2, "--length");
}

TEST_F(CommandLine, OrdersAreTimedAndVerified) {
  const auto order = [](const std::string& arguments) {
    const ProgramRun run = run_program("order " + arguments + " --rays 100 --json");
    EXPECT_EQ(run.status, 0) << run.err;
    return Json::parse(run.out);
  };
  for (const std::string method : {"mpvo", "power", "auto"}) {
    const Json json = order(sphere() + " --sort " + method);
    EXPECT_TRUE(json["exact"]) << method;
    EXPECT_EQ(json["wrong_faces"], 0) << method;
    EXPECT_EQ(json["wrong_rays"], 0) << method;
    EXPECT_EQ(json["rays"], 100);
    EXPECT_EQ(json["cycles"], 0);
    EXPECT_GT(json["cells_per_s"].get<double>(), 0);
  }
  const std::string cycle = output_.file("cycle.vtu");
  ASSERT_EQ(run_program("sample cycle -o " + cycle).status, 0);
  const Json json = order(cycle + " --view +z --sort mpvo");
  EXPECT_GT(json["cycles"], 0);
  EXPECT_FALSE(json["exact"]);
  EXPECT_EQ(order(cycle + " --view +z --sort fragments")["wrong_rays"], 0);
  expect_error("order " + sphere() + " --sort none --json", 2, "none");
}

// Seen along z the cells of `cycle` hide each other in rings: every pixel has to be sorted by
// itself.
TEST_F(CommandLine, CyclesAreDrawnAsTheReferenceDoes) {
  const std::string cycle = output_.file("cycle.vtu");
  ASSERT_EQ(run_program("sample cycle -o " + cycle).status, 0);
  for (const std::string how : {"--projector cpu", "--projector gl --sort fragments"}) {
    const std::string stats = output_.file("stats.json");
    const ProgramRun run =
        run_program("render " + cycle + " --view +z --size 96x96 --verify 1000 " + how + " -o " +
                    output_.file("cycle.npy") + " --stats " + stats);
    ASSERT_EQ(run.status, 0) << run.err;
    const Json json = Json::parse(read_text(stats));
    EXPECT_EQ(json["sort"]["method"], "fragments");
    EXPECT_LT(json["verified"]["max_error"].get<double>(), 1e-5) << how;
  }
}

TEST_F(CommandLine, BareValuesAreAVolumeOfTheGivenSize) {
  const std::string raw = output_.file("values.bin");
  std::string bytes;
  for (int i = 0; i < 3 * 4 * 5; ++i) bytes.push_back(static_cast<char>(i));
  std::ofstream(raw, std::ios::binary) << bytes;
  const ProgramRun run = run_program("info " + raw + " --raw 3x4x5:uint8 --json");
  ASSERT_EQ(run.status, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["points"], 60);
  EXPECT_EQ(json["fields"][0]["max"], 59);
  EXPECT_EQ(json["bounds"], Json({0, 2, 0, 3, 0, 4}));
  expect_error("info " + raw + " --raw 3x4x6:uint8", 1, "values.bin");
}

TEST_F(CommandLine, ErrorsSayWhichFileAndLeaveNothing) {
  const std::string out = " -o " + output_.file("x.png");
  expect_error("render nothing.vtu" + out, 1, "nothing.vtu");
  write_text(output_.file("empty.vtu"), "");
  expect_error("render " + output_.file("empty.vtu") + out, 1, "empty.vtu");
  write_text(output_.file("junk.vtu"), "this is no mesh\n");
  expect_error("render " + output_.file("junk.vtu") + out, 1, "junk.vtu");
  const std::string whole = read_text(sphere());
  write_text(output_.file("cut.vtu"), whole.substr(0, whole.size() / 2));
  expect_error("render " + output_.file("cut.vtu") + out, 1, "cut.vtu");
  write_text(output_.file("mesh.vtx"), whole);
  expect_error("render " + output_.file("mesh.vtx") + out, 1, ".vtu");
  expect_error("render " + sphere() + " --field sfere" + out, 1, "'sphere'");
  expect_error("render " + sphere() + " --field sfere" + out, 1, "sphere.vtu");
  expect_error("render " + sphere() + " -o " + output_.file("x.jpg"), 1, ".png");
  expect_error("render " + sphere() + " -o " + output_.file("x"), 1, "has no extension");
  expect_error("render -" + out, 1, "standard input");
  expect_error("info " + output_.file("") + "/", 1, "is a folder");
  expect_error("render " + sphere() + " -o " + output_.file("none/x.png"), 1, "none");
  expect_error("render " + sphere() + " --tf nothing.json" + out, 1, "nothing.json");
  for (const std::string name : {"empty.vtu", "junk.vtu", "cut.vtu", "mesh.vtx"})
    ::unlink(output_.file(name).c_str());
  EXPECT_TRUE(output_.is_empty());
}

// A mesh alone is drawn too: by its height, and this is told.
TEST_F(CommandLine, AMeshWithoutFieldsIsDrawnByItsHeight) {
  const std::string mesh = output_.file("one.node");
  write_text(mesh, "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n");
  write_text(output_.file("one.ele"), "1 4 0\n1 1 2 3 4\n");
  const std::string render = "render " + mesh + " --size 24x18 -o ";
  const ProgramRun run = run_program(render + output_.file("a.npy"));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("one.node: has no fields; drawn by 'z'"), std::string::npos) << run.err;
  ASSERT_EQ(run_program(render + output_.file("b.npy") + " --field z").status, 0);
  EXPECT_EQ(read_text(output_.file("a.npy")), read_text(output_.file("b.npy")));
}

TEST_F(CommandLine, UnwritableOutputIsAnErrorBeforeTheWork) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  ::chmod(output_.file("").c_str(), 0500);
  expect_error("render " + sphere() + " -o " + output_.file("x.png"), 1, "x.png");
  ::chmod(output_.file("").c_str(), 0700);
}

TEST_F(CommandLine, WrongUsageShowsTheRightOne) {
  const std::string out = " -o " + output_.file("x.png");
  expect_error("", 2, "render, import, info");
  expect_error("render " + sphere() + " " + output_.file("x.png"), 2, "behind -o");
  EXPECT_EQ(lines_of(run_program("view").err), 3);
  expect_error("rendr x", 2, "'render'");
  expect_error("render", 2, "INPUT");
  expect_error("render " + sphere(), 2, "--output");
  expect_error("render " + sphere() + out + " --feild x", 2, "'--field'");
  expect_error("render " + sphere() + out + " --mode emmission", 2, "'emission'");
  expect_error("render " + sphere() + out + " --tf viridiss", 2, "'viridis'");
  expect_error("render " + sphere() + out + " --size 5", 2, "--size");
  expect_error("render " + sphere() + out + " --eye 0,0", 2, "--eye");
  expect_error("render " + sphere() + out + " --sort none", 2, "--sort");
  expect_error("render " + sphere() + out + " --fov 200", 2, "--fov");
  expect_error("render " + sphere() + out + " --eye 0,0,9 --target 0,0,9", 2, "eye and target");
  expect_error("sample orbitl -o " + output_.file("x.vtu"), 2, "'orbital'");
  const std::string sample = "sample orbital -o " + output_.file("x.vtu") + " --cells ";
  expect_error(sample + "0", 2, "--cells needs a whole number of at least 1");
  expect_error(sample + "1.5", 2, "--cells needs a whole number of at least 1");
  expect_error(sample + "1e10", 2, "--cells can be no more than 2147483647");
  // Of what can be asked for, the most memory: 150 GB as a grid, over 1 TB by TetGen.
  expect_error(sample + "2e9", 2, "GB of memory");
  expect_error("sample heat-sink --cells 2e9 -o " + output_.file("x.vtu"), 2, "GB of memory");
  EXPECT_TRUE(output_.is_empty());
}

TEST_F(CommandLine, WaysToMakeTetrahedraAreChecked) {
  const TemporaryFolder folder;
  const std::string box = folder.file("box.off");
  write_text(box,
             "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
             "4 0 3 2 1\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n4 4 5 6 7\n");
  const std::string import = "import " + box + " -o " + folder.file("box.vtu");
  expect_error(import + " --tetrahedralize tetgne", 2, "did you mean 'tetgen'");
  expect_error(import + " --quality 0.5", 2, "a ratio above 1");
  expect_error(import + " --quality 2:90", 2, "below 60");
  expect_error(import + " --max-volume 0", 2, "above 0");
  expect_error(import + " --weld -1", 2, "at least 0");
  expect_error(import + " --hole 1,2", 2, "3 numbers");
  expect_error(import + " --largest-hole 0.5", 2, "--repair");
  expect_error(import + " --labels --surface-at 1", 2, "--labels");
  expect_error(import + " --surface-at 1", 1, "regular grid");
  expect_error("info " + sphere() + " --tetrahedralize tetgen", 1, "for surfaces");
  const ProgramRun run = run_program(import + " --max-volume 0.01 --hole 0.5,0.5,7");
#ifdef TETRAGLASS_WITH_TETGEN
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("(0.5, 0.5, 7), lies outside"), std::string::npos) << run.err;
  EXPECT_EQ(run_program(import + " --max-volume 0.01 --quality 1.5:10").status, 0);
#endif
}

TEST_F(CommandLine, HelpAndVersion) {
  EXPECT_EQ(run_program("--help").status, 0);
  const ProgramRun help = run_program("render --help");
  EXPECT_EQ(help.status, 0);
  for (const std::string option : {"--mode", "--isovalue", "--ortho", "--verify", "--stats"}) {
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
  }
  const ProgramRun version = run_program("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_NE(version.out.find("BSD-3-Clause"), std::string::npos);
}

TEST_F(CommandLine, NegativeNumbersAreValuesNotOptions) {
  const ProgramRun run =
      run_program("render " + sphere() +
                  " --size 16x16 --view -z --up -1,0,0 --isovalue -5 --isovalue 0.5 "
                  "--mode iso -o " +
                  output_.file("x.png"));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("isovalue -5 lies outside"), std::string::npos) << run.err;
}

TEST_F(CommandLine, ExplainPrintsThePlan) {
  const ProgramRun run = run_program(
      "render " + sphere() + " --size 16x16 --mode emission --explain -o " + output_.file("x.png"));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("order: none"), std::string::npos) << run.out;
}

// The paper's number of cells; the singular line's cells without volume are counted, not drawn.
TEST_F(CommandLine, BluntFinHasThePapersCells) {
  SKIP_WITHOUT_DATA();
  const std::string fin = (data_folder() / "classics" / "bluntfinxyz.bin").string();
  const Json info = Json::parse(run_program("info --json " + fin).out);
  EXPECT_EQ(info["tetrahedra"], 224874);
  EXPECT_EQ(info["cells"]["hexahedron"], 37479);
  EXPECT_GT(info["degenerate"].get<int>(), 0);
  const std::string picture = output_.file("fin.npy");
  const ProgramRun run = run_program("render " + fin + " --size 64x64 -o " + picture + " --stats " +
                                     output_.file("fin.json"));
  ASSERT_EQ(run.status, 0) << run.err;
  const Json stats = Json::parse(read_text(output_.file("fin.json")));
  EXPECT_EQ(stats["cells"], 224874);
  EXPECT_EQ(stats["cells_skipped"]["degenerate"], info["degenerate"]);
  const project::Image image = project::read_image(picture).image;
  EXPECT_TRUE(
      std::all_of(image.rgba.begin(), image.rgba.end(), [](float v) { return std::isfinite(v); }));
}

TEST_F(CommandLine, RegionsAndSamples) {
  const std::string render = "render " + sphere() + " --mode thickness --size 40x30 -o ";
  const std::string whole = output_.file("whole.npy");
  const std::string part = output_.file("part.npy");
  ASSERT_EQ(run_program(render + whole).status, 0);
  ASSERT_EQ(run_program(render + part + " --region 10,5,20,15").status, 0);
  const project::Image all = project::read_image(whole).image;
  const project::Image some = project::read_image(part).image;
  ASSERT_EQ(some.width, 20);
  ASSERT_EQ(some.height, 15);
  EXPECT_NEAR(some.pixel(7, 3)[0], all.pixel(17, 8)[0], 1e-5);
  const ProgramRun smooth = run_program(render + part + " --samples 4 --verify 50");
  EXPECT_EQ(smooth.status, 0) << smooth.err;
  EXPECT_EQ(project::read_image(part).image.width, 40);
  expect_error(render + part + " --samples 5", 2, "4 and 9");
  expect_error(render + part + " --samples 3", 2, "1 and 4");
  expect_error(render + part + " --region 30,5,20,15", 2, "leaves the picture");
  expect_error(render + part + " --region 1,2,3", 2, "--region");
  expect_error(render + part + " --region 1,2,3,0", 2, "whole pixels");
  expect_error("render " + sphere() + " --size 40000x10 --samples 4 -o " + part, 2, "65536");
}

// Every library that the program is linked to is in --version, with its licence.
TEST_F(CommandLine, VersionNamesWhatIsLinked) {
  const std::string version = run_program("--version").out;
  const std::string list = output_.file("needed");
  if (std::system(("readelf -d '" TETRAGLASS_PROGRAM "' >'" + list + "' 2>/dev/null").c_str()) != 0)
    GTEST_SKIP() << "readelf is not installed";
  const std::vector<std::pair<std::string, std::string>> names = {
      {"libvtk", "VTK"},           {"libnetcdf", "NetCDF"},
      {"libmedC", "MED"},          {"libtet", "TetGen"},
      {"libOpenMesh", "OpenMesh"}, {"libgmsh", "Gmsh"},
      {"libmpfr", "MPFR"},         {"libgmp", "GMP"},
      {"libOSMesa", "OSMesa"},     {"libEGL", "EGL"},
      {"libpng", "libpng"},        {"libOpenEXR", "OpenEXR"},
      {"libfmt", "fmt"},           {"libtbb", "oneTBB"},
      {"libcairo", "Cairo"},       {"libfontconfig", "Fontconfig"},
      {"libglfw", "GLFW"},         {"libstb", "stb"},
      {"libhwy", "Highway"},       {"libexpat", "expat"},
      {"libcerf", "libcerf"},      {"libz.", "zlib"},
      {"libbz2", "bzip2"},         {"libX11", "libX11"}};
  // The compiler's and the system's own, whose licences ask for nothing here.
  const std::vector<std::string> own = {"libstdc++",  "libm.",  "libgcc_s", "libc.",   "ld-linux",
                                        "libpthread", "libdl.", "libasan",  "libubsan"};
  std::istringstream lines(read_text(list));
  std::size_t seen = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t start = line.find('[');
    if (line.find("NEEDED") == std::string::npos || start == std::string::npos) continue;
    const std::string library = line.substr(start + 1);
    const auto begins = [&](const std::string& name) { return library.starts_with(name); };
    if (std::any_of(own.begin(), own.end(), begins)) continue;
    ++seen;
    const auto found = std::find_if(names.begin(), names.end(),
                                    [&](const auto& name) { return begins(name.first); });
    ASSERT_NE(found, names.end()) << library << " is new: --version must name its licence";
    EXPECT_NE(version.find(found->second), std::string::npos) << library;
  }
  EXPECT_GE(seen, 15U);
}

}  // namespace
}  // namespace tetraglass::tests
