#include "integrators/general/alpha_stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/cubic_hermite.h"
#include "integrators/thresholds.h"

namespace pintle {
namespace {

using S = Planar;

constexpr int kMaxIterations = 10;                                         // upper limit for Newton's method
constexpr double kNewtonShare = 0.01;                                      // fraction of the tolerance: a correction below this is the last
constexpr double kLoosestNewton = 1e-5;                                    // upper limit on the tolerance of the iteration, because forces are k times positions

}  // namespace

AlphaStepper::AlphaStepper(const System& system, const AlphaWeights& weights, double tolerance, std::unique_ptr<ConstraintForces> ideal_joints)
    : system_(system), weights_(weights), beta_(weights.beta()), gamma_(weights.gamma()), tolerance_(tolerance),
      newton_tolerance_(ideal_joints && ideal_joints->projects() ? kLoosestNewton : std::min(tolerance, kLoosestNewton)), constraints_(std::move(ideal_joints)), force_evaluator_(system), borders_(system), tangents_(system), lu_(system.pattern()),
      begin_(zero_state(system)), end_(begin_), between_(begin_), a_before_(begin_.q), a_now_(begin_.q), q_(begin_.q), v_(begin_.q), a_(begin_.q), F_begin_(begin_.q),
      F_(begin_.q), work_(system.bodies.size()), forced_(tolerance) {
  before_ = now_ = {begin_.q, begin_.q, begin_.q, 0};
}

void AlphaStepper::start(const State& state, double h) {
  begin_ = end_ = state;
  if (!constraints_) {
    force_evaluator_.complete(end_);
    borders_.start(end_);
  } else if (!constraints_->start(end_)) {
    failure_ = "ideal joints cannot be closed at the start";
  }
  now_ = {end_.v, end_.a, end_.a, 0};
  h_ = h;
}

// theory/solvers Eq. (3.7): the lag of the accelerations is proportional to the step; this converts it to that of a step of h.
void AlphaStepper::set_lag(double h, const Knot& knot, Vecs& a) const {
  const double share = weights_.lag() != 0 && knot.h > 0 ? h / knot.h : 1;
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = weights_.lagged(share, knot.a[i], knot.law[i]);
}

// F = Q + G' law(gap, rate), or with the constraint forces of ideal joints.
void AlphaStepper::forces(double t, const Vecs& q, const Vecs& v, std::vector<double>& law_state, Vecs& F) {
  ++counters_.evaluations;
  if (constraints_) return constraints_->find_forces(t, q, v, F);
  system_.accelerations(t, q, v, F, law_state.data());
  for (int i = 0; i < system_.n_bodies(); ++i) F[i] = F[i].cwiseProduct(system_.bodies[i].mass);
}

// The laws' own states at the end of a step of h, by the trapezoidal rule, joint by joint.
void AlphaStepper::find_states(double t, const Vecs& q, const Vecs& v, double h) {
  if (z_.empty() || constraints_) return;
  system_.motions(q, v, m_);
  LawTangents law;
  LawImpedance<double> follows;
  for (int j = 0; j < system_.n_joints(); ++j) {
    const JointData& joint = system_.joints[j];
    const int n = joint.law.n_states(), first = joint.first_state;
    if (n == 0) continue;
    const JointKinematics r = system_.kinematics(j, t, m_);
    follows.reserve(n);
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
      joint.law.linearize({t, r.gap, r.rate, z_.data() + first}, law);
      follows.find(law, 2 / h);
      double change = 0, size = 0;
      Eigen::VectorXd missing(n);
      for (int z = 0; z < n; ++z) missing[z] = begin_.law_rate[first + z] + law.state_rate[z] - 2 / h * (z_[first + z] - begin_.law_state[first + z]);
      for (int z = 0; z < n; ++z) {
        double move = 0;
        for (int y = 0; y < n; ++y) move += follows.inverse[z * n + y] * missing[y];
        z_[first + z] += move;
        change = std::max(change, std::abs(move));
        size = std::max(size, std::abs(z_[first + z]));
      }
      if (!(change > kLastBits * size)) break;
    }
  }
}

// theory/solvers Eq. (3.2): positions and velocities that follow from the accelerations a_.
void AlphaStepper::place(double h) {
  for (std::size_t i = 0; i < q_.size(); ++i) {
    q_[i] = weights_.position(h, begin_.q[i], begin_.v[i], a_now_[i], a_[i]);
    v_[i] = weights_.velocity(h, begin_.v[i], a_now_[i], a_[i]);
  }
}

