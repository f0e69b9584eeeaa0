#include "integrators/general/dopri5.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "integrators/dormand_prince.h"
#include "integrators/thresholds.h"

namespace pintle {
namespace {

using S = Planar;

using namespace dormand_prince;

}  // namespace

Dopri5::Dopri5(const System& system, double tolerance)
    : system_(system), force_evaluator_(system), borders_(system), tolerance_(tolerance), q_(system.bodies.size()), v_(system.bodies.size()), dq_(system.bodies.size()),
      dv_(system.bodies.size()) {
  for (auto* k : {&kq_, &kv_})
    for (auto& x : *k) x.resize(system.bodies.size());
  z_.resize(system.n_law_states());
  for (auto& k : kz_) k.resize(z_.size());
  scale_.body.assign(system.bodies.size(), S::Vec::Zero());
}

void Dopri5::start(const State& state, double h) {
  begin_ = end_ = state;
  h_ = h;
  complete(end_);
  borders_.start(end_);
  std::vector<int> all(system_.joints.size());
  std::iota(all.begin(), all.end(), 0);
  rounding_ = loads_above_rounding(system_, all, end_, tolerance_);
  grow_scale();
}

bool Dopri5::step(double t_end) {
  begin_ = end_;
  double h = max_step_ > 0 ? std::min(h_, max_step_) : h_;
  kq_[0] = begin_.v;
  kv_[0] = begin_.a;
  kz_[0] = begin_.law_rate;
  borders_.begin_step();
  while (true) {
    h = std::min(h, t_end - begin_.t);
    if (h <= kLastBits * std::abs(t_end)) {
      failure_ = fmt::format("the step size became too small at t = {:.9g} s", begin_.t);
      return false;
    }
    for (int s = 1; s < 7; ++s) {
      for (std::size_t i = 0; i < q_.size(); ++i) {
        q_[i].setZero();
        v_[i].setZero();
        for (int k = 0; k < s; ++k) {
          q_[i] += kA[s][k] * kq_[k][i];
          v_[i] += kA[s][k] * kv_[k][i];
        }
        q_[i] = begin_.q[i] + h * q_[i];
        v_[i] = begin_.v[i] + h * v_[i];
      }
      for (std::size_t z = 0; z < z_.size(); ++z) {
        z_[z] = begin_.law_state[z];
        for (int k = 0; k < s; ++k) z_[z] += h * kA[s][k] * kz_[k][z];
      }
      kq_[s] = v_;
      system_.accelerations(begin_.t + kC[s] * h, q_, v_, kv_[s], z_.data(), kz_[s].data());
      ++counters_.evaluations;
    }
    const double e = error(h) / tolerance_;
    const double factor = step_ratio(e);
    if (is_accepted(e, h, t_end)) {
      end_.t = end_of_step(begin_.t, h, t_end);
      end_.q = q_;
      end_.v = v_;
      end_.law_state = z_;
      complete(end_);
      if (borders_.shorten(end_, h)) {
        ++counters_.rejected;
        continue;
      }
      end_.dissipated = begin_.dissipated + 0.5 * h * (begin_.loss_power + end_.loss_power);
      end_.supplied = begin_.supplied + 0.5 * h * (begin_.supply_power + end_.supply_power);
      if (borders_.cross(end_)) {
        complete(end_);
        borders_.record(end_);
      }
      grow_scale();
      ++counters_.steps;
      h_ = borders_.has_shortened() ? std::max(h_, h * factor) : h * factor;
      return true;
    }
    ++counters_.rejected;
    h *= std::min(factor, 0.8);
  }
}

// The embedded error as a joint force: by how much errors of positions and velocities change the laws' forces, over the loads.
double Dopri5::error(double h) {
  for (std::size_t i = 0; i < q_.size(); ++i) {
    dq_[i].setZero();
    dv_[i].setZero();
    for (int s = 0; s < 7; ++s) {
      dq_[i] += kE[s] * h * kq_[s][i];
      dv_[i] += kE[s] * h * kv_[s][i];
    }
  }
  system_.motions(q_, v_, m_);
  system_.joint_kinematics(begin_.t + h, m_, r_);
  double worst = 0;
  for (int j = 0; j < system_.n_joints(); ++j) {
    const JointData& joint = system_.joints[j];
    const S::Vec de = gap_change(joint.at, r_[j], dq_), dr = gap_change(joint.at, r_[j], dv_), load = load_on(joint.at, scale_);
    LawTangents law;
    joint.law.linearize({begin_.t + h, r_[j].gap, r_[j].rate, z_.data() + joint.first_state}, law);
    S::Vec df = law.stiffness * de + law.damping * dr;
    for (int z = 0; z < law.n; ++z)
      for (int s = 0; s < 7; ++s)
        for (int k = 0; k < 3; ++k) df[k] -= law.force_by_state[k][z] * kE[s] * h * kz_[s][joint.first_state + z];
    worst = std::max({worst, df.head<2>().norm() / load[0], std::abs(df[2]) / load[2]});
    if (!std::isfinite(df.sum())) return std::numeric_limits<double>::infinity();
  }
  return std::max(worst, over_loads(system_, dv_, scale_) / h);
}

void Dopri5::grow_scale() {
  system_.motions(end_.q, end_.v, m_);
  system_.external(end_.t, m_, external_);
  grow_load_scale(system_, m_, external_, end_, scale_, magnitudes_);
  raise_above(rounding_, scale_);
}

}  // namespace pintle
