// One turn of the four-bar: Pintle compared with SUNDIALS, by the resulting error of the joint forces of each method.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "bench/commands.h"
#include "bench/groups.h"
#include "bench/pintle_methods.h"
#include "bench/result_table.h"
#include "bench/sundials_methods.h"
#include "bench/stopwatch.h"
#include "bench/work_precision.h"

namespace pintle::bench {
namespace {

constexpr int kOutputs = 200;
constexpr double kReferenceTolerance = 1e-11;
constexpr double kTightExplicit = 1e-13;
constexpr double kAsked = 1e-5;
const std::string kOurs = "Pintle", kPeers = "SUNDIALS", kWholeRun = "Pintle, whole run";

std::vector<Contestant> our_methods(const ReadyModel& ready, const Problem& problem, const Samples& truth) {
  std::vector<Contestant> list;
  for (const int stages : {3, 5})
    list.push_back({fmt::format("Pintle, order {}", 2 * stages - 1), kOurs, kCompliant,
                    [&problem, stages](double tolerance) { return run_radau(problem, stages, tolerance).measured(); },
                    stages == 3 ? decades(-2, -7, 2) : decades(-3, -10), &truth});
  list.push_back({kWholeRun, "Pintle, start to report", kCompliant,
                  [&](double tolerance) { return whole_run(ready, problem, tolerance); }, decades(-2, -8), &truth});
  return list;
}

std::vector<Contestant> peer_methods(const Problem& problem, bool all, const Samples& truth) {
  std::vector<Contestant> list;
  for (auto& [method, ladder] : peer_ladders(all))
    list.push_back({method.name, kPeers, kCompliant,
                    [&problem, peer = method](double tolerance) { return run_sundials(peer, problem, tolerance); }, ladder, &truth});
  return list;
}

// The price of an error in both programs.
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
    const auto best = [&](const std::string& group, double e) { return work.best_for(group, Measure::kForce, e); };
    const int peer = best(kPeers, error), ours = best(kOurs, error),
              whole = best(kWholeRun, error);
    const auto time = [&](int c) { return c < 0 ? NAN : 1e3 * work.time_for(static_cast<std::size_t>(c), Measure::kForce, error); };
    const auto name = [&](int c) { return text(c < 0 ? "-" : work.contestant(static_cast<std::size_t>(c)).name); };
    table.add_row({number(error, "{:.0e}"), name(peer), number(time(peer), "{:.2f}"), name(ours),
                   number(time(ours), "{:.3f}"), number(time(peer) / time(ours), "{:.0f}"),
                   number(time(whole), "{:.3f}"), number(time(peer) / time(whole), "{:.0f}")});
  }
  return table;
}

// The parts of a run at the usual tolerance.
ResultTable one_turn(const ReadyModel& ready, const Problem& problem, const Samples& reference, int repetitions) {
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
    const double all = whole_run(ready, problem, kAsked).seconds;
    if (i == 0) continue;  // warms up the caches
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
  const MethodRun all = whole_run(ready, problem, kAsked);
  row("simulate(): start, integrations, table", all.steps, NAN, all.samples.error(reference), whole);
  return table;
}

}  // namespace

nlohmann::ordered_json compare_peers(const PeerOptions& options) {
  const ReadyModel ready(collection_model("four_bar"));
  Problem problem = ready.problem(kOutputs);
  const PintleRun reference = run_radau(problem, 5, kReferenceTolerance);
  problem.force = reference.samples.largest_force();
  const MethodRun tight = run_sundials(explicit_witness(), problem, kTightExplicit);
  if (!reference.completed || !tight.completed)
    throw std::runtime_error("the reference runs of the four-bar did not end");
  const double agreement = tight.samples.error(reference.samples);
  fmt::print(
      "\nReference: Pintle, order 9, tolerance {:.0e}, {} steps; an explicit run of ARKODE (order 8, tolerance {:.0e}, "
      "{} steps)\n"
      "agrees with it to {:.1e} of the peak forces.\n",
      kReferenceTolerance, reference.counters.steps, kTightExplicit, tight.steps, agreement);
  std::vector<Contestant> all = our_methods(ready, problem, reference.samples);
  for (Contestant& peer : peer_methods(problem, options.all_methods, reference.samples)) all.push_back(std::move(peer));
  WorkPrecision work(std::move(all));
  work.measure({options.repetitions});
  const ResultTable curves = work.table("Work and precision: largest joint-force error over the peak, median time"), prices = price_list(work);
  const ResultTable turn = one_turn(ready, problem, reference.samples, options.repetitions);
  for (const ResultTable* table : {&curves, &prices, &turn}) table->print();
  return {
      {"reference_agreement", agreement}, {"curves", curves.json()}, {"prices", prices.json()}, {"turn", turn.json()}};
}

}  // namespace pintle::bench
