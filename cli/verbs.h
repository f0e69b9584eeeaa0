// One function per verb: it declares the verb's options and what to do when the verb is chosen. The verb's result is
// stored in `exit_code`; errors are exceptions, which main() turns into messages and exit codes.
#pragma once

#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace pintle::cli {

void add_run(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_compare(CLI::App& app, int& exit_code);
void add_life(CLI::App& app, int& exit_code);
void add_stiffen(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
/// Converts a picture to the bytes of a PNG file.
using WritePng = std::function<std::string(const std::string& svg, double dots_per_inch)>;
/// Without `write_png` the verb rejects PNG.
void add_plot(CLI::App& app, int& exit_code, const WritePng& write_png);
inline void add_plot(CLI::App& app, int& exit_code) { add_plot(app, exit_code, {}); }
void add_solvers(CLI::App& app, int& exit_code);
void add_convert(CLI::App& app, int& exit_code);
void add_fmt(CLI::App& app, int& exit_code);
void add_schema(CLI::App& app, int& exit_code);
void add_version(CLI::App& app, int& exit_code);

}  // namespace pintle::cli
