// pintle-bench: the accuracy and the cost of the forces, in Pintle and in other programs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fstream>

#include "base/freed_memory.h"
#include "bench/commands.h"
#include "bench/scaling.h"

namespace pintle::bench {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string json_file;
  CurveOptions curves;
  std::vector<std::string> truth_problems{"a02_40", "a02_400"};
  double truth_tolerance = 1e-6;
  std::string record_as;
  PeerOptions peers;
  StiffnessOptions stiffness;
  ForceOptions forces;
  ScaleOptions scale;
  std::vector<int> loops{40, 400, 4000, 40000};
  int scaling_rounds = 7;
  SweepOptions sweeps;
  SpaceOptions space;
  RealJointOptions joints;
  BatteryOptions battery;
  std::string stability = std::string(PINTLE_SOURCE_DIR) + "/docs/theory/stability.svg";
  std::string micro_filter = ".";
  double micro_time = 0.2;
};

void add_curves(CLI::App& app, Options& o, Json& out) {
  CLI::App* verb = app.add_subcommand("curves", "work-precision of all programs on every problem");
  verb->add_option("--problems", o.curves.problems, "names (default: all)")->delimiter(',');
  verb->add_option("--rounds", o.curves.rounds, "rounds; every method runs once in each")->capture_default_str();
  verb->add_option("--cap", o.curves.cap, "time limit of a run in seconds")->capture_default_str();
  verb->add_flag("--quick", o.curves.quick, "about a minute: fewer problems and rounds, a smaller cap");
  verb->add_flag("--details", o.curves.details, "print every run");
  verb->add_option("--write", o.curves.folder, "folder for the pictures and their page, README.md");
  verb->callback([&] { out["curves"] = measure_curves(o.curves); });
}

void add_truths(CLI::App& app, Options& o) {
  CLI::App* verb = app.add_subcommand("truths", "recompute bench/truths, the reference solutions of large mechanisms for the curves; takes an hour");
  verb->add_option("--problems", o.truth_problems)->delimiter(',')->capture_default_str();
  verb->add_option("--tolerance", o.truth_tolerance)->capture_default_str();
  verb->callback([&] { store_truths(o.truth_problems, o.truth_tolerance); });
}

void add_instructions(CLI::App& app, Options& o, Json& out) {
  CLI::App* verb = app.add_subcommand("instructions", "instruction counts of fixed commands, compared with the last release");
  verb->add_option("--record", o.record_as, "the version to write to bench/instructions.json");
  verb->callback([&] { out["instructions"] = count_instructions(o.record_as); });
}

void add_stability(CLI::App& app, Options& o, Json& out) {
  CLI::App* verb = app.add_subcommand("stability", "spectral radius of a step across taut joints: the picture of theory/time section 4.1");
  verb->add_option("--write", o.stability, "the picture")->capture_default_str();
  verb->callback([&] { out["stability"] = study_stability(o.stability); });
}

void add_peers(CLI::App& app, Options& o, Json& out) {
  CLI::App* verb = app.add_subcommand("peers", "one turn of the four-bar: work-precision against SUNDIALS");
  verb->add_option("--repetitions", o.peers.repetitions, "rounds; every method runs once in each")->capture_default_str();
  verb->callback([&] { out["peers"] = compare_peers(o.peers); });
}

void add_stiffness(CLI::App& app, Options& o, Json& out) {
  CLI::App* verb = app.add_subcommand("stiffness", "the four-bar's steps for joints from soft to very stiff");
  verb->add_option("--stiffness", o.stiffness.stiffness, "N/m")->delimiter(',');
  verb->add_option("--damping", o.stiffness.damping, "N*s/m")->delimiter(',');
  verb->add_option("--tolerance", o.stiffness.tolerance, "relative to the peak force")->capture_default_str();
  verb->add_option("--repetitions", o.stiffness.repetitions)->capture_default_str();
  verb->callback([&] { out["stiffness"] = study_stiffness(o.stiffness); });
}

