#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <new>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/interior_points.h"
#include "mesh/parcel.h"
#include "mesh/predicates.h"
#include "mesh/run_apart.h"
#include "mesh/self_intersection.h"
#include "mesh/surface_diagnosis.h"
#include "mesh/tetrahedralize.h"
#include "mesh/triangle_surface.h"

#ifdef TETRAGLASS_WITH_TETGEN

#define TETLIBRARY
#include <tetgen.h>

namespace tetraglass::mesh {
namespace {

/// The volume of the largest tetrahedra, over the wanted mean: where walls are too thin for the
/// lattice inside, TetGen adds points until none is larger. With 4 there are 0.9 to 1.1 times as
/// many tetrahedra as wanted on the surfaces that this was tried on, and up to 1.5 times on some of
/// many thin walls; with 2 there were 1.1 to 1.8 times as many.
constexpr double kLargestOfMean = 4;
/// The largest volume over that of the lattice's tetrahedra, where the largest is asked for: those
/// between the lattice and the surface are larger than the lattice's own.
constexpr double kMeanOfLargest = 2;
constexpr double kMostCells = 2e7;  ///< TetGen takes about 1 kB for each
/// A surface is kept as it is where its edges are at most so many times as long as the wanted
/// tetrahedra's: then points inside fit to it.
constexpr double kFineEdges = 2;
/// Processor time that TetGen may take; it has needed 6 s for any surface so far.
constexpr unsigned kMostSeconds = 300;

/// How often the shell goes round the point (negatively if its faces turn inwards), from the solid
/// angles of its triangles. Source: van Oosterom and Strackee 1983, Eq. 8.
int winding_number(const TriangleSurface& surface, std::span<const std::size_t> shell,
                   const Eigen::Vector3d& p) {
  double angle = 0;
  for (const std::size_t i : shell) {
    const auto& t = surface.triangles[i];
    const Eigen::Vector3d a = surface.points[t[0]] - p;
    const Eigen::Vector3d b = surface.points[t[1]] - p;
    const Eigen::Vector3d c = surface.points[t[2]] - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return static_cast<int>(std::lround(angle / (4 * std::numbers::pi)));
}

/// Whether a place belongs to the solid, by how often each shell goes round it.
bool is_solid(const TriangleSurface& surface, const Eigen::Vector3d& p) {
  int total = 0;
  int crossings = 0;
  for (const auto& shell : surface.shells) {
    const int winding = winding_number(surface, shell, p);
    total += winding;
    crossings += std::abs(winding);
  }
  return is_solid(surface, total, crossings);
}

/// TetGen crashes on some surfaces that intersect themselves, so they do not get that far.
void check_embedded(const TriangleSurface& surface) {
  const SurfaceFaults faults = find_faults(surface);
  if (faults.flat + faults.crossings > 0) {
    throw base::InputError(describe(surface, diagnose(surface)));
  }
}

[[noreturn]] void fail(int code) {
  // The codes of TetGen 1.5, `terminatetetgen` in tetgen.h.
  switch (code) {
    case 1:
      throw std::bad_alloc();
    case 3:
      throw base::InputError("the surface intersects itself");
    case 4:
      throw base::InputError(
          "the surface has features smaller than the precision of its "
          "coordinates");
    case 5:
      throw base::InputError("two faces of the surface overlap or touch");
    default:
      throw base::InputError(fmt::format(
          "the surface could not be filled (TetGen ended with code {}); it may intersect "
          "itself",
          code));
  }
}

void give(const TriangleSurface& surface, std::span<const Eigen::Vector3d> inside, tetgenio& in) {
  in.numberofpoints = static_cast<int>(surface.points.size() + inside.size());
  in.pointlist = new REAL[(surface.points.size() + inside.size()) * 3];  // freed by tetgenio
  REAL* coordinate = in.pointlist;
  for (const Eigen::Vector3d& p : surface.points) coordinate = std::copy_n(p.data(), 3, coordinate);
  for (const Eigen::Vector3d& p : inside) coordinate = std::copy_n(p.data(), 3, coordinate);
  in.numberoffacets = static_cast<int>(surface.triangles.size());
  in.facetlist = new tetgenio::facet[surface.triangles.size()];
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    tetgenio::facet& facet = in.facetlist[i];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::polygon& polygon = facet.polygonlist[0];
    tetgenio::init(&polygon);
    polygon.numberofvertices = 3;
    polygon.vertexlist = new int[3];
    for (std::size_t k = 0; k < 3; ++k) {
      polygon.vertexlist[k] = static_cast<int>(surface.triangles[i][k]);
    }
  }
}

/// Everything within the hull of a surface, in regions that it cuts off.
struct Filling {
  std::vector<Eigen::Vector3d> points;
  std::vector<Cell> cells;
  std::vector<int> regions;  ///< of each cell

