// One turn of the four-bar: Pintle beside SUNDIALS, by the error of the joint forces that each method ends up with.
#include <arkode/arkode_arkstep.h>
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "bench/commands.h"
#include "bench/pintle_methods.h"
#include "bench/result_table.h"
#include "bench/stopwatch.h"
#include "bench/work_precision.h"
#include "pintle/simulate.h"

namespace pintle::bench {
namespace {

constexpr int kOutputs = 200;
constexpr double kReferenceTolerance = 1e-11;
constexpr double kTightExplicit = 1e-13;
constexpr double kAsked = 1e-5;
const std::string kOurs = "Pintle", kPeers = "SUNDIALS", kWholeRun = "Pintle, whole run";

std::vector<double> decades(int from, int to, int per_decade = 1) {
  std::vector<double> ladder;
  for (int i = from * per_decade; i >= to * per_decade; --i)
    ladder.push_back(std::pow(10.0, static_cast<double>(i) / per_decade));
  return ladder;
}

// World forces of the joints from the columns of a run, the first row (the start) left out.
ForceSamples samples_of(const Trajectory& run, const System& system) {
  ForceSamples samples(system);
  std::vector<int> columns;
  for (const LoadSummary& joint : run.joints) {
    const std::string prefix = "joint." + joint.name + ".on_" + joint.second_body + ".";
    columns.push_back(run.column(prefix + "fx[world]"));
    columns.push_back(run.column(prefix + "fy[world]"));
  }
  for (std::size_t row = 1; row < run.n_rows(); ++row) {
    std::vector<double> loads;
    for (std::size_t i = 0; i < columns.size(); i += 2)
      loads.insert(loads.end(), {run.at(row, columns[i]), run.at(row, columns[i + 1]), 0});
    samples.add_loads(loads);
  }
  return samples;
}

MethodRun whole_run(const Model& model, const System& system, double tolerance) {
  Model asked = model;
  asked.simulate.tolerance = tolerance;
  asked.simulate.output_step = model.simulate.duration / kOutputs;
  const Stopwatch watch;
  const Trajectory run = simulate(asked);
  const double seconds = watch.seconds();
  return {run.outcome == Outcome::kCompleted || run.outcome == Outcome::kToleranceNotMet, seconds,
          static_cast<double>(run.counters.steps), static_cast<double>(run.counters.evaluations),
          samples_of(run, system)};
}

std::vector<Contestant> our_methods(const ReadyModel& ready, const Problem& problem) {
  std::vector<Contestant> list;
  for (const int stages : {3, 5})
    list.push_back({fmt::format("Pintle, order {}", 2 * stages - 1), kOurs,
                    [&problem, stages](double tolerance) {
                      PintleRun run = run_radau(problem, stages, tolerance);
                      return MethodRun{run.completed, run.seconds, static_cast<double>(run.counters.steps),
                                       static_cast<double>(run.counters.evaluations), std::move(run.samples)};
                    },
                    stages == 3 ? decades(-2, -7, 2) : decades(-3, -10)});
  list.push_back({kWholeRun, "Pintle, start to report",
                  [&ready](double tolerance) { return whole_run(ready.model, ready.system, tolerance); },
                  decades(-2, -8)});
  return list;
}

PeerMethod runge_kutta(const char* name, Family family, int table, Weights weights) {
  PeerMethod m;
  m.name = name;
  m.code.family = family;
  m.code.table = table;
  m.weights = weights;
  m.stop_at_outputs = true;
  return m;
}

PeerMethod multistep(const char* name, Family family, Weights weights) {
  PeerMethod m;
  m.name = name;
  m.code.family = family;
  m.weights = weights;
  return m;
}

PeerMethod bdf(const char* name, int max_order, Weights weights) {
  PeerMethod m = multistep(name, Family::kBdf, weights);
  m.code.max_order = max_order;
  return m;
}

using PeerLadders = std::vector<std::pair<PeerMethod, std::vector<double>>>;

PeerLadders peer_ladders(bool all) {
  const auto explicit_rk = Family::kExplicitRungeKutta, implicit_rk = Family::kImplicitRungeKutta;
  const auto force = Weights::kForce, plain = Weights::kPlain;
  PeerLadders list{
      {bdf("CVODE BDF, dense, plain weights", 5, plain), decades(-5, -11, 2)},
      {bdf("CVODE BDF, dense, order <= 2, force weights", 2, force), decades(0, -4, 2)},
      {multistep("CVODE Adams, force weights", Family::kAdams, force), decades(-2, -6)},
      {runge_kutta("ARKODE ERK 5 (Cash-Karp), force weights", explicit_rk, ARKODE_CASH_KARP_6_4_5, force),
       decades(-2, -6)},
      {runge_kutta("ARKODE ESDIRK 4 (6 stages), force weights", implicit_rk, ARKODE_ESDIRK436L2SA_6_3_4, force),
       decades(-2, -6)},
  };
  if (!all) return list;
  PeerMethod limited = bdf("CVODE BDF, dense, stability limit, plain weights", 5, plain);
  limited.code.limit_unstable = true;
  PeerMethod sparse_bdf = bdf("CVODE BDF, KLU, plain weights", 5, plain);
  PeerMethod sparse_rk =
      runge_kutta("ARKODE ESDIRK 5 (7 stages), KLU", implicit_rk, ARKODE_ESDIRK547L2SA2_7_4_5, force);
  sparse_bdf.code.solver = sparse_rk.code.solver = LinearSolver::kKlu;
  const PeerLadders more{
      {sparse_bdf, decades(-6, -11)},
      {limited, decades(-6, -11)},
      {bdf("CVODE BDF, dense, force weights", 5, force), decades(-3, -8)},
      {bdf("CVODE BDF, dense, order <= 2, plain weights", 2, plain), decades(-5, -9)},
      {bdf("CVODE BDF, dense, order <= 3, force weights", 3, force), decades(0, -6)},
      {multistep("CVODE Adams, plain weights", Family::kAdams, plain), decades(-6, -10)},
      {runge_kutta("ARKODE ERK 5 (Dormand-Prince), force weights", explicit_rk, ARKODE_DORMAND_PRINCE_7_4_5, force),
       decades(-2, -6)},
      {runge_kutta("ARKODE ERK 5 (Dormand-Prince), plain weights", explicit_rk, ARKODE_DORMAND_PRINCE_7_4_5, plain),
       decades(-5, -8)},
      {runge_kutta("ARKODE ERK 6 (Verner), force weights", explicit_rk, ARKODE_VERNER_8_5_6, force), decades(-4, -7)},
      {runge_kutta("ARKODE ERK 8 (Fehlberg), force weights", explicit_rk, ARKODE_FEHLBERG_13_7_8, force),
       decades(-3, -6)},
      {sparse_rk, decades(-2, -6)},
      {runge_kutta("ARKODE ESDIRK 5 (7 stages), plain weights", implicit_rk, ARKODE_ESDIRK547L2SA2_7_4_5, plain),
       decades(-5, -8)},
      {runge_kutta("ARKODE DIRK 5 (8 stages), force weights", implicit_rk, ARKODE_ARK548L2SA_DIRK_8_4_5, force),
       decades(-2, -6)},
  };
  list.insert(list.end(), more.begin(), more.end());
  return list;
}

std::vector<Contestant> peer_methods(const Problem& problem, bool all) {
  std::vector<Contestant> list;
  for (auto& [method, ladder] : peer_ladders(all))
    list.push_back({method.name, kPeers,
                    [&problem, peer = method](double tolerance) {
                      PeerRun run = run_sundials(peer, problem, tolerance);
                      return MethodRun{run.completed, run.seconds, static_cast<double>(run.steps),
                                       static_cast<double>(run.evaluations), std::move(run.samples)};
                    },
                    ladder});
  return list;
}

// What a user pays for an error, here and there.
ResultTable price_list(const WorkPrecision& work) {
  ResultTable table("Time for a given joint-force error", {{"error", "error"},
                                                           {"best of SUNDIALS", "peer", true},
                                                           {"ms", "peer_milliseconds"},
                                                           {"best of Pintle", "ours", true},
                                                           {"ms ", "our_milliseconds"},
                                                           {"ratio", "ratio"},
                                                           {"whole run, ms", "whole_run_milliseconds"},
                                                           {"ratio ", "whole_run_ratio"}});
  for (const double error : {1e-3, 1e-4, 1e-5}) {
    const int peer = work.best_for(kPeers, error), ours = work.best_for(kOurs, error),
              whole = work.best_for(kWholeRun, error);
    const auto time = [&](int c) { return c < 0 ? NAN : 1e3 * work.time_for(static_cast<std::size_t>(c), error); };
    const auto name = [&](int c) { return text(c < 0 ? "-" : work.contestant(static_cast<std::size_t>(c)).name); };
    table.add_row({number(error, "{:.0e}"), name(peer), number(time(peer), "{:.2f}"), name(ours),
                   number(time(ours), "{:.3f}"), number(time(peer) / time(ours), "{:.0f}"),
                   number(time(whole), "{:.3f}"), number(time(peer) / time(whole), "{:.0f}")});
  }
  return table;
}

// What a run at the usual tolerance consists of.
ResultTable one_turn(const ReadyModel& ready, const Problem& problem, const ForceSamples& reference, int repetitions) {
  ResultTable table(fmt::format("Four-bar, one turn, tolerance {:.0e}, {} output times", kAsked, kOutputs),
                    {{"part", "part", true},
                     {"steps", "steps"},
                     {"Newton", "newton_iterations"},
                     {"force error", "force_error"},
                     {"ms", "milliseconds"},
                     {"+- %", "spread_percent"}});
  Problem only_end = problem;
  only_end.outputs = {problem.outputs.back()};
  Times start, bare, alone, pilot, reported, whole;
  for (int i = 0; i <= 5 * repetitions; ++i) {
    const Stopwatch watch;
    const ReadyModel fresh(ready.model);
    const double seconds = watch.seconds();
    const double steps_only = run_radau(only_end, 3, kAsked).seconds;
    const double single = run_radau(problem, 3, kAsked).seconds;
    const RunPasses passes = run_passes(problem, kAsked);
    const double all = whole_run(ready.model, ready.system, kAsked).seconds;
    if (i == 0) continue;  // for the caches
    start.add(seconds);
    bare.add(steps_only);
    alone.add(single);
    pilot.add(passes.pilot.seconds);
    reported.add(passes.reported.seconds);
    whole.add(all);
  }
  const auto row = [&](const char* part, double steps, double newton, double error, const Times& times) {
    table.add_row({text(part), count(steps), count(newton), number(error, "{:.1e}"),
                   number(1e3 * times.median(), "{:.3f}"), number(100 * times.spread(), "{:.0f}")});
  };
  const auto row_of = [&](const char* part, const PintleRun& run, const Times& times) {
    row(part, static_cast<double>(run.counters.steps), static_cast<double>(run.counters.newton_iterations),
        run.samples.error(reference), times);
  };
  row("assembly and start", NAN, NAN, NAN, start);
  const PintleRun steps_only = run_radau(only_end, 3, kAsked);
  row("RadauStepper, nothing between steps", static_cast<double>(steps_only.counters.steps),
      static_cast<double>(steps_only.counters.newton_iterations), NAN, bare);
  row_of("RadauStepper with dense output", run_radau(problem, 3, kAsked), alone);
  const RunPasses passes = run_passes(problem, kAsked);
  row_of("pilot integration", passes.pilot, pilot);
  row_of("reported integration", passes.reported, reported);
  const MethodRun all = whole_run(ready.model, ready.system, kAsked);
  row("simulate(): start, integrations, table", all.steps, NAN, all.samples.error(reference), whole);
  return table;
}

}  // namespace

nlohmann::ordered_json compare_peers(const PeerOptions& options) {
  const ReadyModel ready(collection_model("four_bar"));
  Problem problem = ready.problem(kOutputs);
  const PintleRun reference = run_radau(problem, 5, kReferenceTolerance);
  problem.force = reference.samples.largest_force();
  const PeerMethod witness =
      runge_kutta("witness", Family::kExplicitRungeKutta, ARKODE_FEHLBERG_13_7_8, Weights::kPlain);
  const PeerRun tight = run_sundials(witness, problem, kTightExplicit);
  if (!reference.completed || !tight.completed)
    throw std::runtime_error("the reference runs of the four-bar did not end");
  const double agreement = tight.samples.error(reference.samples);
  fmt::print(
      "\nReference: Pintle, order 9, tolerance {:.0e}, {} steps; an explicit run of ARKODE (order 8, tolerance {:.0e}, "
      "{} steps)\n"
      "agrees with it to {:.1e} of the peak forces.\n",
      kReferenceTolerance, reference.counters.steps, kTightExplicit, tight.steps, agreement);
  std::vector<Contestant> all = our_methods(ready, problem);
  for (Contestant& peer : peer_methods(problem, options.all_methods)) all.push_back(std::move(peer));
  WorkPrecision work(std::move(all));
  work.measure(options.repetitions, reference.samples);
  const ResultTable curves = work.table(), prices = price_list(work);
  const ResultTable turn = one_turn(ready, problem, reference.samples, options.repetitions);
  for (const ResultTable* table : {&curves, &prices, &turn}) table->print();
  return {
      {"reference_agreement", agreement}, {"curves", curves.json()}, {"prices", prices.json()}, {"turn", turn.json()}};
}

}  // namespace pintle::bench
