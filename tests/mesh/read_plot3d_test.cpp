#include "mesh/read_plot3d.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "support/temporary_folder.h"

namespace tetraglass::mesh {
namespace {

/// How a file is written.
struct Layout {
  bool big_endian, records, many, blanks, doubles;
};

class Writer {
 public:
  explicit Writer(Layout layout) : layout_(layout) {}

  template <typename T>
  void put(T value) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    if (layout_.big_endian != (std::endian::native == std::endian::big)) std::ranges::reverse(raw);
    block_.append(raw.data(), raw.size());
  }
  void real(double value) { layout_.doubles ? put(value) : put(static_cast<float>(value)); }
  void end() {
    const std::string block = std::exchange(block_, "");
    const auto mark = [&] {
      if (!layout_.records) return;
      put(static_cast<std::int32_t>(block.size()));
      bytes_ += std::exchange(block_, "");
    };
    mark();
    bytes_ += block;
    mark();
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  Layout layout_;
  std::string block_;
  std::string bytes_;
};

/// Bricks of different numbers of points along each axis; with `many`, a second one beside the
/// first.
std::vector<std::array<int, 3>> sizes(const Layout& layout) {
  if (layout.many) return {{3, 4, 5}, {2, 3, 4}};
  return {{3, 4, 5}};
}

std::string grid_bytes(const Layout& layout, bool blank_a_corner = false) {
  Writer out(layout);
  if (layout.many) {
    out.put(static_cast<std::int32_t>(sizes(layout).size()));
    out.end();
  }
  for (const auto& n : sizes(layout)) {
    for (const int k : n) out.put(static_cast<std::int32_t>(k));
  }
  out.end();
  int grid = 0;
  for (const auto& n : sizes(layout)) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < n[2]; ++k) {
        for (int j = 0; j < n[1]; ++j) {
          for (int i = 0; i < n[0]; ++i) {
            out.real(axis == 0 ? i + 100.0 * grid : axis == 1 ? j : k);
          }
        }
      }
    }
    for (int p = 0; layout.blanks && p < n[0] * n[1] * n[2]; ++p) {
      out.put(static_cast<std::int32_t>(blank_a_corner && p == 0 ? 0 : p % 2 == 0 ? 1 : -2));
    }
    out.end();
    ++grid;
  }
  return out.bytes();
}

/// A gas at rest but for u = (0.5, 0, 0): density 2, pressure 3.
std::string solution_bytes(const Layout& layout, double energy_shift = 0) {
  Writer out(layout);
  if (layout.many) {
    out.put(static_cast<std::int32_t>(sizes(layout).size()));
    out.end();
  }
  for (const auto& n : sizes(layout)) {
    for (const int k : n) out.put(static_cast<std::int32_t>(k));
  }
  out.end();
  for (const auto& n : sizes(layout)) {
    for (const double condition : {2.0, 0.0, 1e6, 0.5}) out.real(condition);
    out.end();
    const double energy = 3 / 0.4 + 0.5 * 2 * 0.25 + energy_shift;
    for (const double channel : {2.0, 1.0, 0.0, 0.0, energy}) {
      for (int p = 0; p < n[0] * n[1] * n[2]; ++p) out.real(channel);
    }
    out.end();
  }
  return out.bytes();
}

const Field* find_field(const MeshData& mesh, const std::string& name) {
  const auto found = std::ranges::find(mesh.fields, name, &Field::name);
  return found != mesh.fields.end() ? &*found : nullptr;
}

TEST(ReadPlot3d, TellsEveryLayoutFromItsSize) {
  for (unsigned choice = 0; choice < 32; ++choice) {
    const Layout layout{(choice & 1U) != 0, (choice & 2U) != 0, (choice & 4U) != 0,
                        (choice & 8U) != 0, (choice & 16U) != 0};
    SCOPED_TRACE(fmt::format("big endian {}, records {}, many {}, blanks {}, doubles {}",
                             layout.big_endian, layout.records, layout.many, layout.blanks,
                             layout.doubles));
    const tests::TemporaryFolder folder;
    tests::write_text(folder.file("a.xyz"), grid_bytes(layout));
    tests::write_text(folder.file("a.q"), solution_bytes(layout));
    const MeshData mesh = read_plot3d(folder.file("a.xyz"));
    ASSERT_EQ(mesh.points.size(), layout.many ? 60U + 24 : 60U);
    ASSERT_EQ(mesh.cell_count(), layout.many ? 24U + 6 : 24U);
    ASSERT_EQ(mesh.points[1], Eigen::Vector3d(1, 0, 0));
    ASSERT_EQ(mesh.points[3], Eigen::Vector3d(0, 1, 0));
    ASSERT_EQ(mesh.points[59], Eigen::Vector3d(2, 3, 4));
    if (layout.many) {
      ASSERT_EQ(mesh.points[60], Eigen::Vector3d(100, 0, 0));
    }
    const Field* pressure = find_field(mesh, "pressure");
    ASSERT_NE(pressure, nullptr);
    for (const double p : pressure->values) ASSERT_NEAR(p, 3, 1e-5);
    const Field* velocity = find_field(mesh, "velocity");
    ASSERT_NE(velocity, nullptr);
    ASSERT_NEAR(velocity->values[0], 0.5, 1e-6);
    ASSERT_EQ(find_field(mesh, "density")->values[0], 2);
    ASSERT_EQ(find_field(mesh, "momentum")->components, 3);
    ASSERT_NE(find_field(mesh, "stagnation_energy"), nullptr);
  }
}

