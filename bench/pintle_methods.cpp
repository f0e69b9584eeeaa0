#include "bench/pintle_methods.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "bench/stopwatch.h"
#include "pintle/read_model.h"
#include "pintle/simulate.h"
#include "run/pass_constants.h"
#include "start/start.h"

namespace pintle::bench {
namespace {

constexpr std::uint64_t kLook = 16;  // steps between two readings of the clock

// World forces of the joints and the position of the followed point from the columns of a run, without the first row (the start).
class RunRows {
 public:
  RunRows(const Trajectory& run, const System& system, FollowedPoint point) : run_(run), point_(point) {
    for (const LoadSummary& joint : run.joints) {
      const std::string prefix = "joint." + joint.name + ".on_" + joint.second_body + ".";
      loads_.push_back(run.column(prefix + "fx[world]"));
      loads_.push_back(run.column(prefix + "fy[world]"));
    }
    n_other_ = system.joints.size() - run.joints.size();
    if (point.body == kGround) return;
    const std::string body = "body." + system.bodies[point.body].name + ".";
    for (const char* coordinate : {"x", "y", "angle"}) pose_.push_back(run.column(body + coordinate));
  }

  void add(std::size_t row, Samples& samples) const {
    std::vector<double> loads;
    for (std::size_t i = 0; i < loads_.size(); i += 2)
      loads.insert(loads.end(), {run_.at(row, loads_[i]), run_.at(row, loads_[i + 1]), 0});
    loads.resize(loads.size() + 3 * n_other_, 0.0);  // servos, whose forces are in other columns
    samples.add_loads(loads);
    if (pose_.empty()) return;
    const Planar::Vec q(run_.at(row, pose_[0]), run_.at(row, pose_[1]), run_.at(row, pose_[2]));
    const Planar::Motion body = Planar::Motion::of(q, Planar::Vec::Zero());
    samples.add_place(body.p + body.turned(point_.at));
  }

 private:
  const Trajectory& run_;
  FollowedPoint point_;
  std::size_t n_other_ = 0;
  std::vector<int> loads_, pose_;
};

}  // namespace

MethodRun PintleRun::measured() const {
  return {completed, seconds, static_cast<double>(counters.steps), static_cast<double>(counters.evaluations), samples};
}

PintleRun run_stepper(const Problem& problem, const MethodChoice& choice, double tolerance, const LoadScale* scale) {
  PintleRun run{false, 0, {}, {}, Samples(*problem.system, problem.point)};
  const Stopwatch watch;
  const std::unique_ptr<Stepper> stepper = make_stepper(*problem.system, choice, tolerance);
  if (scale) stepper->set_load_scale(*scale);
  const double end = problem.outputs.back();
  stepper->start(*problem.start, 1e-4 * end);
  std::size_t row = 0;
  while (row < problem.outputs.size() && stepper->step(end)) {
    const State& now = stepper->state();
    for (; row < problem.outputs.size() && problem.outputs[row] <= now.t; ++row) {
      const double t = problem.outputs[row];
      const State& at = t < now.t ? stepper->interpolate(t) : now;
      run.samples.add(at.q, at.v, at.force);
    }
    if (stepper->counters().steps % kLook == 0 && watch.seconds() > problem.cap) break;
  }
  run.completed = row == problem.outputs.size();
  run.seconds = watch.seconds();
  run.counters = stepper->counters();
  run.scale = stepper->load_scale();
  return run;
}

PintleRun run_radau(const Problem& problem, int stages, double tolerance, const LoadScale* scale) {
  return run_stepper(problem, {Equations::kNewtonian, "radau", stages}, tolerance, scale);
}

MethodRun whole_run(const ReadyModel& ready, const Problem& problem, double tolerance) {
  Model asked = ready.model;
  asked.simulate.tolerance = tolerance;
  asked.simulate.duration = problem.outputs.back();
  asked.simulate.output_step = problem.outputs.back() / static_cast<double>(problem.outputs.size());
  MethodRun out{false, 0, 0, 0, Samples(ready.system, problem.point)};
  const Stopwatch watch;
  const Trajectory run = simulate(asked, [&](const Progress&) { return watch.seconds() < problem.cap; });
  out.seconds = watch.seconds();
  out.steps = static_cast<double>(run.counters.steps);
  out.evaluations = static_cast<double>(run.counters.evaluations);
  out.completed = run.outcome == Outcome::kCompleted || run.outcome == Outcome::kToleranceNotMet;
  if (!out.completed) return out;
  const RunRows rows(run, ready.system, problem.point);
  for (std::size_t row = 1; row < run.n_rows(); ++row) rows.add(row, out.samples);
  return out;
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

ReadyModel::ReadyModel(Model from) : model(std::move(from)), assembly(start_of_run(model)) {}

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

FollowedPoint ReadyModel::point(const MarkerRef& marker) const {
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    for (const Marker& m : model.bodies[i].markers)
      if (model.bodies[i].name == marker.body && m.name == marker.marker)
        return {static_cast<int>(i), {m.position[0], m.position[1]}};
  throw std::logic_error("no marker " + marker.body + "." + marker.marker);
}

Model collection_model(const std::string& name, const std::vector<std::string>& overrides) {
  return read_model(std::string(PINTLE_SOURCE_DIR) + "/mechanisms/" + name + ".toml", overrides);
}

}  // namespace pintle::bench
