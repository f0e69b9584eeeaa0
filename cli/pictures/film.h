// pintle film.
#pragma once

namespace CLI {
class App;
}

namespace pintle::cli {

void add_film(CLI::App& app, int& exit_code);

}  // namespace pintle::cli
