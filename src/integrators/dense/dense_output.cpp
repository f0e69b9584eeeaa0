#include "integrators/dense/dense_output.h"

#include <array>
#include <type_traits>

#include "base/cubic_hermite.h"
#include "integrators/force_evaluator.h"

namespace pintle {
namespace {

// Values of the six quintic Hermite functions and their first two derivatives at s in [0, 1]: for f, h f', h^2 f'' at the
// start and at the end.
struct Hermite {
  std::array<double, 6> f, df, ddf;
  explicit Hermite(double s) {
    const double s2 = s * s, s3 = s2 * s, s4 = s3 * s, s5 = s4 * s;
    f = {1 - 10 * s3 + 15 * s4 - 6 * s5, s - 6 * s3 + 8 * s4 - 3 * s5, (s2 - 3 * s3 + 3 * s4 - s5) / 2,
         10 * s3 - 15 * s4 + 6 * s5, -4 * s3 + 7 * s4 - 3 * s5, (s3 - 2 * s4 + s5) / 2};
    df = {-30 * s2 + 60 * s3 - 30 * s4, 1 - 18 * s2 + 32 * s3 - 15 * s4, (2 * s - 9 * s2 + 12 * s3 - 5 * s4) / 2,
          30 * s2 - 60 * s3 + 30 * s4, -12 * s2 + 28 * s3 - 15 * s4, (3 * s2 - 8 * s3 + 5 * s4) / 2};
    ddf = {-60 * s + 180 * s2 - 120 * s3, -36 * s + 96 * s2 - 60 * s3, (2 - 18 * s + 36 * s2 - 20 * s3) / 2,
           60 * s - 180 * s2 + 120 * s3, -24 * s + 84 * s2 - 60 * s3, (6 * s - 24 * s2 + 20 * s3) / 2};
  }
};

// Curve through (x, x', x'') at both ends: written so that only the increment is interpolated.
template <class Vecs>
void interpolate(const Hermite& H, double h, const Vecs& x0, const Vecs& v0, const Vecs& a0, const Vecs& x1, const Vecs& v1, const Vecs& a1, Vecs& x, Vecs& v,
                 Vecs& a) {
  using Vec = typename Vecs::value_type;
  for (std::size_t i = 0; i < x0.size(); ++i) {
    const Vec d = x1[i] - x0[i], hv0 = h * v0[i], hv1 = h * v1[i], ha0 = h * h * a0[i], ha1 = h * h * a1[i];
    x[i] = x0[i] + H.f[3] * d + H.f[1] * hv0 + H.f[4] * hv1 + H.f[2] * ha0 + H.f[5] * ha1;
    v[i] = (H.df[3] * d + H.df[1] * hv0 + H.df[4] * hv1 + H.df[2] * ha0 + H.df[5] * ha1) / h;
    a[i] = (H.ddf[3] * d + H.ddf[1] * hv0 + H.ddf[4] * hv1 + H.ddf[2] * ha0 + H.ddf[5] * ha1) / (h * h);
  }
}

}  // namespace

template <class S>
BasicDenseOutput<S>::BasicDenseOutput(const BasicSystem<S>& system)
    : system_(system), out_(zero_state(system)) {
  for (int j = 0; j < system.n_joints(); ++j)
    if (has_slip(system.joints[j].displacement)) slipping_.push_back(static_cast<std::size_t>(j));
}

template <class S>
const BasicState<S>& BasicDenseOutput<S>::at(double t, const BasicState<S>& begin, const BasicState<S>& end) {
  if (t == end.t) return end;
  if (t == begin.t) return begin;
  const double h = end.t - begin.t, s = (t - begin.t) / h;
  const Hermite H(s);
  if constexpr (S::kCurved) {  // cubic curves for increments and velocities: accelerations are not the increments' second derivatives
    const double r = 1 - s;
    for (std::size_t i = 0; i < out_.q.size(); ++i) {
      const typename S::Vec dq = S::difference(end.q[i], begin.q[i]), rate = S::rate_of_increment(dq, end.v[i]);
      out_.q[i] = S::moved(begin.q[i], cubic_blend(s) * dq + h * s * r * (r * begin.v[i] - s * rate));
      out_.v[i] = cubic_hermite(s, h, begin.v[i], begin.a[i], end.v[i], end.a[i]);
      out_.a[i] = cubic_hermite_slope(s, h, begin.v[i], begin.a[i], end.v[i], end.a[i]);
    }
  } else {
    interpolate(H, h, begin.q, begin.v, begin.a, end.q, end.v, end.a, out_.q, out_.v, out_.a);
  }
  interpolate(H, h, begin.gap, begin.gap_rate, begin.gap_accel, end.gap, end.gap_rate, end.gap_accel, out_.gap, out_.gap_rate,
              out_.gap_accel);
  for (const std::size_t j : slipping_) {  // states need not contain the distance that surfaces have slipped
    const double v0 = begin.gap_rate[j][kSlip], v1 = end.gap_rate[j][kSlip], a0 = begin.gap_accel[j][kSlip], a1 = end.gap_accel[j][kSlip];
    out_.gap[j][kSlip] = begin.gap[j][kSlip];
    out_.gap_rate[j][kSlip] = cubic_hermite(s, h, v0, a0, v1, a1);
    out_.gap_accel[j][kSlip] = cubic_hermite_slope(s, h, v0, a0, v1, a1);
  }
  out_.t = t;
  out_.sliding = begin.sliding;
  out_.dissipated = cubic_hermite(s, h, begin.dissipated, begin.loss_power, end.dissipated, end.loss_power);
  out_.supplied = cubic_hermite(s, h, begin.supplied, begin.supply_power, end.supplied, end.supply_power);
  for (std::size_t z = 0; z < out_.law_state.size(); ++z)
    out_.law_state[z] = cubic_hermite(s, h, begin.law_state[z], begin.law_rate[z], end.law_state[z], end.law_rate[z]);
  find_joint_forces(system_, out_);
  find_law_rates(system_, out_);
  return out_;
}

template <class S>
const BasicState<S>& BasicDenseOutput<S>::at(double t, const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes) {
  if (t == end.t) return end;
  if (t == begin.t) return begin;
  if (!dense_forces_) make_room();
  if (begin.t != curves_from_ || end.t != curves_to_) {
    find_curves(begin, end, nodes);
    find_forces(begin, end, nodes);
  }
  follow(t, begin, end);
  follow_states((t - begin.t) / (end.t - begin.t), nodes);
  return out_;
}

// Storage for the curves: many runs need none.
template <class S>
void BasicDenseOutput<S>::make_room() {
  dense_forces_ = make_dense_forces(system_);
  body_.resize(system_.bodies.size());
  gap_.resize(system_.joints.size());
  if (S::kCurved) increment_.resize(system_.bodies.size());
  force_.resize(system_.joints.size());
}

// The state on the curves, at time t.
template <class S>
void BasicDenseOutput<S>::follow(double t, const BasicState<S>& begin, const BasicState<S>& end) {
  const double h = end.t - begin.t, x = (t - begin.t) / h;
  const CurveWeights weights(x, h);
  const auto &value = weights.value, &first = weights.first, &second = weights.second;
  const auto along = [&](const std::vector<Curve>& curves, const auto& x0, const VecsOf<S>& v0, auto& position, VecsOf<S>& rate, VecsOf<S>& accel) {
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const Curve& curve = curves[i];
      typename S::Vec a = curve.c[0], v = v0[i] + x * curve.bend_v + first[0] * a, q;
      constexpr bool flat = std::is_same_v<std::decay_t<decltype(x0[i])>, typename S::Vec>;
      if constexpr (flat) q = x0[i] + x * h * v0[i] + weights.end_mismatch_weight * curve.bend_q + second[0] * a;
      for (int k = 1; k < n_; ++k) {
        a += value[k] * curve.c[k];
        v += first[k] * curve.c[k];
        if constexpr (flat) q += second[k] * curve.c[k];
      }
      accel[i] = a;
      rate[i] = v;
      if constexpr (flat) position[i] = q;
    }
  };
  out_.t = t;
  out_.sliding = begin.sliding;
  along(body_, begin.q, begin.v, out_.q, out_.v, out_.a);
  if constexpr (S::kCurved)
    for (std::size_t i = 0; i < increment_.size(); ++i) {
      typename S::Vec dq = weights.end_mismatch_weight * increment_bend_[i];
      for (int k = 0; k < n_; ++k) dq += first[k] * increment_[i][k];
      out_.q[i] = S::moved(begin.q[i], dq);
    }
  along(gap_, begin.gap, begin.gap_rate, out_.gap, out_.gap_rate, out_.gap_accel);
  for (std::size_t j = 0; j < force_.size(); ++j) {
    typename S::Vec f = force_[j][0];
    for (int k = 1; k < n_force_; ++k) f += value[k] * force_[j][k];
    out_.force[j] = f;
  }
  std::array<double, 2> work = {x * bend_work_[0], x * bend_work_[1]};
  for (int k = 0; k < n_; ++k)
    for (int i = 0; i < 2; ++i) work[i] += first[k] * power_[k][i];
  out_.supplied = begin.supplied + work[0];
  out_.dissipated = begin.dissipated + work[1];
}

