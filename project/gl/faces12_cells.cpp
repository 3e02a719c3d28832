#include "project/gl/faces12_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "base/errors.h"
#include "project/gl/functions.inl"
#include "project/gl/mesh_buffers.h"
#include "project/gl/switches.h"

namespace tetraglass::project::gl {
namespace {

constexpr std::size_t kVertices = 12;  // of a cell
constexpr std::size_t kGrain = 1024;   // cells that a task takes at least: some 100 us of work

// weiler2002, section 4.1: 4 MB as luminance and alpha, "a good compromise".
constexpr int kMinimumSize = 128;

constexpr double kLargestShort = std::numeric_limits<std::int16_t>::max();

using Matrix34 = Eigen::Matrix<double, 3, 4>;

// One cell in normalized units, as floats have it.
struct PlacedCell {
  Matrix34 points;
  Eigen::Vector4d values = Eigen::Vector4d::Zero();
};

PlacedCell placed(const Scene& scene, const Normalization& normalization, std::uint32_t index) {
  PlacedCell result;
  const mesh::Cell& cell = scene.mesh->cells[index];
  const bool point_field = scene.field.location == mesh::Location::point;
  for (int i = 0; i < 4; ++i) {
    const std::uint32_t vertex = cell[static_cast<std::size_t>(i)];
    result.points.col(i) = normalization.point(scene.mesh->points[vertex]).cast<double>();
    result.values[i] = normalization.value(scene.field.values[point_field ? vertex : index]);
  }
  return result;
}

double longest_edge(const Matrix34& p) {
  double longest = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) longest = std::max(longest, (p.col(i) - p.col(j)).norm());
  }
  return longest;
}

// Of the linear function with these values; 0 where the cell is flat. Beyond what floats hold the
// gradient of a sliver is cut.
Eigen::Vector3d gradient(const PlacedCell& cell) {
  Eigen::Matrix3d edges;
  Eigen::Vector3d rises;
  for (int i = 0; i < 3; ++i) {
    edges.row(i) = (cell.points.col(i + 1) - cell.points.col(0)).transpose();
    rises[i] = cell.values[i + 1] - cell.values[0];
  }
  const double volume = edges.determinant();
  if (volume == 0) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d a = edges.row(0);
  const Eigen::Vector3d b = edges.row(1);
  const Eigen::Vector3d c = edges.row(2);
  const Eigen::Vector3d result =
      (rises[0] * b.cross(c) + rises[1] * c.cross(a) + rises[2] * a.cross(b)) / volume;
  constexpr double kMost = 1e30;
  return result.cwiseMax(-kMost).cwiseMin(kMost);
}

// Of the face opposite vertex i, outwards; 0 where it has no area.
Eigen::Vector3d outward_normal(const Matrix34& p, int i) {
  const auto& face = mesh::kFaceVertices[static_cast<std::size_t>(i)];
  const Eigen::Vector3d n =
      (p.col(face[1]) - p.col(face[0])).cross(p.col(face[2]) - p.col(face[0]));
  const double size = n.norm();
  return size > 0 ? Eigen::Vector3d(n / size) : Eigen::Vector3d::Zero();
}

template <class Number>
Number stored(double value, double scale) {
  if constexpr (std::is_same_v<Number, float>) {
    return static_cast<float>(value);
  } else {
    return static_cast<Number>(
        std::lround(std::clamp(value / scale, -kLargestShort, kLargestShort)));
  }
}

// A plane as the vertex stage rebuilds it (equation 4): two components, the third from them, in
// floats and in the same order; and the constant that puts *that* plane through the middle of the
// face, so that the roundings of the normal tilt it only.
template <class Number>
struct Plane {
  std::array<Number, 2> normal;
  float constant;
};

template <class Number>
Plane<Number> stored_plane(const Matrix34& p, int i, const Eigen::Vector4f& scale) {
  Eigen::Vector3d n = outward_normal(p, i);
  if (n.z() < 0) n = -n;
  Plane<Number> plane{{stored<Number>(n.x(), scale[2]), stored<Number>(n.y(), scale[2])}, 0};
  const float x = static_cast<float>(plane.normal[0]) * scale[2];
  const float y = static_cast<float>(plane.normal[1]) * scale[2];
  const float rest = 1.0F - x * x - y * y;
  const Eigen::Vector3d rebuilt(x, y, std::sqrt(std::max(rest, 0.0F)));
  const Eigen::Vector3d middle = (p.rowwise().sum() - p.col(i)) / 3;
  plane.constant = static_cast<float>(rebuilt.dot(middle));
  return plane;
}

