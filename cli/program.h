// The framework common to all of Pintle's programs: command line, messages, exit codes.
#pragma once

#include <initializer_list>

namespace CLI {
class App;
}

namespace pintle::cli {

using AddVerb = void (*)(CLI::App& app, int& exit_code);

/// Parses the command line, calls the chosen verb, and turns its exceptions into messages and exit codes.
int run_program(int argc, char** argv, std::initializer_list<AddVerb> verbs);

}  // namespace pintle::cli
