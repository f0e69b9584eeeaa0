// The error of a step, and its end: moved onto its gaps, with the work done on the way.
#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/radau_stepper.h"
#include "integrators/step_error.h"

namespace pintle {
namespace {

using S = Planar;

}  // namespace

// How much of the forces the step's polynomials leave unresolved, over the load scale. theory/time Eqs. (3.12), (3.13).
bool RadauStepper::error_estimate(double h, double& error) {
  const Stage& last = stage_[n_ - 1];
  const double mu = kProjectionShare * table_.real_eigenvalue / std::abs(h);
  if (!projector_.prepare(begin_.t + h, last.m, mu, last.gap, last.gap_rate)) return false;
  solver_->tails(begin_, tail_move_, tail_);
  const double of_bodies = of_motion_ ? motion_tail() : tail_size(scale_, 1);
  error = of_motion_ ? of_bodies : std::max(of_bodies, gap_tail());
  return std::isfinite(error);
}

// Legendre coefficients of the body forces M a, as accelerations that the bodies can yield to within the step: stiff joints hold back
// the rest, and what a step does not resolve of their vibration is damped by it. theory/time Eq. (3.14).
double RadauStepper::motion_tail() {
  for (int i = 0; i < system_.n_bodies(); ++i)
    for (int c = 0; c < S::kDof; ++c) tail_move_[i][c] = system_.bodies[i].mass[c] * tail_move_[i][c];
  solver_->yield_to(tail_move_);
  return tail_size(motion_scale_.loads(), 1);
}

// The size of the last of three coefficients on the bodies, with what the next one will be like: they fall off by a ratio where the
// motion is smooth (then the next one is that much smaller than the last) and do not where it vibrates.
double RadauStepper::tail_size(const LoadScale& scale, double factor) const {
  Lanes<3> size = Lanes<3>::all(0), sum = size;
  for (int i = 0; i < system_.n_bodies(); ++i)
    for (int k = 0; k < S::kDof; ++k) {
      const Lanes<3> relative = (system_.bodies[i].mass[k] / scale.body[i][k]) * tail_move_[i][k];
      size = larger_size(size, relative);
      sum += relative;
    }
  if (!std::isfinite(sum[0] + sum[1] + sum[2])) return std::numeric_limits<double>::infinity();
  if (!(size[0] > 0)) return 0;
  return factor * size[0] * fall_off(size[0], size[1], size[2]);
}

// The gaps' own accelerations come out of the stages as second differences of what the forces demand; where a joint is
// neither stiff nor soft for this step, their error is the force's. As forces: through the projector.
double RadauStepper::gap_tail() {
  if (system_.joints.empty()) return 0;
  projector_.close(tail_, tail_move_);
  return tail_size(scale_, kGapError);
}

// theory/time Eqs. (4.1)-(4.3).
void RadauStepper::finish_step(double h) {
  const Stage& last = stage_[n_ - 1];
  nodes_.a[0] = begin_.a;
  nodes_.gap_accel[0] = begin_.gap_accel;
  nodes_.force[0] = begin_.force;
  end_.t = begin_.t + h;
  end_.q = last.q;
  end_.v = last.v;
  end_.a = last.a;
  end_.gap_accel = last.gap_accel;
  move_onto_gaps();
  take_gaps();
  balance_forces();
  add_work(h);
  for (int s = 0; s < n_; ++s) {
    nodes_.a[s + 1].swap(stage_[s].a);
    nodes_.gap_accel[s + 1].swap(stage_[s].gap_accel);
    nodes_.force[s + 1].swap(stage_[s].force);
  }
  nodes_.force[n_] = end_.force;
  control_.have_history = true;
  if (system_.has_branches()) see_sides();
  grow_scale();
  control_.last = h;
}

// What the rounding of positions leaves of a gap, or that of velocities of its rate.
double RadauStepper::rounding_of(const Vecs& x) {
  return 16 * std::numeric_limits<double>::epsilon() * largest_coordinate(x);
}

// What is asked of the joints, where they forbid anything.
double RadauStepper::largest_wanted() const {
  double size = 0;
  for (std::size_t j = 0; j < wanted_.size(); ++j)
    for (int k = 0; k < S::kDof; ++k)
      if (system_.joints[j].free_mask[k] == 0) size = std::max(size, std::abs(wanted_[j][k]));
  return size;
}

// Positions and velocities, each in one pass, and a second where the first has left more than rounding.
void RadauStepper::move_onto_gaps() {
  const Stage& last = stage_[n_ - 1];
  const double rounding = rounding_of(end_.q), rounding_of_rate = rounding_of(end_.v);
  for (int pass = 0; pass < 2; ++pass) {
    const std::vector<Reading>& r = pass == 0 ? projector_.readings() : end_r_;
    for (std::size_t j = 0; j < wanted_.size(); ++j) wanted_[j] = last.gap[j] - r[j].gap;
    if (pass > 0 && largest_wanted() < rounding) break;
    projector_.close(wanted_, end_.q);
    system_.motions(end_.q, end_.v, end_m_);
    system_.readings(end_.t, end_m_, end_r_);
  }
  for (auto& x : move_) x.setZero();
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t j = 0; j < wanted_.size(); ++j) {
      wanted_[j] = last.gap_rate[j] - end_r_[j].rate;
      subtract_gap(system_.joints[j].at, end_r_[j], move_, wanted_[j]);
    }
    if (pass > 0 && largest_wanted() < rounding_of_rate) break;
    projector_.close(wanted_, move_);
  }
  for (std::size_t i = 0; i < end_.v.size(); ++i) end_.v[i] += move_[i];
  system_.motions(end_.q, end_.v, end_m_);
  system_.readings(end_.t, end_m_, end_r_);
}