// One Newton correction, theory/solvers Eq. (3.4). Returns its size in units of the tolerance.
double AlphaStepper::correct(double h) {
  const double t = begin_.t + h, new_a = 1 - weights_.accelerations, new_F = 1 - weights_.forces;
  find_states(t, q_, v_, h);
  forces(t, q_, v_, z_, F_);
  tangents_.find(t, q_, v_, z_, 2 / h, constraints_.get());
  tangents_.combine(new_a, new_F * h * h * beta_, new_F * h * gamma_, lu_);
  ++counters_.factorizations;
  ++counters_.newton_iterations;
  if (!lu_.factorize()) return std::numeric_limits<double>::infinity();
  for (int i = 0; i < system_.n_bodies(); ++i) {
    const S::Vec rest = new_F * F_[i] + weights_.forces * F_begin_[i] -
                        system_.bodies[i].mass.cwiseProduct(new_a * a_[i] + weights_.accelerations * a_now_[i]);
    work_[i] = {{rest[0], rest[1], rest[2]}};
  }
  lu_.solve(work_);
  double size = 0, sum = 0;
  const double of_v = projects() ? 0 : h * gamma_;  // with projection, velocities follow from it
  for (std::size_t i = 0; i < a_.size(); ++i)
    for (int k = 0; k < S::kDof; ++k) {
      const double da = work_[i][k];
      sum += da;
      a_[i][k] += da;
      size = std::max({size, h * h * beta_ * std::abs(da) / tolerance_.weight(begin_.q[i][k], q_[i][k], largest_q_),
                       of_v * std::abs(da) / tolerance_.weight(begin_.v[i][k], v_[i][k], largest_v_)});
    }
  place(h);
  return std::isfinite(sum) ? size : std::numeric_limits<double>::infinity();
}

bool AlphaStepper::solve(double h) {
  a_ = a_now_;
  z_ = begin_.law_state;
  place(h);
  if (constraints_) constraints_->begin_step(begin_, h * h * beta_);
  const double enough = kNewtonShare * newton_tolerance_ / tolerance_.relative;
  double last = std::numeric_limits<double>::infinity();
  bool solved = false;
  for (int i = 0; i < kMaxIterations && !solved; ++i) {
    const double size = correct(h);
    if (!std::isfinite(size) || (i > 2 && size > 2 * last)) return false;
    solved = size < std::max(enough, 1e-2 * kLastBits);
    last = size;
  }
  solved = solved || last < 1;  // at the roundoff of stiff forces the corrections no longer shrink
  return solved && (!constraints_ || constraints_->project(begin_.t + h, q_, v_, a_));
}

// The estimated error of the step, in units of the tolerance.
double AlphaStepper::error(double h) {
  double worst = 0, sum = 0;
  for (std::size_t i = 0; i < a_.size(); ++i)
    for (int k = 0; k < S::kDof; ++k) {
      const auto [e_q, e_v] = weights_.local_errors(h, now_.h, {before_.v[i][k], a_before_[i][k], begin_.v[i][k], a_now_[i][k], v_[i][k], a_[i][k]});
      sum += e_q + e_v;
      worst = std::max({worst, e_q / tolerance_.weight(begin_.q[i][k], q_[i][k], largest_q_), e_v / tolerance_.weight(begin_.v[i][k], v_[i][k], largest_v_)});
    }
  return std::isfinite(sum) ? worst : std::numeric_limits<double>::infinity();
}

void AlphaStepper::find_begin_forces() {
  if (!constraints_) return forces(begin_.t, begin_.q, begin_.v, begin_.law_state, F_begin_);
  for (int i = 0; i < system_.n_bodies(); ++i) F_begin_[i] = system_.bodies[i].mass.cwiseProduct(begin_.a[i]);
}

