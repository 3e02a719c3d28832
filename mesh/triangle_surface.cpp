#include "mesh/triangle_surface.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <tuple>
#include <unordered_map>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/cell_shapes.h"
#include "mesh/surface_diagnosis.h"

namespace tetraglass::mesh {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// For each point the first one that equals it.
std::vector<std::uint32_t> first_equals(std::span<const Eigen::Vector3d> points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) {
    return std::tuple(points[i].x(), points[i].y(), points[i].z());
  };
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(key(a), a) < std::tuple(key(b), b);
  });
  std::vector<std::uint32_t> first(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && points[order[i]] == points[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

class Collector {
 public:
  explicit Collector(const MeshData& data) : data_(data) {}

  TriangleSurface collect(std::vector<std::string>& notes) {
    check_points();
    first_ = first_equals(data_.points);
    for (std::size_t i = 0; i < data_.cell_count(); ++i) add_cell(i);
    gather_points();
    if (merged_ > 0) notes.push_back(fmt::format("{} points equal others: made one", merged_));
    if (collapsed_ > 0) {
      notes.push_back(fmt::format("{} triangles with two equal corners are left out", collapsed_));
    }
    return std::move(surface_);
  }

 private:
  void check_points() const {
    for (std::size_t i = 0; i < data_.points.size(); ++i) {
      if (!data_.points[i].allFinite()) {
        throw base::InputError(fmt::format("the coordinates of point {} are not finite", i));
      }
    }
  }

  void add_cell(std::size_t cell) {
    cell_ = cell;
    const CellShape* shape = find_shape(data_.types[cell]);
    if (shape == nullptr || shape->dimension != 2) return;
    std::span<const std::uint32_t> points = data_.cell(cell);
    for (const std::uint32_t i : points) {
      if (i >= data_.points.size()) {
        throw base::InputError(fmt::format("cell {} names point {}, but there are {} points", cell,
                                           i, data_.points.size()));
      }
    }
    if (shape->corners > 0) {
      const auto corners = static_cast<std::size_t>(shape->corners);
      if (points.size() < corners) {
        throw base::InputError(fmt::format("cell {} ({}) has {} points instead of {}", cell,
                                           shape->name, points.size(), corners));
      }
      points = points.first(corners);
    }
    if (shape->type == CellType::triangle_strip) {
      for (std::size_t k = 0; k + 2 < points.size(); ++k) {
        // Every other triangle of a strip runs the other way round.
        add_polygon(std::array{points[k + k % 2], points[k + 1 - k % 2], points[k + 2]});
      }
    } else if (shape->type == CellType::pixel) {
      add_polygon(std::array{points[0], points[1], points[3], points[2]});
    } else {
      add_polygon(points);
    }
  }

  void add_polygon(std::span<const std::uint32_t> polygon) {
    std::vector<std::uint32_t> p;
    for (const std::uint32_t i : polygon) p.push_back(first_[i]);
    const std::size_t n = p.size();
    if (n < 3) return;
    const auto m = static_cast<std::size_t>(std::ranges::min_element(p) - p.begin());
    for (std::size_t k = 1; k + 1 < n; ++k) {
      const Triangle t = {p[m], p[(m + k) % n], p[(m + k + 1) % n]};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
        ++collapsed_;
      } else {
        surface_.triangles.push_back(t);
        surface_.cells.push_back(static_cast<std::uint32_t>(cell_));
      }
    }
  }

  void gather_points() {
    std::vector<bool> used(data_.points.size(), false);
    for (const Triangle& t : surface_.triangles) {
      for (const std::uint32_t i : t) used[i] = true;
    }
    std::vector<std::uint32_t> number(data_.points.size());
    for (std::uint32_t i = 0; i < data_.points.size(); ++i) {
      if (first_[i] != i) ++merged_;
      if (!used[i]) continue;
      number[i] = static_cast<std::uint32_t>(surface_.points.size());
      surface_.points.push_back(data_.points[i]);
      surface_.sources.push_back(i);
    }
    for (Triangle& t : surface_.triangles) {
      for (std::uint32_t& i : t) i = number[i];
    }
  }

  const MeshData& data_;
  TriangleSurface surface_;
  std::vector<std::uint32_t> first_;
  std::size_t cell_ = 0;  ///< whose triangles are being made
  std::size_t merged_ = 0;
  std::size_t collapsed_ = 0;
};

using Edges = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<EdgeUse>>;

void check_closed(const TriangleSurface& surface, const Edges& edges) {
  const bool open =
      std::ranges::any_of(edges, [](const auto& edge) { return edge.second.size() == 1; });
  if (open) throw base::InputError(describe(surface, diagnose(surface)));
}

/// Finds the shells and turns triangles so that neighbours agree.
void orient(TriangleSurface& surface, const Edges& edges) {
  struct Link {
    std::size_t triangle;
    bool agrees;
  };
  std::vector<std::vector<Link>> links(surface.triangles.size());
  for (const auto& [edge, uses] : edges) {
    // At an edge of more than two triangles it cannot be told which continue each other, but they
    // hang together.
    for (std::size_t k = 0; uses.size() == 2 && k < 2; ++k) {
      links[uses[k].triangle].push_back({uses[1 - k].triangle, uses[0].forward != uses[1].forward});
    }
  }
  std::vector<signed char> direction(surface.triangles.size(), 0);
  for (std::size_t start = 0; start < surface.triangles.size(); ++start) {
    if (direction[start] != 0) continue;
    std::vector<std::size_t> shell = {start};
    direction[start] = 1;
    for (std::size_t k = 0; k < shell.size(); ++k) {
      for (const Link& link : links[shell[k]]) {
        if (direction[link.triangle] != 0) continue;
        direction[link.triangle] =
            static_cast<signed char>(link.agrees ? direction[shell[k]] : -direction[shell[k]]);
        shell.push_back(link.triangle);
      }
    }
    std::size_t turned = 0;
    for (const std::size_t i : shell) turned += direction[i] < 0 ? 1 : 0;
    for (const std::size_t i : shell) {
      if (direction[i] < 0) std::swap(surface.triangles[i][1], surface.triangles[i][2]);
    }
    surface.turned += turned;
    std::ranges::sort(shell);
    surface.shells.push_back(std::move(shell));
  }
}

}  // namespace

