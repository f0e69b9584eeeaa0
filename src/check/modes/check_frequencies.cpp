#include "check/modes/check_frequencies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "laws/law_tangents.h"
#include "linalg/dense_factors.h"
#include "mobility/constraint_rows.h"

namespace pintle {
namespace {

using S = Planar;

constexpr int kDenseFreedoms = 450;  // all modes up to here, only the fastest beyond

// Columns scaled by the square root of the mass: K_m = sum k g g', g = M^-1/2 G'. A row involves two bodies.
class MassScaledRows {
 public:
  MassScaledRows(const System& system, const std::vector<ConstraintRow>& rows) : system_(system), rows_(rows) {
    scale_.resize(S::kDof * system.n_bodies());
    for (int i = 0; i < system.n_bodies(); ++i)
      scale_.segment<3>(3 * i) = system.bodies[i].mass.cwiseSqrt().cwiseInverse();
  }
  int size() const { return static_cast<int>(scale_.size()); }
  int n_rows() const { return static_cast<int>(rows_.size()); }
  const ConstraintRow& row(int i) const { return rows_[i]; }

  double dot(int i, const Eigen::VectorXd& x) const {
    double sum = 0;
    for_each(i, [&](int column, double value) { sum += value * x[column]; });
    return sum;
  }
  void add(int i, double factor, Eigen::VectorXd& y) const {
    for_each(i, [&](int column, double value) { y[column] += factor * value; });
  }
  // Calls use(j, stiffness, damping) for the row itself and for the other rows of its joint, with the values that couple it to them.
  template <class Use>
  void for_each_coupled(int i, Use&& use) const {
    const ConstraintRow& row = rows_[i];
    use(i, row.stiffness, row.damping);
    for (int j = std::max(0, i - S::kDof); j < std::min(n_rows(), i + S::kDof); ++j) {
      const ConstraintRow& other = rows_[j];
      if (j == i || other.joint != row.joint) continue;
      use(j, 0.5 * (row.stiffness_by[other.component] + other.stiffness_by[row.component]), 0.5 * (row.damping_by[other.component] + other.damping_by[row.component]));
    }
  }
  double mobility(int i) const {  // g' g = G M^-1 G' [1/kg]
    double sum = 0;
    for_each(i, [&](int, double value) { sum += value * value; });
    return sum;
  }
  Eigen::MatrixXd stiffness() const {
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size(), size());
    for (int i = 0; i < n_rows(); ++i)
      for_each_coupled(i, [&](int j, double stiffness, double) { for_each(i, [&](int a, double x) { for_each(j, [&](int b, double y) { K(a, b) += stiffness * x * y; }); }); });
    return K;
  }
  // The mode with shape x of unit length.
  CheckMode mode(const Eigen::VectorXd& x) const {
    double stiffness = 0, damping = 0, most = -1;
    int dominant = 0;
    for (int i = 0; i < n_rows(); ++i) {
      const double g = dot(i, x);
      double energy = 0;
      for_each_coupled(i, [&](int j, double k, double c) {
        const double other = dot(j, x);
        energy += k * g * other;
        damping += c * g * other;
      });
      stiffness += energy;
      if (energy > most) {
        most = energy;
        dominant = i;
      }
    }
    const JointData& joint = system_.joints[rows_[dominant].joint];
    CheckMode out;
    out.frequency = std::sqrt(stiffness);
    out.damping_ratio = stiffness > 0 ? damping / (2 * out.frequency) : 0;
    out.joint = joint.name;
    out.component = component_name(joint, rows_[dominant].component);
    out.share = stiffness > 0 ? most / stiffness : 0;
    return out;
  }

 private:
  template <class Use>
  void for_each(int i, Use&& use) const {
    const Placement& at = system_.joints[rows_[i].joint].at;
    for (int k = 0; k < S::kDof; ++k) {
      if (at.a != kGround) use(3 * at.a + k, rows_[i].on_a[k] * scale_[3 * at.a + k]);
      if (at.b != kGround) use(3 * at.b + k, rows_[i].on_b[k] * scale_[3 * at.b + k]);
    }
  }

