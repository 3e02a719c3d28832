#include "project/compare.h"

#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/mesh_input.h"
#include "apps/subcommands.h"
#include "project/image_file.h"

namespace tetraglass::apps {
namespace {

struct CompareArguments {
  std::string a;
  std::string b;
  std::string output;
  bool json = false;
};

void compare(const CompareArguments& arguments) {
  project::ReadImage a = project::read_image(arguments.a);
  project::ReadImage b = project::read_image(arguments.b);
  if (a.encoded != b.encoded) {
    // A .png holds less than the others do: compare what it holds.
    project::ReadImage& linear = a.encoded ? b : a;
    linear.image = project::encode(linear.image, {});
    for (float& value : linear.image.rgba) value = std::clamp(value, 0.0F, 1.0F);
    warn("one picture is a .png: the other is compared as a .png over black would hold it");
  }
  const project::Difference difference = project::compare(a.image, b.image);
  if (!arguments.output.empty()) {
    project::write_image(project::difference_image(a.image, b.image, difference), arguments.output);
  }
  if (arguments.json) {
    const nlohmann::ordered_json json = {
        {"max", difference.max},
        {"rms", difference.rms},
        {"psnr_db", difference.psnr_db},  // null where the pictures are equal
        {"pixels", difference.pixels},
        {"worst", {{"x", difference.worst_x}, {"y", difference.worst_y}}}};
    fmt::print("{}\n", json.dump());
  } else {
    fmt::print("largest difference {:.6g} at ({}, {}), RMS {:.6g}, PSNR {:.2f} dB, {} pixels\n",
               difference.max, difference.worst_x, difference.worst_y, difference.rms,
               difference.psnr_db, difference.pixels);
  }
}

}  // namespace

void add_compare(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("compare", "Largest and RMS difference and PSNR of two pictures");
  auto arguments = std::make_shared<CompareArguments>();
  app->footer("usage: tetraglass compare A B [-o diff.png] [--json]");
  app->add_option("A", arguments->a, "A picture: .png, .exr or .npy")
      ->type_name("FILE")
      ->required();
  app->add_option("B", arguments->b, "A picture of the same size")->type_name("FILE")->required();
  app->add_option("-o,--output", arguments->output, "A picture of the difference, scaled to white")
      ->type_name("FILE");
  app->add_flag("--json", arguments->json,
                "Print JSON (psnr_db is null where the pictures are equal)");
  app->callback([arguments] { compare(*arguments); });
}

}  // namespace tetraglass::apps
