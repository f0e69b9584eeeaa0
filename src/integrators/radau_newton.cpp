// The stage equations of one step, solved by simplified Newton: one real and one complex block factorisation per step.
// theory/time Eqs. (3.5)-(3.11).
#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/radau_stepper.h"

namespace pintle {
namespace {

using S = Planar;

constexpr int kMaxIterations = 14;
constexpr double kNewtonShare = 0.02;  // of the tolerance, left to the iteration

}  // namespace

bool RadauStepper::attempt(double h) {
  predict(h);
  double previous = 0;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    for (int i = 0; i < n_; ++i) {
      place_stage(i, h);
      find_residuals(i, h);
    }
    if (iteration == 0) {
      linearize(h);
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
      for (int i = 0; i < n_; ++i) place_stage(i, h);
      return true;
    }
  }
  return false;
}

void RadauStepper::predict(double h) {
  for (int s = 0; s < n_; ++s) {
    Stage& stage = stage_[s];
    if (!have_history_) {
      stage.a = begin_.a;
      stage.gap_accel = begin_.gap_accel;
      continue;
    }
    const RadauTable::Vec w = table_.weights(1 + table_.c[s] * h / last_h_);
    for (auto& x : stage.a) x.setZero();
    for (auto& x : stage.gap_accel) x.setZero();
    for (int k = 0; k <= n_; ++k) {
      for (std::size_t i = 0; i < stage.a.size(); ++i) stage.a[i] += w[k] * nodes_.a[k][i];
      for (std::size_t j = 0; j < stage.gap_accel.size(); ++j) stage.gap_accel[j] += w[k] * nodes_.gap_accel[k][j];
    }
  }
}

// Where one stage is, and its joint forces, from the accelerations of all. Eq. (3.5).
void RadauStepper::place_stage(int i, double h) {
  Stage& s = stage_[i];
  const double hc = h * table_.c[i];
  std::array<double, RadauTable::kMaxStages> A, A2;
  for (int k = 0; k < n_; ++k) {
    A[k] = h * table_.A(i, k);
    A2[k] = h * h * table_.A2(i, k);
  }
  for (std::size_t b = 0; b < system_.bodies.size(); ++b) {
    S::Vec v = begin_.v[b], q = begin_.q[b] + hc * begin_.v[b];
    for (int k = 0; k < n_; ++k) {
      v += A[k] * stage_[k].a[b];
      q += A2[k] * stage_[k].a[b];
    }
    s.v[b] = v;
    s.q[b] = q;
  }
  system_.motions(s.q, s.v, s.m);
  for (std::size_t j = 0; j < system_.joints.size(); ++j) {
    S::Vec rate = begin_.gap_rate[j], gap = begin_.gap[j] + hc * begin_.gap_rate[j];
    for (int k = 0; k < n_; ++k) {
      rate += A[k] * stage_[k].gap_accel[j];
      gap += A2[k] * stage_[k].gap_accel[j];
    }
    s.gap_rate[j] = rate;
    s.gap[j] = gap;
    s.force[j] = law_force(system_.joints[j].law, gap, rate);
  }
}

