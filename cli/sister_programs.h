// Verbs that need large libraries are programs of their own, so that all others start without them.
#pragma once

namespace CLI {
class App;
}

namespace pintle::cli {

/// The program that does what the command line asks for, where this one does not: pintle-sweep (HDF5, MPI) for sweeps,
/// pintle-pictures (a rasteriser) for films and for plots as PNG. Else nullptr.
const char* sister_for(int argc, const char* const* argv);

/// Gives this process up to a program beside it or on the path. Returns only where there is none.
void become(const char* program, char** argv);

/// The verbs `sweep` and `film`, for the help; chosen, they say that their program is missing.
void add_sister_programs(CLI::App& app, int& exit_code);

}  // namespace pintle::cli
