#include "project/gl/cell_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "project/gl/cell_projector.h"
#include "project/gl/gl_projector.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace tetraglass::project {
namespace {

using gl::CellCutter;
using gl::PartLimits;

double wave(const Eigen::Vector3d& p) {
  return std::sin(3 * p.x()) * std::cos(4 * p.y()) + p.z() * p.z();
}

const mesh::TetMesh& bricks() {
  static const mesh::TetMesh kMesh = tests::box({0, 0, 0}, {1, 1, 1}, 5, 5, 5, wave);
  return kMesh;
}

TEST(CellParts, CoverAllCellsInTheirOrderWithinTheLimits) {
  const mesh::TetMesh& mesh = bricks();
  std::vector<std::uint32_t> cells(mesh.cells.size());
  std::iota(cells.begin(), cells.end(), 0U);
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    if (trial > 0) std::shuffle(cells.begin(), cells.end(), random);
    const PartLimits limits{500 + random() % 9000, 1 + random() % 400, 4 + random() % 100, 16, 32};
    CellCutter cutter(mesh, limits);
    for (std::size_t first = 0; first < cells.size();) {
      const std::span<const std::uint32_t> rest = std::span(cells).subspan(first);
      const std::size_t count = cutter.next(rest);
      std::set<std::uint32_t> points;
      const auto bytes = [&](std::size_t number) { return 16 * number + 32 * points.size(); };
      for (const std::uint32_t cell : rest.first(count)) {
        points.insert(mesh.cells[cell].begin(), mesh.cells[cell].end());
      }
      EXPECT_TRUE(
          std::equal(points.begin(), points.end(), cutter.points().begin(), cutter.points().end()));
      for (std::size_t i = 0; i < cutter.points().size(); ++i) {
        EXPECT_EQ(cutter.place(cutter.points()[i]), i);
      }
      EXPECT_LE(bytes(count), limits.bytes);
      EXPECT_LE(count, limits.cells);
      EXPECT_LE(points.size(), limits.points);
      // One cell more would be too much.
      if (count < rest.size()) {
        const mesh::Cell& next = mesh.cells[rest[count]];
        points.insert(next.begin(), next.end());
        EXPECT_TRUE(bytes(count + 1) > limits.bytes || count + 1 > limits.cells ||
                    points.size() > limits.points);
      }
      first += count;
    }
  }
}

TEST(CellParts, NeedRoomForOneCell) {
  const std::vector<std::uint32_t> cells = {0, 1};
  CellCutter tight(bricks(), {16 + 4 * 16, 10, 10, 16, 16});
  EXPECT_EQ(tight.next(cells), 1U);
  CellCutter none(bricks(), {16 + 4 * 16 - 1, 10, 10, 16, 16});
  EXPECT_THROW((void)none.next(cells), base::UnavailableError);
}

struct Wanted {
  const char* name;
  Mode mode;
  std::optional<SortMethod> sort;
  Shading shading = Shading::none;
  double opacity = 1;
};

class GlPartsTest : public testing::TestWithParam<Layout> {
 protected:
  static Scene scene(const Wanted& wanted) {
    const preint::TransferFunction tf({{-1.0, {0.1, 0.2, 0.9}, 0.0},
                                       {0.2, {0.2, 1.0, 0.3}, 2.0},
                                       {0.5, {1.0, 0.3, 0.1}, 0.5},
                                       {2.0, {1.0, 0.9, 0.2}, 5.0}});
    Scene result = tests::make_scene(bricks(), wanted.mode, tf, 48);
    result.shading = wanted.shading;
    result.gradient = has_faces12(GetParam()) ? GradientOf::cell : GradientOf::vertex;
    if (wanted.mode == Mode::iso) {
      result.isosurfaces = {{0.3, {1, 0.5, 0}, wanted.opacity}, {0.8, {0, 0.5, 1}, 1}};
    }
    return result;
  }

  static Image draw(const Scene& scene, const Wanted& wanted, std::optional<std::size_t> memory,
                    Stats& stats) {
    Request request;
    request.projector = Projector::gl;
    request.sort = wanted.sort;
    request.gl.layout = GetParam();
    request.gl.memory = memory;
    return render_gl(scene, plan(scene, request), stats);
  }

  // Of the mesh on the context. (An order of the layouts of 12 vertices lies beside it.)
  static std::size_t held(const Stats& stats) {
    const auto bytes = [&](Effect effect) {
      const auto found = stats.work.find(effect);
      return found == stats.work.end() ? 0 : found->second.bytes;
    };
    return bytes(Effect::cells) + bytes(Effect::gradients);
  }

  static double largest_difference(const Image& a, const Image& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
      largest = std::max(largest, std::abs(double{a.rgba[i]} - b.rgba[i]));
    }
    return largest;
  }
};

INSTANTIATE_TEST_SUITE_P(Gl, GlPartsTest,
                         testing::Values(Layout::indexed, Layout::strip, Layout::faces12,
                                         Layout::faces12_short),
                         [](const auto& shown) {
                           std::string name = to_string(shown.param);
                           std::erase(name, '-');
                           return name;
                         });

