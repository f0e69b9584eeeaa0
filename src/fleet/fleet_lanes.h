// FleetWork for one width of registers.
#pragma once

#include "fleet/fleet_start.h"
#include "fleet/fleet_steps.h"
#include "fleet/fleet_work.h"

namespace pintle::PINTLE_FLEET {

class Work final : public FleetWork {
 public:
  explicit Work(const FleetPlan& plan)
      : plan_(plan), mechanism_(plan.base), start_(mechanism_), steps_(mechanism_, plan),
        assembled_(plan.base.bodies.size(), plan.base.joints.size()), state_(assembled_) {}

  void put(int lane, const System& variant, const Vecs& q, const Vecs& v, double duration) override {
    mechanism_.put(lane, variant);
    duration_.set(lane, duration);
    for (std::size_t i = 0; i < q.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        assembled_.q[i][k].set(lane, q[i][k]);
        assembled_.v[i][k].set(lane, v[i][k]);
      }
  }
  void run() override {
    state_ = assembled_;
    start_.find(state_, plan_.span * duration_, plan_.sweeps, unsettled_);
    steps_.start(state_);
    for (const FleetStep& step : plan_.steps) steps_.step(step, duration_);
  }
  const Each& unsettled() const override { return unsettled_; }
  const Each& worst() const override { return steps_.worst(); }
  int iterations() const override { return steps_.iterations(); }
  const std::vector<FleetPeak>& peaks() const override { return steps_.peaks(); }

 private:
  const FleetPlan& plan_;
  FleetMechanism mechanism_;
  FleetStart start_;
  FleetSteps steps_;
  FleetState assembled_, state_;
  Each duration_, unsettled_;
};

std::unique_ptr<FleetWork> make_fleet_work(const FleetPlan& plan) { return std::make_unique<Work>(plan); }

}  // namespace pintle::PINTLE_FLEET
