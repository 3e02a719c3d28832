#include "mesh/import.h"

#include <algorithm>
#include <array>
#include <string>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "mesh/read_plot3d.h"
#include "support/data.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace tetraglass::mesh {
namespace {

std::string refusal(const std::string& file) {
  try {
    static_cast<void>(import_mesh(file));
  } catch (const base::Error& error) {
    return error.what();
  }
  return "";
}

TEST(Import, SaysWhatIsWrongWithTheFile) {
  const tests::TemporaryFolder folder;
  const std::string missing = folder.file("none.vtu");
  EXPECT_EQ(refusal(missing), missing + ": there is no such file");
  const std::string empty = folder.file("empty.vtu");
  tests::write_text(empty, "");
  EXPECT_EQ(refusal(empty), empty + ": is empty (0 bytes)");
  EXPECT_NE(refusal(folder.file("")).find("is a folder"), std::string::npos);
  const std::string unknown = folder.file("a.vtuu");
  tests::write_text(unknown, "x");
  EXPECT_NE(refusal(unknown).find("did you mean '.vtu'"), std::string::npos) << refusal(unknown);
  EXPECT_NE(refusal(unknown).find(".msh"), std::string::npos) << "lists what is readable";
  const std::string bare = folder.file("bare");
  tests::write_text(bare, "x");
  EXPECT_NE(refusal(bare).find("has no extension"), std::string::npos);
}

TEST(Import, EveryExtensionRefusesNonsenseInOneLine) {
  const tests::TemporaryFolder folder;
  const std::vector<std::string> contents = {"\n",
                                             "nonsense",
                                             std::string(10'000, '9'),
                                             std::string(1'000, '\0'),
                                             std::string(300, '\xff'),
                                             "1 2 3 4 5 6 7 8 9",
                                             "<?xml version=\"1.0\"?><VTKFile></VTKFile>"};
  for (const std::string& extension : readable_extensions()) {
    for (const std::string& content : contents) {
      const std::string file = folder.file("a" + extension);
      tests::write_text(file, content);
      testing::internal::CaptureStderr();
      testing::internal::CaptureStdout();
      const std::string message = refusal(file);
      const std::string printed =
          testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
      EXPECT_EQ(printed, "") << extension;
      EXPECT_TRUE(message.starts_with(folder.file(""))) << extension << ": " << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << extension << ": " << message;
      std::filesystem::remove(file);
    }
  }
}

TEST(Import, ExtensionsAreKnownInCapitals) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder.file("A.OFF"),
                    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n"
                    "3 1 2 3\n3 0 3 2\n");
#ifdef TETRAGLASS_WITH_TETGEN
  const Import import = import_mesh(folder.file("A.OFF"));
  double volume = 0;
  for (const Cell& cell : import.mesh.cells) volume += tests::volume(import.mesh, cell);
  EXPECT_NEAR(volume, 1.0 / 6, 1e-12);
  ASSERT_EQ(import.mesh.fields.size(), 1U);
  EXPECT_EQ(import.mesh.fields[0].name, "distance");
  EXPECT_GT(*std::ranges::max_element(import.mesh.fields[0].values), 0);
#else
  EXPECT_NE(refusal(folder.file("A.OFF")).find("TETRAGLASS_WITH_TETGEN"), std::string::npos);
#endif
}

TEST(Import, OfPointsAloneKeepsTheirFields) {
#ifdef TETRAGLASS_WITH_CGAL
  const tests::TemporaryFolder folder;
  tests::write_text(folder.file("a.node"),
                    "5 3 1\n1 0 0 0 1\n2 1 0 0 2\n3 0 1 0 3\n4 0 0 1 4\n5 1 1 1 5\n");
  const Import with_field = import_mesh(folder.file("a.node"));
  EXPECT_EQ(with_field.report.input_points, 5U);
  ASSERT_EQ(with_field.mesh.fields.size(), 1U);
  EXPECT_EQ(with_field.mesh.fields[0].name, "attribute");
  tests::write_text(folder.file("b.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n");
  EXPECT_EQ(import_mesh(folder.file("b.obj")).mesh.fields.at(0).name, "distance");
#endif
}

TEST(Import, PointsWithoutTheCellsOfAGridAreNoCloud) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder.file("a.vtk"),
                    "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 "
                    "float\n0 0 0 1 0 0 0 1 0 0 0 1 1 1 1\n");
  EXPECT_NE(refusal(folder.file("a.vtk")).find("no cells"), std::string::npos);
}

