#include "laws/flexures/blade.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "laws/flexures/blade_basis.h"

namespace pintle {
namespace {

using Vec3 = Eigen::Vector3d;

// Shape of the blade, as its slope angle, and end forces.
struct BladeShape {
  int level = 0;                          // level of the BladeBasis
  double theta = 0;                       // slope at the far end [rad]
  double c[BladeBasis::kMost] = {};       // coefficients of the basis functions
  double n[2] = {};                       // force on the far end, along and across the unloaded blade
};

constexpr int kBladeNewton = 30;                    // limit on Newton iterations for the shape of a blade
constexpr double kSettled = 1e-10;             // relative step after which the error is about its square
constexpr double kRounding = 1e-6;             // a step below this relative size that does not shrink is rounding
constexpr double kTail = 1e-8;                 // accepted share of the last coefficients; energy and forces have an error of its square
constexpr double kRoughTail = 1e-4;            // the same with the largest number of functions
constexpr int kFinest = 512;                   // largest number of parts into which the path is divided
constexpr double kMostTension = 1e5;           // in units of EI/L^2: beyond this the basis does not resolve the bending at the clamps
constexpr double kSurelyStable = std::numbers::pi * std::numbers::pi;

// With N basis functions or, if N is Eigen::Dynamic, with as many as the basis has.
template <int N>
class BentBlade {
  static constexpr bool kKnown = N != Eigen::Dynamic;
  static constexpr int kPoints = kKnown ? N + BladeBasis::kMorePoints : N, kUnknowns = kKnown ? N + 2 : N;
  static constexpr int kMostFunctions = kKnown ? N : BladeBasis::kMost;                // capacity
  static constexpr int kMostPoints = kMostFunctions + BladeBasis::kMorePoints;         // capacity
  static constexpr int kMostUnknowns = kMostFunctions + 2;                             // capacity
  using Column = Eigen::Matrix<double, kUnknowns, 1, 0, kMostUnknowns, 1>;
  using Columns3 = Eigen::Matrix<double, kUnknowns, 3, 0, kMostUnknowns, 3>;
  using Square = Eigen::Matrix<double, kUnknowns, kUnknowns, 0, kMostUnknowns, kMostUnknowns>;
  using Coefficients = Eigen::Matrix<double, N, 1, 0, kMostFunctions, 1>;
  using Field = Eigen::Array<double, kPoints, 1, 0, kMostPoints, 1>;  // one number per point of the quadrature
  using Functions = Eigen::Matrix<double, kPoints, N, 0, kMostPoints, kMostFunctions>;

 public:
  BentBlade(const BladeBasis& basis, double axial, double shear)
      : axial_(axial), shear_(shear), n_(basis.n), s_(basis.s.data(), basis.n_points), w_(basis.w.data(), basis.n_points), angle_(basis.angle.data(), basis.n_points, n_),
        curvature_(basis.curvature.data(), basis.n_points, n_), sine_(basis.n_points), versine_(basis.n_points), H_(n_ + 2, n_ + 2), residual_(n_ + 2), by_theta_(n_ + 2) {}

  // Newton's method.
  bool refine(const Vec3& displacement, BladeShape& shape) {
    double last = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < kBladeNewton; ++iteration) {
      assemble(shape, displacement);
      lu_.compute(H_);
      const Column step = lu_.solve(-residual_);
      if (!step.allFinite()) return false;
      const double turned = step.head(n()).norm(), pushed = step.template tail<2>().norm();
      coefficients(shape) += step.head(n());
      for (int k = 0; k < 2; ++k) shape.n[k] += step[n_ + k];
      const double angles = coefficients(shape).norm() + std::abs(shape.theta), forces = std::hypot(shape.n[0], shape.n[1]) + angles;
      const double relative = std::max(angles > 0 ? turned / angles : 0, forces > 0 ? pushed / forces : 0);
      if (relative <= kSettled || (relative < kRounding && relative > 0.5 * last)) {
        assemble(shape, displacement);
        return is_stable();
      }
      last = relative;
    }
    return false;
  }

