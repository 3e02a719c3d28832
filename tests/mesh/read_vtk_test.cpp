#include "mesh/read_vtk.h"

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "support/data.h"
#include "support/temporary_folder.h"

namespace tetraglass::mesh {
namespace {

MeshData read(const std::string& name, const std::string& content) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder.file(name), content);
  return read_vtk(folder.file(name));
}

std::string array(const std::string& name, const std::string& type, const std::string& values,
                  int components = 1) {
  return fmt::format(
      "<DataArray Name=\"{}\" type=\"{}\" NumberOfComponents=\"{}\" "
      "format=\"ascii\">{}</DataArray>\n",
      name, type, components, values);
}

std::string grid_file(const std::string& pieces) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
         "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n" +
         pieces + "</UnstructuredGrid>\n</VTKFile>\n";
}

/// Two tetrahedra on a face, with `data` between the points and the cells.
std::string two_tetrahedra(const std::string& data = "",
                           const std::string& connectivity = "0 1 2 3 1 2 3 4") {
  return "<Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n" + data + "<Points>" +
         array("Points", "Float64", "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1", 3) + "</Points>\n<Cells>" +
         array("connectivity", "Int64", connectivity) + array("offsets", "Int64", "4 8") +
         array("types", "UInt8", "10 10") + "</Cells>\n</Piece>\n";
}

TEST(ReadVtk, ReadsFieldsOfPointsAndCells) {
  const MeshData mesh = read(
      "a.vtu", grid_file(two_tetrahedra("<PointData GlobalIds=\"number\">" +
                                        array("number", "Int64", "1 2 3 4 5") +
                                        array("v", "Float32", "0 0 1 0 0 2 0 0 3 0 0 4 0 0 5", 3) +
                                        "<DataArray type=\"String\" Name=\"text\" "
                                        "NumberOfTuples=\"5\" format=\"ascii\">65 0 66 0 "
                                        "67 0 68 0 69 0</DataArray></PointData><CellData>" +
                                        array("t", "UInt8", "250 3") + "</CellData>\n")));
  ASSERT_EQ(mesh.cell_count(), 2U);
  EXPECT_EQ(mesh.points[4], Eigen::Vector3d(1, 1, 1));
  ASSERT_EQ(mesh.fields.size(), 3U);
  EXPECT_EQ(mesh.fields[0].name, "v");
  EXPECT_EQ(mesh.fields[0].values[5], 2);
  EXPECT_EQ(mesh.fields[1].name, "t");
  EXPECT_EQ(mesh.fields[1].values, (std::vector<double>{250, 3}));
  EXPECT_EQ(mesh.fields[2].name, "number");  // ids come last
  ASSERT_EQ(mesh.notes.size(), 1U);
  EXPECT_NE(mesh.notes[0].find("'text'"), std::string::npos);
}

TEST(ReadVtk, LeavesOutGhosts) {
  const MeshData mesh =
      read("a.vtu", grid_file(two_tetrahedra("<CellData>" + array("vtkGhostType", "UInt8", "1 0") +
                                             array("t", "Float64", "10 20") + "</CellData>\n")));
  ASSERT_EQ(mesh.cell_count(), 1U);
  EXPECT_EQ(mesh.cell(0)[3], 4U);
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].values, (std::vector<double>{20}));
}

TEST(ReadVtk, JoinsThePiecesOfAParallelFile) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder.file("0.vtu"), grid_file(two_tetrahedra()));
  tests::write_text(folder.file("1.vtu"), grid_file(two_tetrahedra()));
  const std::string head =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PUnstructuredGrid GhostLevel=\"0\">"
      "<PPoints><PDataArray type=\"Float64\" Name=\"Points\" "
      "NumberOfComponents=\"3\"/></PPoints>\n";
  const std::string end = "</PUnstructuredGrid></VTKFile>\n";
  tests::write_text(folder.file("a.pvtu"),
                    head + "<Piece Source=\"0.vtu\"/><Piece Source=\"1.vtu\"/>" + end);
  const MeshData mesh = read_vtk(folder.file("a.pvtu"));
  ASSERT_EQ(mesh.cell_count(), 4U);
  EXPECT_EQ(mesh.cell(3)[3], 9U);
  tests::write_text(folder.file("b.pvtu"),
                    head + "<Piece Source=\"0.vtu\"/><Piece Source=\"2.vtu\"/>" + end);
  EXPECT_THROW(static_cast<void>(read_vtk(folder.file("b.pvtu"))), base::ReadError);
}

