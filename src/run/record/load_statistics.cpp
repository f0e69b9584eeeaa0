#include "run/record/load_statistics.h"

#include <algorithm>
#include <cmath>

#include "integrators/thresholds.h"
#include "run/record/force_table.h"

namespace pintle {
namespace {

constexpr int kMostHalvings = 10;  // upper limit on halvings of a part of a step, as a jump of the loads is never resolved, and on jumps in it, as more of them are noise. With 5, the RMS of a pulse of 0.4 ms in a second is right to 4e-4 only

// At the end of a step, the state before the event: what laws set their states to there belongs to the next step. A step so short that it has passed over a jump
// of a force or of a driven coordinate has no curve; its ends count.
template <class S>
const BasicState<S>& on_curve(BasicStepper<S>& stepper, double t) {
  const double begin = stepper.previous().t, end = stepper.state().t;
  if (t < end && end - begin <= kShortestRefused * end) return stepper.previous();
  return t == stepper.state().t ? stepper.state_before_event() : stepper.interpolate(t);
}

}  // namespace

template <class S>
BasicLoadRecorder<S>::BasicLoadRecorder(const BasicSystem<S>& system, const LoadSampling& sampling, bool with_heat, const Signals* signals)
    : system_(system), grid_(sampling.n, sampling.accuracy), sampling_(sampling), with_heat_(with_heat), signals_(signals), n_signals_(signals == nullptr ? 0 : signals->n_signals()), wear_(system), duty_(system) {
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

// A run without any steps has the loads of its start.
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
    if (with_heat_ && system_.joints[j].servo < 0 && system_.joints[j].driven >= 0) lengths_.push_back({static_cast<int>(j)});
  }
  remember_lengths(state);
  for (std::size_t i = 0; i < signal_.size(); ++i) first(signal_[i], samples_[static_cast<std::size_t>(stride_ - n_signals_) + i]);
}

// Power of the joint's force on its gap, less what its law is supplied with from outside.
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

template <class S>
void BasicLoadRecorder<S>::remember_lengths(const BasicState<S>& end) {
  for (DrivenLength& length : lengths_) {
    const std::size_t j = static_cast<std::size_t>(length.joint);
    const int k = system_.joints[j].driven;
    length = {length.joint, end.gap[j][k], end.gap_rate[j][k], stored(length.joint, end)};
  }
}

// If a length jumps between two steps, its drive does work on the energy stored in the joint, which no step shows.
template <class S>
void BasicLoadRecorder<S>::add_work_of_length_jumps(const BasicState<S>& begin) {
  for (const DrivenLength& length : lengths_) {
    const std::size_t j = static_cast<std::size_t>(length.joint);
    const int k = system_.joints[j].driven;
    const double moved = (std::abs(length.rate) + std::abs(begin.gap_rate[j][k])) * (begin.t - end_);
    if (std::abs(begin.gap[j][k] - length.gap) > moved) work_[j] -= stored(length.joint, begin) - length.stored;
  }
}

template <class S>
void BasicLoadRecorder<S>::add_step(BasicStepper<S>& stepper) {
  const double t0 = stepper.previous().t, t1 = stepper.state().t;
  add_work_of_length_jumps(stepper.previous());
  remember_lengths(stepper.state());
  if (end_ == begin_)  // drop the values for a run without steps
    for (auto* all : {&force_, &couple_, &signal_})
      for (CurveSums& sums : *all) sums.integral = sums.square = 0;
  end_ = t1;
  if (sampling_.resolution <= 0) return add_resolved(stepper, t0, t1, 0);
  const double parts = std::max(std::ceil((t1 - t0) / sampling_.longest_part), 1.0);
  double from = t0;
  for (double i = 1; i <= parts; ++i) {
    const double to = i < parts ? t0 + i / parts * (t1 - t0) : t1;
    jumps_ = 0;
    add_resolved(stepper, from, to, kMostHalvings);
    from = to;
  }
}

template <class S>
void BasicLoadRecorder<S>::add_resolved(BasicStepper<S>& stepper, double t0, double t1, int halvings) {
  take_samples(stepper, t0, t1);
  const bool resolved = sampling_.resolution <= 0 || is_resolved(stepper.load_scale());
  if (halvings > 0 && !resolved && jumps_ < kMostHalvings) {
    const double middle = t0 + 0.5 * (t1 - t0);
    add_resolved(stepper, t0, middle, halvings - 1);
    return add_resolved(stepper, middle, t1, halvings - 1);
  }
  if (!resolved) ++jumps_;
  add_samples(t0, t1 - t0, resolved);
  if (with_heat_ && !wear_.empty()) add_wear(stepper, t0, t1);
}

template <class S>
void BasicLoadRecorder<S>::take_samples(BasicStepper<S>& stepper, double t0, double t1) {
  const bool wears = with_heat_ && !wear_.empty();
  for (int i = 0; i < grid_.n(); ++i) {
    const BasicState<S>& state = on_curve(stepper, i + 1 < grid_.n() ? t0 + grid_.instant(i) * (t1 - t0) : t1);
    sample(i, state);
    if (wears) wear_.sample(i, state);
    if (with_heat_) duty_.sample(i, state);
  }
}

