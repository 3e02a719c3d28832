#include <CLI/CLI.hpp>

#include "apps/render_arguments.h"

namespace tetraglass::apps {

void add_figure_options(CLI::App* app, FigureArguments& a) {
  app->add_flag("--outline", a.outline, "The edges of the box of the cells, at their depth");
  app->add_flag("--axes", a.axes, "Axes with numbers along three edges of that box");
  app->add_flag("--legend", a.legend, "What the colors stand for, beside the picture");
  app->add_option("--legend-title", a.legend_title, "Default: the field's name");
  app->add_option("--title", a.title, "A line above the picture");
  app->add_option("--surface", a.surfaces,
                  ".stl, .obj, .off or .ply: an opaque surface among the volume; repeatable")
      ->type_name("FILE")
      ->take_all()
      ->expected(1);
  app->add_option("--surface-color", a.surface_color, "Linear R,G,B of all surfaces");
}

}  // namespace tetraglass::apps
