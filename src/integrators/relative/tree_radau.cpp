#include "integrators/relative/tree_radau.h"

#include <utility>

#include "integrators/load_scale.h"

namespace pintle {
namespace {

using S = Planar;
using Eigen::VectorXd;

}  // namespace

TreeRadau::TreeRadau(const System& system, double tolerance, int stages)
    : StepEvents(system), system_(system), table_(RadauTable::of(stages)), n_(table_.n), tolerance_(tolerance),
      tree_(std::make_unique<JointTree>(system)), stages_(system, *tree_, table_, tolerance), end_at_(system, *tree_), inside_at_(end_at_), open_contacts_(system, tree_->laws()), force_tail_(system, tree_->laws()), bends_(system) {
  scale_.body.assign(system.bodies.size(), S::Vec::Zero());
  end_at_.set_sliding(sliding_);
  inside_at_.set_sliding(begin_state_.sliding);  // a jump released at the end of a step is still held inside it
  stages_.set_sliding(sliding_);
  const int n = tree_->n(), m = end_at_.n_gaps();
  nodes_ = {Eigen::MatrixXd::Zero(n, n_ + 1), Eigen::MatrixXd::Zero(m, n_ + 1), Eigen::MatrixXd::Zero(m, n_ + 1), Eigen::MatrixXd::Zero(2, n_ + 1),
            Eigen::MatrixXd::Zero(system.n_law_states(), n_ + 1), Eigen::MatrixXd::Zero(system.n_law_states(), n_ + 1)};
}

bool TreeRadau::attempt(double h) {
  return stages_.solve(begin_, h, control_.have_history ? &nodes_ : nullptr, control_.last, scale_, counters_);
}

// The tree takes positions and rates from the bodies; gaps and forces of the joints that remain laws are those of the state.
void TreeRadau::start(const State& state, double h) {
  end_state_ = state;
  control_.start(h);
  sliding_ = state.sliding;
  read_coordinates(*tree_, state, end_);
  read_carried(*tree_, state, end_);
  end_at_.place(end_.t, end_.y, end_.u);
  projector_.prepare(end_at_, 1, end_);
  projector_.accelerations(end_at_, end_.force, end_.w);
  const auto [supplied, lost] = end_at_.power(end_);
  end_state_.supply_power = supplied;
  end_state_.loss_power = lost;
  finish_end(end_.w);
  reset_event_detection();
  before_compensation_ = end_;
}

bool TreeRadau::step(double t_end) {
  if (control_.advance(*this, t_end, tolerance_, n_ + 1, counters_)) return true;
  std::vector<std::pair<double, int>> residuals;
  for (const int j : tree_->laws()) residuals.emplace_back(stages_.residual(j), j);
  failure_ = no_step_message(system_, begin_state_, control_.next, std::move(residuals), control_.last_event(system_, begin_.t - control_.usual));
  return false;
}

void TreeRadau::begin_at_end() {
  begin_ = end_;
  begin_state_ = end_state_;
}

// Fills in the bodies' state at the end of the step, with the reactions for u' = w.
void TreeRadau::finish_end(const VectorXd& w) {
  end_at_.write(end_, w, end_state_);
  grow_load_scale(system_, end_at_.pose().m, end_at_.Q(), end_state_, scale_);
}

}  // namespace pintle