Edges find_edges(std::span<const Triangle> triangles) {
  Edges edges;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[i][k];
      const std::uint32_t b = triangles[i][(k + 1) % 3];
      edges[std::minmax(a, b)].push_back({i, a < b});
    }
  }
  return edges;
}

TriangleSurface collect_triangles(const MeshData& data, std::vector<std::string>& notes) {
  return Collector(data).collect(notes);
}

TriangleSurface triangle_surface(const MeshData& data, std::vector<std::string>& notes) {
  TriangleSurface surface = collect_triangles(data, notes);
  const Edges edges = find_edges(surface.triangles);
  check_closed(surface, edges);
  surface.inner_walls =
      std::ranges::any_of(edges, [](const auto& edge) { return edge.second.size() % 2 != 0; });
  orient(surface, edges);
  if (surface.turned > 0) {
    notes.push_back(fmt::format("{} of {} triangles ran the other way round than their neighbours",
                                surface.turned, surface.triangles.size()));
  }
  return surface;
}

double enclosed_volume(const TriangleSurface& surface) {
  if (surface.points.empty()) return 0;
  const Eigen::Vector3d& origin = surface.points[0];
  double volume = 0;
  for (const auto& shell : surface.shells) {
    double of_shell = 0;
    for (const std::size_t i : shell) {
      const Triangle& t = surface.triangles[i];
      of_shell += (surface.points[t[0]] - origin)
                      .dot((surface.points[t[1]] - origin).cross(surface.points[t[2]] - origin)) /
                  6;
    }
    // Where the directions say nothing, each shell counts for itself.
    volume += surface.turned > 0 ? std::abs(of_shell) : of_shell;
  }
  return volume;
}

}  // namespace tetraglass::mesh
