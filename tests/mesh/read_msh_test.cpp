#include "mesh/read_msh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "support/temporary_folder.h"

namespace tetraglass::mesh {
namespace {

const std::string kText2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n1\n3 7 \"solid\"\n$EndPhysicalNames\n"
    "$Nodes\n5\n10 0 0 0\n20 1 0 0\n30 0 1 0\n40 0 0 1\n50 1 1 1\n$EndNodes\n"
    "$Elements\n3\n1 2 2 0 1 10 20 30\n2 4 2 7 1 10 20 30 40\n3 4 2 8 1 20 30 40 50\n$EndElements\n"
    "$NodeData\n1\n\"heat of it\"\n1\n0.5\n3\n0\n1\n5\n10 1\n20 2\n30 3\n40 4\n50 5\n$EndNodeData\n"
    "$NodeData\n1\n\"heat of it\"\n1\n1.5\n3\n1\n1\n4\n50 50\n10 10\n20 20\n30 30\n$EndNodeData\n"
    "$ElementData\n1\n\"flow\"\n1\n0\n3\n0\n3\n2\n3 1 2 3\n2 4 5 6\n$EndElementData\n";

MeshData read(const std::string& content, const std::string& time = "") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder.file("a.msh"), content);
  return read_msh(folder.file("a.msh"), time);
}

void check_two_tetrahedra(const MeshData& mesh) {
  ASSERT_EQ(mesh.points.size(), 5U);
  EXPECT_EQ(mesh.points[4], Eigen::Vector3d(1, 1, 1));
  ASSERT_EQ(mesh.cell_count(), 3U);
  EXPECT_EQ(mesh.types[0], CellType::triangle);
  EXPECT_EQ(mesh.types[2], CellType::tetra);
  EXPECT_EQ(mesh.cell(2)[3], 4U);
  ASSERT_FALSE(mesh.fields.empty());
  EXPECT_EQ(mesh.fields[0].name, "physical");
  EXPECT_EQ(mesh.fields[0].values, (std::vector<double>{0, 7, 8}));
}

TEST(ReadMsh, ReadsVersion2WithItsFields) {
  const MeshData mesh = read(kText2);
  check_two_tetrahedra(mesh);
  ASSERT_EQ(mesh.fields.size(), 3U);
  const Field& heat = mesh.fields[1];
  EXPECT_EQ(heat.name, "heat of it");
  EXPECT_EQ(heat.values[4], 50);  // of the last step
  EXPECT_TRUE(std::isnan(heat.values[3]));
  const Field& flow = mesh.fields[2];
  EXPECT_EQ(flow.location, Location::cell);
  EXPECT_EQ(flow.components, 3);
  EXPECT_TRUE(std::isnan(flow.values[0]));
  EXPECT_EQ(flow.values[3], 4);
  EXPECT_EQ(flow.values[8], 3);
}

TEST(ReadMsh, TakesTheTimeStepThatIsAskedFor) {
  EXPECT_EQ(read(kText2, "index:0").fields[1].values[3], 4);
  EXPECT_EQ(read(kText2, "0.4").fields[1].values[4], 5);
  EXPECT_EQ(read(kText2, "1.4").fields[1].values[4], 50);
  EXPECT_THROW(static_cast<void>(read(kText2, "index:2")), base::UsageError);
}

