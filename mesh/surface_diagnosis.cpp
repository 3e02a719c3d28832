#include "mesh/surface_diagnosis.h"

#include <numeric>

#include <fmt/format.h>

namespace tetraglass::mesh {
namespace {

constexpr std::size_t kFew = 3;

using Edge = SurfaceDiagnosis::Edge;

std::size_t root_of(std::vector<std::size_t>& parents, std::size_t i) {
  while (parents[i] != i) {
    parents[i] = parents[parents[i]];
    i = parents[i];
  }
  return i;
}

std::string point_text(const TriangleSurface& surface, std::uint32_t i) {
  const Eigen::Vector3d& p = surface.points[i];
  return fmt::format("{} ({:g}, {:g}, {:g})", surface.sources[i], p.x(), p.y(), p.z());
}

std::string edges_text(const TriangleSurface& surface, const std::vector<Edge>& edges,
                       std::size_t count) {
  std::string text;
  for (const Edge& edge : edges) {
    text += fmt::format("{}{} - {}", text.empty() ? "" : ", ", point_text(surface, edge[0]),
                        point_text(surface, edge[1]));
  }
  return fmt::format("between the points {}{}", text, count > edges.size() ? ", ..." : "");
}

std::string crossings_text(const TriangleSurface& surface, const SurfaceFaults& faults) {
  std::string text;
  for (const auto& [a, b] : faults.first_crossings) {
    const std::string at = text.empty()
                               ? " near point " + point_text(surface, surface.triangles[a][0])
                               : std::string();
    text += fmt::format("{}{} with {}{}", text.empty() ? "" : ", ", surface.cells[a],
                        surface.cells[b], at);
  }
  return fmt::format("the cells {}{}", text,
                     faults.crossings > faults.first_crossings.size() ? ", ..." : "");
}

std::string flat_text(const TriangleSurface& surface, const SurfaceFaults& faults) {
  std::string text;
  for (const std::size_t i : faults.first_flat) {
    text += fmt::format("{}cell {} at point {}", text.empty() ? "" : ", ", surface.cells[i],
                        point_text(surface, surface.triangles[i][0]));
  }
  return text + (faults.flat > faults.first_flat.size() ? ", ..." : "");
}

}  // namespace

SurfaceDiagnosis diagnose(const TriangleSurface& surface) {
  SurfaceDiagnosis diagnosis;
  const auto edges = find_edges(surface.triangles);
  diagnosis.edges = edges.size();
  std::vector<std::size_t> parents(surface.triangles.size());
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  const auto note = [](std::size_t& count, std::vector<Edge>& first, const Edge& edge) {
    ++count;
    if (first.size() < kFew) first.push_back(edge);
  };
  for (const auto& [ends, uses] : edges) {
    const Edge edge = {ends.first, ends.second};
    if (uses.size() == 1) note(diagnosis.open_edges, diagnosis.first_open, edge);
    if (uses.size() > 2) note(diagnosis.crowded_edges, diagnosis.first_crowded, edge);
    if (uses.size() == 2 && uses[0].forward == uses[1].forward) ++diagnosis.disagreeing_edges;
    for (const EdgeUse& use : uses) {
      parents[root_of(parents, use.triangle)] = root_of(parents, uses[0].triangle);
    }
  }
  for (std::size_t i = 0; i < parents.size(); ++i) diagnosis.parts += parents[i] == i ? 1 : 0;
  diagnosis.faults = find_faults(surface);
  return diagnosis;
}

std::string describe(const TriangleSurface& surface, const SurfaceDiagnosis& diagnosis) {
  std::vector<std::string> found;
  if (diagnosis.open_edges > 0) {
    found.push_back(
        fmt::format("the surface is not closed: {} of its {} edges have one triangle only, {}",
                    diagnosis.open_edges, diagnosis.edges,
                    edges_text(surface, diagnosis.first_open, diagnosis.open_edges)));
  }
  if (diagnosis.faults.crossings > 0) {
    found.push_back(fmt::format("the surface intersects itself: {} pairs of triangles, {}",
                                diagnosis.faults.crossings,
                                crossings_text(surface, diagnosis.faults)));
  }
  if (diagnosis.faults.flat > 0) {
    found.push_back(fmt::format("{} triangles have no area, {}", diagnosis.faults.flat,
                                flat_text(surface, diagnosis.faults)));
  }
  if (diagnosis.crowded_edges > 0) {
    found.push_back(
        fmt::format("{} edges have more than two triangles, {}", diagnosis.crowded_edges,
                    edges_text(surface, diagnosis.first_crowded, diagnosis.crowded_edges)));
  }
  if (diagnosis.disagreeing_edges > 0) {
    found.push_back(
        fmt::format("at {} edges neighbours run opposite ways round", diagnosis.disagreeing_edges));
  }
  found.push_back(fmt::format("{} triangles in {} part{}", surface.triangles.size(),
                              diagnosis.parts, diagnosis.parts == 1 ? "" : "s"));
  return fmt::format("{}", fmt::join(found, "; "));
}

}  // namespace tetraglass::mesh
