// The stage equations of one step, solved by simplified Newton: one real and one complex block factorisation per step.
// theory/time Eqs. (3.5)-(3.11).
#include <algorithm>

#include "integrators/radau_stepper.h"

namespace pintle {
namespace {

using S = Planar;

constexpr int kMaxIterations = 14;
constexpr double kNewtonShare = 0.02;  // of the tolerance, left to the iteration

// Lagrange weights at x of the cubic through nodes {0, c1, c2, 1}.
std::array<double, 4> lagrange(const Eigen::Vector3d& c, double x) {
  const std::array<double, 4> n{0, c[0], c[1], c[2]};
  std::array<double, 4> w{1, 1, 1, 1};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (i != j) w[i] *= (x - n[j]) / (n[i] - n[j]);
  return w;
}

}  // namespace

bool RadauStepper::attempt(double h) {
  predict(h);
  double previous = 0;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    for (int i = 0; i < kStages; ++i) evaluate_stage(i, h);
    if (iteration == 0) {
      linearize();
      if (!factorize(h)) return false;
    }
    solve_correction(h);
    ++counters_.newton_iterations;
    const double size = correction_size() / tolerance_;
    if (!std::isfinite(size)) return false;
    double rate = std::pow(std::clamp(contraction_, 1e-3, 1.0), 0.8);
    if (iteration > 0) {
      rate = size / previous;
      contraction_ = rate;
      if (rate > 2 || (rate > 0.95 && iteration > 2)) return false;
    }
    previous = size;
    if (rate < 1 && rate / (1 - rate) * size < kNewtonShare) {
      for (int i = 0; i < kStages; ++i) evaluate_stage(i, h);
      return true;
    }
  }
  return false;
}

void RadauStepper::predict(double h) {
  for (int s = 0; s < kStages; ++s) {
    if (!have_history_) {
      stage_[s].a = begin_.a;
      stage_[s].gap_accel = begin_.gap_accel;
      continue;
    }
    const auto w = lagrange(table_.c, 1 + table_.c[s] * h / last_h_);
    for (std::size_t i = 0; i < system_.bodies.size(); ++i)
      stage_[s].a[i] = w[0] * history_a_[0][i] + w[1] * history_a_[1][i] + w[2] * history_a_[2][i] + w[3] * history_a_[3][i];
    for (std::size_t j = 0; j < system_.joints.size(); ++j)
      stage_[s].gap_accel[j] = w[0] * history_gap_[0][j] + w[1] * history_gap_[1][j] + w[2] * history_gap_[2][j] + w[3] * history_gap_[3][j];
  }
}

// Collocation and residuals of one stage from the accelerations of all. Eqs. (3.5), (3.6).
void RadauStepper::evaluate_stage(int i, double h) {
  Stage& s = stage_[i];
  const double t = begin_.t + table_.c[i] * h, hc = h * table_.c[i];
  const Eigen::RowVector3d A = h * table_.A.row(i), A2 = h * h * table_.A2.row(i);
  for (std::size_t b = 0; b < system_.bodies.size(); ++b) {
    s.v[b] = begin_.v[b] + A[0] * stage_[0].a[b] + A[1] * stage_[1].a[b] + A[2] * stage_[2].a[b];
    s.q[b] = begin_.q[b] + hc * begin_.v[b] + A2[0] * stage_[0].a[b] + A2[1] * stage_[1].a[b] + A2[2] * stage_[2].a[b];
  }
  system_.motions(s.q, s.v, s.m);
  system_.readings(t, s.m, s.r);
  system_.external(t, s.m, s.Q);
  for (std::size_t b = 0; b < system_.bodies.size(); ++b) s.ra[b] = system_.bodies[b].mass.cwiseProduct(s.a[b]) - s.Q[b];
  for (std::size_t j = 0; j < system_.joints.size(); ++j) {
    const JointData& joint = system_.joints[j];
    const Reading& r = s.r[j];
    s.gap_rate[j] = begin_.gap_rate[j] + A[0] * stage_[0].gap_accel[j] + A[1] * stage_[1].gap_accel[j] + A[2] * stage_[2].gap_accel[j];
    s.gap[j] = begin_.gap[j] + hc * begin_.gap_rate[j] + A2[0] * stage_[0].gap_accel[j] + A2[1] * stage_[1].gap_accel[j] + A2[2] * stage_[2].gap_accel[j];
    s.force[j] = law_force(joint.law, s.gap[j], s.gap_rate[j]);
    s.re[j] = s.gap_accel[j] - r.bias;
    if (joint.at.a != kGround) {
      s.ra[joint.at.a] -= r.GA.transpose() * s.force[j];
      s.re[j] -= r.GA * s.a[joint.at.a];
    }
    if (joint.at.b != kGround) {
      s.ra[joint.at.b] -= r.GB.transpose() * s.force[j];
      s.re[j] -= r.GB * s.a[joint.at.b];
    }
  }
  ++counters_.evaluations;
}

