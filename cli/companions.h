// Verbs that are programs of their own beside pintle, because the libraries that they alone need would triple the time that pintle
// takes to start: pintle-sweep has HDF5 and MPI, pintle-studio has a web server.
#pragma once

namespace CLI {
class App;
}

namespace pintle::cli {

inline constexpr const char* kSweepDescription = "Run a model with many sets of values, in a grid or by chance; peaks of every joint force";

/// Puts the program of the verb, if it has one, in the place of this process: from beside this program or from the path. Returns
/// if the verb has no program, or there is none to be found.
void become_companion(int argc, char** argv);

/// The verbs for the list of verbs; called when their programs are not found.
void add_sweep_program(CLI::App& app, int& exit_code);
void add_studio_program(CLI::App& app, int& exit_code);

}  // namespace pintle::cli
