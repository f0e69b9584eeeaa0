// The step loop: predict, solve, estimate, accept or shrink. As RadauStepper's.
#include "integrators/tree_radau.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/tree_load_scale.h"

namespace pintle {
namespace {

using S = Planar;
using Eigen::VectorXd;

constexpr int kMaxRetries = 80;
constexpr double kShortest = 1e-11;    // of the run: the shortest step that is refused for its error
constexpr double kKinkAtStart = 1e-5;  // of the usual step: a kink this close to its start is crossed
constexpr double kShrink = 0.35;       // after Newton failed
constexpr double kShort = 0.9;        // of the way to a kink that is only guessed at
constexpr double kAfterKink = 0.3;     // of the usual step
constexpr double kSafety = 0.9, kLeast = 0.15, kMost = 4, kMostAtFirst = 100;

}  // namespace

TreeRadau::TreeRadau(const System& system, double tolerance, int stages)
    : system_(system), table_(RadauTable::of(stages)), n_(table_.n), tolerance_(tolerance),
      tree_(std::make_unique<JointTree>(system)), stages_(system, *tree_, table_, tolerance), end_at_(system, *tree_), inside_at_(end_at_) {
  scale_.body.assign(system.bodies.size(), S::Vec::Zero());
  for (TreeInstant* at : {&end_at_, &inside_at_}) at->hold(held_);
  stages_.hold(held_);
  const int n = tree_->n(), m = end_at_.n_gaps();
  nodes_ = {Eigen::MatrixXd::Zero(n, n_ + 1), Eigen::MatrixXd::Zero(m, n_ + 1), Eigen::MatrixXd::Zero(m, n_ + 1), Eigen::MatrixXd::Zero(2, n_ + 1)};
}

bool TreeRadau::attempt(double h) {
  return stages_.solve(begin_, h, have_history_ ? &nodes_ : nullptr, last_h_, scale_, counters_);
}

// The tree takes positions and rates from the bodies; gaps and forces of the joints that stay laws are the state's.
void TreeRadau::start(const State& state, double h) {
  end_state_ = state;
  h_ = usual_h_ = h;
  have_history_ = false;
  held_ = state.held;
  jumps_.forget();
  end_.t = state.t;
  tree_->read_positions(state.q, end_.y);
  TreePose pose;
  tree_->place(end_.y, VectorXd::Zero(tree_->n()), pose);
  tree_->read_rates(pose, state.v, end_.u);
  take_carried(*tree_, state, end_);
  end_at_.place(end_.t, end_.y, end_.u);
  projector_.prepare(end_at_, 1, end_.gap, end_.rate);
  projector_.accelerations(end_at_, end_.force, end_.w);
  const auto [supplied, lost] = end_at_.power(end_.gap, end_.rate, end_.force);
  end_state_.supply_power = supplied;
  end_state_.loss_power = lost;
  finish_end(end_.w);
}

bool TreeRadau::step(double t_end) {
  if (release_jumps(system_, end_.t, end_at_.pose().m, held_)) {
    balance_end();
    have_history_ = false;
  }
  begin_ = end_;
  begin_state_ = end_state_;
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
      begin_state_ = end_state_;
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
  note_failure(h);
  return false;
}

void TreeRadau::note_failure(double h) {
  failure_ = fmt::format("the step size has shrunk to nothing at t = {:.9g} s, step {:.3g} s", begin_.t, h);
  std::vector<std::pair<double, int>> worst;
  for (const int j : tree_->laws()) worst.emplace_back(-stages_.residual(j), j);
  std::sort(worst.begin(), worst.end());
  for (std::size_t i = 0; i < std::min<std::size_t>(3, worst.size()); ++i)
    failure_ += fmt::format("; joint {} (residual {:.3g} m/s^2)", system_.joints[worst[i].second].name, -worst[i].first);
}

// What the state of the bodies says about the end, with reactions that go with u' = w.
void TreeRadau::finish_end(const VectorXd& w) {
  end_at_.write(end_, w, end_state_);
  if (system_.has_branches()) side_ = end_at_.branches(end_.gap, end_.rate);
  grow_load_scale(system_, end_at_.pose().m, end_at_.Q(), end_state_, scale_);
}

}  // namespace pintle
