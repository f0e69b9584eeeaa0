// BatchWork for one width of registers.
#pragma once

#include "batch/batch_start.h"
#include "batch/batch_steps.h"
#include "batch/batch_work.h"

namespace pintle::PINTLE_BATCH {

class Work final : public BatchWork {
 public:
  explicit Work(const BatchPlan& plan)
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
    for (const double share : plan_.steps) steps_.step(share, duration_);
  }
  const VariantLanes& unsettled() const override { return unsettled_; }
  const VariantLanes& worst() const override { return steps_.worst(); }
  int iterations() const override { return steps_.iterations(); }
  const std::vector<BatchPeak>& peaks() const override { return steps_.peaks(); }

 private:
  const BatchPlan& plan_;
  BatchMechanism mechanism_;
  BatchStart start_;
  BatchSteps steps_;
  BatchState assembled_, state_;
  VariantLanes duration_, unsettled_;
};

std::unique_ptr<BatchWork> make_batch_work(const BatchPlan& plan) { return std::make_unique<Work>(plan); }

}  // namespace pintle::PINTLE_BATCH
