// pintle-sweep: the program with only the verb sweep.
#include "cli/ensembles/sweep.h"
#include "cli/program.h"

int main(int argc, char** argv) { return pintle::cli::run_program(argc, argv, {pintle::cli::add_sweep}); }
