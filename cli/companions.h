// Verbs that are programs of their own beside pintle, because the libraries that they alone need would triple the time that pintle
// takes to start: pintle-sweep has HDF5 and MPI, pintle-studio a web server, pintle-pictures a rasteriser.
#pragma once

namespace CLI {
class App;
}

namespace pintle::cli {

inline constexpr const char* kSweepDescription = "Run a model with many sets of values, in a grid or random; peaks of every joint force";
inline constexpr const char* kStudioDescription = "Draw, play and read mechanisms in the browser, with this folder's models";
inline constexpr const char* kFilmDescription = "Film a run as GIF or WebM, or draw one instant of it as SVG or PNG";

/// Puts the program that does what the command line asks for, where it is not this one, in the place of this process: from
/// beside this program or from the path. Plots as PNG are pictures too. Returns where there is none, or none is to be found.
void become_companion(int argc, char** argv);

/// The verbs for the list of verbs; called when their programs are not found.
void add_companions(CLI::App& app, int& exit_code);

}  // namespace pintle::cli
