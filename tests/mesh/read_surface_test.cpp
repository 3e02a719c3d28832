#include "mesh/read_surface.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "support/temporary_folder.h"

namespace tetraglass::mesh {
namespace {

MeshData read(const std::string& name, const std::string& content) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder.file(name), content);
  return read_surface(folder.file(name));
}

/// The message, without the name of the file; empty if it is read.
std::string error_of(const std::string& name, const std::string& content) {
  try {
    static_cast<void>(read(name, content));
  } catch (const base::ReadError& error) {
    const std::string what = error.what();
    return what.substr(what.find(name) + name.size() + 2);
  }
  return "";
}

void expect_triangle(const MeshData& mesh) {
  ASSERT_EQ(mesh.cell_count(), 1U);
  EXPECT_EQ(mesh.types[0], CellType::triangle);
  ASSERT_EQ(mesh.points.size(), 3U);
  EXPECT_EQ(mesh.points[mesh.cell(0)[0]], Eigen::Vector3d(1.123456789012345, 0, 0));
}

TEST(ReadSurface, KeepsAllDigitsOfText) {
  expect_triangle(
      read("a.off", "OFF\n# three\n3 1 0\n1.123456789012345 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
  expect_triangle(read("a.obj", "v 1.123456789012345 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  expect_triangle(
      read("a.ply",
           "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double "
           "y\nproperty double z\nelement face 1\nproperty list uchar int "
           "vertex_indices\nend_header\n1.123456789012345 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
  expect_triangle(read("a.stl",
                       "solid s\nfacet normal 0 0 1\nouter loop\nvertex 1.123456789012345 0 "
                       "0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n"));
}

TEST(ReadSurface, KeepsPolygonsAndUnusualForms) {
  const MeshData colored = read(
      "a.off", "COFF 4 1 0\n0 0 0 255 0 0\n1 0 0 1 1 1\n1 1 0 0 0 0\n0 1 0 0 0 0\n4 0 1 2 3 9\n");
  ASSERT_EQ(colored.cell_count(), 1U);
  EXPECT_EQ(colored.types[0], CellType::quad);
  const MeshData slashes = read("a.obj",
                                "mtllib none.mtl\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0\nv 0 1 0\nvt 0 "
                                "0\nf 1/1/1 2//1 3/1 4\nf -4 -3 -2\n");
  ASSERT_EQ(slashes.cell_count(), 2U);
  EXPECT_EQ(slashes.cell(0)[3], 3U);
  EXPECT_EQ(slashes.cell(1)[0], 0U);
}

std::string ply_bytes(bool big_endian) {
  std::string bytes =
      std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
      "_endian 1.0\nelement vertex 3\nproperty float x\nproperty float "
      "y\nproperty double quality\nproperty float z\nproperty uchar red\nelement "
      "face 1\nproperty uchar flag\nproperty list ushort uint vertex_index\nend_header\n";
  const auto put = [&](auto value) {
    std::array<char, sizeof(value)> raw{};
    std::memcpy(raw.data(), &value, sizeof(value));
    if (big_endian != (std::endian::native == std::endian::big)) std::ranges::reverse(raw);
    bytes.append(raw.data(), raw.size());
  };
  for (const float i : {0.0F, 1.0F, 2.0F}) {
    put(i);
    put(i * i);
    put(10.0 * static_cast<double>(i));
    put(0.5F);
    put(std::uint8_t{200});
  }
  put(std::uint8_t{7});
  put(std::uint16_t{3});
  for (const std::uint32_t i : {2U, 0U, 1U}) put(i);
  return bytes;
}

TEST(ReadSurface, ReadsBinaryPlyOfBothByteOrders) {
  for (const bool big_endian : {false, true}) {
    const MeshData mesh = read("a.ply", ply_bytes(big_endian));
    ASSERT_EQ(mesh.points.size(), 3U);
    EXPECT_EQ(mesh.points[2], Eigen::Vector3d(2, 4, 0.5));
    ASSERT_EQ(mesh.fields.size(), 1U);  // of the color none
    EXPECT_EQ(mesh.fields[0].name, "quality");
    EXPECT_EQ(mesh.fields[0].values, (std::vector<double>{0, 10, 20}));
    ASSERT_EQ(mesh.cell_count(), 1U);
    EXPECT_EQ(mesh.cell(0)[0], 2U);
    const std::string bytes = ply_bytes(big_endian);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_NE(error_of("a.ply", bytes.substr(0, size)), "") << size;
    }
  }
}

std::string stl_bytes(std::uint32_t claimed, int triangles) {
  std::string bytes = "solid, but binary all the same: facet" + std::string(43, ' ');
  const auto put = [&](std::uint32_t word) {
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(word >> (8 * i));
  };
  put(claimed);
  for (int t = 0; t < triangles; ++t) {
    for (int i = 0; i < 12; ++i) {
      put(std::bit_cast<std::uint32_t>(i < 3 ? 0.0F : static_cast<float>((i * i + 5 * t) % 7)));
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

TEST(ReadSurface, JoinsTheCornersOfStl) {
  EXPECT_EQ(read("a.stl", stl_bytes(2, 2)).cell_count(), 2U);
  const MeshData two = read("b.stl",
                            "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 "
                            "0\nvertex 0 1 0\nendloop\nendfacet\nfacet normal 0 0 1\nouter "
                            "loop\nvertex 1 0 -0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\n"
                            "endsolid\n");
  EXPECT_EQ(two.points.size(), 4U);
}

TEST(ReadSurface, FilesWithoutFacesArePoints) {
  EXPECT_EQ(read("a.obj", "v 0 0 0\nv 1 2 3\n").points.size(), 2U);
  EXPECT_EQ(read("a.off", "OFF\n1 0 0\n1 2 3\n").points.size(), 1U);
}

TEST(ReadSurface, SaysInWhichLineAFileIsWrong) {
  EXPECT_EQ(error_of("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"),
            "line 6: point 7 is named, but there are 3 points, counted from 0");
  EXPECT_EQ(error_of("a.off", "OFF\n3 1 0\n0 0 0\n1 x 0\n"), "line 4: 'x' is no number");
  EXPECT_EQ(error_of("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n"),
            "ends at line 4, where point 2 of 3 should be");
  EXPECT_EQ(error_of("a.obj", "v 0 0 0\nf 1 2 3\n"),
            "line 2: point 2 is named, but there are 1 points, counted from 1");
  EXPECT_EQ(error_of("a.obj", "v 0 0 0\nf 0 1 1\n"),
            "line 2: point 0 is named, but there are 1 points, counted from 1");
  EXPECT_EQ(error_of("a.stl", "solid\nfacet\nouter loop\nvertex 0 0 0\nendloop\n"),
            "line 5: a facet with 1 corners");
  EXPECT_EQ(error_of("a.stl", "solid\nfacet\n"), "is cut off: there is no 'endsolid'");
}

TEST(ReadSurface, DoesNotBelieveAHeadThatClaimsTooMuch) {
  EXPECT_EQ(error_of("a.off", "OFF\n900000000 1 0\n0 0 0\n"),
            "line 2: 900000000 points cannot be in a file of 24 bytes");
  EXPECT_NE(error_of("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3000000000 0 1 2\n"), "");
  EXPECT_NE(error_of("a.stl", stl_bytes(4000000000U, 1)).find("is cut off"), std::string::npos);
  EXPECT_NE(error_of("a.ply",
                     "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float "
                     "x\nend_header\n0\n")
                .find("claims 4000000000"),
            std::string::npos);
  EXPECT_NE(error_of("a.ply",
                     "ply\nformat ascii 1.0\nelement face 1\nproperty list uint int "
                     "vertex_indices\nend_header\n4000000000 0 1 2\n"),
            "");
}

}  // namespace
}  // namespace tetraglass::mesh
