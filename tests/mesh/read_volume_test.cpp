#include "mesh/read_volume.h"

#include <bit>
#include <cstring>
#include <functional>

#include <bzlib.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "base/errors.h"
#include "mesh/decompose.h"
#include "mesh/import.h"
#include "support/data.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kX = 5;
constexpr std::size_t kY = 3;
constexpr std::size_t kZ = 2;

/// The values 0, 1, 2, ... of a grid of 5 x 3 x 2 points.
template <typename T>
std::string values(bool big_endian = false) {
  std::string bytes;
  for (std::size_t i = 0; i < kX * kY * kZ; ++i) {
    std::array<char, sizeof(T)> raw = std::bit_cast<std::array<char, sizeof(T)>>(static_cast<T>(i));
    if (big_endian != (std::endian::native == std::endian::big)) {
      std::reverse(raw.begin(), raw.end());
    }
    bytes.append(raw.data(), raw.size());
  }
  return bytes;
}

std::string packed(const std::string& bytes) {
  std::string result(compressBound(bytes.size()), '\0');
  uLongf size = result.size();
  compress(reinterpret_cast<Bytef*>(result.data()), &size,
           reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  result.resize(size);
  return result;
}

std::string bzipped(std::string bytes) {
  std::string result(2 * bytes.size() + 1000, '\0');
  auto size = static_cast<unsigned>(result.size());
  BZ2_bzBuffToBuffCompress(result.data(), &size, bytes.data(), static_cast<unsigned>(bytes.size()),
                           1, 0, 0);
  result.resize(size);
  return result;
}

const tests::TemporaryFolder& folder() {
  static const tests::TemporaryFolder kFolder;
  return kFolder;
}

std::string write(const std::string& name, const std::string& content) {
  tests::write_text(folder().file(name), content);
  return folder().file(name);
}

MeshData read(const std::string& name, const std::string& content) {
  return read_volume(write(name, content));
}

void expect_counting(const MeshData& mesh) {
  ASSERT_EQ(mesh.points.size(), kX * kY * kZ);
  ASSERT_EQ(mesh.cell_count(), (kX - 1) * (kY - 1) * (kZ - 1));
  ASSERT_EQ(mesh.fields.size(), 1U);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    ASSERT_EQ(mesh.fields[0].values[i], static_cast<double>(i));
  }
}

/// Where the point with the value v is to be.
void expect_places(const MeshData& mesh, const Vector3d& origin, const Eigen::Matrix3d& axes) {
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vector3d index(static_cast<double>(v % kX), static_cast<double>(v / kX % kY),
                         static_cast<double>(v / (kX * kY)));
    ASSERT_TRUE(mesh.points[v].isApprox(origin + axes * index, 1e-14)) << v;
  }
}

const std::string kNrrd = "NRRD0004\n# a remark\ndimension: 3\nsizes: 5 3 2\nnote:=of someone\n";

TEST(ReadVolume, NrrdInEveryPacking) {
  const std::string head = kNrrd + "type: int16\nendian: big\n";
  const std::string raw = values<std::int16_t>(true);
  expect_counting(read("a.nrrd", head + "encoding: raw\n\n" + raw));
  expect_counting(read("a.nrrd", head + "encoding: gzip\n\n" + packed(raw)));
  expect_counting(read("a.nrrd", head + "encoding: bzip2\n\n" + bzipped(raw)));
  expect_counting(read("a.nrrd", head + "encoding: raw\nline skip: 2\n\na\nb\n" + raw));
  expect_counting(read("a.nrrd", head + "encoding: raw\nbyte skip: 3\n\nabc" + raw));
  expect_counting(read("a.nrrd", head + "encoding: raw\nbyte skip: -1\n\nanything" + raw));
  expect_counting(read("a.nrrd", head + "encoding: gz\nbyte skip: 3\n\n" + packed("abc" + raw)));
  expect_counting(read("a.nrrd", head + "encoding: gz\nbyte skip: -1\n\n" + packed("ab" + raw)));
  std::string text;
  for (std::size_t i = 0; i < kX * kY * kZ; ++i) text += fmt::format("{} ", i);
  expect_counting(read("a.nrrd", head + "encoding: ascii\n\n" + text));
  write("other.raw", raw);
  expect_counting(read("a.nhdr", head + "encoding: raw\ndata file: other.raw\n"));
}

