#include "analyses/integration.h"

#include <algorithm>
#include <cmath>

#include "integrators/dense_output.h"

namespace pintle {

Integration integrate_radau(const System& system, const State& start, const IntegrationPlan& plan, Recorder& recorder) {
  Integration out;
  RadauStepper stepper(system, plan.tolerance);
  stepper.set_max_step(plan.max_step);
  if (plan.scale) stepper.set_load_scale(*plan.scale);
  stepper.start(start, plan.first_step);
  DenseOutput dense(system);
  recorder.add(start);
  std::size_t row = 1;
  const double end = plan.duration, almost = end * (1 - 1e-12);
  while (stepper.state().t < almost) {
    if (!stepper.step(end)) {
      out.ended = Ended::kFailed;
      out.message = stepper.failure();
      break;
    }
    const State &begin = stepper.previous(), &now = stepper.state();
    const double mu = stepper.table().real_eigenvalue / (now.t - begin.t);
    for (double t = static_cast<double>(row) * plan.output_step; t <= now.t && t < almost; t = static_cast<double>(++row) * plan.output_step)
      recorder.add(dense.at(t, begin, now, mu));
    if (plan.keep_going && !plan.keep_going(now.t)) {
      out.ended = Ended::kStopped;
      break;
    }
  }
  if (stepper.state().t > recorder.forces().t.back()) recorder.add(stepper.state());
  out.t = stepper.state().t;
  out.counters = stepper.counters();
  out.scale = stepper.load_scale();
  return out;
}

}  // namespace pintle