// What is missing in the equations of one stage. Eq. (3.6).
void RadauStepper::find_residuals(int i, double h) {
  Stage& s = stage_[i];
  const double t = begin_.t + table_.c[i] * h;
  system_.readings(t, s.m, s.r);
  system_.external(t, s.m, s.Q);
  for (std::size_t b = 0; b < system_.bodies.size(); ++b) s.ra[b] = system_.bodies[b].mass.cwiseProduct(s.a[b]) - s.Q[b];
  for (std::size_t j = 0; j < system_.joints.size(); ++j) {
    const JointData& joint = system_.joints[j];
    const Reading& r = s.r[j];
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
void RadauStepper::linearize(double h) {
  const int middle = n_ / 2;
  const Stage& s = stage_[middle];
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
  system_.external_tangents(begin_.t + table_.c[middle] * h, s.m, [this](int i, int j, const S::Mat& dq, const S::Mat& dv) {
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
  ++counters_.factorizations;
  if (!real_lu_.factorize()) return false;
  for (int p = 0; p < table_.pairs; ++p) {
    assemble(pairs_[p].lu, Complex(table_.eigenvalue[p].real() / h, table_.eigenvalue[p].imag() / h));
    ++counters_.factorizations;
    if (!pairs_[p].lu.factorize()) return false;
  }
  return true;
}

// One Newton correction: into the diagonal frame, the solves, back. Eqs. (3.9)-(3.11).
void RadauStepper::solve_correction(double h) {
  transform_residuals(h);
  real_lu_.solve(real_rhs_);
  for (Pair& pair : pairs_) pair.lu.solve(pair.rhs);
  back_to_stages(h);
  for (int s = 0; s < n_; ++s) {
    for (std::size_t b = 0; b < real_rhs_.size(); ++b) stage_[s].a[b] += delta_a_[s][b];
    for (std::size_t j = 0; j < real_re_.size(); ++j) stage_[s].gap_accel[j] += delta_gap_[s][j];
  }
}

void RadauStepper::transform_residuals(double h) {
  const double mu = table_.real_eigenvalue / h;
  const RadauTable::Vec& w = table_.inverse_real;
  for (std::size_t b = 0; b < real_rhs_.size(); ++b) {
    S::Vec sum = S::Vec::Zero();
    for (int s = 0; s < n_; ++s) sum -= w[s] * stage_[s].ra[b];
    for (int k = 0; k < 3; ++k) real_rhs_[b][k] = sum[k];
  }
  const auto push = [](auto& rhs, int body, const S::Mat& G, const auto& put) {
    if (body != kGround) put(rhs[body], G);
  };
  for (std::size_t j = 0; j < real_re_.size(); ++j) {
    const JointBlocks& b = blocks_[j];
    const Placement& at = system_.joints[j].at;
    S::Vec& e = real_re_[j];
    e.setZero();
    for (int s = 0; s < n_; ++s) e += w[s] * stage_[s].re[j];
    // mu^-2 (K + mu C) times the residual
    const S::Vec f = (b.K * e) / (mu * mu) + (b.C * e) / mu;
    const auto put = [&f](BlockVec<double, 3>& rhs, const S::Mat& G) {
      const S::Vec g = G.transpose() * f;
      for (int k = 0; k < 3; ++k) rhs[k] += g[k];
    };
    push(real_rhs_, at.a, frozen_[j].GA, put);
    push(real_rhs_, at.b, frozen_[j].GB, put);
  }
  for (int p = 0; p < table_.pairs; ++p) {
    Pair& pair = pairs_[p];
    const Complex nu(table_.eigenvalue[p].real() / h, table_.eigenvalue[p].imag() / h);
    const Complex i1 = Complex(1) / nu, i2 = i1 * i1;
    std::array<double, RadauTable::kMaxStages> re, im;
    for (int s = 0; s < n_; ++s) {
      re[s] = table_.inverse_complex[p][s].real();
      im[s] = table_.inverse_complex[p][s].imag();
    }
    for (std::size_t b = 0; b < pair.rhs.size(); ++b) {
      S::Vec x = S::Vec::Zero(), y = S::Vec::Zero();
      for (int s = 0; s < n_; ++s) {
        x -= re[s] * stage_[s].ra[b];
        y -= im[s] * stage_[s].ra[b];
      }
      for (int k = 0; k < 3; ++k) pair.rhs[b][k] = {x[k], y[k]};
    }
    for (std::size_t j = 0; j < pair.re.size(); ++j) {
      const JointBlocks& b = blocks_[j];
      const Placement& at = system_.joints[j].at;
      ComplexVec& e = pair.re[j];
      e.re.setZero();
      e.im.setZero();
      for (int s = 0; s < n_; ++s) {
        e.re += re[s] * stage_[s].re[j];
        e.im += im[s] * stage_[s].re[j];
      }
      const S::Vec Kr = b.K * e.re, Ki = b.K * e.im, Cr = b.C * e.re, Ci = b.C * e.im;
      const S::Vec fr = i2.re * Kr - i2.im * Ki + i1.re * Cr - i1.im * Ci;
      const S::Vec fi = i2.re * Ki + i2.im * Kr + i1.re * Ci + i1.im * Cr;
      const auto put = [&fr, &fi](BlockVec<Complex, 3>& rhs, const S::Mat& G) {
        const S::Vec gr = G.transpose() * fr, gi = G.transpose() * fi;
        for (int k = 0; k < 3; ++k) rhs[k] += Complex(gr[k], gi[k]);
      };
      push(pair.rhs, at.a, frozen_[j].GA, put);
      push(pair.rhs, at.b, frozen_[j].GB, put);
    }
  }
}

void RadauStepper::back_to_stages(double h) {
  const double mu2 = std::pow(table_.real_eigenvalue / h, 2);
  for (std::size_t b = 0; b < real_rhs_.size(); ++b) {
    const S::Vec x = mu2 * S::Vec(real_rhs_[b][0], real_rhs_[b][1], real_rhs_[b][2]);
    for (int s = 0; s < n_; ++s) delta_a_[s][b] = table_.T_real[s] * x;
    real_rhs_[b] = {{x[0], x[1], x[2]}};
  }
  const auto gap_of = [this](std::size_t j, const auto& at_body) {
    const Placement& at = system_.joints[j].at;
    S::Vec e = S::Vec::Zero();
    if (at.a != kGround) e += frozen_[j].GA * at_body(at.a);
    if (at.b != kGround) e += frozen_[j].GB * at_body(at.b);
    return e;
  };
  for (std::size_t j = 0; j < real_re_.size(); ++j) {
    const S::Vec e = gap_of(j, [this](int i) { return S::Vec(real_rhs_[i][0], real_rhs_[i][1], real_rhs_[i][2]); }) - real_re_[j];
    for (int s = 0; s < n_; ++s) delta_gap_[s][j] = table_.T_real[s] * e;
  }
  for (int p = 0; p < table_.pairs; ++p) {
    Pair& pair = pairs_[p];
    const Complex nu(table_.eigenvalue[p].real() / h, table_.eigenvalue[p].imag() / h), nu2 = nu * nu;
    std::array<double, RadauTable::kMaxStages> Tr, Ti;
    for (int s = 0; s < n_; ++s) {
      Tr[s] = 2 * table_.T_complex[p][s].real();
      Ti[s] = 2 * table_.T_complex[p][s].imag();
    }
    for (std::size_t b = 0; b < pair.rhs.size(); ++b) {
      for (int k = 0; k < 3; ++k) pair.rhs[b][k] = nu2 * pair.rhs[b][k];
      for (int s = 0; s < n_; ++s)
        for (int k = 0; k < 3; ++k) delta_a_[s][b][k] += Tr[s] * pair.rhs[b][k].re - Ti[s] * pair.rhs[b][k].im;
    }
    for (std::size_t j = 0; j < pair.re.size(); ++j) {
      const auto& x = pair.rhs;
      const S::Vec er = gap_of(j, [&x](int i) { return S::Vec(x[i][0].re, x[i][1].re, x[i][2].re); }) - pair.re[j].re;
      const S::Vec ei = gap_of(j, [&x](int i) { return S::Vec(x[i][0].im, x[i][1].im, x[i][2].im); }) - pair.re[j].im;
      for (int s = 0; s < n_; ++s) delta_gap_[s][j] += Tr[s] * er - Ti[s] * ei;
    }
  }
}

double RadauStepper::correction_size() const {
  double size = 0;
  for (int s = 0; s < n_; ++s)
    for (int b = 0; b < system_.n_bodies(); ++b) {
      const S::Vec relative = system_.bodies[b].mass.cwiseProduct(delta_a_[s][b]).cwiseQuotient(scale_.body[b]);
      if (!relative.allFinite()) return std::numeric_limits<double>::infinity();
      size = std::max(size, relative.cwiseAbs().maxCoeff());
    }
  return size;
}

}  // namespace pintle