/// What the list of sources says of a file: cells as they are in the file, and tetrahedra where
/// they can be told without this program.
struct Known {
  const char* file;
  std::size_t points;
  std::map<CellType, std::size_t> cells;
  std::size_t tetrahedra;  // 0: not told
  double volume;           // 0: not told
};

using enum CellType;

TEST(Import, RealFilesHaveTheCellsTheyShould) {
  SKIP_WITHOUT_DATA();
  const std::vector<Known> files = {
      {"classics/bluntfinxyz.bin", 40960, {{hexahedron, 37479}}, 224874, 0},
      {"classics/postxyz.bin", 109744, {{hexahedron, 102675}}, 616050, 0},
      {"classics/post.vtk", 2288, {{tetra, 8750}}, 8750, 27.7949},
      {"tets/CylinderLinear.vtk", 465, {{tetra, 1522}}, 1522, 3.05608e-05},
      {"tets/CylinderQuadratic.vtk", 2814, {{quadratic_tetra, 1522}}, 1522, 3.05608e-05},
      {"tets/bracket_appended_compressed.vtu", 50000, {{tetra, 206208}}, 206208, 0.00270362},
      {"tets/fea_kiefer/dataset.vtu", 102578, {{quadratic_tetra, 56786}}, 56786, 7.41372},
      {"tets/a_grid.vtk", 1317, {{tetra, 4802}}, 4802, 0},
      {"tets/Tetrahedron.vtu", 35, {{tetra, 96}}, 96, 8},
      {"tets/QuadraticTetra.vtu", 189, {{quadratic_tetra, 96}}, 96, 8},
      {"tets/piezo_mesh_micro.vtk", 8918, {{tetra, 42744}}, 42744, 0.934806},
      {"tets/wheelset.vtk", 5457, {{tetra, 21934}}, 21934, 0.158133},
      {"tets/octahedron.node", 330, {{tetra, 1224}}, 1224, 256.0 / 3},
      {"tets/octahedron.ele", 330, {{tetra, 1224}}, 1224, 256.0 / 3},
      {"tets/quadratic_sphere_tet.msh",
       1310,
       {{vertex, 2}, {quadratic_edge, 10}, {quadratic_triangle, 322}, {quadratic_tetra, 722}},
       722,
       0.505397},
      {"tets/indheat.bin.v22.msh", 4949, {{triangle, 5884}, {tetra, 29176}}, 29176, 1},
      {"tets/piece.asc.v22.msh",
       3939,
       {{vertex, 126}, {line, 852}, {triangle, 6908}, {tetra, 13179}},
       13179,
       0.98255},
      {"tets/piece.bin.v22.msh",
       3939,
       {{vertex, 126}, {line, 852}, {triangle, 6908}, {tetra, 13179}},
       13179,
       0.98255},
      {"tets/piece.asc.v41.msh",
       4094,
       {{vertex, 126}, {line, 852}, {triangle, 7206}, {tetra, 13370}},
       13370,
       0},
      {"tets/piece.bin.v41.msh",
       4094,
       {{vertex, 126}, {line, 852}, {triangle, 7206}, {tetra, 13370}},
       13370,
       0},
      {"tets/actuator.msh", 8498, {{quadratic_triangle, 208}, {quadratic_tetra, 3729}}, 3729, 0},
      {"mixed/AngularSector.vtk", 10141, {{hexahedron, 7632}, {pyramid, 144}}, 0, 0},
      {"mixed/notch_stress_fixed.vtk", 3537, {{hexahedron, 2188}, {wedge, 4}}, 0, 0},
      {"mixed/notch_disp.vtu", 12717, {{quadratic_hexahedron, 2188}, {quadratic_wedge, 4}}, 0, 0},
      {"mixed/can.vtu", 6724, {{hexahedron, 4800}}, 28800, 0},
      {"mixed/disk_out_ref.ex2", 8499, {{hexahedron, 7472}}, 0, 0},
      {"mixed/simple-cube-multi-element-order1.e",
       719,
       {{tetra, 295}, {hexahedron, 27}, {wedge, 250}, {pyramid, 750}},
       0,
       4},
      {"mixed/simple-cube-multi-element-order2.e",
       911,
       {{quadratic_tetra, 295}, {triquadratic_hexahedron, 27}},
       0,
       2},
      {"mixed/fire_ug.vtu", 12323, {{hexahedron, 10462}}, 62772, 0},
      {"mixed/hexa.vtk", 12167, {{hexahedron, 10648}}, 63888, 0.875155},
      {"mixed/QuadraticPyramid.vtu", 153, {{quadratic_pyramid, 48}}, 96, 8},
      {"mixed/QuadraticWedge.vtu", 93, {{quadratic_wedge, 16}}, 48, 8},
      {"mixed/Wedge.vtu", 27, {{wedge, 16}}, 48, 8},
      {"mixed/Hexahedron.vtu", 26, {{hexahedron, 7}}, 0, 0},
      {"mixed/SampleStructGrid.vtk", 24000, {{hexahedron, 19 * 29 * 39}}, 128934, 0},
      {"mixed/office.binary.vtk", 8400, {{hexahedron, 7220}}, 43320, 4.49 * 4.49 * 2.49},
      {"volumes/ironProt.vtk", 314432, {{voxel, 300763}}, 6 * 300763, 300763},
      {"volumes/carotid.vtk", 167580, {{voxel, 158400}}, 6 * 158400, 158400},
      {"volumes/heart.vti", 12288, {{voxel, 10571}}, 6 * 10571, 4 * 10571},
      {"torture/polyhedron2pieces.vtu", 18, {{pyramid, 2}, {polyhedron, 2}}, 0, 0},
      {"torture/PentaHexa.vtk", 401, {{pentagonal_prism, 60}, {hexagonal_prism, 150}}, 0, 0},
      {"torture/VTKCellTypes.vtk",
       27,
       {{vertex, 1},
        {line, 1},
        {poly_line, 1},
        {triangle, 1},
        {triangle_strip, 1},
        {polygon, 1},
        {pixel, 1},
        {quad, 1},
        {tetra, 1},
        {voxel, 1},
        {hexahedron, 1}},
       0,
       0},
      {"torture/uGridEx.vtk",
       27,
       {{vertex, 1},
        {line, 2},
        {triangle, 2},
        {triangle_strip, 1},
        {polygon, 1},
        {quad, 1},
        {tetra, 2},
        {hexahedron, 2}},
       0,
       0},
      {"torture/TriQuadraticHexahedron.vtu", 117, {{triquadratic_hexahedron, 7}}, 0, 0},
      {"torture/quadraticTetra01.vtu",
       22,
       {{quadratic_triangle, 2}, {quadratic_tetra, 1}},
       1,
       0.133333},
      {"torture/vox8_binary.vtk", 27, {{voxel, 8}}, 48, 8},
      {"torture/mesh_vtk51.vtk", 1331, {{hexahedron, 1000}, {quad, 600}}, 6000, 3.375e-9},
      {"torture/notch_stress.vtk", 12717, {{hexahedron, 2188}, {wedge, 4}}, 0, 0},
      {"torture/tetraMesh.vtk", 55, {{tetra, 160}}, 160, 0},
      {"torture/Armadillo_Tetra_4406.vtu", 1446, {{tetra, 4406}}, 4406, 231.214},
      {"torture/6_tetra_bad.msh", 17, {{tetra, 6}}, 6, 31.65 + 2 * 4.5},
      {"torture/box-noglom.ex2", 27, {{tetra, 40}}, 40, 1000},
      {"torture/edgeFaceElem.exii", 12, {{hexahedron, 2}, {tetra, 1}}, 0, 0},
      {"torture/read_exodus_TET10.e", 381, {{quadratic_tetra, 192}}, 192, 64},
      {"torture/read_exodus_TET14.e", 813, {{quadratic_tetra, 192}}, 192, 64},
      {"torture/read_exodus_PYRAMID5.e", 35, {{pyramid, 48}}, 96, 64},
      {"torture/tetgen_one_tet10.node", 10, {{quadratic_tetra, 1}}, 1, 1.0 / 6},
      {"torture/LagrangeHexWedge.vtk", 72, {{lagrange_hexahedron, 2}, {lagrange_wedge, 1}}, 0, 0},
      {"torture/tets_in_1x1x1_block_o6.vtk", 311, {{lagrange_tetra, 5}}, 5 * 216, 1},
      {"torture/multi-bin.xyz", 2304, {{hexahedron, 2 * 7 * 11 * 11}}, 0, 0},
      {"torture/multi-bin-C.xyz", 2304, {{hexahedron, 2 * 7 * 11 * 11}}, 0, 0},
      {"torture/multi-ascii.xyz", 2304, {{hexahedron, 2 * 7 * 11 * 11}}, 0, 0},
  };
  for (const Known& known : files) {
    SCOPED_TRACE(known.file);
    const Import import = import_mesh((tests::data_folder() / known.file).string());
    EXPECT_EQ(import.report.input_points, known.points);
    EXPECT_EQ(import.report.input_cells, known.cells);
    if (known.tetrahedra > 0) {
      EXPECT_EQ(import.mesh.cells.size(), known.tetrahedra);
    }
    double volume = 0;
    for (const Cell& cell : import.mesh.cells) {
      const double v = tests::volume(import.mesh, cell);
      EXPECT_GE(v, -1e-12 * std::abs(volume));
      volume += v;
    }
    // The sources give six digits.
    if (known.volume > 0) {
      EXPECT_NEAR(volume, known.volume, 5e-6 * known.volume);
    }
    for (const Field& field : import.mesh.fields) {
      EXPECT_EQ(field.tuples(), field.location == Location::point ? import.mesh.points.size()
                                                                  : import.mesh.cells.size())
          << field.name;
    }
  }
}

