#include "bench/sundials_methods.h"

#include "bench/stopwatch.h"

namespace pintle::bench {
namespace {

// Absolute tolerances for positions, then velocities.
std::vector<double> floors(const FlatEquations& equations, const Problem& problem, Weights weights, double tolerance) {
  std::vector<double> out(equations.size(), tolerance);
  if (weights == Weights::kPlain) return out;
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = tolerance * problem.force / (i < out.size() / 2 ? problem.stiffness : problem.impedance);
  return out;
}

double relative_tolerance(Weights weights, double tolerance) { return weights == Weights::kPlain ? tolerance : 1e-15; }

}  // namespace

PeerRun run_sundials(const PeerMethod& method, const Problem& problem, double tolerance) {
  PeerRun run{false, 0, 0, 0, ForceSamples(*problem.system)};
  const Stopwatch watch;
  FlatEquations equations(*problem.system, FlatEquations::Energies::kLeftOut);
  std::vector<double> y(equations.size());
  equations.flatten(*problem.start, y.data());
  SundialsCode code(method.code, equations, problem.start->t, y, relative_tolerance(method.weights, tolerance),
                    floors(equations, problem, method.weights, tolerance));
  State state = zero_state(*problem.system);
  code.stop_at(problem.outputs.back());
  run.completed = true;
  for (const double t : problem.outputs) {
    if (method.stop_at_outputs) code.stop_at(t);
    if (!code.advance_to(t)) {
      run.completed = false;
      break;
    }
    equations.unflatten(t, code.y(), state);
    run.samples.add_by_laws(t, state.q, state.v);
  }
  run.seconds = watch.seconds();
  Counters counters;
  code.count(counters);
  run.steps = static_cast<long>(counters.steps);
  run.evaluations = static_cast<long>(counters.evaluations);
  return run;
}

}  // namespace pintle::bench