// Tangents at the predicted middle stage: joints' G'KG and G'CG with the geometric stiffness, loads' slopes. Eq. (3.8).
void RadauStepper::linearize() {
  const Stage& s = stage_[1];
  frozen_ = s.r;
  for (std::size_t j = 0; j < blocks_.size(); ++j) {
    const JointData& joint = system_.joints[j];
    JointBlocks& b = blocks_[j];
    const Response response = respond(joint.law, s.gap[j], s.gap_rate[j]);
    b.K = response.stiffness;
    b.C = response.damping;
    const auto geometric = geometric_stiffness(joint.probe, system_.pose(joint.at, s.m), response.force);
    const std::array<const S::Mat*, 2> G{&s.r[j].GA, &s.r[j].GB};
    for (int x = 0; x < 2; ++x)
      for (int y = 0; y < 2; ++y) {
        b.SK[2 * x + y] = G[x]->transpose() * (b.K * *G[y]) - geometric.block<3, 3>(3 * x, 3 * y);
        b.SC[2 * x + y] = G[x]->transpose() * (b.C * *G[y]);
      }
  }
  load_blocks_.clear();
  system_.external_tangents(begin_.t, s.m, [this](int i, int j, const S::Mat& dq, const S::Mat& dv) {
    load_blocks_.push_back({i, j, dq, dv});
  });
}

template <class T>
void RadauStepper::assemble(BlockLu<T, 3>& lu, const T& mu) const {
  const auto add = [&mu](Block<T, 3>& block, const S::Mat& K, const S::Mat& C, double sign) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) block(r, c) += T(sign * K(r, c)) + (sign * C(r, c)) * mu;
  };
  lu.set_zero();
  const T mu2 = mu * mu;
  for (int i = 0; i < system_.n_bodies(); ++i)
    for (int r = 0; r < 3; ++r) lu.diagonal(i)(r, r) = system_.bodies[i].mass[r] * mu2;
  for (int j = 0; j < system_.n_joints(); ++j) {
    const Placement& at = system_.joints[j].at;
    const JointBlocks& b = blocks_[j];
    if (at.a != kGround) add(lu.diagonal(at.a), b.SK[0], b.SC[0], 1);
    if (at.b != kGround) add(lu.diagonal(at.b), b.SK[3], b.SC[3], 1);
    if (at.a == kGround || at.b == kGround) continue;
    BlockPattern::Slot slot = b.ab;
    add(lu.off_diagonal(slot), b.SK[1], b.SC[1], 1);
    slot.upper = !slot.upper;
    add(lu.off_diagonal(slot), b.SK[2], b.SC[2], 1);
  }
  for (const LoadBlock& b : load_blocks_)
    add(b.i == b.j ? lu.diagonal(b.i) : lu.off_diagonal(system_.pattern().slot(b.i, b.j)), b.dq, b.dv, -1);
}

bool RadauStepper::factorize(double h) {
  assemble(real_lu_, table_.real_eigenvalue / h);
  assemble(complex_lu_, Complex(table_.eigenvalue.real() / h, table_.eigenvalue.imag() / h));
  counters_.factorizations += 2;
  return real_lu_.factorize() && complex_lu_.factorize();
}

