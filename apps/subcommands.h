#pragma once

namespace CLI {
class App;
}

namespace tetraglass::apps {

/// Each adds its subcommand to the program: its options, and as callback the work itself, which
/// throws the exceptions of base/errors.h.
void add_render(CLI::App& program);
void add_import(CLI::App& program);
void add_info(CLI::App& program);
void add_sample(CLI::App& program);
void add_compare(CLI::App& program);
void add_order(CLI::App& program);
void add_table(CLI::App& program);
void add_accuracy(CLI::App& program);
void add_view(CLI::App& program);

}  // namespace tetraglass::apps
