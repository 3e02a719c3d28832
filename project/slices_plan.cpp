#include "project/slices_plan.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "base/errors.h"

namespace tetraglass::project {
namespace {

double diagonal(const mesh::RectilinearGrid& grid) {
  double longest = 0;
  for (int corner = 0; corner < 4; ++corner) {
    Eigen::Vector3d across;
    for (int k = 0; k < 3; ++k) {
      const double extent = grid.coordinates[static_cast<std::size_t>(k)].back();
      across[k] = k > 0 && (corner >> (k - 1) & 1) == 1 ? -extent : extent;
    }
    longest = std::max(longest, (grid.axes * across).norm());
  }
  return longest;
}

/// The smallest mean distance between planes of the grid.
double plane_distance(const mesh::RectilinearGrid& grid) {
  const Eigen::Matrix3d inverse = grid.axes.inverse();
  double smallest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double mean = grid.coordinates[k].back() / static_cast<double>(grid.size(k) - 1) /
                        inverse.row(static_cast<Eigen::Index>(k)).norm();
    if (k == 0 || mean < smallest) smallest = mean;
  }
  return smallest;
}

double plan_distance(const Scene& scene, const SlicesRequest& request, const SlicesPlan& plan) {
  if (request.slices && request.distance) {
    throw base::UsageError("--slices and --slice-distance say the same: give one of them");
  }
  const double across = diagonal(*scene.grid);
  if (request.slices) {
    if (*request.slices < 1 || *request.slices > kMostSlices) {
      throw base::UsageError(fmt::format("--slices must lie between 1 and {}", kMostSlices));
    }
    return across / *request.slices;
  }
  if (request.distance) {
    if (!(*request.distance >= across / kMostSlices && std::isfinite(*request.distance))) {
      throw base::UsageError(fmt::format(
          "--slice-distance must be at least {:.3g} here: {} slices across the grid's diagonal",
          across / kMostSlices, kMostSlices));
    }
    return *request.distance;
  }
  if (plan.stack == Stack::textures) return 0;
  return std::max(0.5 * plane_distance(*scene.grid), across / kMostSlices);
}

void check_classification(const Scene& scene, const SlicesPlan& plan) {
  if (plan.classify == Classify::pre && scene.mode != Mode::full) {
    throw base::UsageError(
        "--classify pre, colors interpolated, is for --mode full; use post or integrated for "
        "mode " +
        to_string(scene.mode));
  }
  if (plan.classify == Classify::post && scene.mode == Mode::iso) {
    throw base::UsageError(
        "--classify post looks at the middle of each slab alone and meets no isosurface: use "
        "--classify integrated");
  }
}

void plan_memory(const SlicesRequest& request, SlicesPlan& plan) {
  plan.compress = request.compress.value_or(false);
  plan.brick_bytes = request.brick_bytes.value_or(0);
  if (plan.compress && plan.stack != Stack::textures) {
    throw base::UsageError("--compress on needs --stack 2d: OpenGL compresses 2D textures only");
  }
  if (plan.compress && request.texels && plan.texels != TexelBits::bits8) {
    throw base::UsageError("--compress on has texels of 8 bits: leave out --texel-bits");
  }
  if (plan.compress) plan.texels = TexelBits::bits8;
  if (plan.brick_bytes > 0 && plan.stack == Stack::textures) {
    throw base::UsageError(
        "--brick is for --stack 3d and shells: 2D textures are small ones already");
  }
}

}  // namespace

SlicesPlan plan_slices(const Scene& scene, const SlicesRequest& request,
                       std::vector<std::string>& reasons) {
  SlicesPlan plan;
  plan.stack = request.stack.value_or(plan.stack);
  plan.filter = request.filter.value_or(plan.filter);
  plan.texels = request.texels.value_or(plan.texels);
  plan.classify = request.classify.value_or(plan.classify);
  plan.skip_empty = request.skip_empty.value_or(plan.skip_empty);
  plan.distance = plan_distance(scene, request, plan);
  check_classification(scene, plan);
  plan_memory(request, plan);
  const std::string where = plan.stack == Stack::textures ? "2D textures, planes of the grid"
                            : plan.stack == Stack::shells && !scene.camera.parallel
                                ? "a 3D texture, spheres about the eye"
                                : "a 3D texture, planes parallel to the image";
  reasons.push_back(plan.distance > 0
                        ? fmt::format("slices: {}, {:.6g} apart ({:.0f} across the diagonal)",
                                      where, plan.distance, diagonal(*scene.grid) / plan.distance)
                        : fmt::format("slices: {}, one for each", where));
  reasons.push_back(
      fmt::format("texels: {}, filter {}", to_string(plan.texels), to_string(plan.filter)) +
      (plan.compress ? ", compressed: not as they were" : ""));
  if (plan.brick_bytes > 0) {
    reasons.push_back(fmt::format(
        "bricks: textures of at most {} bytes, loaded for every frame, one after the other",
        plan.brick_bytes));
  }
  reasons.push_back(plan.classify == Classify::post
                        ? "classify: post, of the value in the middle of each slab"
                    : plan.classify == Classify::pre
                        ? "classify: pre, colors and opacities of the grid's points are "
                          "interpolated: not those of interpolated values"
                        : "classify: integrated, from front to back of each slab");
  return plan;
}

bool is_any_set(const SlicesRequest& request) {
  return request.stack || request.filter || request.texels || request.classify || request.slices ||
         request.distance || request.skip_empty || request.compress || request.brick_bytes;
}

std::string to_string(Stack stack) {
  switch (stack) {
    case Stack::planes:
      return "3d";
    case Stack::shells:
      return "shells";
    case Stack::textures:
      return "2d";
  }
  return "";
}

std::string to_string(Filter filter) {
  return filter == Filter::linear ? "linear" : "nearest";
}

std::string to_string(TexelBits texels) {
  switch (texels) {
    case TexelBits::bits8:
      return "8 bits";
    case TexelBits::bits12:
      return "12 bits";
    case TexelBits::bits16:
      return "16 bits";
    case TexelBits::floats:
      return "floats";
  }
  return "";
}

std::string to_string(Classify classify) {
  switch (classify) {
    case Classify::post:
      return "post";
    case Classify::pre:
      return "pre";
    case Classify::integrated:
      return "integrated";
  }
  return "";
}

}  // namespace tetraglass::project