void add_forces(CLI::App& app, Options& o, Json& out) {
  CLI::App* verb = app.add_subcommand("forces", "true and stated force errors of every model of the collection");
  verb->add_option("--models", o.forces.models, "names without .toml (default: all)")->delimiter(',');
  verb->add_option("--tolerances", o.forces.tolerances)->delimiter(',');
  verb->add_option("--cap", o.forces.cap, "time limit of a run in seconds")->capture_default_str();
  verb->add_option("--negligible", o.forces.negligible,
                   "share of the largest force that any joint is measured by at least")
      ->capture_default_str();
  verb->add_flag("--joints", o.forces.every_joint, "print every joint, not only the worst of each model");
  verb->callback([&] { out["forces"] = study_forces(o.forces); });
}

void add_scale(CLI::App& app, Options& o, Json& out) {
  CLI::App* verb = app.add_subcommand("scale", "time and memory against the number of bodies");
  verb->add_option("--shapes", o.scale.shapes, "chain, tree, ladder, grid")->delimiter(',')->check(CLI::IsMember({"chain", "tree", "ladder", "grid"}))->capture_default_str();
  verb->add_option("--sizes", o.scale.sizes, "bars; of a ladder loops")->delimiter(',')->capture_default_str();
  verb->add_option("--grid-sizes", o.scale.grid_sizes, "parallelograms along an edge")->delimiter(',')->capture_default_str();
  verb->add_option("--steps", o.scale.steps, "steps timed")->capture_default_str();
  verb->add_flag("--verbose", o.scale.verbose, "report each finished model");
  verb->callback([&] { out["scale"] = study_scale(o.scale); });
}

void add_scaling(CLI::App& app, Options& o, Json& out) {
  CLI::App* verb = app.add_subcommand("scaling", "time of N four-bars against N, and its exponent, as in the curves");
  verb->add_option("--sizes", o.loops, "loops")->delimiter(',')->check(CLI::PositiveNumber)->expected(2, 100)->capture_default_str();
  verb->add_option("--rounds", o.scaling_rounds, "runs of each")->check(CLI::PositiveNumber)->capture_default_str();
  verb->callback([&] {
    const Scaling scaling = measure_scaling(o.loops, o.scaling_rounds);
    const ResultTable table = scaling.table();
    table.print();
    fmt::print("Exponent of time over N: {:.3f}\n", scaling.exponent());
    out["scaling"] = table.json();
    out["exponent"] = scaling.exponent();
  });
}

void add_sweeps(CLI::App& app, Options& o, Json& out) {
  CLI::App* verb = app.add_subcommand("sweeps", "variants of a model per second, in batches and one by one");
  verb->add_option("--models", o.sweeps.models, "names without .toml")->delimiter(',')->capture_default_str();
  verb->add_option("--tolerances", o.sweeps.tolerances)->delimiter(',')->capture_default_str();
  verb->add_option("--variants", o.sweeps.variants)->capture_default_str();
  verb->add_option("--rounds", o.sweeps.rounds, "rounds; both ways in each")->capture_default_str();
  verb->callback([&] { out["sweeps"] = study_sweeps(o.sweeps); });
}

void add_space(CLI::App& app, Options& o, Json& out) {
  CLI::App* verb = app.add_subcommand("space", "Bricard's hinges, and the four-bar in space beside that of the plane");
  verb->add_option("--tolerance", o.space.tolerance)->check(CLI::PositiveNumber)->capture_default_str();
  verb->add_option("--rounds", o.space.rounds, "rounds; every mechanism has its turn in each")->check(CLI::PositiveNumber)->capture_default_str();
  verb->callback([&] { out["space"] = study_space(o.space); });
}

void add_joints(CLI::App& app, Options& o, Json& out) {
  CLI::App* verb = app.add_subcommand("joints", "what clearance and friction cost, beside the mechanism without them and beside SUNDIALS' BDF");
  verb->add_option("--tolerances", o.joints.tolerances)->delimiter(',')->capture_default_str();
  verb->add_option("--rounds", o.joints.rounds, "rounds; each mechanism with and without in each")->check(CLI::PositiveNumber)->capture_default_str();
  verb->add_option("--cap", o.joints.cap, "time limit of a run of the peer in seconds")->capture_default_str();
  verb->callback([&] { out["joints"] = study_real_joints(o.joints); });
}