// Whether more samples would hardly change the curves of the joints' loads. Loads that are almost nothing compared with those in the error norm are roundoff.
template <class S>
bool BasicLoadRecorder<S>::is_resolved(const BasicLoadScale<S>& scale) const {
  double largest[2] = {0, 0};  // force, couple
  for (const typename S::Vec& load : scale.body) largest[0] = std::max(largest[0], load[0]);
  const auto seen = [&](const CurveSums& sums, int joint, int first, int n) {
    double size = sums.peak;
    for (int i = 0; i < grid_.n(); ++i)
      for (int c = first; c < first + n; ++c) size = std::max(size, std::abs(samples_[static_cast<std::size_t>(i * stride_ + joint * S::kDof + c)]));
    return size;
  };
  for (int j = 0; j < system_.n_joints(); ++j) {
    largest[0] = std::max(largest[0], seen(force_[static_cast<std::size_t>(j)], j, 0, kForce));
    largest[1] = std::max(largest[1], seen(couple_[static_cast<std::size_t>(j)], j, kForce, kCouple));
  }
  largest[1] = std::max(largest[1], largest[0] * system_.largest_radius_of_gyration());
  for (int j = 0; j < system_.n_joints(); ++j)
    for (const bool couple : {false, true}) {
      if (couple && !has_couple_[static_cast<std::size_t>(j)]) continue;
      const int first = couple ? kForce : 0, n = couple ? kCouple : kForce;
      const double size = std::max(seen((couple ? couple_ : force_)[static_cast<std::size_t>(j)], j, first, n), sampling_.resolution * largest[couple ? 1 : 0]);  // small loads relative to the largest
      for (int c = first; c < first + n; ++c)
        if (grid_.chebyshev_tail(samples_.data() + j * S::kDof + c, stride_) > std::max(sampling_.resolution * size, kLastBits * largest[couple ? 1 : 0])) return false;
    }
  return true;
}

// A curve through the two sides of a jump overshoots both: there only the samples count for the peak.
template <class S>
template <int n, Sums kind>
CurveGrid::AtPoints BasicLoadRecorder<S>::add_load(const double* samples, double t0, double h, bool resolved, CurveSums& sums) const {
  const CurveSums before = sums;
  const CurveGrid::AtPoints squares = add_curve<n, kind>(grid_, samples, stride_, t0, h, sums);
  if (resolved) return squares;
  sums.peak = before.peak;
  sums.peak_time = before.peak_time;
  for (int i = 0; i < grid_.n(); ++i) {
    double square = 0;
    for (int c = 0; c < n; ++c) square += samples[i * stride_ + c] * samples[i * stride_ + c];
    if (!(square > sums.peak * sums.peak)) continue;
    sums.peak = kind == Sums::kWithSign ? samples[i * stride_] : std::sqrt(square);
    sums.peak_time = t0 + grid_.instant(i) * h;
  }
  return squares;
}

template <class S>
void BasicLoadRecorder<S>::add_samples(double t0, double h, bool resolved) {
  const double* at = samples_.data();
  for (std::size_t j = 0; j < force_.size(); ++j, at += S::kDof) {
    const CurveGrid::AtPoints squares = add_load<kForce>(at, t0, h, resolved, force_[j]);
    if (with_heat_) duty_.add_curve(static_cast<int>(j), grid_, {at, stride_, kForce}, squares, h);
    if (has_couple_[j]) add_load<kCouple>(at + kForce, t0, h, resolved, couple_[j]);
  }
  for (std::size_t j = 0; j < work_.size(); ++j, ++at)
    for (int i = 0; i < grid_.n(); ++i) work_[j] += h * grid_.integral()[static_cast<std::size_t>(i)] * at[static_cast<std::ptrdiff_t>(i) * stride_];
  for (CurveSums& sums : signal_) add_load<1, Sums::kWithSign>(at++, t0, h, resolved, sums);
}

// Where a contact turns far, or reverses, the step is divided more finely than by the samples.
template <class S>
void BasicLoadRecorder<S>::add_wear(BasicStepper<S>& stepper, double t0, double t1) {
  const int parts = wear_.finer_parts(grid_);
  if (parts == 0) return wear_.add_curve(grid_, t1 - t0);
  for (int i = 0; i <= parts; ++i) wear_.sample(i, on_curve(stepper, i < parts ? t0 + (t1 - t0) * i / parts : t1));
  wear_.add_trapezoids(parts, t1 - t0);
}

template <class S>
LoadStatistics BasicLoadRecorder<S>::over_run(const CurveSums& sums) const {
  const double share = end_ > begin_ ? 1 / (end_ - begin_) : 1;
  return {sums.peak, sums.peak_time, share * sums.integral, std::sqrt(share * sums.square)};
}

// The force on the second body drives the gap; what the joint takes up and does not store is lost.
template <class S>
double BasicLoadRecorder<S>::heat(int joint, const BasicState<S>& state) const {
  const std::size_t j = static_cast<std::size_t>(joint);
  return stored_[j] - work_[j] - stored(joint, state);
}

template class BasicLoadRecorder<Planar>;
PINTLE_IN_SPACE(template class BasicLoadRecorder<Spatial>;)

}  // namespace pintle
