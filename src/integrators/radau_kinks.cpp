// Steps that end where a law or a load has a kink or a jump: found on the step's own curve, approached from before, and
// crossed by a step too short to matter. theory/time section 7.
#include <algorithm>
#include <limits>

#include "integrators/radau_stepper.h"

namespace pintle {
namespace {

using S = Planar;

constexpr int kHalvings = 46;
constexpr double kCrossing = 1e-9;  // of the usual step: the least that is gone to cross
constexpr int kCrossings = 5;       // each ten times longer, until the side has changed

}  // namespace

// The sides at share x of the step, on the curve through its stages.
std::uint64_t RadauStepper::sides(double x, double h) {
  RadauTable::Vec v(n_), q(n_);
  for (int i = 0; i < n_; ++i) {
    double power = x;
    v[i] = q[i] = 0;
    for (int k = 0; k < n_; ++k, power *= x) {
      v[i] += table_.stages_to_powers(k, i) * power / (k + 1);
      q[i] += table_.stages_to_powers(k, i) * power * x / ((k + 1) * (k + 2));
    }
  }
  for (std::size_t b = 0; b < inside_q_.size(); ++b) {
    inside_q_[b] = begin_.q[b] + x * h * begin_.v[b];
    inside_v_[b] = begin_.v[b];
    for (int i = 0; i < n_; ++i) {
      inside_q_[b] += h * h * q[i] * stage_[i].a[b];
      inside_v_[b] += h * v[i] * stage_[i].a[b];
    }
  }
  for (std::size_t j = 0; j < inside_gap_.size(); ++j) {
    inside_gap_[j] = begin_.gap[j] + x * h * begin_.gap_rate[j];
    inside_rate_[j] = begin_.gap_rate[j];
    for (int i = 0; i < n_; ++i) {
      inside_gap_[j] += h * h * q[i] * stage_[i].gap_accel[j];
      inside_rate_[j] += h * v[i] * stage_[i].gap_accel[j];
    }
  }
  system_.motions(inside_q_, inside_v_, inside_m_);
  return system_.branches(begin_.t + x * h, inside_m_, inside_gap_, inside_rate_);
}

RadauStepper::Kink RadauStepper::first_kink(double h) {
  double before = 0;
  for (int i = 0; i < 2 * n_; ++i) {
    const double x = i % 2 == 0 ? 0.5 * (table_.nodes[i / 2] + table_.nodes[i / 2 + 1]) : table_.nodes[i / 2 + 1];
    if (sides(x, h) == side_) {
      before = x;
      continue;
    }
    double after = x;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (before + after);
      (sides(middle, h) == side_ ? before : after) = middle;
    }
    return {before, after};
  }
  return {};
}

// Moves end_ over the kink that it stands just before, by Taylor's series, and renews its accelerations there.
void RadauStepper::cross_kink(double distance) {
  double beyond = std::max(kCrossing * usual_h_, 4 * std::numeric_limits<double>::epsilon() * std::abs(end_.t));
  for (int i = 0; i < kCrossings; ++i, beyond *= 10) {
    const double d = (i == 0 ? distance : 0) + beyond, half = 0.5 * d * d;
    end_.t += d;
    for (std::size_t b = 0; b < end_.q.size(); ++b) {
      end_.q[b] += d * end_.v[b] + half * end_.a[b];
      end_.v[b] += d * end_.a[b];
    }
    for (std::size_t j = 0; j < end_.gap.size(); ++j) {
      end_.gap[j] += d * end_.gap_rate[j] + half * end_.gap_accel[j];
      end_.gap_rate[j] += d * end_.gap_accel[j];
    }
    system_.motions(end_.q, end_.v, end_m_);
    const std::uint64_t now = system_.branches(end_.t, end_m_, end_.gap, end_.gap_rate);
    if (now == side_) continue;
    side_ = now;
    break;
  }
  balance_end();
  have_history_ = false;
}

// What the laws and loads really give at end_.
void RadauStepper::balance_end() {
  system_.readings(end_.t, end_m_, end_r_);
  for (int j = 0; j < system_.n_joints(); ++j) end_.force[j] = law_force(system_.joints[j].law, end_.gap[j], end_.gap_rate[j]);
  find_accelerations(system_, end_m_, end_r_, end_);
  const auto [supplied, lost] = power(end_.t, end_.q, end_m_, end_.gap, end_.gap_rate, end_.force);
  end_.supply_power = supplied;
  end_.loss_power = lost;
}

}  // namespace pintle
