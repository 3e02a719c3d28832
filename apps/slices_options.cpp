#include "apps/slices_options.h"

#include <CLI/CLI.hpp>

#include "apps/options.h"

namespace tetraglass::apps {

void add_slices_options(CLI::App& app, SlicesArguments& a) {
  app.add_option("--slices", a.slices,
                 "Slices across the grid's diagonal, for --projector slices. Default: two for each "
                 "of its points (--stack 2d: one at each plane)");
  app.add_option("--slice-distance", a.distance, "The same as a distance, in the grid's units");
  app.add_option("--stack", a.stack,
                 "3d (default; planes parallel to the image) | shells (spheres about the eye) | 2d "
                 "(the grid's own planes as 2D textures)");
  app.add_option("--filter", a.filter, "linear (default) | nearest, between the grid's points");
  app.add_option("--texel-bits", a.texel_bits, "8 | 12 | 16 | float (default), of a grid's value");
  app.add_option("--classify", a.classify,
                 "integrated (default; from front to back of each slab) | post (its middle) | pre "
                 "(colors are interpolated, mode full)");
  app.add_option(
      "--skip-empty", a.skip_empty,
      "on (default) | off: whether blocks of the grid that show nothing are passed over");
  app.add_option("--compress", a.compress,
                 "on | off (default): whether 2D textures are compressed (S3TC), for --stack 2d");
  app.add_option("--brick", a.brick,
                 "Most bytes of a texture: larger grids are drawn brick by brick, for --stack 3d "
                 "and shells. Default: one texture, where OpenGL can hold it");
}

project::SlicesRequest make_slices_request(const SlicesArguments& a) {
  using project::Classify;
  using project::Filter;
  using project::Stack;
  using project::TexelBits;
  project::SlicesRequest request;
  if (!a.slices.empty()) request.slices = parse_count(a.slices, "--slices", 1);
  if (!a.distance.empty()) request.distance = parse_number(a.distance, "--slice-distance");
  if (!a.stack.empty()) {
    request.stack = parse_choice<Stack>(
        a.stack, "--stack",
        {{"3d", Stack::planes}, {"shells", Stack::shells}, {"2d", Stack::textures}});
  }
  if (!a.filter.empty()) {
    request.filter = parse_choice<Filter>(
        a.filter, "--filter", {{"linear", Filter::linear}, {"nearest", Filter::nearest}});
  }
  if (!a.texel_bits.empty()) {
    request.texels = parse_choice<TexelBits>(a.texel_bits, "--texel-bits",
                                             {{"8", TexelBits::bits8},
                                              {"12", TexelBits::bits12},
                                              {"16", TexelBits::bits16},
                                              {"float", TexelBits::floats}});
  }
  if (!a.classify.empty()) {
    request.classify = parse_choice<Classify>(
        a.classify, "--classify",
        {{"post", Classify::post}, {"pre", Classify::pre}, {"integrated", Classify::integrated}});
  }
  if (!a.skip_empty.empty()) {
    request.skip_empty =
        parse_choice<bool>(a.skip_empty, "--skip-empty", {{"on", true}, {"off", false}});
  }
  if (!a.compress.empty()) {
    request.compress = parse_choice<bool>(a.compress, "--compress", {{"on", true}, {"off", false}});
  }
  if (!a.brick.empty()) {
    request.brick_bytes = static_cast<std::size_t>(parse_count(a.brick, "--brick", 1));
  }
  return request;
}

}  // namespace tetraglass::apps
