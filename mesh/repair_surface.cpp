#include "mesh/repair_surface.h"

#include "base/errors.h"

#ifdef TETRAGLASS_WITH_CGAL

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <map>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <fmt/format.h>
// After OpenMesh's headers, which they extend.
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>
#include <CGAL/boost/graph/properties_TriMesh_ArrayKernelT.h>

#include "mesh/parcel.h"
#include "mesh/run_apart.h"
#include "mesh/triangle_surface.h"

namespace tetraglass::mesh {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Polygon = std::vector<std::size_t>;

struct InDouble : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Halfedges = OpenMesh::TriMesh_ArrayKernelT<InDouble>;
using Halfedge = boost::graph_traits<Halfedges>::halfedge_descriptor;
using Face = boost::graph_traits<Halfedges>::face_descriptor;

/// Processor time that a repair may take; the largest surface so far has needed 1 s.
constexpr unsigned kMostSeconds = 120;
/// Holes of more edges are left open: closing them would take too long (cubic in the worst case).
constexpr std::size_t kMostEdgesOfHole = 2000;

/// What was done; plain numbers, to be handed from process to process.
struct Counts {
  std::uint64_t points = 0, triangles = 0;  ///< that the repaired surface has
  std::uint64_t doubled = 0;                ///< triangles
  std::uint64_t turned = 0;                 ///< triangles
  std::uint64_t split = 0;                  ///< points
  std::uint64_t stitched = 0;               ///< pairs of edges
  std::uint64_t flat = 0;                   ///< triangles
  std::uint64_t holes = 0, hole_edges = 0, hole_triangles = 0;
  std::uint64_t open = 0;  ///< holes left
  double largest_open = 0, largest_closed = 0;
};

struct Repaired {
  Counts counts;
  std::vector<std::uint32_t> sources;  ///< of each point, its number in the surface
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

double diagonal(const CGAL::Bbox_3& box) {
  return Eigen::Vector3d(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin())
      .stableNorm();
}

class Repair {
 public:
  Repair(const TriangleSurface& surface, double largest_hole)
      : surface_(surface), largest_hole_(largest_hole) {
    for (const Eigen::Vector3d& p : surface.points) {
      points_.emplace_back(p.x(), p.y(), p.z());
      box_ += points_.back().bbox();
    }
    for (const auto& t : surface.triangles) polygons_.push_back({t[0], t[1], t[2]});
  }

  std::string parcel() {
    mend_soup();
    build_mesh();
    counts_.stitched = pmp::stitch_borders(mesh_);
    drop_flat_faces();
    close_holes();
    // Shells whose triangles disagreed have come out either way.
    if (counts_.turned > 0 && CGAL::is_closed(mesh_)) pmp::orient_to_bound_a_volume(mesh_);
    return packed();
  }

 private:
  void mend_soup() {
    counts_.doubled = pmp::merge_duplicate_polygons_in_polygon_soup(
        points_, polygons_,
        CGAL::parameters::erase_all_duplicates(false).require_same_orientation(false));
    std::vector<Polygon> before = polygons_;
    const std::size_t point_count = points_.size();
    pmp::orient_polygon_soup(points_, polygons_);
    counts_.split = points_.size() - point_count;
    for (std::size_t i = 0; i < polygons_.size(); ++i) {
      std::array<Point, 3> now;
      std::array<Point, 3> then;
      for (std::size_t k = 0; k < 3; ++k) {
        now[k] = points_[polygons_[i][k]];
        then[k] = points_[before[i][k]];
      }
      bool same = false;
      for (int turn = 0; turn < 3; ++turn) {
        same = same || now == then;
        std::ranges::rotate(then, then.begin() + 1);
      }
      counts_.turned += same ? 0 : 1;
    }
  }

  /// CGAL would round the coordinates to float on their way into OpenMesh's structure.
  void build_mesh() {
    mesh_.add_property(source_);
    std::map<Point, std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < surface_.points.size(); ++i) numbers[points_[i]] = i;
    std::vector<bool> used(points_.size(), false);
    for (const Polygon& polygon : polygons_) {
      for (const std::size_t i : polygon) used[i] = true;
    }
    std::vector<Halfedges::VertexHandle> vertices(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!used[i]) continue;
      vertices[i] = mesh_.add_vertex({points_[i].x(), points_[i].y(), points_[i].z()});
      mesh_.property(source_, vertices[i]) = numbers.at(points_[i]) + 1;
    }
    for (const Polygon& p : polygons_) {
      if (!mesh_.add_face(vertices[p[0]], vertices[p[1]], vertices[p[2]]).is_valid()) {
        throw base::Error("not a manifold");
      }
    }
  }

  void drop_flat_faces() {
    const std::size_t before = flat_faces();
    pmp::remove_degenerate_faces(mesh_);  // collapses short edges and flips long ones
    mesh_.garbage_collection();
    counts_.flat = before - std::min(before, flat_faces());
  }

  std::size_t flat_faces() {
    const auto faces = mesh_.faces();
    return static_cast<std::size_t>(std::count_if(faces.begin(), faces.end(), [&](const auto f) {
      return pmp::is_degenerate_triangle_face(f, mesh_);
    }));
  }

