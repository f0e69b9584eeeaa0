// The program and its verbs. Some are programs of their own beside it.
#include "cli/program.h"
#include "cli/sister_programs.h"
#include "cli/verbs.h"

int main(int argc, char** argv) {
  using namespace pintle::cli;
  if (const char* sister = sister_for(argc, argv)) become(sister, argv);
  return run_program(argc, argv, {add_run, add_check, add_compare, add_stiffen, add_plot, add_report, add_solvers, add_sister_programs, add_convert, add_fmt, add_schema, add_version});
}