  // Whether this many functions represent the shape and changes of it, to within `share`. The coefficients of exp(k s), where k is the root of the
  // force along the blade, fall as exp(-n^2/k).
  bool follows_changes() const { return n_ * n_ >= -std::log(kTail) * std::sqrt(turns_.abs().maxCoeff()); }
  bool follows_shape(const BladeShape& shape, double share) const {
    double size = std::abs(shape.theta);
    for (int i = 0; i < n(); ++i) size = std::max(size, std::abs(shape.c[i]) / std::sqrt(2 * i + 3));
    return std::max(std::abs(shape.c[n_ - 1]), std::abs(shape.c[n_ - 2])) / std::sqrt(2 * n_ + 1) <= share * size;
  }

  // The functions from here on are evaluated at the equilibrium found.
  BladeAnswer answer(const BladeShape& shape, const Vec3& rate, bool with_slopes) {
    lu_.compute(H_);
    BladeAnswer out;
    out.force << shape.n[0], shape.n[1], moment_;
    out.energy = 0.5 * (shape.theta * shape.theta + bending(coefficients(shape), coefficients(shape))) + 0.5 * (w_ * (axial_ * N_.square() + shear_ * Q_.square())).sum();
    Columns3 right = Columns3::Zero(n_ + 2, 3);
    right(n_, 0) = right(n_ + 1, 1) = -1;
    right.col(2) = -by_theta_;
    follows_ = lu_.solve(right);  // (2.7)
    for (int k = 0; k < 3; ++k) {
      out.stiffness(0, k) = follows_(n_, k);
      out.stiffness(1, k) = follows_(n_ + 1, k);
      out.stiffness(2, k) = by_theta_.dot(follows_.col(k)) + (k == 2 ? moment_by_theta_ : 0);
    }
    find_losses(rate, with_slopes, out);
    return out;
  }

  double largest(const BladeShape& shape, const Vec3& displacement, double by_bending, double by_pull) const {
    const Field curvature = shape.theta + (curvature_ * coefficients(shape)).array();
    const double inside = (by_bending * curvature.abs() + by_pull * N_.abs()).maxCoeff();
    // At the ends from the balance of moments, which the forces satisfy better than the series does.
    const double far = moment_, near = far + (1 + displacement[0]) * shape.n[1] - displacement[1] * shape.n[0];
    const double pull = shape.n[0] * std::cos(shape.theta) + shape.n[1] * std::sin(shape.theta);
    return std::max({inside, by_bending * std::abs(far) + by_pull * std::abs(pull), by_bending * std::abs(near) + by_pull * std::abs(shape.n[0])});
  }

 private:
  auto n() const { return Eigen::fix<N>(n_); }
  template <class Shape>
  auto coefficients(Shape& shape) const {
    return Eigen::Map<std::conditional_t<std::is_const_v<Shape>, const Coefficients, Coefficients>>(shape.c, n_);
  }

  // The integral of P_(i+1) squared over s.
  static double own(int i) { return 1.0 / (2 * i + 3); }
  template <class A, class B>
  double bending(const A& a, const B& b) const {
    double sum = 0;
    for (int i = 0; i < n(); ++i) sum += own(i) * a[i] * b[i];
    return sum;
  }

  // The integrals of `field` times each function.
  Coefficients against_functions(const Field& field) const { return angle_.transpose().lazyProduct(field.matrix()); }

  // Slope along the blade and forces in the blade's local axes: Eqs. (2.2), (2.4).
  void follow_slope(const BladeShape& shape) {
    slope_ = shape.theta * s_ + angle_.lazyProduct(coefficients(shape)).array();
    for (int q = 0; q < n() + BladeBasis::kMorePoints; ++q) {
      const double half_sine = std::sin(0.5 * slope_[q]), half_cosine = std::cos(0.5 * slope_[q]);
      sine_[q] = 2 * half_sine * half_cosine;
      versine_[q] = 2 * half_sine * half_sine;
    }
    cosine_ = 1 - versine_;
    N_ = shape.n[0] * cosine_ + shape.n[1] * sine_;
    Q_ = shape.n[1] * cosine_ - shape.n[0] * sine_;
    const double difference = axial_ - shear_;
    bends_ = -Q_ - difference * N_ * Q_;
    turns_ = N_ + difference * (N_.square() - Q_.square());
  }

