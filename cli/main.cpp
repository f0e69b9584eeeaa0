// The program and its verbs. Some verbs are separate programs next to it.
#include "cli/companions.h"
#include "cli/program.h"
#include "cli/verbs.h"

int main(int argc, char** argv) {
  using namespace pintle::cli;
  become_companion(argc, argv);
  return run_program(argc, argv, {add_run, add_check, add_compare, add_stiffen, add_life, add_plot, add_report, add_solvers, add_companions, add_convert, add_fmt, add_schema, add_version});
}