TEST(ReadVolume, NrrdOfEveryType) {
  const auto check = [](const char* type, const std::string& bytes) {
    SCOPED_TRACE(type);
    expect_counting(read("a.nrrd", kNrrd + "endian: little\nencoding: raw\ntype: " + type +
                                       std::string("\n\n") + bytes));
  };
  check("signed char", values<std::int8_t>());
  check("uchar", values<std::uint8_t>());
  check("short", values<std::int16_t>());
  check("unsigned short", values<std::uint16_t>());
  check("int", values<std::int32_t>());
  check("uint32_t", values<std::uint32_t>());
  check("long long", values<std::int64_t>());
  check("uint64", values<std::uint64_t>());
  check("float", values<float>());
  check("Double", values<double>());
}

TEST(ReadVolume, NrrdKeepsPlaceAndDirections) {
  const std::string tail = "type: uchar\nencoding: raw\n\n" + values<std::uint8_t>();
  const MeshData plain = read("a.nrrd", kNrrd + tail);
  expect_places(plain, Vector3d::Zero(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(plain.types[0], CellType::voxel);
  const MeshData spaced = read("a.nrrd", kNrrd + "spacings: 1 2 0.5\naxis mins: 1 2 3\n" + tail);
  expect_places(spaced, {1, 2, 3}, Vector3d(1, 2, 0.5).asDiagonal());
  const MeshData turned =
      read("a.nrrd", kNrrd +
                         "space dimension: 3\nspace directions: (0,2,0) (-1,0,0) (0,0,-3)\nspace "
                         "origin: (5,6,7)\n" +
                         tail);
  Eigen::Matrix3d axes;
  axes << 0, -1, 0, 2, 0, 0, 0, 0, -3;
  expect_places(turned, {5, 6, 7}, axes);
  const Decomposition split = decompose(turned);
  EXPECT_EQ(split.inverted, 0U) << "left-handed axes make no inverted cells";
  double volume = 0;
  for (const Cell& cell : split.mesh.cells) volume += tests::volume(split.mesh, cell);
  EXPECT_NEAR(volume, 8 * 6, 1e-12);
}

TEST(ReadVolume, NrrdOfSeveralValuesAtAPoint) {
  std::string bytes;
  for (const char c : values<std::uint8_t>()) bytes += {c, char(2 * c)};
  const MeshData mesh =
      read("a.nrrd",
           "NRRD0004\ndimension: 4\nsizes: 2 5 3 2\nkinds: vector domain domain domain\ntype: "
           "uchar\nencoding: raw\n\n" +
               bytes);
  ASSERT_EQ(mesh.fields[0].components, 2);
  EXPECT_EQ(mesh.fields[0].values[2 * 7], 7);
  EXPECT_EQ(mesh.fields[0].values[2 * 7 + 1], 14);
}

void expect_refusal(const std::string& name, const std::string& content, const char* why) {
  try {
    static_cast<void>(read(name, content));
    ADD_FAILURE() << "was read: " << why;
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

TEST(ReadVolume, NrrdThatLiesIsRefused) {
  const std::string head = "NRRD0004\ntype: short\nendian: little\nencoding: raw\n";
  const std::string raw = values<std::int16_t>();
  const auto refused = [&](const std::string& more, const char* why) {
    expect_refusal("a.nrrd", head + more + "\n\n" + raw, why);
  };
  refused("dimension: 3\nsizes: 40000 40000 40000", "32 bits");
  refused("dimension: 3\nsizes: 1000 1000 100", "is cut off");
  refused("dimension: 3\nsizes: 5 3 3", "is cut off");
  refused("dimension: 3\nsizes: 5 3 0", "whole numbers");
  refused("dimension: 3\nsizes: 5 3 1", "no volume");
  refused("dimension: 3\nsizes: 5 3", "differ");
  refused("dimension: 2\nsizes: 5 3", "no volume");
  refused("dimension: 4\nsizes: 2 2 3 2", "no volume");
  refused("dimension: 3\nsizes: 5 3 2\nbyte skip: -5", "byte skip");
  refused("dimension: 3\nsizes: 5 3 2\nbyte skip: 999999", "is cut off");
  refused("dimension: 3\nsizes: 5 3 2\nspacings: 1 0 1", "do not span");
  refused("dimension: 3\nsizes: 5 3 2\nspace directions: (1,0,0) (1,0,0) (0,0,1)", "do not span");
  refused("dimension: 3\nsizes: 5 3 2\ndata file: none.raw", "missing");
  expect_refusal(
      "a.nrrd",
      "NRRD0001\ntype: uchar\ndimension: 3\nsizes: 3 4 4\nencoding: raw\n\n" + std::string(48, 'a'),
      "no volume");
  const std::string gzip = kNrrd + "type: uchar\nencoding: gzip\n\n";
  expect_refusal("a.nrrd", gzip + "not packed at all", "is damaged");
  expect_refusal("a.nrrd", gzip + packed(values<std::uint8_t>()).substr(0, 12), "is cut off");
  const std::string bzip = kNrrd + "type: uchar\nencoding: bzip2\n\n";
  expect_refusal("a.nrrd", bzip + "not packed at all", "is damaged");
  expect_refusal("a.nrrd", bzip + bzipped(values<std::uint8_t>()).substr(0, 12), "is cut off");
  expect_refusal("a.nrrd", kNrrd + "type: short\nencoding: raw\n\n" + raw, "byte order");
}

const std::string kMeta = "NDims = 3\nDimSize = 5 3 2\n";

TEST(ReadVolume, MetaImageInEveryPacking) {
  const std::string raw = values<std::uint16_t>(true);
  const std::string head = kMeta + "ElementType = MET_USHORT\nElementByteOrderMSB = True\n";
  expect_counting(read("a.mha", head + "ElementDataFile = LOCAL\n" + raw));
  expect_counting(
      read("a.mha", head + "CompressedData = True\nElementDataFile = LOCAL\n" + packed(raw)));
  write("other.raw", "abc" + raw);
  expect_counting(read("a.mhd", head + "HeaderSize = 3\nElementDataFile = other.raw\n"));
  expect_counting(read("a.mhd", head + "HeaderSize = -1\nElementDataFile = other.raw\n"));
  std::string text;
  for (std::size_t i = 0; i < kX * kY * kZ; ++i) text += fmt::format("{} ", i);
  expect_counting(read("a.mha", head + "BinaryData = False\nElementDataFile = LOCAL\n" + text));
}

TEST(ReadVolume, MetaImageKeepsPlaceAndDirections) {
  const MeshData mesh =
      read("a.mha", kMeta +
                        "TransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 1 2 3\nElementSpacing = 2 "
                        "3 4\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n" +
                        values<std::uint8_t>());
  Eigen::Matrix3d axes;
  axes << 0, -3, 0, 2, 0, 0, 0, 0, 4;
  expect_places(mesh, {1, 2, 3}, axes);
}

TEST(ReadVolume, MetaImageThatLiesIsRefused) {
  const std::string local = "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
  expect_refusal("a.mha", "NDims = 3\nDimSize = 5 3 3\n" + local + values<std::uint8_t>(),
                 "is cut off");
  expect_refusal("a.mha", "NDims = 3\nDimSize = 5 3\n" + local, "differ");
  expect_refusal("a.mha", "NDims = 2\nDimSize = 5 3\n" + local, "no volume");
  expect_refusal("a.mha", kMeta + "ElementType = MET_OTHER\nElementDataFile = LOCAL\n", "type");
  expect_refusal("a.mha", kMeta + "ElementDataFile = LOCAL\n", "ElementType");
  expect_refusal("a.mha", kMeta, "ElementDataFile");
  expect_refusal("a.mhd", kMeta + "ElementType = MET_UCHAR\nElementDataFile = none.raw\n",
                 "missing");
}

TEST(ReadVolume, ValuesInSeveralFiles) {
  const std::string raw = values<std::uint8_t>();
  const std::size_t half = raw.size() / 2;
  write("z08.raw", raw.substr(0, half));
  write("z10.raw", raw.substr(half));
  write("h08.raw", "head" + raw.substr(0, half));
  write("h10.raw", "head" + raw.substr(half));
  const std::string nrrd = kNrrd + "type: uchar\nencoding: raw\n";
  expect_counting(read("a.nhdr", nrrd + "data file: LIST\nz08.raw\nz10.raw\n"));
  expect_counting(read("a.nhdr", nrrd + "data file: z%02d.raw 8 10 2\n"));
  expect_counting(read("a.nhdr", nrrd + "data file: z%02d.raw 8 10 2 2\n"));
  const std::string meta = kMeta + "ElementType = MET_UCHAR\n";
  expect_counting(read("a.mhd", meta + "ElementDataFile = LIST\nz08.raw\n\nz10.raw"));
  expect_counting(read("a.mhd", meta + "HeaderSize = 4\nElementDataFile = h%02d.raw 8 10 2\n"));
  const auto refused = [&](const std::string& files, const char* why) {
    expect_refusal("a.nhdr", nrrd + "data file: " + files + "\n", why);
  };
  refused("LIST\nz08.raw\nz09.raw", "missing");
  refused("LIST\nz08.raw", "is cut off");
  refused("z%02d.raw 8 10 1", "missing");
  refused("z%02d.raw 8 10 0", "no range");
  refused("z%02d.raw 10 8 2", "no range");
  refused("z%02d.raw 0 18446744073709551615 1", "no range");
  refused("z%02d.raw -8 10 2", "whole numbers");
  refused("z%02d.raw 8 10", "MIN MAX STEP");
  refused("z%s.raw 8 10 2", "MIN MAX STEP");
  refused("z%d%d.raw 8 10 2", "MIN MAX STEP");
  refused("z%9999d.raw 8 10 2", "MIN MAX STEP");
  refused("z% 8 10 2", "MIN MAX STEP");
  expect_refusal("a.nhdr", nrrd + "byte skip: 4\ndata file: h%02d.raw 8 10 2\n", "without skips");
  expect_refusal("a.mhd", meta + "HeaderSize = 16\nElementDataFile = h%02d.raw 8 10 2\n" + "",
                 "cut off");
}

std::string inr_head(const std::string& type) {
  std::string head = "#INRIMAGE-4#{\nXDIM=5\nYDIM=3\nZDIM=2\nVDIM=1\n" + type +
                     "CPU=sun\nVX=1\nVY=2\nVZ=3\nTX=5\n";
  head.resize(252, '\n');
  return head + "##}\n";
}

TEST(ReadVolume, Inrimage) {
  const MeshData mesh =
      read("a.inr", inr_head("TYPE=float\nPIXSIZE=32 bits\n") + values<float>(true));
  expect_counting(mesh);
  expect_places(mesh, {5, 0, 0}, Vector3d(1, 2, 3).asDiagonal());
  expect_counting(read(
      "a.inr", inr_head("TYPE=unsigned fixed\nPIXSIZE=16 bits\n") + values<std::uint16_t>(true)));
  expect_refusal("a.inr", inr_head("TYPE=float\nPIXSIZE=64 bits\n") + values<float>(),
                 "is cut off");
  expect_refusal("a.inr", inr_head("TYPE=text\nPIXSIZE=64 bits\n"), "type");
  expect_refusal("a.inr", "#INRIMAGE-4#{\nXDIM=5\n", "no INRIMAGE");
}

TEST(ReadVolume, VolVis) {
  const std::string head = "11111\n5 3 2 8\n1.0 2.0 0.5\n1 6 0 ";
  const std::string raw = values<std::uint8_t>();
  const MeshData mesh = read("a.slc", head + "0\n1 1 Xrgb" + raw);
  expect_counting(mesh);
  expect_places(mesh, Vector3d::Zero(), Vector3d(1, 2, 0.5).asDiagonal());
  const std::string runs = std::string("\x8f", 1) + raw.substr(0, 15) + std::string(1, '\0');
  const std::string more = std::string("\x8e", 1) + raw.substr(15, 14) + "\x01\x1d";
  expect_counting(read("a.slc", head + "1\n1 1 Xrgb17 X" + runs + "17 X" + more));
  expect_refusal("a.slc", head + "1\n1 1 Xrgb17 X" + runs + "17 X" + runs.substr(0, 5),
                 "is cut off");
  expect_refusal("a.slc", head + "1\n1 1 Xrgb3 X\x7f\x01\x01", "goes beyond");
  expect_refusal("a.slc", head + "1\n1 1 Xrgb2 X\x05\x01", "instead of 15");
  expect_refusal("a.slc", "11111\n400 300 200 8\n1 1 1\n1 6 0 0\n0 0 X", "is cut off");
  expect_refusal("a.slc", "11112\n", "no VolVis file");
}

TEST(ReadVolume, RawAsItsLayoutSays) {
  const std::string file = write("a.raw", values<std::int16_t>());
  expect_counting(read_raw(file, "5x3x2:int16"));
  expect_counting(read_raw(file, "5x3x2:int16:little"));
  EXPECT_EQ(read_raw(file, "5x3x2:int16:big").fields[0].values[1], 256);
  for (const char* layout :
       {"5x3x3:int16", "5x3x2:int32", "5x3x2:int8", "400000x300000x300000:int8"}) {
    EXPECT_THROW(static_cast<void>(read_raw(file, layout)), base::Error) << layout;
  }
  for (const char* layout : {"", "5x3x2", "5x3:int16", "5x3x2:short", "5x3x2:int16:middle",
                             "5x3x-2:int16", "5x3x2.0:int16", "0x3x2:int16"}) {
    EXPECT_THROW(static_cast<void>(read_raw(file, layout)), base::UsageError) << layout;
  }
  ImportOptions options;
  options.raw = "5x3x2:int16";
  EXPECT_EQ(import_mesh(file, options).report.input_points, kX * kY * kZ);
  EXPECT_THROW(static_cast<void>(import_mesh(file)), base::ReadError);
}

TEST(ReadVolume, TheNeghipOfVolVisIsTheRawOneWithABorder) {
  SKIP_WITHOUT_DATA();
  const Volume padded = read_slc((tests::data_folder() / "volumes/neghip.slc").string());
  const MeshData raw = read_raw(
      (tests::data_folder() / "volumes/neghip_64x64x64_uint8.raw").string(), "64x64x64:uint8");
  ASSERT_EQ(padded.size, (std::array<std::size_t, 3>{66, 66, 66}));
  for (std::size_t k = 0; k < 64; ++k) {
    for (std::size_t j = 0; j < 64; ++j) {
      for (std::size_t i = 0; i < 64; ++i) {
        ASSERT_EQ(padded.values[((k + 1) * 66 + j + 1) * 66 + i + 1],
                  raw.fields[0].values[(k * 64 + j) * 64 + i]);
      }
    }
  }
}

TEST(ReadVolume, TheBallsOfEveryPackingAreTheSame) {
  SKIP_WITHOUT_DATA();
  const auto ball = [](const std::string& name) {
    return read_nrrd((tests::data_folder() / ("torture/BallBinary30x30x30" + name)).string());
  };
  const Volume first = ball(".nrrd");
  for (const char* name : {"_gz.nrrd", "_bz2.nrrd", "_gz_lineskip.nrrd",
                           "_gz_byteskip_minus_one.nrrd", ".nhdr", "_byteskip_minus_one.nhdr"}) {
    EXPECT_EQ(ball(name).values, first.values) << name;
  }
  EXPECT_THROW(static_cast<void>(ball("_byteskip_minus_five.nhdr")), base::ReadError);
}

}  // namespace
}  // namespace tetraglass::mesh
