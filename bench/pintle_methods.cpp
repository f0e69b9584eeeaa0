#include "bench/pintle_methods.h"

#include <algorithm>
#include <cmath>

#include "analyses/passes.h"
#include "analyses/start.h"
#include "bench/stopwatch.h"
#include "integrators/dense_output.h"
#include "pintle/read_model.h"
#include "system/build.h"

namespace pintle::bench {
PintleRun run_radau(const Problem& problem, int stages, double tolerance, const LoadScale* scale) {
  PintleRun run{false, 0, {}, {}, ForceSamples(*problem.system)};
  const Stopwatch watch;
  RadauStepper stepper(*problem.system, tolerance, stages);
  DenseOutput dense(*problem.system);
  if (scale) stepper.set_load_scale(*scale);
  const double end = problem.outputs.back();
  stepper.start(*problem.start, 1e-4 * end);
  std::size_t row = 0;
  while (row < problem.outputs.size() && stepper.step(end)) {
    const State &begin = stepper.previous(), &now = stepper.state();
    for (; row < problem.outputs.size() && problem.outputs[row] <= now.t; ++row) {
      const double t = problem.outputs[row];
      const State& at = t < now.t ? dense.at(t, begin, now, stepper.nodes()) : now;
      run.samples.add(t, at.q, at.v, at.force);
    }
  }
  run.completed = row == problem.outputs.size();
  run.seconds = watch.seconds();
  run.counters = stepper.counters();
  run.scale = stepper.load_scale();
  return run;
}

RunPasses run_passes(const Problem& problem, double tolerance) {
  int stages = tolerance < kTight ? 5 : 3;
  PintleRun pilot = run_radau(problem, stages, kPilot * tolerance);
  const Counters& c = pilot.counters;
  if (stages == 3 && static_cast<double>(c.newton_iterations) < kEasy * static_cast<double>(c.steps)) {
    stages = 5;
    const double spent = pilot.seconds;
    pilot = run_radau(problem, stages, kPilot * tolerance, &pilot.scale);
    pilot.seconds += spent;
  }
  PintleRun reported = run_radau(problem, stages, tolerance, &pilot.scale);
  return {std::move(pilot), std::move(reported)};
}

ReadyModel::ReadyModel(Model from) : model(std::move(from)), system(build_system(model)) {
  start = start_of_run(model, system).state;
}

Problem ReadyModel::problem(int outputs) const {
  Problem p;
  p.system = &system;
  p.start = &start;
  p.outputs = output_times(model.simulate.duration, outputs);
  for (const JointData& joint : system.joints) {
    const Response law = respond(joint.law, Planar::Vec::Zero(), Planar::Vec::Zero());
    double mass = 1e300;
    for (const int body : {joint.at.a, joint.at.b})
      if (body != kGround) mass = std::min(mass, system.bodies[body].mass[0]);
    p.stiffness = std::max(p.stiffness, law.stiffness(0, 0));
    p.impedance = std::max(p.impedance, std::max(law.damping(0, 0), std::sqrt(law.stiffness(0, 0) * mass)));
  }
  return p;
}

Model collection_model(const std::string& name, const std::vector<std::string>& overrides) {
  return read_model(std::string(PINTLE_SOURCE_DIR) + "/mechanisms/" + name + ".toml", overrides);
}

}  // namespace pintle::bench