std::string polyhedron(const std::string& faces, int end) {
  return grid_file("<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points>" +
                   array("Points", "Float64", "0 0 0 1 0 0 0 1 0 0 0 1", 3) + "</Points>\n<Cells>" +
                   array("connectivity", "Int64", "0 1 2 3") + array("offsets", "Int64", "4") +
                   array("types", "UInt8", "42") + array("faces", "Int64", faces) +
                   array("faceoffsets", "Int64", std::to_string(end)) + "</Cells></Piece>\n");
}

TEST(ReadVtk, ReadsPolyhedra) {
  const MeshData mesh = read("a.vtu", polyhedron("4 3 0 1 2 3 0 1 3 3 1 2 3 3 0 2 3", 17));
  ASSERT_EQ(mesh.cell_count(), 1U);
  EXPECT_EQ(mesh.types[0], CellType::polyhedron);
  ASSERT_EQ(mesh.cell(0).size(), 17U);
  EXPECT_EQ(mesh.cell(0)[0], 4U);
  EXPECT_EQ(mesh.cell(0)[16], 3U);
}

TEST(ReadVtk, RefusesFacesThatDoNotFit) {
  const auto refused = [](const std::string& faces, int end) {
    EXPECT_THROW(static_cast<void>(read("a.vtu", polyhedron(faces, end))), base::ReadError)
        << faces << " / " << end;
  };
  refused("4 3 0 1 2 3 0 1 3 3 1 2 3 3 0 2 3", 16);
  refused("4 3 0 1 2 3 0 1 3 3 1 2 3 3 0 2 3", 18);
  refused("4 3 0 1 2 3 0 1 3 3 1 2 3 3 0 2 3", 1000000000);
  refused("999999999 3 0 1 2 3 0 1 3 3 1 2 3 3 0 2 3", 17);
  refused("4 3 0 1 2 99999 0 1 3 3 1 2 3 3 0 2 3", 17);
  refused("-4 3 0 1 2 3 0 1 3 3 1 2 3 3 0 2 3", 17);
}

TEST(ReadVtk, RefusesIndicesBeyondThePoints) {
  for (const char* connectivity : {"0 1 2 3 1 2 3 5", "0 1 2 3 1 2 3 -1"}) {
    EXPECT_THROW(static_cast<void>(read("a.vtu", grid_file(two_tetrahedra("", connectivity)))),
                 base::InputError)
        << connectivity;
  }
}

TEST(ReadVtk, XmlThatIsCutOffIsAnError) {
  const std::string whole = grid_file(two_tetrahedra());
  const std::size_t end = whole.rfind("</VTKFile>");
  for (std::size_t size = 1; size < end + 9; size += 7) {
    EXPECT_THROW(static_cast<void>(read("a.vtu", whole.substr(0, size))), base::ReadError) << size;
  }
}

TEST(ReadVtk, ImagesAndGridsBecomeCells) {
  const MeshData image =
      read("a.vti",
           "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" "
           "byte_order=\"LittleEndian\"><ImageData WholeExtent=\"0 2 0 1 0 1\" Origin=\"1 2 3\" "
           "Spacing=\"0.5 1 4\"><Piece Extent=\"0 2 0 1 0 1\"><PointData>" +
               array("s", "Float32", "0 1 2 3 4 5 6 7 8 9 10 11") +
               "</PointData></Piece></ImageData></VTKFile>\n");
  EXPECT_EQ(image.census().at(CellType::voxel), 2U);
  EXPECT_EQ(image.points[11], Eigen::Vector3d(2, 3, 7));
  const MeshData rectilinear = read(
      "a.vtr",
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"RectilinearGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\"><RectilinearGrid WholeExtent=\"0 1 0 1 0 1\"><Piece "
      "Extent=\"0 1 0 1 0 1\"><Coordinates>" +
          array("x", "Float64", "0 1") + array("y", "Float64", "0 2") +
          array("z", "Float64", "0 5") + "</Coordinates></Piece></RectilinearGrid></VTKFile>\n");
  EXPECT_EQ(rectilinear.census().at(CellType::voxel), 1U);
  EXPECT_EQ(rectilinear.points[7], Eigen::Vector3d(1, 2, 5));
  const MeshData structured =
      read("a.vts",
           "<?xml version=\"1.0\"?>\n<VTKFile type=\"StructuredGrid\" version=\"1.0\" "
           "byte_order=\"LittleEndian\"><StructuredGrid WholeExtent=\"0 1 0 1 0 1\"><Piece "
           "Extent=\"0 1 0 1 0 1\"><Points>" +
               array("Points", "Float64", "0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1", 3) +
               "</Points></Piece></StructuredGrid></VTKFile>\n");
  EXPECT_EQ(structured.census().at(CellType::hexahedron), 1U);
}

