// The step loop: predict, solve, estimate, accept or shrink; moving the result onto the gaps.
#include "integrators/radau_stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace pintle {
namespace {

using S = Planar;

constexpr int kMaxRetries = 60;
constexpr double kShortest = 1e-11;  // of the run: the shortest step that is refused for its error
constexpr double kProjectionShare = 0.01;  // of the step's own frequency: every mode that a step does not resolve to the full is moved
constexpr double kErrorFactor = 1.0;  // the spectral tail over the step's force error, from the four-bar at k = 1e6..1e12

// Legendre coefficients on [0, 1] of the cubic through values at {0, c1, c2, 1}.
Eigen::Matrix4d legendre_transform(const Eigen::Vector3d& c) {
  Eigen::Matrix4d at;
  const std::array<double, 4> nodes{0, c[0], c[1], c[2]};
  for (int i = 0; i < 4; ++i) {
    const double x = 2 * nodes[i] - 1;
    at.row(i) << 1, x, (3 * x * x - 1) / 2, (5 * x * x * x - 3 * x) / 2;
  }
  return at.inverse();
}

}  // namespace

RadauStepper::RadauStepper(const System& system, double tolerance)
    : system_(system), table_(RadauTable::get()), tolerance_(tolerance), blocks_(system.joints.size()),
      real_lu_(system.pattern()), complex_lu_(system.pattern()), real_rhs_(system.bodies.size()),
      complex_rhs_(system.bodies.size()), real_re_(system.joints.size()), complex_re_(system.joints.size()),
      projector_(system), wanted_(system.joints.size()), move_(system.bodies.size()), end_r_(system.joints.size()),
      end_m_(system.bodies.size()) {
  const std::size_t n = system.bodies.size(), m = system.joints.size();
  for (Stage& s : stage_) {
    s.q = s.v = s.a = s.Q = s.ra = Vecs(n, S::Vec::Zero());
    s.gap = s.gap_rate = s.gap_accel = s.force = s.re = Vecs(m, S::Vec::Zero());
    s.m.resize(n);
    s.r.resize(m);
  }
  for (auto& d : delta_a_) d.resize(n);
  for (auto& d : delta_gap_) d.resize(m);
  for (auto& d : history_a_) d.resize(n);
  for (auto& d : history_gap_) d.resize(m);
  scale_.body.assign(n, S::Vec::Zero());
  for (std::size_t j = 0; j < m; ++j) {
    const Placement& at = system.joints[j].at;
    if (at.a != kGround && at.b != kGround) blocks_[j].ab = system.pattern().slot(at.a, at.b);
  }
}

void RadauStepper::start(const State& state, double h) {
  begin_ = end_ = state;
  h_ = h;
  have_history_ = false;
  contraction_ = 0.5;
  system_.motions(end_.q, end_.v, end_m_);
  system_.readings(end_.t, end_m_, end_r_);
  stage_[2].Q.assign(system_.bodies.size(), S::Vec::Zero());
  system_.external(end_.t, end_m_, stage_[2].Q);
  grow_scale();
}

bool RadauStepper::step(double t_end) {
  begin_ = end_;
  double h = h_;
  if (max_step_ > 0) h = std::min(h, max_step_);
  for (int retry = 0; retry < kMaxRetries; ++retry) {
    const double left = t_end - begin_.t;
    if (h > left || left - h < 1e-3 * h) h = left;
    else if (left < 1.7 * h) h = 0.5 * left;
    if (h <= 16 * std::numeric_limits<double>::epsilon() * std::max(std::abs(begin_.t), std::abs(t_end))) break;
    if (!attempt(h)) {
      ++counters_.newton_failures;
      h *= 0.35;
      have_history_ = have_history_ && retry == 0;
      continue;
    }
    const double error = error_estimate() / tolerance_;
    double factor = std::clamp(0.9 * std::pow(std::max(error, 1e-12), -0.2), 0.15, 4.0);
    // A force that jumps cannot be resolved by any step: one that is this short passes over the jump.
    const bool jump = error > 1 && h <= kShortest * std::abs(t_end);
    if (jump) factor = 4;
    if (error > 1 && !jump) {
      ++counters_.rejected;
      h *= std::min(factor, 0.7);
      continue;
    }
    if (!finish_step(h)) {
      ++counters_.newton_failures;
      h *= 0.35;
      continue;
    }
    ++counters_.steps;
    last_h_ = h;
    have_history_ = true;
    h_ = h * factor;
    return true;
  }
  note_failure(h, "the step size has shrunk to nothing");
  return false;
}