// The carried gap, but the geometry's where no motion could bring it there (redundant joints).
void RadauStepper::take_gaps() {
  const Stage& last = stage_[n_ - 1];
  const double rounding = rounding_of(end_.q);
  for (std::size_t j = 0; j < wanted_.size(); ++j) {
    const S::Vec difference = end_r_[j].gap - last.gap[j];
    end_.gap[j] = last.gap[j];
    for (int k = 0; k < S::kDof; ++k)
      if (std::abs(difference[k]) > rounding) end_.gap[j][k] = end_r_[j].gap[k];
    end_.gap_rate[j] = end_r_[j].rate;
    end_.force[j] = law_force(system_.joints[j].law, end_.gap[j], end_.gap_rate[j]);
  }
}

// At the end of the step positions and velocities are better than anywhere inside: so are the forces that balance them.
void RadauStepper::balance_forces() {
  const Stage& last = stage_[n_ - 1];
  move_ = last.a;
  for (std::size_t j = 0; j < wanted_.size(); ++j) {
    wanted_[j] = last.gap_accel[j] - end_r_[j].bias;
    subtract_gap(system_.joints[j].at, end_r_[j], move_, wanted_[j]);
  }
  projector_.close(wanted_, move_);
  projector_.improve_forces(last.Q, move_, end_.force);
}

void RadauStepper::add_work(double h) {
  nodes_.power[0] = {begin_.supply_power, begin_.loss_power};
  end_.supplied = begin_.supplied;
  end_.dissipated = begin_.dissipated;
  for (int s = 0; s < n_; ++s) {
    const Stage& stage = stage_[s];
    nodes_.power[s + 1] = power(begin_.t + h * table_.c[s], stage.q, stage.m, stage.gap, stage.gap_rate, stage.force);
    end_.supplied += h * table_.b[s] * nodes_.power[s + 1][0];
    end_.dissipated += h * table_.b[s] * nodes_.power[s + 1][1];
  }
  end_.supply_power = nodes_.power[n_][0];
  end_.loss_power = nodes_.power[n_][1];
}

std::array<double, 2> RadauStepper::power(double t, const Vecs& q, const std::vector<S::Motion>& m, const Vecs& gap,
                                          const Vecs& gap_rate, const Vecs& force) const {
  std::array<double, 2> out{};
  if (system_.has_loads()) {
    const ExternalWork work = system_.external_work(t, q, m, end_.held);
    out = {work.supplied, work.lost};
  }
  for (int j = 0; j < system_.n_joints(); ++j) {
    const JointData& joint = system_.joints[j];
    if (joint.servo >= 0) out[0] += force[j][joint.servo] * system_.pose(joint.at, m).rate[joint.servo];
    else out[1] += law_loss(joint.law, gap[j], gap_rate[j]);
  }
  return out;
}

void RadauStepper::grow_scale() { grow_load_scale(system_, end_r_, stage_[n_ - 1].Q, end_, move_, scale_); }

}  // namespace pintle
