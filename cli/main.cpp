// The program and its verbs. `sweep` is a program of its own beside it.
#include "cli/program.h"
#include "cli/sweep_program.h"
#include "cli/verbs.h"

int main(int argc, char** argv) {
  using namespace pintle::cli;
  if (wants_sweep(argc, argv)) become_sweep_program(argv);
  return run_program(argc, argv, {add_run, add_check, add_compare, add_stiffen, add_plot, add_report, add_solvers, add_sweep_program, add_convert, add_fmt, add_schema, add_version});
}
