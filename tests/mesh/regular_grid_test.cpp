#include "mesh/regular_grid.h"

#include <array>

#include <gtest/gtest.h>

#include "base/errors.h"

namespace tetraglass::mesh {
namespace {

Volume slanted(std::array<std::size_t, 3> size) {
  Volume volume;
  volume.size = size;
  volume.origin = {10, 20, 30};
  volume.axes << 0.1, 0.02, 0, 0, -0.3, 0.01, 0, 0, 0.5;
  for (std::size_t i = 0; i < volume.points(); ++i) volume.values.push_back(double(i % 17));
  return volume;
}

TEST(RegularGrid, IsFoundInThePointsOfAVolume) {
  const Volume volume = slanted({5, 4, 3});
  const Volume found = regular_grid(volume_mesh(volume), "");
  EXPECT_EQ(found.size, volume.size);
  EXPECT_LT((found.origin - volume.origin).norm(), 1e-14);
  EXPECT_LT((found.axes - volume.axes).norm(), 1e-14);
  EXPECT_EQ(found.values, volume.values);
}

TEST(RegularGrid, OtherPointsAreRefused) {
  MeshData data = volume_mesh(slanted({5, 4, 3}));
  data.points[17].x() += 0.01;
  EXPECT_THROW(static_cast<void>(regular_grid(data, "")), base::InputError);
  data = volume_mesh(slanted({5, 4, 3}));
  data.points.pop_back();
  EXPECT_THROW(static_cast<void>(regular_grid(data, "")), base::InputError);
  EXPECT_THROW(static_cast<void>(regular_grid({}, "")), base::InputError);
}

TEST(RegularGrid, OfCellsIsThatOfTheirCentres) {
  MeshData data = volume_mesh(slanted({4, 4, 4}));
  data.fields.push_back({"c", Location::cell, 1, std::vector<double>(27, 5)});
  const Volume found = regular_grid(data, "c");
  EXPECT_EQ(found.size, (std::array<std::size_t, 3>{3, 3, 3}));
  EXPECT_LT((found.origin - Eigen::Vector3d(10.06, 19.855, 30.25)).norm(), 1e-13);
  EXPECT_THROW(static_cast<void>(regular_grid(data, "d")), base::InputError);
}

TEST(Interpolate, IsExactForTrilinearFunctionsAndClampsOutside) {
  Volume volume = slanted({4, 5, 6});
  const auto f = [](const Eigen::Vector3d& at) {
    return 1 + at.x() - 2 * at.y() + 3 * at.z() + at.x() * at.y() * at.z();
  };
  for (std::size_t i = 0; i < volume.points(); ++i) {
    volume.values[i] = f({double(i % 4), double(i / 4 % 5), double(i / 20)});
  }
  const auto value = [&](const Eigen::Vector3d& at) {
    double result = 0;
    interpolate(volume, volume.values, 1, volume.origin + volume.axes * at, {&result, 1});
    return result;
  };
  for (const Eigen::Vector3d& at :
       {Eigen::Vector3d(0.3, 2.7, 4.1), Eigen::Vector3d(3, 4, 5), Eigen::Vector3d(0, 0, 0)}) {
    EXPECT_NEAR(value(at), f(at), 1e-12);
  }
  EXPECT_NEAR(value({-1, 2, 9}), f({0, 2, 5}), 1e-12);
}

}  // namespace
}  // namespace tetraglass::mesh