  void close_holes() {
    std::vector<Halfedge> borders;
    pmp::extract_boundary_cycles(mesh_, std::back_inserter(borders));
    for (const Halfedge border : borders) {
      CGAL::Bbox_3 box;
      std::size_t edges = 0;
      for (const Halfedge h : CGAL::halfedges_around_face(border, mesh_)) {
        box += get(CGAL::vertex_point, mesh_, target(h, mesh_)).bbox();
        ++edges;
      }
      const double size = diagonal(box) / diagonal(box_);
      std::vector<Face> faces;
      if (size <= largest_hole_ && edges <= kMostEdgesOfHole) {
        pmp::triangulate_hole(mesh_, border, std::back_inserter(faces));
      }
      if (faces.empty()) {
        ++counts_.open;
        counts_.largest_open = std::max(counts_.largest_open, size);
      } else {
        ++counts_.holes;
        counts_.hole_edges += edges;
        counts_.hole_triangles += faces.size();
        counts_.largest_closed = std::max(counts_.largest_closed, size);
      }
    }
  }

  std::string packed() {
    std::vector<std::uint32_t> sources;
    for (const auto v : mesh_.vertices()) {
      if (mesh_.property(source_, v) == 0) throw base::Error("a point has been added");
      sources.push_back(mesh_.property(source_, v) - 1);
    }
    std::vector<std::uint32_t> corners;
    for (const auto f : mesh_.faces()) {
      for (const auto v : mesh_.fv_range(f)) corners.push_back(static_cast<std::uint32_t>(v.idx()));
    }
    counts_.points = sources.size();
    counts_.triangles = corners.size() / 3;
    Parcel parcel;
    parcel.put(&counts_, 1);
    parcel.put(sources.data(), sources.size());
    parcel.put(corners.data(), corners.size());
    return std::move(parcel.bytes);
  }

  const TriangleSurface& surface_;
  const double largest_hole_;
  std::vector<Point> points_;
  std::vector<Polygon> polygons_;
  CGAL::Bbox_3 box_;
  Halfedges mesh_;
  OpenMesh::VPropHandleT<std::uint32_t> source_;  ///< of each vertex, its number in the surface + 1
  Counts counts_;
};

Repaired unpack(std::string bytes) {
  Parcel parcel(std::move(bytes));
  Repaired repaired;
  repaired.counts = parcel.take<Counts>(1)[0];
  repaired.sources = parcel.take<std::uint32_t>(repaired.counts.points);
  const std::vector<std::uint32_t> corners =
      parcel.take<std::uint32_t>(3 * repaired.counts.triangles);
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    repaired.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
  }
  return repaired;
}

void tell(const Counts& counts, double largest_hole, std::vector<std::string>& notes) {
  std::vector<std::string> done;
  const auto tell_count = [&](std::uint64_t count, const char* what) {
    if (count > 0) done.push_back(fmt::format("{} {}", count, what));
  };
  tell_count(counts.doubled, "triangles that were there twice left out");
  tell_count(counts.turned, "triangles turned to agree with their neighbours");
  tell_count(counts.split, "points doubled where more than one sheet met");
  tell_count(counts.stitched, "pairs of edges stitched");
  tell_count(counts.flat, "triangles without area removed");
  if (counts.holes > 0) {
    done.push_back(fmt::format(
        "{} holes of {} edges closed by {} triangles, the largest {:.3g} of the surface's diagonal",
        counts.holes, counts.hole_edges, counts.hole_triangles, counts.largest_closed));
  }
  notes.push_back("repair: " +
                  (done.empty() ? "nothing to do" : fmt::format("{}", fmt::join(done, ", "))));
  if (counts.open > 0) {
    notes.push_back(fmt::format(
        "repair: {} holes are left open, the largest {:.3g} of the surface's diagonal; holes up to "
        "{:g} are closed",
        counts.open, counts.largest_open, largest_hole));
  }
}

MeshData with_fields(const MeshData& data, const TriangleSurface& surface,
                     const Repaired& repaired) {
  MeshData result;
  for (const std::uint32_t i : repaired.sources) result.points.push_back(surface.points[i]);
  for (const auto& triangle : repaired.triangles) result.add_cell(CellType::triangle, triangle);
  for (const Field& field : data.fields) {
    if (field.location != Location::point) continue;
    const auto n = static_cast<std::size_t>(field.components);
    Field& out =
        result.fields.emplace_back(Field{field.name, Location::point, field.components, {}});
    for (const std::uint32_t i : repaired.sources) {
      const double* values = field.values.data() + n * surface.sources[i];
      out.values.insert(out.values.end(), values, values + n);
    }
  }
  return result;
}

}  // namespace

MeshData repair_surface(const MeshData& data, double largest_hole,
                        std::vector<std::string>& notes) {
  const TriangleSurface surface = collect_triangles(data, notes);
  const Apart apart =
      run_apart([&] { return Repair(surface, largest_hole).parcel(); }, kMostSeconds, "repair");
  if (!apart.ending.empty() || apart.result.size() < sizeof(Counts)) {
    throw base::InputError("the repair of the surface " +
                           (apart.ending.empty() ? "failed" : apart.ending) +
                           "; without --repair its faults are told");
  }
  const Repaired repaired = unpack(apart.result);
  tell(repaired.counts, largest_hole, notes);
  return with_fields(data, surface, repaired);
}

}  // namespace tetraglass::mesh

#else

namespace tetraglass::mesh {

MeshData repair_surface(const MeshData& /*data*/, double /*largest_hole*/,
                        std::vector<std::string>& /*notes*/) {
  throw base::UnavailableError(
      "repairing a surface needs CGAL's polygon mesh processing, which this build lacks "
      "(TETRAGLASS_WITH_CGAL)");
}

}  // namespace tetraglass::mesh

#endif