bool RadauStepper::trial(double h) {
  begin_ = end_;
  if (!attempt(h) || !finish_step(h)) return false;
  last_h_ = h;
  have_history_ = true;
  return true;
}

// How much of the body forces the step's cubic leaves unresolved: Legendre coefficients fall off by a ratio r where the
// motion is smooth (then the next ones are r, r^2 .. smaller) and do not where it vibrates. theory/time Eq. (3.12).
double RadauStepper::error_estimate() const {
  static const Eigen::Matrix4d to_legendre = legendre_transform(RadauTable::get().c);
  std::array<double, 4> size{};
  for (int i = 0; i < system_.n_bodies(); ++i) {
    const S::Vec& mass = system_.bodies[i].mass;
    for (int k = 1; k < 4; ++k) {
      const S::Vec coefficient = to_legendre(k, 0) * begin_.a[i] + to_legendre(k, 1) * stage_[0].a[i] +
                                 to_legendre(k, 2) * stage_[1].a[i] + to_legendre(k, 3) * stage_[2].a[i];
      const double relative = mass.cwiseProduct(coefficient).cwiseAbs().cwiseQuotient(scale_.body[i]).maxCoeff();
      size[k] = std::max(size[k], relative);
    }
  }
  if (!(size[3] > 0)) return std::isfinite(size[3]) ? 0.0 : 1e300;
  const double ratio = std::min(1.0, std::max(size[3] / size[2], std::sqrt(size[3] / size[1])));
  return kErrorFactor * size[3] * ratio * ratio;
}