// The laws' own states on the polynomial through the nodes.
template <class S>
void BasicDenseOutput<S>::follow_states(double x, const BasicStepNodes<S>& nodes) {
  if (out_.law_state.empty()) return;
  const RadauTable::Vec weight = nodes.table->weights(x);
  for (std::size_t z = 0; z < out_.law_state.size(); ++z) {
    out_.law_state[z] = out_.law_rate[z] = 0;
    for (int node = 0; node <= nodes.table->n; ++node) {
      out_.law_state[z] += weight[node] * nodes.law_state[node][z];
      out_.law_rate[z] += weight[node] * nodes.law_rate[node][z];
    }
  }
}

// Powers of x from values at the nodes; what is left at the far end goes into bends.
template <class S>
void BasicDenseOutput<S>::find_curves(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes) {
  const RadauTable& table = *nodes.table;
  n_ = table.n + 1;
  curves_from_ = begin.t;
  curves_to_ = end.t;
  const double h = end.t - begin.t;
  const auto coefficient = [&](int k, const std::vector<VecsOf<S>>& values, std::size_t i) {
    typename S::Vec c = S::Vec::Zero();
    for (int node = 0; node < n_; ++node) c += table.to_powers(k, node) * values[node][i];
    return c;
  };
  const auto find = [&](std::vector<Curve>& curves, const std::vector<VecsOf<S>>& a, const auto& x0, const VecsOf<S>& v0, const auto& x1, const VecsOf<S>& v1) {
    for (std::size_t i = 0; i < curves.size(); ++i) {
      Curve& curve = curves[i];
      curve.bend_v = v1[i] - v0[i];
      constexpr bool flat = std::is_same_v<std::decay_t<decltype(x0[i])>, typename S::Vec>;
      if constexpr (flat) curve.bend_q = x1[i] - x0[i] - h * v0[i];
      for (int k = 0; k < n_; ++k) {
        curve.c[k] = coefficient(k, a, i);
        curve.bend_v -= CurveWeights::first_integral_at_end(k, h) * curve.c[k];
        curve.bend_q -= CurveWeights::second_integral_at_end(k, h) * curve.c[k];
      }
    }
  };
  find(body_, nodes.a, begin.q, begin.v, end.q, end.v);
  for (std::size_t i = 0; i < increment_.size(); ++i)
    for (int k = 0; k < n_; ++k) increment_[i][k] = coefficient(k, nodes.increment_rate, i);
  if (S::kCurved) increment_bend_ = nodes.increment_bend;
  find(gap_, nodes.gap_accel, begin.gap, begin.gap_rate, end.gap, end.gap_rate);
  bend_work_ = {end.supplied - begin.supplied, end.dissipated - begin.dissipated};
  for (int k = 0; k < n_; ++k) {
    for (int i = 0; i < 2; ++i) {
      power_[k][i] = 0;
      for (int node = 0; node < n_; ++node) power_[k][i] += table.to_powers(k, node) * nodes.power[node][i];
      bend_work_[i] -= CurveWeights::first_integral_at_end(k, h) * power_[k][i];
    }
  }
}

// The forces' own curves: through the ends and the samples inside. theory/time section 5.
template <class S>
void BasicDenseOutput<S>::find_forces(const BasicState<S>& begin, const BasicState<S>& end, const BasicStepNodes<S>& nodes) {
  dense_forces_->find(begin, end, nodes, sampled_);
  const auto& to_powers = ForceSamples::of(*nodes.table).to_powers;
  n_force_ = ForceSamples::kAll;
  for (std::size_t j = 0; j < force_.size(); ++j)
    for (int k = 0; k < n_force_; ++k) {
      force_[j][k].setZero();
      for (int i = 0; i < n_force_; ++i) force_[j][k] += to_powers[k][i] * sampled_[i][j];
    }
}

template class BasicDenseOutput<Planar>;
PINTLE_IN_SPACE(template class BasicDenseOutput<Spatial>;)

}  // namespace pintle
