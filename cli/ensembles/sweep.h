// pintle sweep.
#pragma once

namespace CLI {
class App;
}

namespace pintle::cli {

void add_sweep(CLI::App& app, int& exit_code);

}  // namespace pintle::cli
