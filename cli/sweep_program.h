// pintle sweep is the program pintle-sweep: it alone carries HDF5 and MPI, which would triple the time that pintle takes to start.
#pragma once

namespace CLI {
class App;
}

namespace pintle::cli {

inline constexpr const char* kSweepDescription = "Run a model with many sets of values, in a grid or by chance; peaks of every joint force";

bool wants_sweep(int argc, char** argv);

/// Puts pintle-sweep, from beside this program or from the path, in the place of this process. Returns only if there is none.
void become_sweep_program(char** argv);

/// The verb for the list of verbs; called when there is no pintle-sweep.
void add_sweep_program(CLI::App& app, int& exit_code);

}  // namespace pintle::cli
