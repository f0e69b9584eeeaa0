#include "run/record/load_statistics.h"

#include <cmath>

#include "run/record/force_table.h"

namespace pintle {

template <class S>
BasicLoadRecorder<S>::BasicLoadRecorder(const BasicSystem<S>& system, int n_samples, bool with_heat, const Signals* signals)
    : system_(system), grid_(n_samples), with_heat_(with_heat), signals_(signals), n_signals_(signals == nullptr ? 0 : signals->n_signals()), wear_(system) {
  const std::size_t joints = system.joints.size();
  stride_ = static_cast<int>(joints) * (S::kDof + 1) + n_signals_;
  samples_.resize(static_cast<std::size_t>(grid_.n() * stride_));
  force_.resize(joints);
  couple_.resize(joints);
  work_.resize(joints, 0);
  stored_.resize(joints, 0);
  signal_.resize(static_cast<std::size_t>(n_signals_));
  for (const BasicJointData<S>& joint : system.joints) has_couple_.push_back(has_couple(joint));
}

template <class S>
double BasicLoadRecorder<S>::stored(int joint, const BasicState<S>& state) const {
  return system_.joints[static_cast<std::size_t>(joint)].law.energy(law_point(system_, joint, state));
}

// A run without a step has had the loads of its start.
template <class S>
void BasicLoadRecorder<S>::start(const BasicState<S>& state) {
  begin_ = end_ = state.t;
  sample(0, state);
  const auto first = [&](CurveSums& sums, double size) { sums = {size, state.t, size, size * size}; };
  for (std::size_t j = 0; j < force_.size(); ++j) {
    const double* load = samples_.data() + j * S::kDof;
    first(force_[j], magnitude<kForce>(load));
    first(couple_[j], magnitude<kCouple>(load + kForce));
    if (with_heat_ && system_.joints[j].servo < 0) stored_[j] = stored(static_cast<int>(j), state);
  }
  for (std::size_t i = 0; i < signal_.size(); ++i) first(signal_[i], samples_[static_cast<std::size_t>(stride_ - n_signals_) + i]);
}

// Of the joint's force on its gap, less what its law is fed with from outside.
template <class S>
double BasicLoadRecorder<S>::power_on_gap(int j, const BasicState<S>& state) const {
  const BasicLaw<S>& law = system_.joints[static_cast<std::size_t>(j)].law;
  return state.force[j].dot(state.gap_rate[j]) - law.supply(law_point(system_, j, state), state.force[j]);
}

template <class S>
void BasicLoadRecorder<S>::sample(int i, const BasicState<S>& state) {
  double* out = samples_.data() + static_cast<std::ptrdiff_t>(i) * stride_;
  system_.motions(state.q, state.v, m_);
  for (int j = 0; j < system_.n_joints(); ++j) {
    const typename S::Vec load = joint_load(system_, j, m_, state.force[j]);
    for (int c = 0; c < S::kDof; ++c) *out++ = load[c];
  }
  for (int j = 0; j < system_.n_joints(); ++j) *out++ = with_heat_ ? power_on_gap(j, state) : 0;
  if (signals_ != nullptr) signals_->put_signals(state, m_, out);
}

// Wear of a sample that stands for so much time, unless it is 0.
template <class S>
void BasicLoadRecorder<S>::sample(int i, const BasicState<S>& state, double wear_time) {
  sample(i, state);
  if (wear_time > 0) wear_.add(state, wear_time * grid_.integral()[static_cast<std::size_t>(i)]);
}

template <class S>
void BasicLoadRecorder<S>::add_step(BasicStepper<S>& stepper) {
  const double t0 = stepper.previous().t, h = stepper.state().t - t0;
  const int last = grid_.n() - 1;
  const bool wears = with_heat_ && !wear_.empty();
  const int parts = wears ? wear_.parts(stepper.previous(), stepper.state()) : 0;
  const double wear_time = wears && parts == 0 ? h : 0;
  sample(0, stepper.previous(), wear_time);
  for (int i = 1; i < last; ++i) sample(i, stepper.interpolate(t0 + grid_.instant(i) * h), wear_time);
  sample(last, stepper.state(), wear_time);
  for (int i = 0; i < parts; ++i) wear_.add(stepper.interpolate(t0 + (i + 0.5) / parts * h), h / parts);
  if (end_ == begin_)  // what stands for a run without a step
    for (auto* all : {&force_, &couple_, &signal_})
      for (CurveSums& sums : *all) sums.integral = sums.square = 0;
  end_ = stepper.state().t;
  const double* at = samples_.data();
  for (std::size_t j = 0; j < force_.size(); ++j, at += S::kDof) {
    add_curve<kForce>(grid_, at, stride_, t0, h, force_[j]);
    if (has_couple_[j]) add_curve<kCouple>(grid_, at + kForce, stride_, t0, h, couple_[j]);
  }
  for (std::size_t j = 0; j < work_.size(); ++j, ++at)
    for (int i = 0; i <= last; ++i) work_[j] += h * grid_.integral()[static_cast<std::size_t>(i)] * at[static_cast<std::ptrdiff_t>(i) * stride_];
  for (CurveSums& sums : signal_) add_curve<1, Sums::kWithSign>(grid_, at++, stride_, t0, h, sums);
}

template <class S>
LoadStatistics BasicLoadRecorder<S>::over_run(const CurveSums& sums) const {
  const double share = end_ > begin_ ? 1 / (end_ - begin_) : 1;
  return {sums.peak, sums.peak_time, share * sums.integral, std::sqrt(share * sums.square)};
}

// The force on the second body drives the gap; what it takes out and does not store is lost.
template <class S>
double BasicLoadRecorder<S>::heat(int joint, const BasicState<S>& state) const {
  const std::size_t j = static_cast<std::size_t>(joint);
  return stored_[j] - work_[j] - stored(joint, state);
}

template class BasicLoadRecorder<Planar>;
PINTLE_IN_SPACE(template class BasicLoadRecorder<Spatial>;)

}  // namespace pintle
