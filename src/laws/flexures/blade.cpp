#include "laws/flexures/blade.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace pintle {
namespace {

constexpr int kUnknowns = BladeBasis::kMost + 2, kPoints = BladeBasis::kMostPoints;
using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kUnknowns, 1>;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kUnknowns, kUnknowns>;
using Field = Eigen::Array<double, Eigen::Dynamic, 1, 0, kPoints, 1>;  // one number per point of the quadrature
using Vec3 = Eigen::Vector3d;

constexpr int kBladeNewton = 30;                    // most iterations for the shape of a blade
constexpr double kSettled = 1e-10;             // relative step after which the error is its square
constexpr double kRounding = 1e-6;             // relative step below which one that does not shrink is rounding
constexpr double kTail = 1e-8;                 // share of the last coefficients; energy and forces are wrong by its square
constexpr double kRoughTail = 1e-4;            // the same with all the functions that there are
constexpr int kFinest = 512;                   // parts into which the path is halved, at most
constexpr double kMostTension = 1e5;           // in units of EI/L^2: beyond, functions of the basis do not follow the bend at the clamps
constexpr double kSurelyStable = std::numbers::pi * std::numbers::pi;

// Of a symmetric matrix: as many as there are negative pivots (Sylvester's law of inertia).
int negative_eigenvalues(Square H) {
  int negative = 0;
  for (Eigen::Index k = 0; k < H.rows(); ++k) {
    const double pivot = H(k, k) != 0 ? H(k, k) : std::numeric_limits<double>::min();
    negative += pivot < 0;
    const Eigen::Index left = H.rows() - k - 1;
    const Column below = H.col(k).tail(left);
    for (Eigen::Index j = 0; j < left; ++j) H.col(k + 1 + j).tail(left) -= (below[j] / pivot) * below;
  }
  return negative;
}

}  // namespace

struct Blade::Work {
  const BladeBasis* basis = nullptr;
  Field slope, cosine, sine, versine;  // 1 - cosine in `versine`
  Field N, Q;                          // force along and across the blade
  Field bends, turns;                  // derivative of the integrand of Eq. (2.3) by the slope, and the second one
  Square H;                            // of the unknowns (c, n)
  Column residual, by_theta;           // and their column for theta
  double moment = 0, moment_by_theta = 0;
  Eigen::PartialPivLU<Square> lu;
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kUnknowns, 3> follows;  // of the unknowns by the displacement
};

Blade::Blade(double axial_compliance, double shear_compliance) : axial_(axial_compliance), shear_(shear_compliance) { BladeBasis::at(0); }

// Slope along the blade and forces in its axes: Eqs. (2.2), (2.4).
void Blade::follow_slope(const BladeShape& shape, Work& work) const {
  const BladeBasis& basis = BladeBasis::at(shape.level);
  work.basis = &basis;
  work.slope = shape.theta * basis.s.array();
  for (int i = 0; i < basis.n; ++i) work.slope += shape.c[i] * basis.angle.col(i).array();
  work.cosine.resize(basis.n_points);
  work.sine.resize(basis.n_points);
  work.versine.resize(basis.n_points);
  for (int q = 0; q < basis.n_points; ++q) {
    const double half_sine = std::sin(0.5 * work.slope[q]), half_cosine = std::cos(0.5 * work.slope[q]);
    work.sine[q] = 2 * half_sine * half_cosine;
    work.versine[q] = 2 * half_sine * half_sine;
    work.cosine[q] = 1 - work.versine[q];
  }
  work.N = shape.n[0] * work.cosine + shape.n[1] * work.sine;
  work.Q = shape.n[1] * work.cosine - shape.n[0] * work.sine;
  const double difference = axial_ - shear_;
  work.bends = -work.Q - difference * work.N * work.Q;
  work.turns = work.N + difference * (work.N.square() - work.Q.square());
}

