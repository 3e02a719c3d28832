// Cells of hard shapes: slivers and needles, without volume, turned inside out.
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mesh/decompose.h"
#include "tests/stability/drawing.h"
#include "tests/stability/hard_meshes.h"

namespace tetraglass::tests {
namespace {

const std::string kOrigin =
    "closed form of a linear field in a convex body, moved by the roundings";

/// Dihedral angles, in radians, or how thin the cells are.
class Thin : public testing::TestWithParam<double> {
 protected:
  void expect(const std::string& name, const HardMesh& hard) {
    Record record("shapes", fmt::format("{}, {:.0e}", name, GetParam()), kOrigin);
    expect_closed_forms(record, hard.mesh, hard.body, outside_views(mesh::bounds(hard.mesh)));
  }
};

TEST_P(Thin, Layers) {
  const double h = GetParam();
  const std::vector<double> even = {-1, 0, 1};
  expect("flat layers", graded_box({even, even, std::vector<double>{-1, 0, h, 2 * h, 1}}));
}

TEST_P(Thin, Needles) {
  const double h = GetParam();
  const std::vector<double> graded = {-1, -h, h, 1};
  expect("needles", graded_box({std::vector<double>{-1, 0, 1}, graded, graded}));
}

TEST_P(Thin, Slivers) {
  expect("slivers", sliver_octahedron(GetParam()));
}

TEST_P(Thin, CapsOnAFace) {
  expect("caps", squeezed_box(Near::face, GetParam()));
}

TEST_P(Thin, WedgesAtAnEdge) {
  expect("wedges", squeezed_box(Near::edge, GetParam()));
}

TEST_P(Thin, SpikesAtAVertex) {
  expect("spikes", squeezed_box(Near::vertex, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Stability, Thin, testing::Values(1e-2, 1e-5, 1e-8), [](const auto& of) {
  return fmt::format("{}", static_cast<int>(std::lround(-std::log10(of.param))));
});

}  // namespace
}  // namespace tetraglass::tests
