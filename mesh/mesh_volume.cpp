#include "mesh/mesh_volume.h"

#include "base/errors.h"

#ifdef TETRAGLASS_WITH_CGAL

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <set>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/refine_mesh_3.h>
#include <Eigen/LU>
#include <fmt/format.h>

#include "base/parallel.h"
#include "mesh/mesh_complex-inl.h"
#include "mesh/regular_grid.h"

namespace tetraglass::mesh {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

constexpr unsigned kMostSeconds = 600;
constexpr double kFacetAngle = 30;  ///< degrees; the largest for which Mesh_3 ends
constexpr double kLargestLabel = 65535;

/// The label of each place.
class Labels {
 public:
  Labels(Volume grid, const VolumeRegions& regions)
      : grid_(std::move(grid)), regions_(regions), inverse_(grid_.axes.inverse()) {
    for (const double value : grid_.values) {
      if (!std::isfinite(value)) throw base::InputError("the image has values that are not finite");
      if (regions.labels && (value != std::floor(value) || value < 0 || value > kLargestLabel)) {
        throw base::InputError(fmt::format(
            "{} is no label (a whole number from 0 to {}); --surface-at takes grey values", value,
            kLargestLabel));
      }
    }
  }

  [[nodiscard]] const Volume& grid() const { return grid_; }

  /// 0 outside of the grid.
  [[nodiscard]] int at(const Vector3d& place) const {
    const Vector3d p = inverse_ * (place - grid_.origin);
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto last = static_cast<double>(grid_.size[static_cast<std::size_t>(k)] - 1);
      if (!(p[k] >= 0 && p[k] <= last)) return 0;
    }
    if (!regions_.labels) {
      double value = 0;
      interpolate(grid_, grid_.values, 1, place, {&value, 1});
      return value >= *regions_.level ? 1 : 0;
    }
    return heaviest(p);
  }

  /// Of a point of the grid.
  [[nodiscard]] int at_point(std::size_t i) const {
    if (regions_.labels) return static_cast<int>(grid_.values[i]);
    return grid_.values[i] >= *regions_.level ? 1 : 0;
  }

 private:
  [[nodiscard]] int heaviest(const Vector3d& p) const {
    std::array<std::pair<int, double>, 8> weights{};
    std::size_t count = 0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      double weight = 1;
      std::array<std::size_t, 3> i{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double t = p[static_cast<Eigen::Index>(k)];
        const double low = std::min(std::floor(t), static_cast<double>(grid_.size[k] - 2));
        const std::size_t up = corner >> k & 1U;
        weight *= up == 1 ? t - low : 1 - (t - low);
        i[k] = static_cast<std::size_t>(low) + up;
      }
      const int label = at_point((i[2] * grid_.size[1] + i[1]) * grid_.size[0] + i[0]);
      std::size_t place = 0;
      while (place < count && weights[place].first != label) ++place;
      if (place == count) weights[count++] = {label, 0.0};
      weights[place].second += weight;
    }
    return std::max_element(weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(count),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  }

  Volume grid_;
  VolumeRegions regions_;
  Eigen::Matrix3d inverse_;
};

/// A connected piece of a region: points of one label that are neighbours in the grid.
struct Piece {
  int label = 0;
  std::size_t points = 0;
  std::vector<std::pair<Vector3d, Vector3d>> ways_out;  ///< from a point in it to one outside
};

class PieceFinder {
 public:
  explicit PieceFinder(const Labels& labels)
      : labels_(labels), grid_(labels.grid()), seen_(grid_.points(), false) {}

