// The stage solver's first guess. Included where it is compiled for registers of several widths.
#pragma once

#include <algorithm>
#include <array>

#include "integrators/absolute/lane_stage_solver.h"
#include "simd/fetch.h"

namespace pintle {

// Accelerations at the stages, extrapolated from the last step's curve; without one those at the start.
template <class S, int N>
struct LaneStageSolver<S, N>::Curve {
  const BasicStepNodes<S>* nodes;
  std::array<L, RadauTable::kMaxNodes> weight;

  Curve(const RadauTable& table, const Predictor& predictor, double h, const BasicStepNodes<S>* before, double last_h) : nodes(before) {
    for (int s = 0; s < N && before; ++s) {
      const double ratio = h / last_h;
      const RadauTable::Vec w = predictor.weights(table, table.c[s], ratio);
      for (int k = 0; k <= N; ++k) weight[k].set(s, w[k]);
    }
  }
  L ahead(const std::vector<VecsOf<S>> BasicStepNodes<S>::*of, const VecsOf<S>& start, std::size_t i, int k) const {
    if (!nodes) return L::all(start[i][k]);
    const std::vector<VecsOf<S>>& node = nodes->*of;
    L x = node[0][i][k] * weight[0];
    for (int n = 1; n <= N; ++n) x += node[n][i][k] * weight[n];
    return x;
  }
  L state_ahead(const std::vector<double>& start, std::size_t z) const {
    if (!nodes) return L::all(start[z]);
    L x = nodes->law_rate[0][z] * weight[0];
    for (int n = 1; n <= N; ++n) x += nodes->law_rate[n][z] * weight[n];
    return x;
  }
};

// Error at the end of the step, over the loads, of accelerations that are extrapolated with these weights of the last step's nodes.
template <class S, int N>
double LaneStageSolver<S, N>::extrapolation_error(const BasicStepNodes<S>& before, const RadauTable::Vec& weights) const {
  double worst = 0;
  for (std::size_t b = 0; b < n_bodies(); ++b)
    for (int k = 0; k < S::kDof; ++k) {
      double guess = 0;
      for (int n = 0; n <= N; ++n) guess += weights[n] * before.a[n][bodies_[b].index][k];
      worst = std::max(worst, bodies_[b].over_scale[k] * std::abs(guess - bodies_[b].a[k][N - 1]));
    }
  return worst;
}

// Prefetch what a large mechanism needs soon, past body b and past joint j: the solver's own data first, then the system's. All such
// functions are inlined by force: the compiler takes one that only prefetches for one that does nothing.
template <class S, int N>
PINTLE_LANES void LaneStageSolver<S, N>::fetch_body(const BasicState<S>& begin, const Curve& curve, const BasicLoadScale<S>& scale, std::size_t b) const {
  fetch(bodies_, b + kLater);
  if (b + kSoon >= n_bodies()) return;
  const int i = bodies_[b + kSoon].index;
  fetch(system_.bodies, i);
  fetch(begin.q, i);
  for (const VecsOf<S>* x : {&begin.v, &begin.a, &scale.body}) fetch(*x, i);
  for (int n = 0; n <= N && curve.nodes; ++n) fetch(curve.nodes->a[n], i);
}
template <class S, int N>
PINTLE_LANES void LaneStageSolver<S, N>::fetch_joint(const BasicState<S>& begin, const Curve* unplaced, std::size_t j) const {
  fetch(joints_, j + kLater);
  if (!unplaced || j + kSoon >= joints_.size()) return;
  const int i = joints_[j + kSoon].index;
  for (const VecsOf<S>* x : {&begin.gap, &begin.gap_rate, &begin.gap_accel}) fetch(*x, i);
  for (int n = 0; n <= N && unplaced->nodes; ++n) fetch(unplaced->nodes->gap_accel[n], i);
}

// The scale of corrections, and a first guess.
template <class S, int N>
void LaneStageSolver<S, N>::begin_bodies(const BasicState<S>& begin, const Curve& curve, const BasicLoadScale<S>& scale, std::size_t first, std::size_t end) {
  L angles = L::all(0);
  for (std::size_t b = first; b < end; ++b) {
    Body& body = bodies_[b];
    if (large_) fetch_body(begin, curve, scale, b);
    const typename S::Vec &mass = system_.bodies[body.index].mass, &load = scale.body[body.index];
    for (int k = 0; k < S::kDof; ++k) {
      body.over_scale[k] = mass[k] / load[k];
      body.a[k] = curve.ahead(&BasicStepNodes<S>::a, begin.a, body.index, k);
    }
    body.begin(step_, begin.q[body.index], begin.v[body.index]);
    angles = larger_size(angles, body.to_check());
  }
  check_angles(angles, first, end);
}

template <class S, int N>
void LaneStageSolver<S, N>::begin_joint(const BasicState<S>& begin, const Curve& curve, const BasicLoadScale<S>& scale, Joint& joint) {
  const typename S::Vec &on = scale.body[bodies_[joint.first].index], &beside = scale.body[bodies_[joint.last].index];
  for (int k = 0; k < S::kDof; ++k) {
    joint.over_scale[k] = 1 / std::max(on[k], beside[k]);
    joint.accel[k] = curve.ahead(&BasicStepNodes<S>::gap_accel, begin.gap_accel, joint.index, k);
  }
  if (!joint.linear) {
    General& general = general_[joint.general];
    const int first_state = system_.joints[joint.index].first_state;
    for (std::size_t z = 0; z < general.rate.size(); ++z) general.rate[z] = curve.state_ahead(begin.law_rate, first_state + z);
  }
  L change = L::all(0), sum = change;
  place_joint(begin, joint, change, sum);
}

// The accelerations prescribed for driven components.
template <class S, int N>
void LaneStageSolver<S, N>::find_targets(double t, double h) {
  for (std::size_t j = 0; j < target_accel_.size(); ++j) {
    const BasicJointData<S>& joint = system_.joints[j];
    if (joint.driven < 0 || joint.target.variables().empty()) continue;
    for (int s = 0; s < N; ++s) target_accel_[j].set(s, target_of(joint, t + table_.c[s] * h)[2]);
  }
}

}  // namespace pintle
