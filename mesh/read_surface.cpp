#include "mesh/read_surface.h"

#include <array>
#include <bit>
#include <cstring>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/file_name.h"
#include "mesh/number_text.h"
#include "mesh/text_lines.h"

namespace tetraglass::mesh {
namespace {

void add_face(MeshData& mesh, const std::vector<std::uint32_t>& points) {
  constexpr std::array<CellType, 5> kTypes = {CellType::polygon, CellType::vertex, CellType::line,
                                              CellType::triangle, CellType::quad};
  mesh.add_cell(points.size() < kTypes.size() ? kTypes[points.size()] : CellType::polygon, points);
}

MeshData read_off(const std::string& file) {
  TextLines lines(file);
  lines.expect("OFF");
  // The keyword may be left out; before it stand S T C N 4 n, of which 4 and n change the points.
  std::size_t at = 0;
  std::string_view keyword = lines.words()[0];
  if (keyword.ends_with("OFF")) {
    keyword.remove_suffix(3);
    if (keyword.find_first_of("4n") != std::string_view::npos) {
      lines.fail("points of other than 3 coordinates are not read");
    }
    if (lines.words().size() > 1 && lines.words()[1] == "BINARY") {
      lines.fail("binary OFF is not read; convert it to text, or to .ply");
    }
    at = 1;
  }
  if (lines.words().size() == at) {
    lines.expect("the numbers of points and faces");
    at = 0;
  }
  const std::size_t points = lines.count(at, "points");
  const std::size_t faces = lines.count(at + 1, "faces");
  MeshData mesh;
  for (std::size_t i = 0; i < points; ++i) {
    lines.expect(fmt::format("point {} of {}", i, points));
    mesh.points.emplace_back(lines.number(0), lines.number(1), lines.number(2));
  }
  std::vector<std::uint32_t> face;
  for (std::size_t i = 0; i < faces; ++i) {
    lines.expect(fmt::format("face {} of {}", i, faces));
    const std::size_t size = lines.count(0, "corners");
    face.clear();
    for (std::size_t k = 0; k < size; ++k) face.push_back(lines.index(1 + k, points));
    if (size > 0) add_face(mesh, face);
  }
  return mesh;
}

MeshData read_obj(const std::string& file) {
  TextLines lines(file);
  MeshData mesh;
  std::vector<std::uint32_t> face;
  while (lines.next()) {
    const std::string_view key = lines.words()[0];
    if (key == "v") {
      mesh.points.emplace_back(lines.number(1), lines.number(2), lines.number(3));
    } else if (key == "f") {
      face.clear();
      for (std::size_t k = 1; k < lines.words().size(); ++k) {
        face.push_back(lines.obj_index(k, mesh.points.size()));
      }
      if (face.size() < 3) lines.fail("a face has fewer than 3 corners");
      add_face(mesh, face);
    }
  }
  return mesh;
}

/// Gives equal corners of triangles the same number.
class CornerMerger {
 public:
  explicit CornerMerger(MeshData& mesh) : mesh_(mesh) {}
  std::uint32_t number(const Eigen::Vector3d& p) {
    // +0 and -0 are the same place.
    const std::array<double, 3> key = {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};
    const auto [entry, is_new] =
        numbers_.try_emplace(key, static_cast<std::uint32_t>(mesh_.points.size()));
    if (is_new) mesh_.points.push_back(p);
    return entry->second;
  }

 private:
  MeshData& mesh_;
  std::map<std::array<double, 3>, std::uint32_t> numbers_;
};

constexpr std::size_t kStlHead = 84;      // a title of 80 bytes, and the number of triangles
constexpr std::size_t kStlTriangle = 50;  // a normal, three corners, two bytes more

std::uint32_t stl_count(const std::string& bytes) {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    count |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[80 + i])) << (8 * i);
  }
  return count;
}

float little_endian_float(const char* bytes) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes, sizeof word);
  if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap32(word);
  return std::bit_cast<float>(word);
}

MeshData read_binary_stl(const std::string& file, const std::string& bytes) {
  const std::uint32_t count = bytes.size() >= kStlHead ? stl_count(bytes) : 0;
  if (bytes.size() < kStlHead || (bytes.size() - kStlHead) / kStlTriangle < count) {
    throw base::ReadError(
        file, fmt::format("is cut off: {} triangles take {} bytes, it has {}", count,
                          kStlHead + kStlTriangle * std::uint64_t{count}, bytes.size()));
  }
  MeshData mesh;
  CornerMerger corners(mesh);
  for (std::uint32_t i = 0; i < count; ++i) {
    std::array<std::uint32_t, 3> triangle{};
    const char* entry = bytes.data() + kStlHead + std::size_t{i} * kStlTriangle + 12;
    for (std::size_t k = 0; k < 3; ++k, entry += 12) {
      const Eigen::Vector3d p(little_endian_float(entry), little_endian_float(entry + 4),
                              little_endian_float(entry + 8));
      if (!p.allFinite()) {
        throw base::ReadError(file, fmt::format("a corner of triangle {} is not finite", i));
      }
      triangle[k] = corners.number(p);
    }
    mesh.add_cell(CellType::triangle, triangle);
  }
  return mesh;
}

MeshData read_text_stl(const std::string& file) {
  TextLines lines(file, '\0');
  MeshData mesh;
  CornerMerger corners(mesh);
  std::vector<std::uint32_t> triangle;
  bool ended = true;
  while (lines.next()) {
    const std::string_view key = lines.words()[0];
    if (key == "solid") ended = false;
    if (key == "endsolid") ended = true;
    if (key == "vertex") {
      const Eigen::Vector3d p(lines.number(1), lines.number(2), lines.number(3));
      if (!p.allFinite()) lines.fail("a corner is not finite");
      triangle.push_back(corners.number(p));
    }
    if (key == "endloop") {
      if (triangle.size() != 3) {
        lines.fail(fmt::format("a facet with {} corners", triangle.size()));
      }
      mesh.add_cell(CellType::triangle, triangle);
      triangle.clear();
    }
  }
  if (!ended) throw base::ReadError(file, "is cut off: there is no 'endsolid'");
  return mesh;
}

MeshData read_stl(const std::string& file) {
  const std::string bytes = content_of(file);
  // Binary files may begin with "solid" as well.
  const bool exact = bytes.size() >= kStlHead &&
                     bytes.size() == kStlHead + kStlTriangle * std::uint64_t{stl_count(bytes)};
  const bool text = !exact && bytes.starts_with("solid") && is_text(bytes);

  return text ? read_text_stl(file) : read_binary_stl(file, bytes);
}

}  // namespace

MeshData read_surface(const std::string& file) {
  const std::string extension = extension_of(file);
  if (extension == ".off") return read_off(file);
  if (extension == ".obj") return read_obj(file);
  if (extension == ".stl") return read_stl(file);
  return read_ply(file);
}

}  // namespace tetraglass::mesh
