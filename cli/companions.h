// Verbs that are separate programs next to pintle, because the libraries that only they need would triple the time pintle takes
// to start: pintle-sweep has HDF5 and MPI, pintle-studio a web server, pintle-pictures a rasteriser.
#pragma once

namespace CLI {
class App;
}

namespace pintle::cli {

inline constexpr const char* kSweepDescription = "Run a model with many sets of values, in a grid or random; peaks of every joint force";
inline constexpr const char* kStudioDescription = "Draw, play and read mechanisms in the browser, with this folder's models";
inline constexpr const char* kFilmDescription = "Film a run as GIF or WebM, or draw one instant of it as SVG or PNG";

/// Replaces this process by the program for the command line's verb, if that is a different program, found next to
/// this program or on the path. Plots as PNG also count as pictures. Returns if there is no such program or it is not found.
void become_companion(int argc, char** argv);

/// Adds these verbs to the list of verbs; called if their programs are not found.
void add_companions(CLI::App& app, int& exit_code);

}  // namespace pintle::cli