  [[nodiscard]] bool contains(const Cell& cell, const Eigen::Vector3d& place) const {
    for (const auto& face : kFaceVertices) {
      if (orientation(points[cell[static_cast<std::size_t>(face[0])]],
                      points[cell[static_cast<std::size_t>(face[1])]],
                      points[cell[static_cast<std::size_t>(face[2])]], place) > 0) {
        return false;
      }
    }
    return true;
  }
};

/// Of each region, whether it is solid.
std::map<int, bool> solid_regions(const TriangleSurface& surface, const Filling& filling,
                                  bool all_solid) {
  // The centre of a region's largest tetrahedron is far enough from its walls for rounding.
  std::map<int, std::pair<double, std::size_t>> largest;
  for (std::size_t i = 0; i < filling.cells.size(); ++i) {
    const auto [a, b, c, d] = filling.cells[i];
    const Eigen::Vector3d& origin = filling.points[a];
    const double volume = (filling.points[b] - origin)
                              .cross(filling.points[c] - origin)
                              .dot(filling.points[d] - origin);
    auto& entry = largest.try_emplace(filling.regions[i], -1.0, i).first->second;
    if (volume > entry.first) entry = {volume, i};
  }
  std::map<int, bool> solid;
  for (const auto& [region, entry] : largest) {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    for (const std::uint32_t i : filling.cells[entry.second]) center += filling.points[i] / 4;
    solid[region] = all_solid || surface.inner_walls || is_solid(surface, center);
  }
  return solid;
}

/// The region that a place lies in.
std::optional<int> region_at(const Filling& filling, const Eigen::Vector3d& place) {
  for (std::size_t i = 0; i < filling.cells.size(); ++i) {
    if (filling.contains(filling.cells[i], place)) return filling.regions[i];
  }
  return std::nullopt;
}

/// What is asked for, and what the surface says, of its regions.
struct Marks {
  std::span<const Eigen::Vector3d> holes;  ///< asked for
  const RegionMarks* file = nullptr;       ///< of the surface
};

/// Of each solid region, its number: counted from 1, or what the file calls it (0 where it is not
/// named).
std::map<int, double> region_numbers(const TriangleSurface& surface, const Filling& filling,
                                     const Marks& marks) {
  std::map<int, bool> solid = solid_regions(surface, filling, marks.file != nullptr);
  for (const Eigen::Vector3d& place : marks.holes) {
    const auto region = region_at(filling, place);
    if (!region) {
      throw base::InputError(fmt::format("the place of a hole, ({:g}, {:g}, {:g}), lies outside",
                                         place.x(), place.y(), place.z()));
    }
    solid[*region] = false;
  }
  if (marks.file != nullptr) {  // those outside of a surface in pieces are usual
    for (const Eigen::Vector3d& place : marks.file->holes) {
      if (const auto region = region_at(filling, place)) solid[*region] = false;
    }
  }
  const bool is_named = marks.file != nullptr && !marks.file->regions.empty();
  std::map<int, double> numbers;
  for (const auto& [region, is_solid] : solid) {
    if (is_solid) numbers.emplace(region, is_named ? 0.0 : static_cast<double>(numbers.size() + 1));
  }
  if (!is_named) return numbers;
  for (const RegionMarks::Region& mark : marks.file->regions) {
    const auto region = region_at(filling, mark.place);
    const auto found = region ? numbers.find(*region) : numbers.end();
    if (found != numbers.end()) found->second = mark.attribute;
  }
  return numbers;
}

TetMesh solid_part(const TriangleSurface& surface, Filling filling, const Marks& marks) {
  for (Cell& cell : filling.cells) {
    const auto [a, b, c, d] = cell;
    const std::vector<Eigen::Vector3d>& p = filling.points;
    if (orientation(p[a], p[b], p[c], p[d]) < 0) std::swap(cell[2], cell[3]);
  }
  const std::map<int, double> numbers = region_numbers(surface, filling, marks);
  TetMesh mesh;
  Field region{"region", Location::cell, 1, {}};
  constexpr std::uint32_t kUnused = 0xffffffffU;
  std::vector<std::uint32_t> number(filling.points.size(), kUnused);
  for (std::size_t i = 0; i < filling.cells.size(); ++i) {
    const auto found = numbers.find(filling.regions[i]);
    if (found == numbers.end()) continue;
    region.values.push_back(found->second);
    Cell cell = filling.cells[i];
    for (std::uint32_t& p : cell) {
      if (number[p] == kUnused) {
        number[p] = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(filling.points[p]);
      }
      p = number[p];
    }
    mesh.cells.push_back(cell);
  }
  const bool is_named = marks.file != nullptr && !marks.file->regions.empty();
  if (numbers.size() > 1 || is_named) mesh.fields.push_back(std::move(region));
  return mesh;
}

std::string tetgen_parcel(const TriangleSurface& surface, std::span<const Eigen::Vector3d> inside,
                          std::string switches) {
  tetgenio in;
  tetgenio out;
  give(surface, inside, in);
  std::array<int, 4> head{};  // a code, and the numbers of points, tetrahedra and their attributes
  try {
    tetrahedralize(switches.data(), &in, &out);
  } catch (int code) {
    head[0] = code;
  }
  Parcel parcel;
  if (head[0] == 0) {
    head = {0, out.numberofpoints, out.numberoftetrahedra, out.numberoftetrahedronattributes};
  }
  parcel.put(head.data(), head.size());
  if (head[0] == 0) {
    const auto cells = static_cast<std::size_t>(head[2]);
    parcel.put(out.pointlist, 3 * static_cast<std::size_t>(head[1]));
    parcel.put(out.tetrahedronlist, 4 * cells);  // of linear ones, so 4 points each
    parcel.put(out.tetrahedronattributelist, static_cast<std::size_t>(head[3]) * cells);
  }
  return std::move(parcel.bytes);
}

/// The tetrahedra of the solid; none where TetGen fails on what another try may do. TetGen 1.5
/// ends the process where one of its assertions fails.
std::optional<TetMesh> run_tetgen(const TriangleSurface& surface,
                                  std::span<const Eigen::Vector3d> inside,
                                  const std::string& switches, const Marks& marks) {
  const Apart apart =
      run_apart([&] { return tetgen_parcel(surface, inside, switches); }, kMostSeconds, "TetGen");
  Parcel parcel(apart.result);
  if (!apart.ending.empty() || parcel.bytes.size() < 4 * sizeof(int)) return std::nullopt;
  const std::vector<int> head = parcel.take<int>(4);
  if (head[0] != 0) fail(head[0]);
  const auto cells = static_cast<std::size_t>(head[2]);
  const auto attributes = static_cast<std::size_t>(head[3]);
  Filling filling;
  const std::vector<double> coordinates =
      parcel.take<double>(3 * static_cast<std::size_t>(head[1]));
  for (std::size_t i = 0; i < coordinates.size(); i += 3) {
    filling.points.emplace_back(&coordinates[i]);
  }
  const std::vector<int> corners = parcel.take<int>(4 * cells);
  const std::vector<double> regions = parcel.take<double>(attributes * cells);
  for (std::size_t i = 0; i < cells; ++i) {
    Cell& cell = filling.cells.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) cell[k] = static_cast<std::uint32_t>(corners[4 * i + k]);
    filling.regions.push_back(attributes > 0 ? static_cast<int>(regions[attributes * (i + 1) - 1])
                                             : 0);
  }
  return solid_part(surface, std::move(filling), marks);
}

/// Whether the triangles are about as small as the tetrahedra that are wanted inside, or smaller.
bool is_fine(const TriangleSurface& surface, double volume_of_cell) {
  double area = 0;
  for (const auto& t : surface.triangles) {
    const Eigen::Vector3d& a = surface.points[t[0]];
    area += (surface.points[t[1]] - a).cross(surface.points[t[2]] - a).norm() / 2;
  }
  // Edges of an equilateral triangle and of a regular tetrahedron.
  const double surface_edge =
      std::sqrt(area / static_cast<double>(surface.triangles.size()) * 4 / std::numbers::sqrt3);
  const double cell_edge = std::cbrt(volume_of_cell * 6 * std::numbers::sqrt2);
  return surface_edge <= kFineEdges * cell_edge;
}

/// The volume of all solid regions, where walls or marks tell of them.
double volume_of_regions(const TriangleSurface& surface, const Marks& marks) {
  const std::optional<TetMesh> mesh = run_tetgen(surface, {}, "pYAQ", marks);
  double volume = 0;
  if (!mesh) return volume;
  for (const Cell& c : mesh->cells) {
    const Eigen::Vector3d& a = mesh->points[c[0]];
    volume +=
        (mesh->points[c[1]] - a).cross(mesh->points[c[2]] - a).dot(mesh->points[c[3]] - a) / 6;
  }
  return volume;
}

void tell(const TriangleSurface& surface, const TetMesh& mesh, bool kept, std::size_t regions,
          std::vector<std::string>& notes) {
  notes.push_back(
      fmt::format("{} triangles in {} shells{}, filled by TetGen with {} points added{}",
                  surface.triangles.size(), surface.shells.size(), kept ? ", kept as they are" : "",
                  mesh.points.size() - std::min(mesh.points.size(), surface.points.size()),
                  kept ? " inside" : " inside and on the surface"));
  if (regions > 1) notes.push_back(fmt::format("{} regions: cell field 'region'", regions));
}

}  // namespace