// What the numbers of the short layout are multiples of.
Eigen::Vector4f short_scale(const Scene& scene, const Normalization& normalization,
                            const std::vector<std::uint32_t>& drawn) {
  struct Largest {
    double gradient = 0;
    double edge = 0;
  };
  const auto larger = [](const Largest& a, const Largest& b) {
    return Largest{std::max(a.gradient, b.gradient), std::max(a.edge, b.edge)};
  };
  const Largest largest = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, drawn.size(), kGrain), Largest{},
      [&](const auto& range, Largest sum) {
        for (std::size_t k = range.begin(); k != range.end(); ++k) {
          const PlacedCell cell = placed(scene, normalization, drawn[k]);
          sum = larger(sum, {gradient(cell).cwiseAbs().maxCoeff(), longest_edge(cell.points)});
        }
        return sum;
      },
      larger);
  // A length of 0 would divide by 0: edges are rounded up from there.
  const auto step = [](double most) {
    return static_cast<float>(most > 0 ? most / kLargestShort : 1);
  };
  return {step(1), step(largest.gradient), step(1), step(largest.edge)};
}

// The four arrays of the layout for the cells of a scene.
template <class Number>
struct Arrays {
  std::vector<std::array<float, 4>> positions;
  std::vector<std::array<Number, 4>> values;
  std::vector<std::array<Number, 4>> normals;
  std::vector<std::array<Number, 3>> adjacent;

  explicit Arrays(std::size_t cells)
      : positions(kVertices * cells),
        values(kVertices * cells),
        normals(kVertices * cells),
        adjacent(kVertices * cells) {}

  void set(std::size_t k, const PlacedCell& cell, bool point_field, const Eigen::Vector4f& scale) {
    const Matrix34& p = cell.points;
    const Eigen::Vector3d g = point_field ? gradient(cell) : Eigen::Vector3d::Zero();
    std::array<Plane<Number>, 4> planes;
    Matrix34 outwards;
    for (int i = 0; i < 4; ++i) {
      planes[static_cast<std::size_t>(i)] = stored_plane<Number>(p, i, scale);
      outwards.col(i) = outward_normal(p, i);
    }
    const Number longest = std::max(stored<Number>(longest_edge(p), scale[3]),
                                    std::is_same_v<Number, float> ? Number(0) : Number(1));
    std::size_t at = kVertices * k;
    for (const std::array<int, 3>& face : mesh::kFaceVertices) {
      for (std::size_t corner = 0; corner < 3; ++corner, ++at) {
        const int i = face[corner];
        const auto& plane = planes[static_cast<std::size_t>(i)];
        const Eigen::Vector3f point = p.col(i).cast<float>();
        positions[at] = {point.x(), point.y(), point.z(), plane.constant};
        values[at] = {stored<Number>(cell.values[i], scale[0]), stored<Number>(g.x(), scale[1]),
                      stored<Number>(g.y(), scale[1]), stored<Number>(g.z(), scale[1])};
        normals[at] = {plane.normal[0], plane.normal[1], static_cast<Number>(corner), longest};
        // The edge from here to the next corner lies opposite the one before.
        const Eigen::Vector3d n = outwards.col(face[(corner + 2) % 3]);
        adjacent[at] = {stored<Number>(n.x(), scale[2]), stored<Number>(n.y(), scale[2]),
                        stored<Number>(n.z(), scale[2])};
      }
    }
  }
};

Table minimum_texture(const Context& context, Minimum minimum) {
  const auto n = static_cast<std::size_t>(kMinimumSize);
  std::vector<float> values(n * n * n);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t least = std::min({i % n, i / n % n, i / (n * n)});
    values[i] = static_cast<float>(least) / static_cast<float>(n - 1);
  }
  return {context,
          minimum == Minimum::texture8 ? Texel::r8 : Texel::r16,
          {kMinimumSize, kMinimumSize, kMinimumSize},
          values,
          true};
}