TEST(ReadPlot3d, ReadsText) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder.file("a.xyz"),
                    "1\n2 2 2\n0 1 0 1 0 1 0 1\n0 0 1 1 0 0 1 1\n4*0 4*1.0D+00\n");
  const MeshData mesh = read_plot3d(folder.file("a.xyz"));
  ASSERT_EQ(mesh.cell_count(), 1U);
  EXPECT_EQ(mesh.points[7], Eigen::Vector3d(1, 1, 1));
  EXPECT_TRUE(mesh.fields.empty());
}

TEST(ReadPlot3d, LeavesOutBlankedCells) {
  const Layout layout{true, false, false, true, false};
  const tests::TemporaryFolder folder;
  tests::write_text(folder.file("a.bin"), grid_bytes(layout, true));
  EXPECT_EQ(read_plot3d(folder.file("a.bin")).cell_count(), 23U);
}

TEST(ReadPlot3d, FindsTheSolutionByName) {
  const Layout layout{};
  for (const auto& [grid, solution] : {std::pair("finxyz.bin", "finq.bin"), {"fin.x", "fin.q"}}) {
    const tests::TemporaryFolder folder;
    tests::write_text(folder.file(grid), grid_bytes(layout));
    tests::write_text(folder.file(solution), solution_bytes(layout) + std::string(484, '\0'));
    EXPECT_EQ(read_plot3d(folder.file(grid)).fields.size(), 5U) << grid;
  }
}

TEST(ReadPlot3d, DerivesNoPressureFromWhatIsNoGas) {
  const Layout layout{};
  const tests::TemporaryFolder folder;
  tests::write_text(folder.file("a.xyz"), grid_bytes(layout));
  tests::write_text(folder.file("a.q"), solution_bytes(layout, -20));
  const MeshData mesh = read_plot3d(folder.file("a.xyz"));
  // Of constant density: the fifth channel as it is.
  ASSERT_NE(find_field(mesh, "pressure"), nullptr);
  EXPECT_NEAR(find_field(mesh, "pressure")->values[0], 3 / 0.4 + 0.25 - 20, 1e-5);
  EXPECT_EQ(find_field(mesh, "stagnation_energy"), nullptr);
}

TEST(ReadPlot3d, RefusesFilesThatAreCutOff) {
  const Layout layout{true, true, true, true, true};
  const std::string grid = grid_bytes(layout);
  const std::string solution = solution_bytes(layout);
  const tests::TemporaryFolder folder;
  for (std::size_t size = 1; size < grid.size(); size += 97) {
    tests::write_text(folder.file("a.xyz"), grid.substr(0, size));
    EXPECT_THROW(static_cast<void>(read_plot3d(folder.file("a.xyz"))), base::ReadError) << size;
  }
  tests::write_text(folder.file("a.xyz"), grid);
  for (std::size_t size = 1; size < solution.size(); size += 97) {
    tests::write_text(folder.file("a.q"), solution.substr(0, size));
    EXPECT_THROW(static_cast<void>(read_plot3d(folder.file("a.xyz"))), base::ReadError) << size;
  }
}

TEST(ReadPlot3d, KnowsASolutionGivenForAGrid) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder.file("a.bin"), solution_bytes({}));
  try {
    static_cast<void>(read_plot3d(folder.file("a.bin")));
    FAIL();
  } catch (const base::ReadError& error) {
    EXPECT_NE(std::string(error.what()).find("is a PLOT3D solution"), std::string::npos);
  }
}

}  // namespace
}  // namespace tetraglass::mesh
