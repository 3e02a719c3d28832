#include "mesh/heat_sink.h"

#include <algorithm>
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "mesh/check.h"
#include "tests/support/meshes.h"

namespace tetraglass::mesh {
namespace {

constexpr double kVolume = (60 * 60 * 6 + 9 * 2 * 60 * 24) * 1e-9;  // m^3

TEST(HeatSink, SurfaceIsClosedAndFacesOutwards) {
  const MeshData surface = heat_sink_surface();
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  double volume = 0;
  for (std::size_t i = 0; i < surface.cell_count(); ++i) {
    const auto face = surface.cell(i);
    ASSERT_EQ(face.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) ++uses[{face[k], face[(k + 1) % 4]}];
    const auto& p = surface.points;
    volume += p[face[0]].cross(p[face[1]]).dot(p[face[2]]) / 6 +
              p[face[0]].cross(p[face[2]]).dot(p[face[3]]) / 6;
  }
  for (const auto& [edge, count] : uses) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(uses.count({edge.second, edge.first}), 1U);
  }
  EXPECT_NEAR(volume, kVolume, 1e-12 * kVolume);
}

#ifdef TETRAGLASS_WITH_TETGEN
TEST(HeatSink, TemperatureIsHotAtTheChipAndCoolAtTheRim) {
  const TetMesh mesh = make_heat_sink(20000);
  double volume = 0;
  for (const Cell& cell : mesh.cells) volume += tests::volume(mesh, cell);
  EXPECT_NEAR(volume, kVolume, 1e-9 * kVolume);
  const Soundness soundness = check(mesh);
  EXPECT_EQ(soundness.parts, 1U);
  EXPECT_EQ(soundness.crowded_faces, 0U);
  ASSERT_EQ(mesh.fields.size(), 1U);
  const std::vector<double>& temperature = mesh.fields[0].values;
  const auto hottest =
      std::max_element(temperature.begin(), temperature.end()) - temperature.begin();
  const Eigen::Vector3d place = mesh.points[static_cast<std::size_t>(hottest)];
  EXPECT_LT((place - Eigen::Vector3d(0.03, 0.03, 0)).norm(), 0.006)
      << "above the middle of the chip";
  EXPECT_GT(*std::min_element(temperature.begin(), temperature.end()), 25);
}

TEST(HeatSink, HasAboutAsManyCellsAsAskedFor) {
  for (const std::size_t cells : {50000U, 150000U}) {
    const auto made = static_cast<double>(make_heat_sink(cells).cells.size());
    EXPECT_GT(made, 0.8 * static_cast<double>(cells));
    EXPECT_LT(made, 1.4 * static_cast<double>(cells));
  }
}
#endif

}  // namespace
}  // namespace tetraglass::mesh