// First and second derivatives of Eq. (2.3): Eqs. (2.5), (2.6).
void Blade::assemble(const BladeShape& shape, const Vec3& displacement, Work& work) const {
  follow_slope(shape, work);
  const BladeBasis& basis = *work.basis;
  const int n = basis.n;
  const auto w = basis.w.array();
  const double difference = axial_ - shear_;
  const Field weighted = w * work.turns, along = w * (work.sine + difference * (work.N * work.sine - work.Q * work.cosine)),
              across = -w * (work.cosine + difference * (work.Q * work.sine + work.N * work.cosine)), bends = w * work.bends;
  work.H.resize(n + 2, n + 2);
  work.residual.resize(n + 2);
  work.by_theta.resize(n + 2);
  for (int i = 0; i < n; ++i) {
    const auto angle = basis.angle.col(i).array();
    const Field turned = weighted * angle;
    for (int j = 0; j <= i; ++j) work.H(i, j) = work.H(j, i) = (turned * basis.angle.col(j).array()).sum();
    const double own = 1.0 / (2 * i + 3);  // the integral of the square of P_(i+1) over s
    work.H(i, i) += own;
    work.H(i, n) = work.H(n, i) = (along * angle).sum();
    work.H(i, n + 1) = work.H(n + 1, i) = (across * angle).sum();
    work.residual[i] = own * shape.c[i] + (bends * angle).sum();
    work.by_theta[i] = (turned * basis.s.array()).sum();
  }
  const auto &c = work.cosine, &s = work.sine;
  work.H(n, n) = -(w * (axial_ * c.square() + shear_ * s.square())).sum();
  work.H(n + 1, n + 1) = -(w * (axial_ * s.square() + shear_ * c.square())).sum();
  work.H(n, n + 1) = work.H(n + 1, n) = -difference * (w * c * s).sum();
  work.residual[n] = displacement[0] + (w * (work.versine - axial_ * work.N * c + shear_ * work.Q * s)).sum();
  work.residual[n + 1] = displacement[1] - (w * (s + axial_ * work.N * s + shear_ * work.Q * c)).sum();
  work.by_theta[n] = (along * basis.s.array()).sum();
  work.by_theta[n + 1] = (across * basis.s.array()).sum();
  work.moment = shape.theta + (bends * basis.s.array()).sum();
  work.moment_by_theta = 1 + (weighted * basis.s.array().square()).sum();
}

// Whether the second variation is positive for all changes that leave the ends where they are. It is where no part of the blade carries
// more than the compression under which a blade buckles that is held against turning alone; else the signs of the eigenvalues say it: two are
// negative for the two forces, and none else.
bool Blade::is_stable(const Work& work) const { return work.turns.minCoeff() > -kSurelyStable || negative_eigenvalues(work.H) == 2; }

// Newton's method at one level.
bool Blade::refine(const Vec3& displacement, BladeShape& shape, Work& work) const {
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < kBladeNewton; ++iteration) {
    assemble(shape, displacement, work);
    work.lu.compute(work.H);
    Column step = work.lu.solve(-work.residual);
    if (!step.allFinite()) return false;
    const int n = work.basis->n;
    const double turned = step.head(n).norm(), pushed = step.tail(2).norm();
    for (int i = 0; i < n; ++i) shape.c[i] += step[i];
    for (int k = 0; k < 2; ++k) shape.n[k] += step[n + k];
    const double angles = Eigen::Map<const Eigen::VectorXd>(shape.c, n).norm() + std::abs(shape.theta), forces = std::hypot(shape.n[0], shape.n[1]) + angles;
    const double relative = std::max(angles > 0 ? turned / angles : 0, forces > 0 ? pushed / forces : 0);
    if (relative <= kSettled || (relative < kRounding && relative > 0.5 * last)) {
      assemble(shape, displacement, work);
      return is_stable(work);
    }
    last = relative;
  }
  return false;
}

