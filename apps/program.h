#pragma once

/// The command line `tetraglass`: one function per subcommand, each in a file of its own.
namespace tetraglass::apps {

/// Runs the program and returns its exit status: 0 done; 1 it could not be done (one line on
/// stderr); 2 wrong usage.
int run(int argc, char** argv);

}  // namespace tetraglass::apps