void add_battery(CLI::App& app, Options& o, Json& out) {
  CLI::App* verb = app.add_subcommand("battery", "random mechanisms of many kinds: true and stated force errors, exit codes");
  verb->add_option("--count", o.battery.count, "mechanisms")->check(CLI::PositiveNumber)->capture_default_str();
  verb->add_option("--first", o.battery.first, "number of the first one")->check(CLI::NonNegativeNumber)->capture_default_str();
  verb->add_option("--seed", o.battery.seed)->capture_default_str();
  verb->add_option("--kind", o.battery.kinds, "kinds (default: all); one kind and --first make a single model again")->delimiter(',');
  verb->add_option("--time", o.battery.time, "begin no mechanism after so many seconds");
  verb->add_option("--truth", o.battery.truth, "tolerance of the runs that the others are compared with")->capture_default_str();
  verb->add_option("--cap", o.battery.cap, "processor time limit of a run in seconds")->capture_default_str();
  verb->add_option("--out", o.battery.folder, "folder for the tables, every run, and the models that broke a promise");
  verb->add_flag("--verbose", o.battery.verbose, "name each mechanism when it begins");
  verb->callback([&] { out["battery"] = run_battery(o.battery); });
}

void add_micro(CLI::App& app, Options& o) {
  CLI::App* verb = app.add_subcommand("micro", "laws, joints, systems, factorisation and single steps");
  verb->add_option("--filter", o.micro_filter, "a regular expression")->capture_default_str();
  verb->add_option("--min-time", o.micro_time, "seconds for each")->capture_default_str();
  verb->callback([&] { run_micro(o.micro_filter, o.micro_time, o.json_file); });
}

// Everything in a few minutes.
Json run_short() {
  Json out;
  run_micro(".", 0.02, "");
  PeerOptions peers;
  peers.repetitions = 3;
  peers.all_methods = false;
  out["peers"] = compare_peers(peers);
  StiffnessOptions stiffness;
  stiffness.stiffness = {1e6, 1e8, 1e10, 1e12};
  stiffness.repetitions = 3;
  out["stiffness"] = study_stiffness(stiffness);
  ForceOptions forces;
  forces.tolerances = {1e-3, 1e-5};
  forces.cap = 5;
  out["forces"] = study_forces(forces);
  return out;
}

int run_program(int argc, char** argv) {
  CLI::App app("Benchmarks of Pintle. Without a sub-command: the curves.", "pintle-bench");
  Options options;
  Json out;
  app.add_option("--json", options.json_file, "also write the tables to this file");
  app.fallthrough();
  app.require_subcommand(0, 1);
  add_curves(app, options, out);
  add_truths(app, options);
  add_instructions(app, options, out);
  add_stability(app, options, out);
  add_peers(app, options, out);
  add_stiffness(app, options, out);
  add_forces(app, options, out);
  add_scale(app, options, out);
  add_scaling(app, options, out);
  add_sweeps(app, options, out);
  add_space(app, options, out);
  add_joints(app, options, out);
  add_battery(app, options, out);
  add_micro(app, options);
  app.add_subcommand("constraints", "the four-bar by penalties and augmented Lagrangian: the table of theory/penalty")->callback([&] { out["constraints"] = study_constraints(); });
  app.add_subcommand("short", "a short version of peers, stiffness, forces and micro")->callback([&] { out = run_short(); });
  CLI11_PARSE(app, argc, argv);
  if (app.get_subcommands().empty()) out["curves"] = measure_curves(options.curves);
  if (!options.json_file.empty() && !out.empty()) {
    std::ofstream file(options.json_file);
    file << out.dump(1) << '\n';
    if (!file.flush()) throw std::runtime_error("cannot write " + options.json_file);
  }
  return 0;
}

}  // namespace
}  // namespace pintle::bench

int main(int argc, char** argv) {
  pintle::keep_freed_memory();
  try {
    return pintle::bench::run_program(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "pintle-bench: {}\n", error.what());
    return 1;
  }
}