  // First and second derivatives of Eq. (2.3): Eqs. (2.5), (2.6).
  void assemble(const BladeShape& shape, const Vec3& displacement) {
    follow_slope(shape);
    const double difference = axial_ - shear_;
    const Field turned = w_ * turns_, along = w_ * (sine_ + difference * (N_ * sine_ - Q_ * cosine_)),
                across = -w_ * (cosine_ + difference * (Q_ * sine_ + N_ * cosine_)), bends = w_ * bends_;
    const Functions weighted = turned.matrix().asDiagonal() * angle_;
    if constexpr (kKnown) H_.topLeftCorner(n(), n()) = angle_.transpose().lazyProduct(weighted);
    else H_.topLeftCorner(n(), n()).noalias() = angle_.transpose() * weighted;
    H_.col(n_).head(n()) = against_functions(along);
    H_.col(n_ + 1).head(n()) = against_functions(across);
    H_.bottomLeftCorner(Eigen::fix<2>, n()) = H_.topRightCorner(n(), Eigen::fix<2>).transpose();
    residual_.head(n()) = against_functions(bends);
    for (int i = 0; i < n(); ++i) {
      H_(i, i) += own(i);
      residual_[i] += own(i) * shape.c[i];
    }
    by_theta_.head(n()) = against_functions(turned * s_);
    const auto &c = cosine_, &s = sine_;
    H_(n_, n_) = -(w_ * (axial_ * c.square() + shear_ * s.square())).sum();
    H_(n_ + 1, n_ + 1) = -(w_ * (axial_ * s.square() + shear_ * c.square())).sum();
    H_(n_, n_ + 1) = H_(n_ + 1, n_) = -difference * (w_ * c * s).sum();
    residual_[n_] = displacement[0] + (w_ * (versine_ - axial_ * N_ * c + shear_ * Q_ * s)).sum();
    residual_[n_ + 1] = displacement[1] - (w_ * (s + axial_ * N_ * s + shear_ * Q_ * c)).sum();
    by_theta_[n_] = (along * s_).sum();
    by_theta_[n_ + 1] = (across * s_).sum();
    moment_ = shape.theta + (bends * s_).sum();
    moment_by_theta_ = 1 + (turned * s_.square()).sum();
  }

  // Whether the second variation is positive for all changes that leave the ends in place. It is if no part of the blade carries more than the
  // buckling load of a blade that is held against rotation only. Otherwise the signs of the eigenvalues decide: exactly two are negative, for
  // the two forces.
  bool is_stable() const { return turns_.minCoeff() > -kSurelyStable || negative_eigenvalues(H_) == 2; }

  // Number of negative eigenvalues of a symmetric matrix: that of negative pivots (Sylvester's law of inertia).
  static int negative_eigenvalues(Square H) {
    int negative = 0;
    for (Eigen::Index k = 0; k < H.rows(); ++k) {
      const double pivot = H(k, k) != 0 ? H(k, k) : std::numeric_limits<double>::min();
      negative += pivot < 0;
      const Eigen::Index left = H.rows() - k - 1;
      const auto below = H.col(k).tail(left).eval();
      for (Eigen::Index j = 0; j < left; ++j) H.col(k + 1 + j).tail(left) -= (below[j] / pivot) * below;
    }
    return negative;
  }

  Field slope_of(const Column& unknowns) const { return angle_.lazyProduct(unknowns.head(n())).array(); }