TetMesh fill_surface(const MeshData& data, std::vector<std::string>& notes,
                     const FillOptions& options) {
  const TriangleSurface surface = triangle_surface(data, notes);
  check_embedded(surface);
  const Marks marks = {options.holes, data.marks ? &*data.marks : nullptr};
  const double volume = surface.inner_walls || marks.file != nullptr
                            ? volume_of_regions(surface, marks)
                            : std::abs(enclosed_volume(surface));
  if (!(volume > 0)) throw base::InputError("the surface encloses no volume");
  const double largest =
      options.max_volume > 0 ? options.max_volume : kLargestOfMean * volume / options.cells;
  const double mean = options.max_volume > 0 ? largest / kMeanOfLargest : volume / options.cells;
  if (volume / mean > kMostCells) {
    throw base::InputError(fmt::format(
        "tetrahedra of at most {:g} would be about {:.2g} in the volume of {:g}; TetGen "
        "takes up to {:g}",
        largest, volume / mean, volume, kMostCells));
  }
  const std::vector<Eigen::Vector3d> inside = interior_points(surface, mean);
  const std::string quality =
      fmt::format("q{}/{}a{:e}A", options.radius_edge_ratio, options.min_dihedral, largest);
  std::optional<TetMesh> mesh;
  bool kept = options.keep_surface || is_fine(surface, mean);
  if (kept) mesh = run_tetgen(surface, inside, "pY" + quality, marks);
  if (!mesh && !options.keep_surface) {
    kept = false;
    mesh = run_tetgen(surface, inside, "p" + quality, marks);
  }
  if (!mesh) {
    throw base::InputError(fmt::format(
        "the surface could not be filled: TetGen fails on it{}, or needs more than {} s",
        options.keep_surface ? " where it is to be kept" : "", kMostSeconds));
  }
  if (mesh->cells.empty()) throw base::InputError("the surface encloses no volume");
  const std::size_t regions =
      mesh->fields.empty()
          ? 1
          : std::set<double>(mesh->fields[0].values.begin(), mesh->fields[0].values.end()).size();
  tell(surface, *mesh, kept, regions, notes);
  return std::move(*mesh);
}

}  // namespace tetraglass::mesh

#else

namespace tetraglass::mesh {

TetMesh fill_surface(const MeshData& /*data*/, std::vector<std::string>& /*notes*/,
                     const FillOptions& /*options*/) {
  throw base::UnavailableError(
      "filling a surface needs TetGen, which this build lacks (TETRAGLASS_WITH_TETGEN)");
}

}  // namespace tetraglass::mesh

#endif
