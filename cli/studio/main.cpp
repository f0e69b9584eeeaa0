// pintle-studio: the program with only the verb studio.
#include "cli/program.h"
#include "cli/studio/studio.h"

int main(int argc, char** argv) { return pintle::cli::run_program(argc, argv, {pintle::cli::add_studio}); }
