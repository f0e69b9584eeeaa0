// A tree and its gaps inside a step, ahead of it and beyond its end, as needed for its events. theory/time section 7.
#include <algorithm>
#include <cmath>

#include "integrators/load_scale.h"
#include "integrators/radau/step_events.h"
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

void TreeRadau::evaluate_switching_functions(double x, double h, double* value) {
  TreeState at;
  at.u = begin_.u;
  at.law_state = begin_.law_state;
  at.y = begin_.y + x * h * begin_.u;
  at.rate = begin_.rate;
  at.gap = begin_.gap + x * h * begin_.rate;
  const auto [first, second] = table_.stage_integrals(x);
  for (int i = 0; i < n_; ++i) {
    const TreeState& stage = stages_.states()[i];
    at.u += h * first[i] * stage.w;
    at.y += h * h * second[i] * stage.w;
    at.rate += h * first[i] * stage.accel;
    at.gap += h * h * second[i] * stage.accel;
    for (std::size_t z = 0; z < at.law_state.size(); ++z) at.law_state[z] += h * first[i] * stage.law_rate[z];
  }
  inside_at_.place_only(begin_.t + x * h, at.y, at.u);
  const auto first_gap = [this](int j) { return 3 * law_index(j); };
  Planar::Vec gap, rate;  // a law's point refers to them
  const auto start = [&](int j) {
    gap = begin_.gap.segment<3>(first_gap(j));
    rate = begin_.rate.segment<3>(first_gap(j));
    return LawPoint{begin_.t, gap, rate, begin_.law_state.data() + system_.joints[j].first_state};
  };
  open_contacts_.follow_positions(start, [&](int j) { return inside_at_.kinematics(static_cast<int>(law_index(j))); }, [&](int j) { return Planar::Vec(at.gap.segment<3>(first_gap(j))); },
                                  largest_coordinate(inside_at_.pose().q), [&](int j, const JointKinematics& r) {
                                    at.gap.segment<3>(first_gap(j)) = r.gap;
                                    at.rate.segment<3>(first_gap(j)) = r.rate;
                                  });
  inside_at_.evaluate_switching_functions(at, value);
}

void TreeRadau::extrapolate_switching_functions(double d, double* value) {
  const double half = 0.5 * d * d;
  inside_at_.place_only(begin_.t + d, begin_.y + d * begin_.u + half * begin_.w, begin_.u + d * begin_.w);
  TreeState at = begin_;
  move_carried(d, at);
  inside_at_.evaluate_switching_functions(at, value);
}

bool TreeRadau::forces_stay_constant(double d) {
  const double most = most_force_change(tolerance_);
  const double near = kShareBeforeEvent * d;
  inside_at_.place(begin_.t + near, begin_.y + near * begin_.u + 0.5 * near * near * begin_.w, begin_.u + near * begin_.w);
  TreeState at = begin_;
  at.t += near;
  move_carried(near, at);
  Eigen::VectorXd force;
  inside_at_.forces(at, force, at.law_rate);
  for (std::size_t l = 0; l < tree_->laws().size(); ++l) {
    const Planar::Vec load = load_on(system_.joints[tree_->laws()[l]].at, scale_);
    for (int k = 0; k < 3; ++k)
      if (const Eigen::Index i = 3 * static_cast<Eigen::Index>(l) + k; !(std::abs(force[i] - begin_.force[i]) <= most * load[k])) return false;
  }
  return loads_stay_constant(system_, begin_.t, near, end_at_.pose().m, sliding_, most, scale_, loads_now_, loads_then_);
}

void TreeRadau::extrapolate_end_state(double d) {
  const double near = kShareBeforeEvent * d;
  TreeState later = end_;
  later.t += near;
  move_carried(near, later);
  inside_at_.place(later.t, end_.y + near * end_.u + 0.5 * near * near * end_.w, end_.u + near * end_.w);
  inside_at_.forces(later, later.force, later.law_rate);
  const auto [supplied, lost] = inside_at_.power(later);
  end_.t += d;
  end_state_.supplied += 0.5 * d * (end_state_.supply_power + supplied);
  end_state_.dissipated += 0.5 * d * (end_state_.loss_power + lost);
  end_.y += d * end_.u + 0.5 * d * d * end_.w;
  end_.u += d * end_.w;
  move_carried(d, end_);
  end_at_.place(end_.t, end_.y, end_.u);
}

const std::vector<Planar::Motion>& TreeRadau::motions_after(double d) {
  inside_at_.place_only(end_.t + d, end_.y + d * end_.u, end_.u + d * end_.w);
  return inside_at_.pose().m;
}

// Driven joints are servos or distances, which are never replaced by coordinates of the tree.
void TreeRadau::shift_gap(int joint, double d, double rate) {
  const std::vector<int>& laws = tree_->laws();
  const auto at = std::find(laws.begin(), laws.end(), joint);
  if (at == laws.end()) return;
  const JointData& driven = system_.joints[static_cast<std::size_t>(joint)];
  const Eigen::Index first = 3 * (at - laws.begin());
  const auto stored = [&] { return driven.law.energy({end_.t, end_.gap.segment<3>(first), end_.rate.segment<3>(first), end_.law_state.data() + driven.first_state}); };
  const double before = stored();
  end_.gap[first + driven.driven] += d;
  end_.rate[first + driven.driven] += rate;
  if (driven.servo < 0) end_state_.supplied += stored() - before;
}

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

void TreeRadau::compensate_late_crossing(double late) {
  before_compensation_ = end_;
  supplied_before_ = end_state_.supplied;
  dissipated_before_ = end_state_.dissipated;
  end_.u += late * (end_.w - begin_.w);
  end_.rate += late * (end_.accel - begin_.accel);
  end_state_.supplied += late * (end_state_.supply_power - begin_state_.supply_power);
  end_state_.dissipated += late * (end_state_.loss_power - begin_state_.loss_power);
  balance_end();
}

void TreeRadau::undo_compensation() {
  end_ = before_compensation_;
  end_state_.supplied = supplied_before_;
  end_state_.dissipated = dissipated_before_;
  balance_end();
}

}  // namespace pintle
