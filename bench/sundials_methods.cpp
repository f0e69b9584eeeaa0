#include "bench/sundials_methods.h"

#include <arkode/arkode_arkstep.h>

#include <cmath>

#include "bench/stopwatch.h"

namespace pintle::bench {
namespace {

// Absolute tolerances for positions, then velocities.
std::vector<double> floors(const FirstOrderOde& equations, const Problem& problem, Weights weights, double tolerance) {
  std::vector<double> out(equations.size(), tolerance);
  if (weights == Weights::kPlain) return out;
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = tolerance * problem.force / (i < out.size() / 2 ? problem.stiffness : problem.impedance);
  return out;
}

double relative_tolerance(Weights weights, double tolerance) { return weights == Weights::kPlain ? tolerance : 1e-15; }

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

}  // namespace

std::vector<double> decades(int from, int to, int per_decade) {
  std::vector<double> ladder;
  for (int i = from * per_decade; i >= to * per_decade; --i)
    ladder.push_back(std::pow(10.0, static_cast<double>(i) / per_decade));
  return ladder;
}

std::vector<PeerLadder> peer_ladders(bool all) {
  const auto explicit_rk = Family::kExplicitRungeKutta, implicit_rk = Family::kImplicitRungeKutta;
  const auto force = Weights::kForce, plain = Weights::kPlain;
  std::vector<PeerLadder> list{
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
  const std::vector<PeerLadder> more{
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

PeerMethod explicit_witness() {
  return runge_kutta("witness", Family::kExplicitRungeKutta, ARKODE_FEHLBERG_13_7_8, Weights::kPlain);
}

MethodRun run_sundials(const PeerMethod& method, const Problem& problem, double tolerance) {
  MethodRun run{false, 0, 0, 0, Samples(*problem.system, problem.point)};
  const Stopwatch watch;
  FirstOrderOde equations(*problem.system, FirstOrderOde::Energies::kLeftOut);
  std::vector<double> y(equations.size());
  equations.flatten(*problem.start, y.data());
  SundialsCode code(method.code, equations, problem.start->t, y, relative_tolerance(method.weights, tolerance),
                    floors(equations, problem, method.weights, tolerance));
  State state = zero_state(*problem.system);
  code.stop_at(problem.outputs.back());
  run.completed = true;
  for (const double t : problem.outputs) {
    if (method.stop_at_outputs) code.stop_at(t);
    if (watch.seconds() > problem.cap || !code.advance_to(t)) {
      run.completed = false;
      break;
    }
    equations.unflatten(t, code.y(), state);
    run.samples.add_by_laws(t, state.q, state.v);
  }
  run.seconds = watch.seconds();
  Counters counters;
  code.count(counters);
  run.steps = static_cast<double>(counters.steps);
  run.evaluations = static_cast<double>(counters.evaluations);
  return run;
}

}  // namespace pintle::bench