bool AlphaStepper::step(double t_end) {
  if (!failure_.empty()) return false;
  begin_ = end_;
  largest_q_ = largest_coordinate(begin_.q);
  largest_v_ = largest_coordinate(begin_.v);
  find_begin_forces();
  double most = 5;  // largest factor by which the next step may grow
  double h = max_step_ > 0 ? std::min(h_, max_step_) : h_;
  borders_.begin_step();
  while (true) {
    h = std::min(h, t_end - begin_.t);
    if (h <= kLastBits * std::abs(t_end)) {
      failure_ = fmt::format("the step size became too small at t = {:.9g} s", begin_.t);
      return false;
    }
    set_lag(h, now_, a_now_);
    set_lag(h, before_, a_before_);
    if (!solve(h)) {
      ++counters_.newton_failures;
      most = 1;
      h *= 0.25;
      continue;
    }
    const double e = error(h);
    const bool forced = constraints_ && forced_.must_take(e, h, begin_.t + h >= t_end);
    const double factor = std::isfinite(e) ? std::clamp(0.9 / std::cbrt(std::max(e, 1e-12)), 0.2, 5.0) : 0.1;
    if (e <= 1 || forced) {
      const bool found = set_end_state(end_of_step(begin_.t, h, t_end), h);
      if (!found) h *= 0.25;
      if (!found || crosses_border(h)) {
        ++counters_.rejected;
        continue;
      }
      finish(h);
      if (forced) {
        h_ = forced_.record_forced_step(begin_.t, h);
        return true;
      }
      forced_.record_step(h);
      h_ = borders_.has_shortened() ? std::max(h_, h * factor) : h * std::min(factor, most);
      return true;
    }
    ++counters_.rejected;
    most = 1;
    h *= std::min(factor, 0.8);
  }
}

std::vector<std::string> AlphaStepper::remarks() const {
  std::vector<std::string> out = forced_.remarks();
  if (constraints_) out.insert(out.begin(), constraints_->remark());
  return out;
}

bool AlphaStepper::set_end_state(double t, double h) {
  end_.t = t;
  end_.q = q_;
  end_.v = v_;
  if (constraints_) return constraints_->complete(end_);
  find_states(t, q_, v_, h);
  end_.law_state = z_;
  force_evaluator_.complete(end_);
  return true;
}

// Energies by the trapezoidal rule, which has the order of the method.
void AlphaStepper::finish(double h) {
  end_.dissipated = begin_.dissipated + 0.5 * h * (begin_.loss_power + end_.loss_power);
  end_.supplied = begin_.supplied + 0.5 * h * (begin_.supply_power + end_.supply_power);
  std::swap(before_, now_);
  now_.v = v_;
  now_.a = a_;
  now_.law = end_.a;
  now_.h = h;
  if (!constraints_ && borders_.cross(end_)) {  // continues as from a start
    force_evaluator_.complete(end_);
    borders_.record(end_);
    now_.a = now_.law = end_.a;
    now_.h = 0;
  }
  ++counters_.steps;
}

// theory/solvers section 4: cubics for the bodies, straight lines for gaps and their rates.
const State& AlphaStepper::interpolate(double t) {
  if (t == end_.t) return end_;
  if (t == begin_.t) return begin_;
  const State& end = state_before_event();
  const double h = end.t - begin_.t, s = (t - begin_.t) / h, r = 1 - s;
  between_.t = t;
  for (std::size_t i = 0; i < q_.size(); ++i) {
    between_.q[i] = cubic_hermite(s, h, begin_.q[i], begin_.v[i], end.q[i], end.v[i]);
    between_.v[i] = cubic_hermite(s, h, begin_.v[i], begin_.a[i], end.v[i], end.a[i]);
    between_.a[i] = r * begin_.a[i] + s * end.a[i];
  }
  if (constraints_) constraints_->complete(between_);
  else interpolate_forces(s);
  between_.dissipated = begin_.dissipated + 0.5 * h * s * (begin_.loss_power + between_.loss_power);
  between_.supplied = begin_.supplied + 0.5 * h * s * (begin_.supply_power + between_.supply_power);
  return between_;
}

// Gaps on straight lines, and the laws' forces there.
void AlphaStepper::interpolate_forces(double s) {
  const State& end = state_before_event();
  const double r = 1 - s;
  for (int j = 0; j < system_.n_joints(); ++j) {
    between_.gap[j] = r * begin_.gap[j] + s * end.gap[j];
    between_.gap_rate[j] = r * begin_.gap_rate[j] + s * end.gap_rate[j];
    between_.gap_accel[j] = r * begin_.gap_accel[j] + s * end.gap_accel[j];
  }
  for (std::size_t z = 0; z < between_.law_state.size(); ++z) {
    between_.law_state[z] = r * begin_.law_state[z] + s * end.law_state[z];
    between_.law_rate[z] = r * begin_.law_rate[z] + s * end.law_rate[z];
  }
  find_joint_forces(system_, between_);
  between_.loss_power = r * begin_.loss_power + s * end.loss_power;
  between_.supply_power = r * begin_.supply_power + s * end.supply_power;
}

}  // namespace pintle