  // Eqs. (2.11), (2.12).
  void find_losses(const Vec3& rate, bool with_slopes, BladeAnswer& out) const {
    const auto &c = cosine_, &s = sine_;
    std::array<Field, 3> slope, along, across, pull, push;  // derivatives by each displacement: of the slope, of the brackets in Eq. (2.11), and of N and Q at constant slope
    for (int k = 0; k < 3; ++k) {
      const Column u = follows_.col(k);
      slope[k] = slope_of(u);
      if (k == 2) slope[k] += s_;
      pull[k] = u[n_] * c + u[n_ + 1] * s;
      push[k] = u[n_ + 1] * c - u[n_] * s;
      along[k] = pull[k] + Q_ * slope[k];
      across[k] = push[k] - N_ * slope[k];
    }
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l <= k; ++l)
        out.losses(k, l) = out.losses(l, k) =
            (l == 2) + bending(follows_.col(k), follows_.col(l)) + (w_ * (axial_ * along[k] * along[l] + shear_ * across[k] * across[l])).sum();
    if (!with_slopes || rate.isZero(0)) return;
    const double difference = axial_ - shear_;
    const Field third = Q_ * (1 + 4 * difference * N_);
    const auto by_force = [&](int a) -> Field { return pull[a] + 2 * difference * (N_ * pull[a] - Q_ * push[a]); };
    for (int k = 0; k < 3; ++k)
      for (int m = 0; m <= k; ++m) {
        // The second derivatives of the unknowns by displacements k and m: Eq. (2.12).
        const Field both = slope[k] * slope[m];
        const Field turned = w_ * (third * both + by_force(k) * slope[m] + by_force(m) * slope[k] - difference * (pull[k] * push[m] + push[k] * pull[m]));
        const Field in_line = w_ * (both * (1 + 2 * difference * N_) - difference * (push[k] * slope[m] + push[m] * slope[k]));
        const Field beside = w_ * (-2 * difference * Q_ * both - difference * (pull[k] * slope[m] + pull[m] * slope[k]));
        Column right(n_ + 2);
        right.head(n()) = -against_functions(turned);
        right[n_] = -(in_line * c - beside * s).sum();
        right[n_ + 1] = -(in_line * s + beside * c).sum();
        const Column second = lu_.solve(right);
        const Field bent = slope_of(second), pulled = second[n_] * c + second[n_ + 1] * s, pushed = second[n_ + 1] * c - second[n_] * s;
        add_turn(k, m, rate, second, pulled + push[k] * slope[m] + across[m] * slope[k] + Q_ * bent, pushed - pull[k] * slope[m] - along[m] * slope[k] - N_ * bent, along, across, out);
        if (m != k)
          add_turn(m, k, rate, second, pulled + push[m] * slope[k] + across[k] * slope[m] + Q_ * bent, pushed - pull[m] * slope[k] - along[k] * slope[m] - N_ * bent, along, across, out);
      }
  }

  // What a change m of the change k of the unknowns adds to the derivatives of the losses.
  void add_turn(int k, int m, const Vec3& rate, const Column& second, const Field& more_along, const Field& more_across, const std::array<Field, 3>& along,
                const std::array<Field, 3>& across, BladeAnswer& out) const {
    for (int l = 0; l < 3; ++l) {
      const double change = bending(second, follows_.col(l)) + (w_ * (axial_ * more_along * along[l] + shear_ * more_across * across[l])).sum();
      out.losses_turn(k, m) += change * rate[l];
      out.losses_turn(l, m) += change * rate[k];
    }
  }

  double axial_, shear_;
  int n_;  // N, if that is known
  Eigen::Map<const Field> s_, w_;
  Eigen::Map<const Functions> angle_, curvature_;
  Field slope_, cosine_, sine_, versine_;  // 1 - cosine in `versine_`
  Field N_, Q_;                            // force along and across the blade
  Field bends_, turns_;                    // first and second derivatives of the integrand of Eq. (2.3) by the slope
  Square H_;                               // of the unknowns (c, n)
  Column residual_, by_theta_;             // and the column for theta
  double moment_ = 0, moment_by_theta_ = 0;
  Eigen::PartialPivLU<Square> lu_;
  Columns3 follows_;  // derivatives of the unknowns by the displacement
};