TEST_P(GlPartsTest, SevenPartsMakeThePictureOfTheWhole) {
  const Shading lit = has_faces12(GetParam()) ? Shading::flat : Shading::smooth;
  const Wanted all[] = {
      {"thickness", Mode::thickness, {}},
      {"emission", Mode::emission, {}},
      {"absorption", Mode::absorption, {}},
      {"mip", Mode::mip, {}},
      {"full", Mode::full, {}},
      {"full, centroid", Mode::full, SortMethod::centroid},
      {"full, fragments", Mode::full, SortMethod::fragments},
      {"full, lit", Mode::full, {}, Shading::single},
      {"iso", Mode::iso, {}, lit},
      {"iso, translucent", Mode::iso, {}, lit, 0.4},
      {"iso, fragments", Mode::iso, SortMethod::fragments, lit, 0.4},
  };
  for (const Wanted& wanted : all) {
    SCOPED_TRACE(wanted.name);
    const Scene drawn = scene(wanted);
    Stats whole;
    const Image expected = draw(drawn, wanted, {}, whole);
    EXPECT_EQ(whole.parts, 1U);
    // Of a mesh on the context as a whole, half is never drawn where surfaces are.
    const std::size_t limit = held(whole) / (wanted.mode == Mode::iso ? 14 : 7);
    Stats parted;
    const Image image = draw(drawn, wanted, limit, parted);
    EXPECT_GE(parted.parts, 7U);
    EXPECT_LE(held(parted), limit);
    EXPECT_GT(held(parted), limit / 2);
    EXPECT_EQ(parted.fragments, whole.fragments);
    EXPECT_EQ(parted.sort_method, whole.sort_method);
    EXPECT_LT(largest_difference(image, expected), 1e-6);
  }
}

TEST_P(GlPartsTest, AFieldOfCellsGoesWithThem) {
  mesh::TetMesh mesh = bricks();
  mesh.fields.clear();
  std::vector<double> numbers(mesh.cells.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(i % 17);
  mesh.fields.push_back({"c", mesh::Location::cell, 1, numbers});
  const Scene drawn = tests::make_scene(
      mesh, Mode::full, preint::TransferFunction({{0, {1, 0, 0}, 1}, {16, {0, 1, 1}, 4}}), 64);
  const Wanted wanted{"", Mode::full, {}};
  Stats whole;
  const Image expected = draw(drawn, wanted, {}, whole);
  Stats parted;
  const Image image = draw(drawn, wanted, held(whole) / 7, parted);
  EXPECT_GE(parted.parts, 7U);
  EXPECT_LE(held(parted), held(whole) / 7);
  EXPECT_LT(largest_difference(image, expected), 1e-6);
}

TEST_P(GlPartsTest, AClippedMeshIsDrawnFromWhatShows) {
  Scene drawn = scene({"", Mode::full, {}});
  drawn.clip = {{{1, 0.2, 0.1}, 0.7}};
  const Wanted wanted{"", Mode::full, {}};
  Stats whole;
  const Image expected = draw(drawn, wanted, {}, whole);
  Stats parted;
  const Image image = draw(drawn, wanted, 4000, parted);
  EXPECT_GT(parted.parts, 2U);
  EXPECT_LT(largest_difference(image, expected), 1e-6);
}

TEST_P(GlPartsTest, EnoughMemoryChangesNothing) {
  const Wanted wanted{"", Mode::full, {}};
  const Scene drawn = scene(wanted);
  Stats whole;
  const Image expected = draw(drawn, wanted, {}, whole);
  Stats limited;
  EXPECT_EQ(draw(drawn, wanted, std::size_t{1} << 40, limited).rgba, expected.rgba);
  EXPECT_EQ(limited.parts, 1U);
  EXPECT_EQ(held(limited), held(whole));
}

TEST_P(GlPartsTest, TooLittleForACellIsRefused) {
  const Wanted wanted{"", Mode::full, {}};
  Stats stats;
  try {
    (void)draw(scene(wanted), wanted, 50, stats);
    ADD_FAILURE() << "not refused";
  } catch (const base::UnavailableError& error) {
    EXPECT_NE(std::string(error.what()).find("--gpu-memory"), std::string::npos);
  }
}

// From view to view each part is cut anew, along the order of the view.
TEST_P(GlPartsTest, ViewsFollowEachOther) {
  const Wanted wanted{"", Mode::full, {}};
  const Scene drawn = scene(wanted);
  Request request;
  request.projector = Projector::gl;
  request.gl.layout = GetParam();
  const auto context = gl::Context::create(ContextKind::osmesa);
  Stats stats;
  gl::CellProjector whole(*context, drawn, plan(drawn, request), stats);
  request.gl.memory = 6000;
  gl::CellProjector parted(*context, drawn, plan(drawn, request), stats);
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(1, 0.8, 0.6), Eigen::Vector3d(-1, 0.1, 0.2), Eigen::Vector3d(0, -1, 3)}) {
    const Frame frame(
        frame_camera(mesh::bounds(bricks()), direction, Eigen::Vector3d::UnitY(), 30, 1), 48, 48);
    EXPECT_LT(largest_difference(parted.draw(frame, stats), whole.draw(frame, stats)), 1e-6);
  }
}

}  // namespace
}  // namespace tetraglass::project