/// The same mesh in version 4.1, text or binary.
std::string version_4(bool binary, bool swapped) {
  std::string out;
  const auto put = [&](auto value) {
    if (!binary) {
      out += std::to_string(value) + " ";
      return;
    }
    std::array<char, sizeof(value)> raw{};
    std::memcpy(raw.data(), &value, sizeof(value));
    if (swapped) std::ranges::reverse(raw);
    out.append(raw.data(), raw.size());
  };
  const auto put_int = [&](std::int32_t v) { put(v); };
  const auto put_size = [&](std::uint64_t v) { put(v); };
  out += binary ? "$MeshFormat\n4.1 1 8\n" : "$MeshFormat\n4.1 0 8\n";
  if (binary) put_int(1);
  out += "\n$EndMeshFormat\n$Entities\n";
  for (const std::uint64_t count : {1U, 0U, 1U, 2U}) put_size(count);
  put_int(1);  // a point, without groups
  for (int i = 0; i < 3; ++i) put(0.0);
  put_size(0);
  for (const int tag : {1, 5, 6}) {  // a surface without groups, two volumes with one each
    put_int(tag);
    for (int i = 0; i < 6; ++i) put(0.25);
    put_size(tag == 1 ? 0 : 1);
    if (tag != 1) put_int(tag + 2);
    put_size(1);
    put_int(-1);
  }
  out += "\n$EndEntities\n$Nodes\n";
  for (const std::uint64_t head : {2U, 5U, 10U, 50U}) put_size(head);
  for (const int i : {2, 5, 1}) put_int(i);  // parametric: two more numbers for each node
  put_size(2);
  for (const std::uint64_t tag : {10U, 20U}) put_size(tag);
  for (const double x : {0., 0., 0., 9., 9., 1., 0., 0., 9., 9.}) put(x);
  for (const int i : {3, 5, 0}) put_int(i);
  put_size(3);
  for (const std::uint64_t tag : {30U, 40U, 50U}) put_size(tag);
  for (const double x : {0., 1., 0., 0., 0., 1., 1., 1., 1.}) put(x);
  out += "\n$EndNodes\n$Elements\n";
  for (const std::uint64_t head : {3U, 3U, 1U, 3U}) put_size(head);
  const auto block = [&](int dimension, int entity, int type, std::vector<std::uint64_t> element) {
    for (const int i : {dimension, entity, type}) put_int(i);
    put_size(1);
    for (const std::uint64_t i : element) put_size(i);
  };
  block(2, 1, 2, {1, 10, 20, 30});
  block(3, 5, 4, {2, 10, 20, 30, 40});
  block(3, 6, 4, {3, 20, 30, 40, 50});
  out += "\n$EndElements\n";
  return out;
}

TEST(ReadMsh, ReadsVersion4InTextAndBinary) {
  check_two_tetrahedra(read(version_4(false, false)));
  check_two_tetrahedra(read(version_4(true, false)));
  check_two_tetrahedra(read(version_4(true, true)));
}

TEST(ReadMsh, KeepsElementsOfTheSameNumber) {
  std::string content = kText2.substr(0, kText2.find("$ElementData"));
  content.replace(content.find("\n3 4 2 8"), 3, "\n2 ");
  EXPECT_EQ(read(content).cell_count(), 3U);
}

TEST(ReadMsh, SectionsThatAreCutOffAreErrors) {
  for (const std::string& whole : {kText2, version_4(false, false), version_4(true, false)}) {
    std::size_t begin = whole.find("$EndMeshFormat") + 15;
    while (begin < whole.size()) {
      const std::size_t name_end = whole.find('\n', begin);
      const std::string end_mark = "$End" + whole.substr(begin + 1, name_end - begin - 1);
      const std::size_t end = whole.find(end_mark, begin) + end_mark.size();
      for (std::size_t size = name_end; size < end; ++size) {
        EXPECT_THROW(static_cast<void>(read(whole.substr(0, size))), base::ReadError)
            << whole.substr(begin, size - begin);
      }
      begin = end + 1;
    }
  }
}

TEST(ReadMsh, DoesNotBelieveWhatCannotBe) {
  const auto broken = [](const std::string& from, const std::string& to) {
    std::string content = kText2;
    content.replace(content.find(from), from.size(), to);
    EXPECT_THROW(static_cast<void>(read(content)), base::ReadError) << to;
  };
  broken("10 20 30 40", "10 20 30 60");
  broken("10 20 30 40", "10 20 30 4000000000000");
  broken("10 20 30 40", "10 20 30 -40");
  broken("2 4 2 7", "2 4321 2 7");
  broken("$Nodes\n5", "$Nodes\n99999999999");
  broken("$Elements\n3", "$Elements\n4");
  broken("0\n1\n5\n10 1", "0\n-1\n5\n10 1");
  broken("0\n1\n5\n10 1", "0\n1\n99999999999\n10 1");
  broken("50 50\n", "60 50\n");
}

}  // namespace
}  // namespace tetraglass::mesh