// Calls use(blade) with as many functions as `level` has: most blades need 8 or 16, for which the code is compiled.
template <class Use>
auto with_functions(int level, double axial, double shear, const Use& use) {
  const auto with = [&]<int N>(std::integral_constant<int, N>) {
    BentBlade<N> blade(BladeBasis::at(level), axial, shear);
    return use(blade);
  };
  if (level == 0) return with(std::integral_constant<int, BladeBasis::kFewest>());
  if (level == 1) return with(std::integral_constant<int, 2 * BladeBasis::kFewest>());
  return with(std::integral_constant<int, Eigen::Dynamic>());
}

// Calls use(blade) with as many functions as the shape and its changes require, at the equilibrium next to `shape`.
template <class Use>
bool solve(const Vec3& displacement, double axial, double shear, BladeShape& shape, const Use& use) {
  enum class Found { kNothing, kMoreWanted, kRight };
  for (;; ++shape.level) {
    const bool last = shape.level + 1 == BladeBasis::kLevels;
    const Found found = with_functions(shape.level, axial, shear, [&](auto& blade) {
      if (!blade.refine(displacement, shape)) return Found::kNothing;
      const bool right = blade.follows_changes() && blade.follows_shape(shape, kTail);
      if (!right && !last) return Found::kMoreWanted;
      if (!right && !blade.follows_shape(shape, kRoughTail)) return Found::kNothing;
      use(blade);
      return Found::kRight;
    });
    if (found != Found::kMoreWanted) return found == Found::kRight;
  }
}

// The same at the equilibrium that is connected with the straight blade: in one step if that succeeds, otherwise along a path from the straight blade: Eq. (2.9).
template <class Use>
bool find(const Vec3& displacement, double axial, double shear, const Use& use) {
  if (!displacement.allFinite() || std::hypot(1 + displacement[0], displacement[1]) - 1 > axial * kMostTension) return false;
  const auto place = [&displacement](double share) { return Vec3(share * share * displacement[0], share * displacement[1], share * displacement[2]); };
  BladeShape shape;
  double done = 0, part = 1;
  while (done < 1) {
    const double next = done + part > 1 - 1e-9 ? 1 : done + part, more = next - done;
    const Vec3 to = place(next);
    BladeShape trial = shape;
    const double bent = 3 * displacement[2] - 6 * displacement[1];  // for small deflections
    trial.theta = to[2];
    trial.c[0] += more * bent;
    trial.n[1] -= 2 * more * bent;
    if (done == 0) {  // the ends approach each other by half of the integral of the squared slope
      const double b = trial.c[0], shortening = to[2] * to[2] / 6 - to[2] * b / 12 + b * b / 60, pull = (to[0] + shortening) / axial;
      if (pull > -kSurelyStable) trial.n[0] = pull;
    }
    if (solve(to, axial, shear, trial, [&](auto& blade) { if (next == 1) use(blade, trial); })) {
      shape = trial;
      done = next;
      part *= 2;
    } else {
      part *= 0.5;
      if (part < 1.0 / kFinest) return false;
    }
  }
  return true;
}

}  // namespace

Blade::Blade(double axial_compliance, double shear_compliance) : axial_(axial_compliance), shear_(shear_compliance) { BladeBasis::at(0); }

bool Blade::has_equilibrium(const Vec3& displacement) const {
  return find(displacement, axial_, shear_, [](const auto&, const BladeShape&) {});
}

std::optional<BladeAnswer> Blade::answer(const Vec3& displacement, const Vec3& rate, bool with_slopes) const {
  std::optional<BladeAnswer> out;
  find(displacement, axial_, shear_, [&](auto& blade, const BladeShape& shape) { out = blade.answer(shape, rate, with_slopes); });
  return out;
}

std::optional<double> Blade::largest(const Vec3& displacement, double bending, double axial) const {
  std::optional<double> out;
  find(displacement, axial_, shear_, [&](const auto& blade, const BladeShape& shape) { out = blade.largest(shape, displacement, bending, axial); });
  return out;
}

}  // namespace pintle
