// Steps over a joint tree end where a law or a load has a kink or a jump. theory/time section 7, as RadauStepper.
#include <algorithm>
#include <limits>

#include "integrators/relative/tree_radau.h"

namespace pintle {
namespace {

// Gaps and the laws' states a time d later, by Taylor's series.
void move_carried(double d, TreeState& at) {
  at.gap += d * at.rate + 0.5 * d * d * at.accel;
  at.rate += d * at.accel;
  for (std::size_t z = 0; z < at.law_state.size(); ++z) at.law_state[z] += d * at.law_rate[z];
}

}  // namespace

// The switching functions at share x of the step, on the curve through its stages.
void TreeRadau::find_switching(double x, double h, double* value) {
  TreeState at;
  at.u = begin_.u;
  at.law_state = begin_.law_state;
  at.y = begin_.y + x * h * begin_.u;
  at.rate = begin_.rate;
  at.gap = begin_.gap + x * h * begin_.rate;
  for (int i = 0; i < n_; ++i) {
    double power = x, first = 0, second = 0;
    for (int k = 0; k < n_; ++k, power *= x) {
      first += table_.stages_to_powers(k, i) * power / (k + 1);
      second += table_.stages_to_powers(k, i) * power * x / ((k + 1) * (k + 2));
    }
    const TreeState& stage = stages_.states()[i];
    at.u += h * first * stage.w;
    at.y += h * h * second * stage.w;
    at.rate += h * first * stage.accel;
    at.gap += h * h * second * stage.accel;
    for (std::size_t z = 0; z < at.law_state.size(); ++z) at.law_state[z] += h * first * stage.law_rate[z];
  }
  inside_at_.place_only(begin_.t + x * h, at.y, at.u);
  inside_at_.find_switching(at, value);
}

// The same a time d ahead of the start, by Taylor's series: all there is to go by when the stages are not solved.
void TreeRadau::find_switching_ahead(double d, double* value) {
  const double half = 0.5 * d * d;
  inside_at_.place_only(begin_.t + d, begin_.y + d * begin_.u + half * begin_.w, begin_.u + d * begin_.w);
  TreeState at = begin_;
  move_carried(d, at);
  inside_at_.find_switching(at, value);
}

SwitchingEvent TreeRadau::locate_event(double h, bool solved) {
  if (!system_.has_branches()) return {};
  return search_.first(table_, [&](double x, double* value) { solved ? find_switching(x, h, value) : find_switching_ahead(x * h, value); });
}

// Moves the end over the event that it stands just before, by Taylor's series.
void TreeRadau::step_over_event(double distance, const SwitchingEvent& event) {
  const double beyond = std::max(StepControl::kCrossing * control_.usual, 4 * std::numeric_limits<double>::epsilon() * std::abs(end_.t));
  search_.step_over(event, distance, beyond, [this](double d, double* value) {
    const double half = 0.5 * d * d;
    end_.t += d;
    end_state_.supplied += d * end_state_.supply_power;
    end_state_.dissipated += d * end_state_.loss_power;
    end_.y += d * end_.u + half * end_.w;
    end_.u += d * end_.w;
    move_carried(d, end_);
    end_at_.place(end_.t, end_.y, end_.u);
    end_at_.find_switching(end_, value);
  });
}

// Over the event; forces and accelerations renewed there. A jump that comes back at once is held.
void TreeRadau::cross_event(double distance, const SwitchingEvent& event) {
  const double before = end_.t;
  const std::vector<Planar::Motion> motions_before = end_at_.pose().m;
  step_over_event(distance, event);
  const bool crossed = end_at_.cross_borders(search_.start(), search_.end(), end_, end_state_.dissipated);
  leave_sliding(system_, end_.t, end_at_.pose().m, sliding_);
  balance_end();
  if (crossed) record_crossings(system_, end_state_, search_.start(), search_.end(), crossings_);
  if (const auto jump = chattering_.crossed(system_, before, motions_before, end_.t, end_at_.pose().m, StepControl::kAtOnce * control_.usual)) {
    const double margin = system_.margin(*jump, end_.t, end_at_.pose().m);
    enter_sliding(*jump, margin, ramp_size(system_, *jump, end_state_, control_.usual, tolerance_), sliding_, [this] { balance_end(); },
              [&] { return margin_rate(*jump); });
  }
  restart_search();
  control_.have_history = false;
}

// How fast the argument of a jump changes at the end, by what it is a moment later.
double TreeRadau::margin_rate(const SlidingMode& jump) {
  const double d = StepControl::kMoment * control_.usual;
  inside_at_.place_only(end_.t + d, end_.y + d * end_.u, end_.u + d * end_.w);
  return (system_.margin(jump, inside_at_.t(), inside_at_.pose().m) - system_.margin(jump, end_.t, end_at_.pose().m)) / d;
}

// What the laws and loads really give at the end.
void TreeRadau::balance_end() {
  end_at_.place(end_.t, end_.y, end_.u);
  end_at_.forces(end_, end_.force, end_.law_rate);
  if (projector_.prepare(end_at_, 1, end_)) projector_.accelerations(end_at_, end_.force, end_.w);
  end_at_.accelerate(end_.w);
  end_at_.gap_accelerations(end_.accel);
  const auto [supplied, lost] = end_at_.power(end_);
  end_state_.supply_power = supplied;
  end_state_.loss_power = lost;
  finish_end(end_.w);
}

}  // namespace pintle
