#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/predicates.h"
#include "mesh/self_intersection.h"
#include "mesh/tetrahedralize.h"
#include "mesh/triangle_surface.h"

#ifdef TETRAGLASS_WITH_TETGEN

#define TETLIBRARY
#include <tetgen.h>

namespace tetraglass::mesh {
namespace {

/// The mean volume of TetGen's tetrahedra over the largest allowed one, measured on coarse surfaces
/// (0.44 to 0.48).
constexpr double kMeanOfLargest = 0.45;
/// The largest ratio of circumradius to shortest edge. TetGen's refinement ends for 2 (Si 2015,
/// Theorem 6.1).
constexpr double kRadiusEdgeRatio = 2;
/// A surface is kept as it is where its edges are at most so many times as long as the wanted
/// tetrahedra's: then points inside fit to it.
constexpr double kFineEdges = 2;
/// The least points inside, of those on the surface, for a field inside to be seen.
constexpr double kLeastInside = 0.05;

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
  int shells = 0;
  for (const auto& shell : surface.shells) {
    const int winding = winding_number(surface, shell, p);
    total += winding;
    shells += std::abs(winding);
  }
  return surface.turned > 0 ? shells % 2 != 0 : total != 0;
}

/// TetGen crashes on some surfaces that intersect themselves, so they do not get that far.
void check_embedded(const TriangleSurface& surface) {
  const SurfaceFaults faults = find_faults(surface);
  const auto place = [&] {
    return fmt::format("({:g}, {:g}, {:g})", faults.where.x(), faults.where.y(), faults.where.z());
  };
  if (faults.flat > 0) {
    throw base::InputError(
        fmt::format("the surface has {} triangles without area, the first at {}; repair it first",
                    faults.flat, place()));
  }
  if (faults.crossings > 0) {
    throw base::InputError(fmt::format(
        "the surface intersects itself: {} pairs of triangles, the first at {}; repair it first",
        faults.crossings, place()));
  }
}

[[noreturn]] void fail(int code) {
  // The codes of TetGen 1.5, `terminatetetgen` in tetgen.h.
  switch (code) {
    case 1:
      throw std::bad_alloc();
    case 3:
      throw base::InputError("the surface intersects itself; repair it first");
    case 4:
      throw base::InputError(
          "the surface has features smaller than the precision of its "
          "coordinates; repair it first");
    case 5:
      throw base::InputError("two faces of the surface overlap or touch; repair it first");
    default:
      throw base::InputError(fmt::format(
          "the surface could not be filled (TetGen ended with code {}); it may intersect "
          "itself",
          code));
  }
}

void give(const TriangleSurface& surface, tetgenio& in) {
  in.numberofpoints = static_cast<int>(surface.points.size());
  in.pointlist = new REAL[surface.points.size() * 3];  // freed by tetgenio
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    std::copy_n(surface.points[i].data(), 3, in.pointlist + 3 * i);
  }
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

/// Of each region that the surface cuts off, whether it is solid.
std::map<int, bool> solid_regions(const TriangleSurface& surface,
                                  std::span<const Eigen::Vector3d> points,
                                  std::span<const Cell> cells, std::span<const int> regions) {
  // The centre of a region's largest tetrahedron is far enough from its walls for rounding.
  std::map<int, std::pair<double, std::size_t>> largest;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& c = cells[i];
    const Eigen::Vector3d& a = points[c[0]];
    const double volume = (points[c[1]] - a).cross(points[c[2]] - a).dot(points[c[3]] - a);
    auto& entry = largest.try_emplace(regions[i], -1.0, i).first->second;
    if (volume > entry.first) entry = {volume, i};
  }
  std::map<int, bool> solid;
  for (const auto& [region, entry] : largest) {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    for (const std::uint32_t i : cells[entry.second]) center += points[i] / 4;
    solid[region] = is_solid(surface, center);
  }
  return solid;
}

TetMesh take(const TriangleSurface& surface, const tetgenio& out) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < out.numberofpoints; ++i) points.emplace_back(out.pointlist + 3 * i);
  std::vector<Cell> cells;
  std::vector<int> regions;
  const int attributes = out.numberoftetrahedronattributes;
  for (int i = 0; i < out.numberoftetrahedra; ++i) {
    Cell cell{};
    for (std::size_t k = 0; k < 4; ++k) {
      cell[k] = static_cast<std::uint32_t>(
          out.tetrahedronlist[i * out.numberofcorners + static_cast<int>(k)]);
    }
    if (orientation(points[cell[0]], points[cell[1]], points[cell[2]], points[cell[3]]) < 0) {
      std::swap(cell[2], cell[3]);
    }
    cells.push_back(cell);
    regions.push_back(
        attributes > 0
            ? static_cast<int>(out.tetrahedronattributelist[i * attributes + attributes - 1])
            : 0);
  }
  const std::map<int, bool> solid = solid_regions(surface, points, cells, regions);
  TetMesh mesh;
  constexpr std::uint32_t kUnused = 0xffffffffU;
  std::vector<std::uint32_t> number(points.size(), kUnused);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!solid.at(regions[i])) continue;
    for (std::uint32_t& p : cells[i]) {
      if (number[p] == kUnused) {
        number[p] = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(points[p]);
      }
      p = number[p];
    }
    mesh.cells.push_back(cells[i]);
  }
  return mesh;
}

TetMesh run_tetgen(const TriangleSurface& surface, std::string switches) {
  tetgenio in;
  tetgenio out;
  give(surface, in);
  try {
    tetrahedralize(switches.data(), &in, &out);
  } catch (int code) {
    fail(code);
  }
  return take(surface, out);
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

}  // namespace

TetMesh fill_surface(const MeshData& data, std::vector<std::string>& notes, double cells) {
  const TriangleSurface surface = triangle_surface(data, notes);
  check_embedded(surface);
  const double volume = std::abs(enclosed_volume(surface));
  if (!(volume > 0)) throw base::InputError("the surface encloses no volume");
  const double largest = volume / (cells * kMeanOfLargest);
  const std::string quality = fmt::format("q{}a{:e}AQ", kRadiusEdgeRatio, largest);
  const auto points = static_cast<double>(surface.points.size());
  TetMesh mesh;
  bool kept = is_fine(surface, volume / cells);
  if (kept) {
    mesh = run_tetgen(surface, "pY" + quality);
    // Between walls as thin as their triangles TetGen places no points while it keeps them.
    kept = static_cast<double>(mesh.points.size()) >= (1 + kLeastInside) * points;
  }
  if (!kept) mesh = run_tetgen(surface, "p" + quality);
  if (mesh.cells.empty()) throw base::InputError("the surface encloses no volume");
  notes.push_back(
      fmt::format("{} triangles in {} shells{}, filled by TetGen with {} points added{}",
                  surface.triangles.size(), surface.shells.size(), kept ? ", kept as they are" : "",
                  mesh.points.size() - std::min(mesh.points.size(), surface.points.size()),
                  kept ? " inside" : " inside and on the surface"));
  return mesh;
}

}  // namespace tetraglass::mesh

#else

namespace tetraglass::mesh {

TetMesh fill_surface(const MeshData& /*data*/, std::vector<std::string>& /*notes*/,
                     double /*cells*/) {
  throw base::UnavailableError(
      "filling a surface needs TetGen, which this build lacks (TETRAGLASS_WITH_TETGEN)");
}

}  // namespace tetraglass::mesh

#endif