// With as many functions as the shape takes, and changes of it: of exp(k s), whose k is the root of the force along the blade, the coefficients fall as
// exp(-n^2/k).
bool Blade::solve(const Vec3& displacement, BladeShape& shape, Work& work) const {
  for (;;) {
    if (!refine(displacement, shape, work)) return false;
    const int n = work.basis->n;
    const bool follows_changes = n * n >= -std::log(kTail) * std::sqrt(work.turns.abs().maxCoeff());
    double size = std::abs(shape.theta);
    for (int i = 0; i < n; ++i) size = std::max(size, std::abs(shape.c[i]) / std::sqrt(2 * i + 3));
    const double tail = std::max(std::abs(shape.c[n - 1]), std::abs(shape.c[n - 2])) / std::sqrt(2 * n + 1);
    if (follows_changes && tail <= kTail * size) return true;
    if (shape.level + 1 == BladeBasis::kLevels) return tail <= kRoughTail * size;
    ++shape.level;
  }
}

// Eq. (2.9): along a path from the straight blade, in one step where that is found.
bool Blade::find(const Vec3& displacement, BladeShape& shape) const {
  if (!displacement.allFinite() || std::hypot(1 + displacement[0], displacement[1]) - 1 > axial_ * kMostTension) return false;
  const auto place = [&displacement](double share) { return Vec3(share * share * displacement[0], share * displacement[1], share * displacement[2]); };
  shape = {};
  Work work;
  double done = 0, part = 1;
  while (done < 1) {
    const double next = done + part > 1 - 1e-9 ? 1 : done + part, more = next - done;
    BladeShape trial = shape;
    const double bent = 3 * displacement[2] - 6 * displacement[1];  // small deflections
    trial.theta = next * displacement[2];
    trial.c[0] += more * bent;
    trial.n[1] -= 2 * more * bent;
    if (solve(place(next), trial, work)) {
      shape = trial;
      done = next;
    } else {
      part *= 0.5;
      if (part < 1.0 / kFinest) return false;
    }
  }
  return true;
}

BladeAnswer Blade::answer(const BladeShape& shape, const Vec3& displacement, const Vec3& rate, bool with_slopes) const {
  Work work;
  assemble(shape, displacement, work);
  work.lu.compute(work.H);
  const BladeBasis& basis = *work.basis;
  const int n = basis.n;
  BladeAnswer out;
  out.force << shape.n[0], shape.n[1], work.moment;
  double bending = shape.theta * shape.theta;
  for (int i = 0; i < n; ++i) bending += shape.c[i] * shape.c[i] / (2 * i + 3);
  out.energy = 0.5 * bending + 0.5 * (basis.w.array() * (axial_ * work.N.square() + shear_ * work.Q.square())).sum();
  work.follows.setZero(n + 2, 3);
  work.follows(n, 0) = work.follows(n + 1, 1) = -1;
  work.follows.col(2) = -work.by_theta;
  work.follows = work.lu.solve(work.follows).eval();  // (2.7)
  for (int k = 0; k < 3; ++k) {
    out.stiffness(0, k) = work.follows(n, k);
    out.stiffness(1, k) = work.follows(n + 1, k);
    out.stiffness(2, k) = work.by_theta.dot(work.follows.col(k)) + (k == 2 ? work.moment_by_theta : 0);
  }
  find_losses(rate, with_slopes, work, out);
  return out;
}