  const System& system_;
  const std::vector<ConstraintRow>& rows_;
  Eigen::VectorXd scale_;
};

std::vector<CheckComponent> local_components(const System& system, const MassScaledRows& rows) {
  std::vector<CheckComponent> out;
  for (int i = 0; i < rows.n_rows(); ++i) {
    const ConstraintRow& row = rows.row(i);
    const JointData& joint = system.joints[row.joint];
    const double mobility = rows.mobility(i);
    if (!(mobility > 0)) continue;
    CheckComponent& c = out.emplace_back();
    c.joint = joint.name;
    c.type = joint.type;
    c.component = component_name(joint, row.component);
    c.stiffness = row.stiffness;
    c.damping = row.damping;
    c.effective_mass = 1 / mobility;
    c.frequency = std::sqrt(row.stiffness * mobility);
    c.damping_ratio = row.damping * mobility / (2 * c.frequency);
  }
  return out;
}

std::vector<CheckMode> all_modes(const MassScaledRows& rows, int n_free) {
  std::vector<CheckMode> modes;
  SymmetricEigen modes_of_rows;
  if (!modes_of_rows.compute(rows.stiffness())) return modes;
  for (int i = n_free; i < rows.size(); ++i) modes.push_back(rows.mode(modes_of_rows.eigenvectors().col(i)));
  std::stable_sort(modes.begin(), modes.end(), [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  return modes;
}

// The stiffest direction, by power iteration from a vector with a component in every direction.
CheckMode fastest_mode(const MassScaledRows& rows) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(rows.size());
  for (int i = 0; i < rows.n_rows(); ++i) rows.add(i, 1 + 0.5 * std::sin(i), x);
  double last = 0;
  for (int iteration = 0; iteration < 1000; ++iteration) {
    const double size = x.norm();
    if (!(size > 0)) break;
    x /= size;
    if (iteration > 20 && std::abs(size - last) < 1e-7 * size) break;
    last = size;
    Eigen::VectorXd next = Eigen::VectorXd::Zero(rows.size());
    for (int i = 0; i < rows.n_rows(); ++i) rows.for_each_coupled(i, [&](int j, double stiffness, double) { rows.add(i, stiffness * rows.dot(j, x), next); });
    x = next;
  }
  return rows.mode(x.normalized());
}

// Laws with states of their own, such as rubber, become stiffer and less damped the faster they vibrate. Each component gets the spring K and the damper C for which
// Z(mu) = K + mu C at the mu with which it vibrates alone, mu^2 m + Z(mu) = 0.
void take_at_their_frequencies(const System& system, const std::vector<JointKinematics>& joint_kinematics, std::vector<ConstraintRow>& rows) {
  constexpr int kPasses = 20;          // upper limit on passes of stiffness and frequency: three or four are enough
  constexpr double kAgreement = 1e-6;  // relative change of the frequency at which the passes end
  const MassScaledRows scaled(system, rows);
  const S::Vec still = S::Vec::Zero();
  for (int i = 0; i < scaled.n_rows(); ++i) {
    ConstraintRow& row = rows[static_cast<std::size_t>(i)];
    const Law& law = system.joints[row.joint].law;
    if (row.servo || law.n_states() == 0) continue;
    std::vector<double> state(static_cast<std::size_t>(law.n_states()));
    const S::Vec& gap = joint_kinematics[row.joint].gap;
    law.rest({0, gap, still, state.data()}, state.data());
    LawTangents tangents;
    law.linearize({0, gap, still, state.data()}, tangents);
    LawImpedance<std::complex<double>> impedance;
    impedance.reserve(law.n_states());
    const double mobility = scaled.mobility(i);
    std::complex<double> mu(0, std::sqrt(row.stiffness * mobility));
    for (int pass = 0; pass < kPasses && mu.imag() > 0; ++pass) {
      impedance.find(tangents, mu);
      const std::complex<double> Z = impedance.weight[S::kDof * row.component + row.component];
      const double damping = Z.imag() / mu.imag(), stiffness = Z.real() - mu.real() * damping, decay = 0.5 * damping * mobility, square = stiffness * mobility - decay * decay;
      if (!(stiffness > 0) || !(square > 0)) break;  // the component creeps
      row.stiffness = stiffness;
      row.damping = damping;
      const std::complex<double> before = std::exchange(mu, {-decay, std::sqrt(square)});
      if (std::abs(mu - before) < kAgreement * std::abs(mu)) break;
    }
  }
}

}  // namespace

double dormand_prince_step(double frequency, double damping_ratio) {
  // The stability function of the seven-stage pair's fifth-order solution.
  const auto growth = [](std::complex<double> z) {
    return std::abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0 * (1.0 + z / 5.0 * (1.0 + z / 5.0))))));
  };
  constexpr double kMargin = 1e-6;  // for roundoff
  const std::complex<double> root = std::sqrt(std::complex<double>(damping_ratio * damping_ratio - 1, 0));
  double shortest = std::numeric_limits<double>::infinity();
  for (const double sign : {1.0, -1.0}) {
    const std::complex<double> lambda = -damping_ratio + sign * root;  // in units of the frequency
    const double size = std::abs(lambda);
    if (!(size > 0) || !(frequency > 0)) continue;
    double z = 0;  // h |lambda|
    while (z < 4 && growth(lambda / size * (z + 1e-3)) <= 1 + kMargin) z += 1e-3;
    shortest = std::min(shortest, z / (size * frequency));
  }
  return shortest;
}

CheckFrequencies check_frequencies(const System& system, const State& assembled, int n_free) {
  CheckFrequencies out;
  const auto joint_kinematics = kinematics_at_rest(system, assembled.q);
  auto constraints = constraint_rows(system, joint_kinematics, 1e-9 * arm_length(system, joint_kinematics));
  take_at_their_frequencies(system, joint_kinematics, constraints);
  const MassScaledRows rows(system, constraints);
  out.components = local_components(system, rows);
  if (out.components.empty()) return out;
  if (n_free >= 0 && rows.size() <= kDenseFreedoms) {
    out.modes = all_modes(rows, n_free);
    out.complete = true;
  } else {
    out.modes = {fastest_mode(rows)};
    out.remark = fmt::format("more than {} degrees of freedom: fastest mode only, by iteration", kDenseFreedoms);
  }
  for (const CheckMode& mode : out.modes) {
    const double step = dormand_prince_step(mode.frequency, mode.damping_ratio);
    out.explicit_step = out.explicit_step > 0 ? std::min(out.explicit_step, step) : step;
  }
  return out;
}

}  // namespace pintle
