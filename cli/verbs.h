// One function per verb: it declares the verb's options, and what to do when the verb is chosen. The verb's answer goes
// to `exit_code`; errors leave as exceptions, which main() turns into messages and exit codes.
#pragma once

namespace CLI {
class App;
}

namespace pintle::cli {

void add_run(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_compare(CLI::App& app, int& exit_code);
void add_stiffen(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_plot(CLI::App& app, int& exit_code);
void add_solvers(CLI::App& app, int& exit_code);
void add_convert(CLI::App& app, int& exit_code);
void add_fmt(CLI::App& app, int& exit_code);
void add_schema(CLI::App& app, int& exit_code);
void add_version(CLI::App& app, int& exit_code);

}  // namespace pintle::cli
