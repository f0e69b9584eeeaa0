// The verb studio.
#pragma once

namespace CLI {
class App;
}

namespace pintle::cli {

void add_studio(CLI::App& app, int& exit_code);

}  // namespace pintle::cli