  std::vector<Piece> find() {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < grid_.points(); ++i) {
      if (!seen_[i] && labels_.at_point(i) != 0) pieces.push_back(grow(i));
    }
    return pieces;
  }

 private:
  [[nodiscard]] Vector3d place(const std::array<std::ptrdiff_t, 3>& at) const {
    return grid_.origin + grid_.axes * Vector3d(static_cast<double>(at[0]),
                                                static_cast<double>(at[1]),
                                                static_cast<double>(at[2]));
  }

  Piece grow(std::size_t start) {
    Piece piece;
    piece.label = labels_.at_point(start);
    std::vector<std::size_t> waiting = {start};
    seen_[start] = true;
    while (!waiting.empty()) {
      const std::size_t i = waiting.back();
      waiting.pop_back();
      ++piece.points;
      const std::array<std::ptrdiff_t, 3> at = {
          static_cast<std::ptrdiff_t>(i % grid_.size[0]),
          static_cast<std::ptrdiff_t>(i / grid_.size[0] % grid_.size[1]),
          static_cast<std::ptrdiff_t>(i / (grid_.size[0] * grid_.size[1]))};
      std::ptrdiff_t stride = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        for (const std::ptrdiff_t step : {-1, 1}) {
          auto next = at;
          next[k] += step;
          const bool inside = next[k] >= 0 && next[k] < static_cast<std::ptrdiff_t>(grid_.size[k]);
          const auto j = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + step * stride);
          if (!inside || labels_.at_point(j) != piece.label) {
            piece.ways_out.emplace_back(place(at), place(next));
          } else if (!seen_[j]) {
            seen_[j] = true;
            waiting.push_back(j);
          }
        }
        stride *= static_cast<std::ptrdiff_t>(grid_.size[k]);
      }
    }
    return piece;
  }

  const Labels& labels_;
  const Volume& grid_;
  std::vector<bool> seen_;
};

/// Where the refinement starts: on the way out of each piece at some of its places, spread evenly
/// over its points and no nearer to each other than `spacing`, so that no piece is forgotten.
void start(const std::vector<Piece>& pieces, const Domain& domain, double spacing,
           Complex& complex) {
  constexpr std::size_t kStartsOfPiece = 24;
  const auto intersect = domain.construct_intersection_object();
  std::vector<Vector3d> taken;
  for (const Piece& piece : pieces) {
    const std::size_t stride = std::max<std::size_t>(1, piece.ways_out.size() / kStartsOfPiece);
    for (std::size_t i = 0; i < piece.ways_out.size(); i += stride) {
      const auto& [in, out] = piece.ways_out[i];
      const auto found = intersect(Kernel::Segment_3(Kernel::Point_3(in.x(), in.y(), in.z()),
                                                     Kernel::Point_3(out.x(), out.y(), out.z())));
      if (std::get<2>(found) == 0) continue;
      const Kernel::Point_3& p = std::get<0>(found);
      const Vector3d at(p.x(), p.y(), p.z());
      const bool crowded = i > 0 && std::ranges::any_of(taken, [&](const Vector3d& other) {
                             return (other - at).squaredNorm() < spacing * spacing;
                           });
      if (crowded) continue;
      taken.push_back(at);
      const auto vertex = complex.triangulation().insert(Triangulation::Point(p));
      complex.set_dimension(vertex, 2);
      complex.set_index(vertex, std::get<1>(found));
    }
  }
}

CGAL::Bbox_3 box_around(const Volume& grid) {
  Eigen::AlignedBox3d box;
  for (int corner = 0; corner < 8; ++corner) {
    Vector3d at;
    for (int k = 0; k < 3; ++k) {
      at[k] = (corner >> k & 1) * static_cast<double>(grid.size[static_cast<std::size_t>(k)] - 1);
    }
    box.extend(grid.origin + grid.axes * at);
  }
  // A little larger, so that regions end within it.
  const Vector3d margin = 0.01 * box.sizes();
  return {box.min().x() - margin.x(), box.min().y() - margin.y(), box.min().z() - margin.z(),
          box.max().x() + margin.x(), box.max().y() + margin.y(), box.max().z() + margin.z()};
}