TEST(Import, InvertedTetrahedraAreCounted) {
  SKIP_WITHOUT_DATA();
  const auto inverted = [](const char* file) {
    return import_mesh((tests::data_folder() / file).string()).report.inverted;
  };
  EXPECT_EQ(inverted("tets/bracket_appended_compressed.vtu"), 206208U);
  EXPECT_EQ(inverted("torture/tetraMesh.vtk"), 80U);
  EXPECT_EQ(inverted("torture/6_tetra_bad.msh"), 1U);
  EXPECT_EQ(inverted("tets/piezo_mesh_micro.vtk"), 0U);
  EXPECT_EQ(inverted("mixed/Wedge.vtu"), 0U);
  EXPECT_EQ(inverted("mixed/simple-cube-multi-element-order1.e"), 0U);
}

TEST(Import, RealFilesThatCannotBeReadSayWhyInOneLine) {
  SKIP_WITHOUT_DATA();
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  for (const char* name : {"torture/Armadillo_Tetra_4406_for_test_broken.vtu",
                           "torture/liver_for_test_broken.vtk",
                           "torture/bad_64bit_elem_integers.e",
                           "surfaces_bad/cow.off",
                           "surfaces_bad/bones.off",
                           "surfaces_bad/elephant-with-holes.off",
                           "surfaces_bad/ALSTOM_TEST4.off",
                           "surfaces_bad/blobby_3cc.off",
                           "surfaces_bad/tetra_intersected_by_triangle.off",
                           "surfaces_bad/quads_to_stitch.off",
                           "surfaces_bad/degtri_sliding.off",
                           "surfaces_bad/open_cube.off",
                           "surfaces_bad/triangle.off",
                           "surfaces_bad/empty.off",
                           "surfaces_bad/empty.ply",
                           "surfaces_bad/empty.stl",
                           "surfaces_bad/empty.msh",
                           "surfaces_bad/beetle.obj",
                           "surfaces_bad/pig.stl",
                           "torture/multi-bin.q"}) {
    const std::string file = (tests::data_folder() / name).string();
    const std::string message = refusal(file);
    EXPECT_TRUE(message.starts_with(file + ": ")) << name << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

#ifdef TETRAGLASS_WITH_TETGEN

TEST(Import, RealSurfacesAreFilled) {
  SKIP_WITHOUT_DATA();
  // The volumes are those that the surfaces enclose, from their triangles.
  const std::array<std::pair<const char*, double>, 6> files = {{{"surfaces/joint.off", 0.359494},
                                                                {"surfaces/star.off", 0.0625},
                                                                {"surfaces/sphere.stl", 0.505952},
                                                                {"surfaces/sphere.ply", 0.505952},
                                                                {"surfaces/spot.obj", 0.718259},
                                                                {"surfaces/knot1.off", 0.0951747}}};
  testing::internal::CaptureStdout();
  for (const auto& [name, volume] : files) {
    const Import import = import_mesh((tests::data_folder() / name).string());
    double sum = 0;
    for (const Cell& cell : import.mesh.cells) sum += tests::volume(import.mesh, cell);
    EXPECT_NEAR(sum, volume, 5e-6 * volume) << name;
    ASSERT_EQ(import.mesh.fields.size(), 1U);
    EXPECT_GT(*std::ranges::max_element(import.mesh.fields[0].values), 0) << name;
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

#endif

}  // namespace
}  // namespace tetraglass::mesh