std::size_t cells_at_once(const GlPlan& plan) {
  constexpr std::size_t kMost = std::numeric_limits<int>::max() / kVertices;
  if (plan.memory == 0) return kMost;
  const std::size_t bytes = faces12_bytes(plan.layout);
  if (plan.memory < bytes) {
    throw base::UnavailableError(
        fmt::format("a cell takes {} bytes and {} are given: use --gpu-memory with more of them",
                    bytes, plan.memory));
  }
  return std::min(kMost, plan.memory / bytes);
}

}  // namespace

Faces12Cells::Faces12Cells(const Context& context, const Scene& scene, const Plan& plan,
                           const Normalization& normalization,
                           const std::vector<std::uint32_t>& drawn)
    : context_(context),
      scene_(scene),
      normalization_(normalization),
      plan_(plan.gl),
      needs_depth_(draws_opaque_surfaces(scene) || !scene.clip.empty() || !scene.opaque.empty() ||
                   scene.depth_cue || is_lit_medium(scene) || plan.sort == SortMethod::fragments),
      count_(drawn.size()),
      at_once_(cells_at_once(plan.gl)),
      arrays_(context) {
  if (plan_.layout == Layout::faces12_short) scale_ = short_scale(scene, normalization, drawn);
  if (plan_.minimum != Minimum::shader) minima_.emplace(minimum_texture(context, plan_.minimum));
  if (count_ > at_once_) {
    cells_ = drawn;
    return;
  }
  load(drawn);
  if (!sorts_cells(plan)) return;
  place_.resize(scene.mesh->cells.size());
  for (std::size_t k = 0; k < count_; ++k) place_[drawn[k]] = static_cast<std::uint32_t>(k);
}

void Faces12Cells::load(std::span<const std::uint32_t> cells) {
  arrays_ = VertexArrays(context_);
  if (plan_.layout == Layout::faces12) {
    upload<float>(cells);
  } else {
    upload<std::int16_t>(cells);
  }
}

template <class Number>
void Faces12Cells::upload(std::span<const std::uint32_t> cells) {
  Arrays<Number> arrays(cells.size());
  const bool point_field = scene_.field.location == mesh::Location::point;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, cells.size(), kGrain), [&](const auto& range) {
        for (std::size_t k = range.begin(); k != range.end(); ++k) {
          arrays.set(k, placed(scene_, normalization_, cells[k]), point_field, scale_);
        }
      });
  std::size_t bytes = arrays_.add(0, arrays.positions);
  bytes += arrays_.add(1, arrays.values);
  bytes += arrays_.add(2, arrays.normals);
  bytes += arrays_.add(3, arrays.adjacent);
  bytes_ = std::max(bytes_, bytes);
}

std::vector<std::string> Faces12Cells::switches() const {
  std::vector<std::string> names = {"FACES12"};
  if (needs_depth_) names.emplace_back("ENTRY_DEPTH");
  if (plan_.edge_fix) names.emplace_back("EDGE_FIX");
  if (plan_.minimum != Minimum::shader) names.emplace_back("MINIMUM_TEXTURE");
  if (plan_.interpolate_lengths) names.emplace_back("INTERPOLATED_LENGTHS");
  return names;
}

void Faces12Cells::set_uniforms(const Program& program) const {
  program.set("scale", scale_);
  if (scene_.modulation) {
    program.set("modulation", modulation_factor(scene_, normalization_));
  }
  program.set("minima", Units::kMinima);
}

void Faces12Cells::set_order(const std::vector<std::uint32_t>& cells) {
  if (count_ > at_once_) {
    cells_ = cells;
    return;
  }
  firsts_.resize(cells.size());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    firsts_[k] = static_cast<int>(kVertices * place_[cells[k]]);
  }
}

std::size_t Faces12Cells::parts() const {
  return std::max<std::size_t>(1, (count_ + at_once_ - 1) / at_once_);
}

void Faces12Cells::draw() {
  if (minima_) minima_->bind(Units::kMinima);
  if (count_ <= at_once_ && firsts_.empty()) {
    arrays_.draw(kVertices * count_);
  } else if (count_ <= at_once_) {
    arrays_.draw_runs(firsts_, static_cast<int>(kVertices));
  }
  for (std::size_t first = 0; first < cells_.size(); first += at_once_) {
    const std::size_t count = std::min(at_once_, cells_.size() - first);
    // What is still drawn from would be kept beside what takes its place.
    context_.gl().Finish();
    load(std::span(cells_).subspan(first, count));
    arrays_.draw(kVertices * count);
  }
}

}  // namespace tetraglass::project::gl