std::string refined(const Labels& labels, const std::vector<Piece>& pieces, double volume_of_cell,
                    double ratio) {
  const auto tell = [](const char* stage) { std::puts(stage); };
  tell("boundaries");
  const Domain domain(
      [&labels](const Kernel::Point_3& p) { return labels.at(Vector3d(p.x(), p.y(), p.z())); },
      box_around(labels.grid()));
  const MeshCriteriaSizes sizes(volume_of_cell);
  namespace parameters = CGAL::parameters;
  const Criteria criteria(
      parameters::facet_angle = kFacetAngle, parameters::facet_size = sizes.circumradius,
      parameters::facet_distance = sizes.distance, parameters::cell_radius_edge_ratio = ratio,
      parameters::cell_size = sizes.circumradius);
  Complex complex;
  start(pieces, domain, sizes.edge, complex);
  tell("refinement");
  CGAL::refine_mesh_3(complex, domain, criteria, parameters::no_exude(), parameters::no_perturb());
  tell("slivers");
  CGAL::exude_mesh_3(complex);
  return complex_parcel(complex);
}

/// The image's point fields at the points of the mesh.
void carry_fields(const MeshData& data, const Volume& grid, TetMesh& mesh) {
  for (const Field& field : data.fields) {
    const auto n = static_cast<std::size_t>(field.components);
    if (field.location != Location::point || field.values.size() != n * grid.points()) continue;
    Field out{field.name, Location::point, field.components, {}};
    out.values.resize(n * mesh.points.size());
    constexpr std::size_t kGrain = 1024;
    base::parallel_ranges(mesh.points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        interpolate(grid, field.values, field.components, mesh.points[i],
                    std::span(out.values).subspan(i * n, n));
      }
    });
    mesh.fields.push_back(std::move(out));
  }
}

}  // namespace

TetMesh mesh_volume(const MeshData& data, const VolumeRegions& regions,
                    std::vector<std::string>& notes, const FillOptions& options) {
  if (!options.holes.empty() || options.keep_surface || options.min_dihedral > 0) {
    throw base::InputError(
        "places of holes, keeping the surface and a smallest dihedral angle are for TetGen");
  }
  if (!regions.labels && !regions.level) {
    throw base::InputError(
        "whether the image has labels or grey values is to be told: --labels or --surface-at V");
  }
  const Labels labels(regular_grid(data, regions.field), regions);
  const std::vector<Piece> pieces = PieceFinder(labels).find();
  std::size_t points = 0;
  for (const Piece& piece : pieces) points += piece.points;
  if (points == 0) {
    throw base::InputError(
        regions.labels ? "the image has no labels but 0"
                       : fmt::format("no value of the image is {} or more", *regions.level));
  }
  const double volume = static_cast<double>(points) * std::abs(labels.grid().axes.determinant());
  const double cell = options.max_volume > 0
                          ? options.max_volume / std::pow(MeshCriteriaSizes::kLargest, 3)
                          : volume / options.cells;
  const Apart apart =
      run_apart([&] { return refined(labels, pieces, cell, options.radius_edge_ratio); },
                kMostSeconds, "CGAL");
  TetMesh mesh = mesh_of_parcel(apart, regions.labels);
  if (mesh.cells.empty()) {
    throw base::InputError("its regions are too small for tetrahedra of that size");
  }
  Volume grid = regular_grid(data, "");
  carry_fields(data, grid, mesh);
  std::size_t small = 0;
  for (const Piece& piece : pieces) {
    const double piece_volume =
        static_cast<double>(piece.points) * std::abs(labels.grid().axes.determinant());
    small += piece_volume < cell ? 1 : 0;
  }
  notes.push_back(fmt::format(
      "{} connected regions of an image, meshed by CGAL with {} points; facets lie within about "
      "{:.3g} of their boundaries",
      pieces.size(), mesh.points.size(), MeshCriteriaSizes(cell).distance));
  if (small > 0) {
    notes.push_back(
        fmt::format("{} of them are smaller than a tetrahedron, and may be lost", small));
  }
  return mesh;
}

}  // namespace tetraglass::mesh

#else

namespace tetraglass::mesh {

TetMesh mesh_volume(const MeshData& /*data*/, const VolumeRegions& /*regions*/,
                    std::vector<std::string>& /*notes*/, const FillOptions& /*options*/) {
  throw base::UnavailableError(
      "meshing an image needs CGAL's Mesh_3, which this build lacks (TETRAGLASS_WITH_CGAL)");
}

}  // namespace tetraglass::mesh

#endif