TEST(ReadVtk, DoesNotMakeAnImageThatOnlyItsHeadSpeaksOf) {
  EXPECT_THROW(
      static_cast<void>(read("a.vtk",
                             "# vtk DataFile Version 3.0\nt\nASCII\nDATASET "
                             "STRUCTURED_POINTS\nDIMENSIONS 100000 100000 100000\nORIGIN 0 0 "
                             "0\nSPACING 1 1 1\n")),
      base::InputError);
}

const std::string kLegacyHead = "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET ";
const std::string kLegacyGrid = kLegacyHead +
                                "UNSTRUCTURED_GRID\nPOINTS 5 float\n0 0 0 1 0 0 0 1 0 0 0 1 1 1 "
                                "1\nCELLS 2 10\n4 0 1 2 3\n4 1 2 3 "
                                "4\nCELL_TYPES 2\n10\n10\n";

TEST(ReadVtk, ReadsTheLegacyFormat) {
  const MeshData grid =
      read("a.vtk", kLegacyGrid +
                        "POINT_DATA 5\nSCALARS a float 1\nLOOKUP_TABLE default\n1 2 3 "
                        "4 5\nSCALARS b int 1\nLOOKUP_TABLE default\n6 7 8 9 "
                        "10\nFIELD f 1\nc 2 5 double\n0 1 2 3 4 5 6 7 8 9\n");
  EXPECT_EQ(grid.cell_count(), 2U);
  ASSERT_EQ(grid.fields.size(), 3U);
  EXPECT_EQ(grid.fields[1].name, "b");
  EXPECT_EQ(grid.fields[2].components, 2);
  const MeshData surface =
      read("a.vtk", kLegacyHead +
                        "POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nPOLYGONS 1 5\n4 0 1 2 "
                        "3\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\n");
  EXPECT_EQ(surface.types, (std::vector<CellType>{CellType::quad, CellType::triangle_strip}));
  const MeshData points = read("a.vtk", kLegacyHead + "POLYDATA\nPOINTS 1 float\n1 2 3\n");
  EXPECT_EQ(points.points.size(), 1U);
  const MeshData version5 = read(
      "a.vtk",
      "# vtk DataFile Version 5.1\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 "
      "0 0 1 0 0 0 1\nMETADATA\nINFORMATION 0\n\nCELLS 2 4\nOFFSETS vtktypeint64\n0 "
      "4\nCONNECTIVITY vtktypeint64\n0 1 2 3\nCELL_TYPES 1\n10\n");
  EXPECT_EQ(version5.cell_count(), 1U);
}

TEST(ReadVtk, LegacyFilesThatAreCutOffAreErrors) {
  for (std::size_t size = 1; size + 4 < kLegacyGrid.size(); ++size) {
    EXPECT_THROW(static_cast<void>(read("a.vtk", kLegacyGrid.substr(0, size))), base::Error)
        << size;
  }
}

TEST(ReadVtk, RefusesLegacyCellsThatContradictTheirSize) {
  const auto broken = [](const std::string& from, const std::string& to) {
    std::string content = kLegacyGrid;
    content.replace(content.find(from), from.size(), to);
    EXPECT_THROW(static_cast<void>(read("a.vtk", content)), base::Error) << to;
  };
  broken("CELLS 2 10", "CELLS 3 10");
  broken("CELLS 2 10", "CELLS 2 9");
  broken("CELLS 2 10", "CELLS 2 1000000000");
  broken("CELLS 2 10", "CELLS 9999999999 10");
  broken("4 1 2 3 4", "400 1 2 3 4");
  broken("4 1 2 3 4", "-4 1 2 3 4");
  broken("4 1 2 3 4", "4 1 2 3 5");
  broken("POINTS 5", "POINTS 6");
  broken("POINTS 5", "POINTS 99999999999");
  broken("CELL_TYPES 2", "CELL_TYPES 3");
  broken("# vtk DataFile", "# VTK data file");
}

TEST(ReadVtk, AnXmlFileOfAnotherKindIsRefused) {
  EXPECT_THROW(static_cast<void>(read("a.vti", grid_file(two_tetrahedra()))), base::ReadError);
  EXPECT_THROW(static_cast<void>(read("a.vtu", "no xml at all")), base::ReadError);
}

TEST(ReadVtk, NothingIsPrinted) {
  SKIP_WITHOUT_DATA();
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  for (const char* name : {"torture/Armadillo_Tetra_4406_for_test_broken.vtu",
                           "torture/liver_for_test_broken.vtk", "mixed/can.vtu"}) {
    try {
      static_cast<void>(read_vtk((tests::data_folder() / name).string()));
    } catch (const base::ReadError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace tetraglass::mesh