// One Newton correction: into the diagonal frame, two solves, back. Eqs. (3.9)-(3.11).
void RadauStepper::solve_correction(double h) {
  const double mu = table_.real_eigenvalue / h;
  const Complex nu(table_.eigenvalue.real() / h, table_.eigenvalue.imag() / h), nu2 = nu * nu, inverse_nu2 = Complex(1) / nu2;
  const Eigen::RowVector3d& p = table_.inverse_real;
  const Eigen::RowVector3d pr = table_.inverse_complex.real(), pi = table_.inverse_complex.imag();
  for (std::size_t b = 0; b < real_rhs_.size(); ++b) {
    const S::Vec &x = stage_[0].ra[b], &y = stage_[1].ra[b], &z = stage_[2].ra[b];
    for (int k = 0; k < 3; ++k) {
      real_rhs_[b][k] = -(p[0] * x[k] + p[1] * y[k] + p[2] * z[k]);
      complex_rhs_[b][k] = {-(pr[0] * x[k] + pr[1] * y[k] + pr[2] * z[k]), -(pi[0] * x[k] + pi[1] * y[k] + pi[2] * z[k])};
    }
  }
  const std::vector<Reading>& frozen = frozen_;
  for (std::size_t j = 0; j < real_re_.size(); ++j) {
    const S::Vec &x = stage_[0].re[j], &y = stage_[1].re[j], &z = stage_[2].re[j];
    const JointBlocks& b = blocks_[j];
    const Placement& at = system_.joints[j].at;
    real_re_[j] = p[0] * x + p[1] * y + p[2] * z;
    complex_re_[j] = {pr[0] * x + pr[1] * y + pr[2] * z, pi[0] * x + pi[1] * y + pi[2] * z};
    // mu^-2 (K + mu C) times the residual, real and complex
    const S::Vec wr = (b.K * real_re_[j]) / (mu * mu) + (b.C * real_re_[j]) / mu;
    const Complex inverse_nu = Complex(1) / nu;
    const S::Vec Kr = b.K * complex_re_[j].re, Ki = b.K * complex_re_[j].im, Cr = b.C * complex_re_[j].re, Ci = b.C * complex_re_[j].im;
    const S::Vec wre = inverse_nu2.re * Kr - inverse_nu2.im * Ki + inverse_nu.re * Cr - inverse_nu.im * Ci;
    const S::Vec wim = inverse_nu2.re * Ki + inverse_nu2.im * Kr + inverse_nu.re * Ci + inverse_nu.im * Cr;
    const auto push = [&](int body, const S::Mat& G) {
      if (body == kGround) return;
      const S::Vec gr = G.transpose() * wr, gre = G.transpose() * wre, gim = G.transpose() * wim;
      for (int k = 0; k < 3; ++k) {
        real_rhs_[body][k] += gr[k];
        complex_rhs_[body][k] += Complex(gre[k], gim[k]);
      }
    };
    push(at.a, frozen[j].GA);
    push(at.b, frozen[j].GB);
  }
  real_lu_.solve(real_rhs_);
  complex_lu_.solve(complex_rhs_);
  const Eigen::Vector3d& T = table_.T_real;
  const Eigen::Vector3d Tr = 2 * table_.T_complex.real(), Ti = 2 * table_.T_complex.imag();
  for (std::size_t b = 0; b < real_rhs_.size(); ++b)
    for (int k = 0; k < 3; ++k) {
      const double x = mu * mu * real_rhs_[b][k];
      const Complex y = nu2 * complex_rhs_[b][k];
      for (int s = 0; s < kStages; ++s) delta_a_[s][b][k] = T[s] * x + Tr[s] * y.re - Ti[s] * y.im;
    }
  for (std::size_t j = 0; j < real_re_.size(); ++j) {
    const Placement& at = system_.joints[j].at;
    const Reading& r = frozen[j];
    S::Vec x = -real_re_[j], yr = -complex_re_[j].re, yi = -complex_re_[j].im;
    const auto pull = [&](int body, const S::Mat& G) {
      if (body == kGround) return;
      S::Vec zr, cr, ci;
      for (int k = 0; k < 3; ++k) {
        zr[k] = mu * mu * real_rhs_[body][k];
        const Complex y = nu2 * complex_rhs_[body][k];
        cr[k] = y.re;
        ci[k] = y.im;
      }
      x += G * zr;
      yr += G * cr;
      yi += G * ci;
    };
    pull(at.a, r.GA);
    pull(at.b, r.GB);
    for (int s = 0; s < kStages; ++s) delta_gap_[s][j] = T[s] * x + Tr[s] * yr - Ti[s] * yi;
  }
  for (int s = 0; s < kStages; ++s) {
    for (std::size_t b = 0; b < real_rhs_.size(); ++b) stage_[s].a[b] += delta_a_[s][b];
    for (std::size_t j = 0; j < real_re_.size(); ++j) stage_[s].gap_accel[j] += delta_gap_[s][j];
  }
}

double RadauStepper::correction_size() const {
  double size = 0;
  for (int s = 0; s < kStages; ++s)
    for (int b = 0; b < system_.n_bodies(); ++b)
      size = std::max(size, system_.bodies[b].mass.cwiseProduct(delta_a_[s][b]).cwiseAbs().cwiseQuotient(scale_.body[b]).maxCoeff());
  return size;
}

}  // namespace pintle
