// The step loop: predict, solve, estimate, accept or shrink.
#include "integrators/radau_stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace pintle {
namespace {

using S = Planar;

constexpr int kMaxRetries = 80;
constexpr double kShortest = 1e-11;  // of the run: the shortest step that is refused for its error
constexpr double kKinkAtStart = 1e-5;  // of the usual step: a kink this close to its start is crossed
constexpr double kShrink = 0.35;     // after Newton failed
constexpr double kShort = 0.9;        // of the way to a kink that is only guessed at
constexpr double kAfterKink = 0.3;   // of the usual step
constexpr double kSafety = 0.9, kLeast = 0.15, kMost = 4, kMostAtFirst = 100;

}  // namespace

RadauStepper::RadauStepper(const System& system, double tolerance, int stages)
    : system_(system), table_(RadauTable::of(stages)), n_(table_.n), tolerance_(tolerance),
      solver_(make_stage_solver(system, table_, tolerance)), stage_(table_.n), projector_(system), tail_(system.joints.size()),
      tail_move_(system.bodies.size()), wanted_(system.joints.size()),
      move_(system.bodies.size()), end_r_(system.joints.size()), end_m_(system.bodies.size()) {
  const std::size_t n = system.bodies.size(), m = system.joints.size();
  const Vecs bodies(n, S::Vec::Zero()), joints(m, S::Vec::Zero());
  for (Stage& s : stage_) {
    s.q = s.v = s.a = s.Q = bodies;
    s.gap = s.gap_rate = s.gap_accel = s.force = joints;
    s.m.resize(n);
  }
  nodes_ = {&table_, std::vector<Vecs>(n_ + 1, bodies), std::vector<Vecs>(n_ + 1, joints), std::vector<Vecs>(n_ + 1, joints),
            std::vector<std::array<double, 2>>(n_ + 1)};
  inside_q_ = inside_v_ = bodies;
  inside_gap_ = inside_rate_ = joints;
  scale_.body = bodies;
}

bool RadauStepper::attempt(double h) {
  if (!solver_->solve(begin_, h, have_history_ ? &nodes_ : nullptr, last_h_, scale_, counters_)) return false;
  solver_->write(stage_);
  return true;
}

void RadauStepper::start(const State& state, double h) {
  begin_ = end_ = state;
  h_ = usual_h_ = h;
  have_history_ = false;
  system_.motions(end_.q, end_.v, end_m_);
  system_.readings(end_.t, end_m_, end_r_);
  Stage& last = stage_[n_ - 1];
  last.Q.assign(system_.bodies.size(), S::Vec::Zero());
  system_.external(end_.t, end_m_, last.Q, end_.held);
  const auto [supplied, lost] = power(end_.t, end_.q, end_m_, end_.gap, end_.gap_rate, end_.force);
  end_.supply_power = supplied;
  end_.loss_power = lost;
  jumps_.forget();
  side_ = system_.has_branches() ? system_.branches(end_.t, end_m_, end_.gap, end_.gap_rate, end_.held) : 0;
  grow_scale();
}

bool RadauStepper::step(double t_end) {
  begin_ = end_;
  double h = h_;
  bool up_to_kink = false;
  if (max_step_ > 0) h = std::min(h, max_step_);
  for (int retry = 0; retry < kMaxRetries; ++retry) {
    const double left = t_end - begin_.t;
    if (h > left || left - h < 1e-3 * h) h = left;
    else if (!up_to_kink && left < 1.7 * h) h = 0.5 * left;
    if (h <= 16 * std::numeric_limits<double>::epsilon() * std::max(std::abs(begin_.t), std::abs(t_end))) break;
    const bool solved = attempt(h);
    if (!solved) {
      ++counters_.newton_failures;
      have_history_ = have_history_ && retry == 0;
    }
    const Kink kink = solved || retry > 0 ? find_kink(h, solved) : Kink{};  // twice unsolved: for a jump on the way?
    if (kink.before < 1 && kink.before * h < kKinkAtStart * usual_h_) {
      cross_kink(kink.before * h);
      begin_ = end_;
      h = std::max(h, kAfterKink * usual_h_);
      continue;
    }
    if (kink.after < 1) {
      up_to_kink = true;
      h *= kink.before * (solved ? 1 - 0.1 * kKinkAtStart : kShort);  // so that the last stage is not on it
      if (solved) ++counters_.rejected;
      continue;
    }
    if (!solved) {
      h *= kShrink;
      continue;
    }
    double error = 0;
    if (!error_estimate(h, error)) {
      ++counters_.newton_failures;
      h *= kShrink;
      continue;
    }
    error /= tolerance_;
    double factor = std::clamp(kSafety * std::pow(std::max(error, 1e-14), -1.0 / (n_ + 1)), kLeast, counters_.steps == 0 ? kMostAtFirst : kMost);
    // A force that jumps cannot be resolved by any step: one that is this short passes over the jump.
    const bool jump = error > 1 && h <= kShortest * std::abs(t_end);
    if (jump) factor = kMost;
    if (error > 1 && !jump) {
      ++counters_.rejected;
      h *= std::min(factor, 0.7);
      continue;
    }
    finish_step(h);
    ++counters_.steps;
    h_ = h * factor;
    if (up_to_kink) h_ = std::max(h_, kAfterKink * usual_h_);  // a better guess than this stump
    else usual_h_ = h_;
    return true;
  }
  note_failure(h, "the step size has shrunk to nothing");
  return false;
}

bool RadauStepper::trial(double h) {
  begin_ = end_;
  double error = 0;
  if (!attempt(h) || !error_estimate(h, error)) return false;
  finish_step(h);
  return true;
}

void RadauStepper::note_failure(double h, const char* why) {
  std::array<std::pair<double, int>, 3> worst{{{0, -1}, {0, -1}, {0, -1}}};
  for (int j = 0; j < system_.n_joints(); ++j) {
    const double size = solver_->residual(j);
    for (auto& w : worst)
      if (w.second < 0 || size > w.first || !std::isfinite(size)) {
        std::move_backward(&w, worst.end() - 1, worst.end());
        w = {size, j};
        break;
      }
  }
  failure_ = fmt::format("{} at t = {:.9g} s, step {:.3g} s", why, begin_.t, h);
  for (const auto& [size, j] : worst)
    if (j >= 0) failure_ += fmt::format("; joint {} (residual {:.3g} m/s^2)", system_.joints[j].name, size);
}

}  // namespace pintle