// Eqs. (2.11), (2.12).
void Blade::find_losses(const Vec3& rate, bool with_slopes, const Work& work, BladeAnswer& out) const {
  const BladeBasis& basis = *work.basis;
  const int n = basis.n;
  const auto w = basis.w.array();
  const auto &c = work.cosine, &s = work.sine, &N = work.N, &Q = work.Q;
  std::array<Field, 3> slope, along, across, pull, push;  // by each displacement: of the slope, of Eq. (2.11)'s brackets, and of N and Q at a held slope
  const auto slope_of = [&basis, n](const auto& unknowns) {
    Field sum = Field::Zero(basis.n_points);
    for (int i = 0; i < n; ++i) sum += unknowns[i] * basis.angle.col(i).array();
    return sum;
  };
  for (int k = 0; k < 3; ++k) {
    const auto u = work.follows.col(k);
    slope[k] = slope_of(u);
    if (k == 2) slope[k] += basis.s.array();
    pull[k] = u[n] * c + u[n + 1] * s;
    push[k] = u[n + 1] * c - u[n] * s;
    along[k] = pull[k] + Q * slope[k];
    across[k] = push[k] - N * slope[k];
  }
  const auto bending = [n](const auto& a, const auto& b) {
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += a[i] * b[i] / (2 * i + 3);
    return sum;
  };
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l)
      out.losses(k, l) = (k == 2 && l == 2) + bending(work.follows.col(k), work.follows.col(l)) + (w * (axial_ * along[k] * along[l] + shear_ * across[k] * across[l])).sum();
  if (!with_slopes || rate.isZero(0)) return;
  const double difference = axial_ - shear_;
  const Field third = Q * (1 + 4 * difference * N);
  for (int k = 0; k < 3; ++k)
    for (int m = 0; m < 3; ++m) {
      // The unknowns' second derivatives by displacements k and m: Eq. (2.12).
      const auto by_force = [&](int a) -> Field { return pull[a] + 2 * difference * (N * pull[a] - Q * push[a]); };
      const Field both = slope[k] * slope[m];
      const Field turned = w * (third * both + by_force(k) * slope[m] + by_force(m) * slope[k] - difference * (pull[k] * push[m] + push[k] * pull[m]));
      const Field in_line = w * (both * (1 + 2 * difference * N) - difference * (push[k] * slope[m] + push[m] * slope[k]));
      const Field beside = w * (-2 * difference * Q * both - difference * (pull[k] * slope[m] + pull[m] * slope[k]));
      Column right(n + 2);
      for (int i = 0; i < n; ++i) right[i] = -(turned * basis.angle.col(i).array()).sum();
      right[n] = -(in_line * c - beside * s).sum();
      right[n + 1] = -(in_line * s + beside * c).sum();
      const Column second = work.lu.solve(right);
      const Field bent = slope_of(second);
      const Field more_along = second[n] * c + second[n + 1] * s + push[k] * slope[m] + across[m] * slope[k] + Q * bent;
      const Field more_across = second[n + 1] * c - second[n] * s - pull[k] * slope[m] - along[m] * slope[k] - N * bent;
      for (int l = 0; l < 3; ++l) {
        const double change = bending(second, work.follows.col(l)) + (w * (axial_ * more_along * along[l] + shear_ * more_across * across[l])).sum();
        out.losses_turn(k, m) += change * rate[l];
        out.losses_turn(l, m) += change * rate[k];
      }
    }
}

double Blade::largest(const BladeShape& shape, const Vec3& displacement, double bending, double axial) const {
  Work work;
  assemble(shape, displacement, work);
  const BladeBasis& basis = *work.basis;
  Field curvature = Field::Constant(basis.n_points, shape.theta);
  for (int i = 0; i < basis.n; ++i) curvature += shape.c[i] * basis.curvature.col(i).array();
  const double inside = (bending * curvature.abs() + axial * work.N.abs()).maxCoeff();
  // At the ends from the balance of moments, which the forces fulfil better than the series does.
  const double far = work.moment, near = far + (1 + displacement[0]) * shape.n[1] - displacement[1] * shape.n[0];
  const double pull = shape.n[0] * std::cos(shape.theta) + shape.n[1] * std::sin(shape.theta);
  return std::max({inside, bending * std::abs(far) + axial * std::abs(pull), bending * std::abs(near) + axial * std::abs(shape.n[0])});
}

}  // namespace pintle
