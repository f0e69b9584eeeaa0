#include "integrators/dense_output.h"

#include <array>

namespace pintle {
namespace {

using S = Planar;

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
void interpolate(const Hermite& H, double h, const Vecs& x0, const Vecs& v0, const Vecs& a0, const Vecs& x1, const Vecs& v1,
                 const Vecs& a1, Vecs& x, Vecs& v, Vecs& a) {
  x.resize(x0.size());
  v.resize(x0.size());
  a.resize(x0.size());
  for (std::size_t i = 0; i < x0.size(); ++i) {
    const S::Vec d = x1[i] - x0[i], hv0 = h * v0[i], hv1 = h * v1[i], ha0 = h * h * a0[i], ha1 = h * h * a1[i];
    x[i] = x0[i] + H.f[3] * d + H.f[1] * hv0 + H.f[4] * hv1 + H.f[2] * ha0 + H.f[5] * ha1;
    v[i] = (H.df[3] * d + H.df[1] * hv0 + H.df[4] * hv1 + H.df[2] * ha0 + H.df[5] * ha1) / h;
    a[i] = (H.ddf[3] * d + H.ddf[1] * hv0 + H.ddf[4] * hv1 + H.ddf[2] * ha0 + H.ddf[5] * ha1) / (h * h);
  }
}

// Weights of the values at the nodes in a curve, its first and its second integral, at x.
struct NodeWeights {
  RadauTable::Vec value, first, second;
  NodeWeights(const RadauTable& table, double x) {
    const int n = table.n + 1;
    value = first = second = RadauTable::Vec::Zero(n);
    for (int i = 0; i < n; ++i) {
      double power = 1;
      for (int k = 0; k < n; ++k, power *= x) {
        const double c = table.to_powers(k, i) * power;
        value[i] += c;
        first[i] += c * x / (k + 1);
        second[i] += c * x * x / ((k + 1) * (k + 2));
      }
    }
  }
};

// The curve whose second derivative goes through `nodes`, bent by rounding-sized amounts to meet the far end.
void integrate(const NodeWeights& at, const NodeWeights& end, double s, double h, const std::vector<Vecs>& nodes, const Vecs& x0,
               const Vecs& v0, const Vecs& x1, const Vecs& v1, Vecs& x, Vecs& v, Vecs& a) {
  x.resize(x0.size());
  v.resize(x0.size());
  a.resize(x0.size());
  for (std::size_t i = 0; i < x0.size(); ++i) {
    S::Vec value = S::Vec::Zero(), first = value, second = value, first_end = value, second_end = value;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const S::Vec& node = nodes[k][i];
      value += at.value[k] * node;
      first += at.first[k] * node;
      second += at.second[k] * node;
      first_end += end.first[k] * node;
      second_end += end.second[k] * node;
    }
    a[i] = value;
    v[i] = v0[i] + h * first + s * (v1[i] - v0[i] - h * first_end);
    x[i] = x0[i] + s * h * v0[i] + h * h * second + s * s * (3 - 2 * s) * (x1[i] - x0[i] - h * v0[i] - h * h * second_end);
  }
}

double cubic(double s, double h, double x0, double v0, double x1, double v1) {
  const double r = 1 - s;
  return x0 + s * s * (3 - 2 * s) * (x1 - x0) + h * s * r * (r * v0 - s * v1);
}

}  // namespace

DenseOutput::DenseOutput(const System& system)
    : system_(system), projector_(system), wanted_(system.joints.size()), move_(system.bodies.size()) {}

const State& DenseOutput::at(double t, const State& begin, const State& end, double mu) {
  if (t == end.t) return end;
  if (t == begin.t) return begin;
  const double h = end.t - begin.t, s = (t - begin.t) / h;
  const Hermite H(s);
  interpolate(H, h, begin.q, begin.v, begin.a, end.q, end.v, end.a, out_.q, out_.v, out_.a);
  interpolate(H, h, begin.gap, begin.gap_rate, begin.gap_accel, end.gap, end.gap_rate, end.gap_accel, out_.gap, out_.gap_rate,
              out_.gap_accel);
  out_.t = t;
  out_.dissipated = cubic(s, h, begin.dissipated, begin.loss_power, end.dissipated, end.loss_power);
  out_.supplied = cubic(s, h, begin.supplied, begin.supply_power, end.supplied, end.supply_power);
  find_forces(mu);
  return out_;
}

const State& DenseOutput::at(double t, const State& begin, const State& end, double mu, const StepNodes& nodes) {
  if (t == end.t) return end;
  if (t == begin.t) return begin;
  const double h = end.t - begin.t, s = (t - begin.t) / h;
  const NodeWeights here(*nodes.table, s), far(*nodes.table, 1);
  integrate(here, far, s, h, nodes.a, begin.q, begin.v, end.q, end.v, out_.q, out_.v, out_.a);
  integrate(here, far, s, h, nodes.gap_accel, begin.gap, begin.gap_rate, end.gap, end.gap_rate, out_.gap, out_.gap_rate,
            out_.gap_accel);
  out_.t = t;
  double supplied = 0, lost = 0, supplied_end = 0, lost_end = 0;
  for (int k = 0; k <= nodes.table->n; ++k) {
    supplied += here.first[k] * nodes.power[k][0];
    lost += here.first[k] * nodes.power[k][1];
    supplied_end += far.first[k] * nodes.power[k][0];
    lost_end += far.first[k] * nodes.power[k][1];
  }
  out_.supplied = begin.supplied + h * supplied + s * (end.supplied - begin.supplied - h * supplied_end);
  out_.dissipated = begin.dissipated + h * lost + s * (end.dissipated - begin.dissipated - h * lost_end);
  find_forces(mu);
  return out_;
}

// theory/time section 5.
void DenseOutput::find_forces(double mu) {
  out_.force.resize(system_.joints.size());
  for (int j = 0; j < system_.n_joints(); ++j) out_.force[j] = law_force(system_.joints[j].law, out_.gap[j], out_.gap_rate[j]);
  system_.motions(out_.q, out_.v, m_);
  if (!projector_.prepare(out_.t, m_, mu, out_.gap, out_.gap_rate)) return;
  const std::vector<Reading>& r = projector_.readings();
  const auto from_bodies = [&](int j, const Vecs& x) {
    const Placement& at = system_.joints[j].at;
    S::Vec y = S::Vec::Zero();
    if (at.a != kGround) y += r[j].GA * x[at.a];
    if (at.b != kGround) y += r[j].GB * x[at.b];
    return y;
  };
  for (auto& x : move_) x.setZero();
  for (int pass = 0; pass < 2; ++pass) {
    for (int j = 0; j < system_.n_joints(); ++j) wanted_[j] = out_.gap_rate[j] - r[j].rate - from_bodies(j, move_);
    projector_.close(wanted_, move_);
  }
  for (std::size_t i = 0; i < move_.size(); ++i) out_.v[i] += move_[i];
  // The convective term at the corrected velocities; the Jacobians stay.
  system_.motions(out_.q, out_.v, m_);
  for (int pass = 0; pass < 2; ++pass) {
    for (int j = 0; j < system_.n_joints(); ++j)
      wanted_[j] = out_.gap_accel[j] - system_.reading(j, out_.t, m_).bias - from_bodies(j, out_.a);
    projector_.close(wanted_, out_.a);
  }
  system_.external(out_.t, m_, Q_);
  for (int pass = 0; pass < 3; ++pass) projector_.improve_forces(Q_, out_.a, out_.force);
}

}  // namespace pintle