// Moves the end of the step onto its gaps and takes over what the geometry alone decides. theory/time Eqs. (4.1)-(4.3).
bool RadauStepper::finish_step(double h) {
  const Stage& last = stage_[kStages - 1];
  for (int s = 0; s < kStages; ++s) {
    history_a_[s + 1] = stage_[s].a;
    history_gap_[s + 1] = stage_[s].gap_accel;
  }
  history_a_[0] = begin_.a;
  history_gap_[0] = begin_.gap_accel;
  end_.t = begin_.t + h;
  end_.dissipated = begin_.dissipated;
  end_.supplied = begin_.supplied;
  end_.q = last.q;
  end_.v = last.v;
  end_.a = last.a;
  end_.gap_accel = last.gap_accel;
  const double mu = kProjectionShare * table_.real_eigenvalue / std::abs(h);
  if (!projector_.prepare(end_.t, last.m, mu, last.gap, last.gap_rate)) return false;
  for (int pass = 0; pass < 2; ++pass) {
    const std::vector<Reading>& r = pass == 0 ? projector_.readings() : end_r_;
    for (std::size_t j = 0; j < wanted_.size(); ++j) wanted_[j] = last.gap[j] - r[j].gap;
    projector_.close(wanted_, end_.q);
    system_.motions(end_.q, end_.v, end_m_);
    system_.readings(end_.t, end_m_, end_r_);
  }
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t j = 0; j < wanted_.size(); ++j) {
      const Placement& at = system_.joints[j].at;
      S::Vec rate = end_r_[j].rate;
      if (pass > 0) {
        if (at.a != kGround) rate += end_r_[j].GA * move_[at.a];
        if (at.b != kGround) rate += end_r_[j].GB * move_[at.b];
      }
      wanted_[j] = last.gap_rate[j] - rate;
    }
    if (pass == 0) for (auto& x : move_) x.setZero();
    projector_.close(wanted_, move_);
  }
  for (std::size_t i = 0; i < end_.v.size(); ++i) end_.v[i] += move_[i];
  system_.motions(end_.q, end_.v, end_m_);
  system_.readings(end_.t, end_m_, end_r_);
  double size = 0;
  for (const auto& q : end_.q) size = std::max(size, std::max(std::abs(q[0]), std::abs(q[1])));
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * std::max(size, 1e-3);
  for (std::size_t j = 0; j < wanted_.size(); ++j) {
    const S::Vec difference = end_r_[j].gap - last.gap[j];
    end_.gap[j] = last.gap[j];
    for (int k = 0; k < S::kDof; ++k)
      if (std::abs(difference[k]) > rounding) end_.gap[j][k] = end_r_[j].gap[k];
    end_.gap_rate[j] = end_r_[j].rate;
    end_.force[j] = law_force(system_.joints[j].law, end_.gap[j], end_.gap_rate[j]);
  }
  for (int s = 0; s < kStages; ++s) {
    const Stage& stage = stage_[s];
    const double t = begin_.t + h * table_.c[s];
    const ExternalWork work = system_.external_work(t, stage.q, stage.m);
    double supplied = work.supplied, lost = work.lost;
    for (std::size_t j = 0; j < wanted_.size(); ++j) {
      const JointData& joint = system_.joints[j];
      if (joint.servo >= 0) {
        supplied += stage.force[j][joint.servo] * system_.pose(joint.at, stage.m).rate[joint.servo];
      } else {
        lost += respond(joint.law, stage.gap[j], stage.gap_rate[j]).loss;
      }
    }
    end_.supplied += h * table_.b[s] * supplied;
    end_.dissipated += h * table_.b[s] * lost;
    end_.supply_power = supplied;
    end_.loss_power = lost;
  }
  grow_scale();
  return true;
}

void RadauStepper::grow_scale() {
  const Vecs& Q = stage_[kStages - 1].Q;
  Vecs& load = move_;
  for (int i = 0; i < system_.n_bodies(); ++i) load[i] = Q[i].cwiseAbs() + system_.bodies[i].mass.cwiseProduct(end_.a[i]).cwiseAbs();
  for (int j = 0; j < system_.n_joints(); ++j) {
    const Placement& at = system_.joints[j].at;
    if (at.a != kGround) load[at.a] += (end_r_[j].GA.transpose() * end_.force[j]).cwiseAbs();
    if (at.b != kGround) load[at.b] += (end_r_[j].GB.transpose() * end_.force[j]).cwiseAbs();
  }
  for (int i = 0; i < system_.n_bodies(); ++i) {
    const S::Vec& mass = system_.bodies[i].mass;
    const double radius = std::sqrt(mass[2] / mass[0]);
    double force = std::max({scale_.body[i][0], load[i][0], load[i][1], 1e-9 * mass[0]});
    double moment = std::max(scale_.body[i][2], load[i][2]);
    force = std::max(force, 1e-3 * moment / radius);
    moment = std::max(moment, 1e-3 * force * radius);
    scale_.body[i] << force, force, moment;
  }
}

void RadauStepper::note_failure(double h, const char* why) {
  std::array<std::pair<double, int>, 3> worst{{{0, -1}, {0, -1}, {0, -1}}};
  for (int j = 0; j < system_.n_joints(); ++j) {
    const double size = stage_[kStages - 1].re[j].norm();
    for (auto& w : worst)
      if (w.second < 0 || size > w.first || !std::isfinite(size)) {
        std::move_backward(&w, worst.end() - 1, worst.end());
        w = {size, j};
        break;
      }
  }
  failure_ = fmt::format("{} at t = {:.9g} s, step {:.3g} s", why, begin_.t, h);
  for (const auto& [size, j] : worst)
    if (j >= 0) failure_ += fmt::format("; joint {} (residual {:.3g} m/s^2)", system_.joints[j].name, size);
}

}  // namespace pintle
