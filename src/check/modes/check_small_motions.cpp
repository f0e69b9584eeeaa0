#include "check/modes/check_small_motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "integrators/general/motion_jacobian.h"
#include "linalg/dense_factors.h"
#include "start/start.h"

namespace pintle {
namespace {

constexpr int kMostUnknowns = 400;  // positions, velocities and states of laws: a check of a hanging chain with so many takes 0.2 s, and the time grows with their cube

CheckSmallMotion small_motion(const System& system, std::complex<double> lambda, const Eigen::VectorXcd& shape) {
  CheckSmallMotion out;
  out.real = lambda.real();
  out.imaginary = lambda.imag();
  out.frequency = std::abs(lambda);
  out.damping_ratio = -out.real / out.frequency;
  const Eigen::VectorXd moving = shape.head(3 * system.n_bodies()).cwiseAbs2();
  Eigen::Index most = 0;
  const double largest = moving.maxCoeff(&most), all = moving.sum();
  out.body = system.bodies[static_cast<std::size_t>(most / 3)].name;
  out.direction = most % 3 == 0 ? "x" : most % 3 == 1 ? "y" : "angle";
  out.share = all > 0 ? largest / all : 0;
  return out;
}

std::string why_not(const System& system, const State& start) {
  if (std::any_of(system.joints.begin(), system.joints.end(), [](const JointData& joint) { return joint.ideal; })) return "they are known for joints that are force laws, not for ideal ones";
  if (motion_unknowns(system) > kMostUnknowns) return fmt::format("not searched for in a mechanism with more than {} positions, velocities and states", kMostUnknowns);
  if (!is_at_rest(system, start)) return "the mechanism does not rest at its start, or something drives it there; without motion and drives, start = \"settled\" lets it come to rest first";
  return "";
}

}  // namespace

CheckSmallMotions check_small_motions(const System& system, const State& start) {
  CheckSmallMotions out;
  out.remark = why_not(system, start);
  GeneralEigen eigen;
  if (!out.remark.empty() || !eigen.compute(motion_jacobian(system, start))) return out;
  out.known = true;
  out.resolved = kResolvedEigenvalue * eigen.eigenvalues().cwiseAbs().maxCoeff();
  int n_slow = 0;
  for (Eigen::Index i = 0; i < eigen.eigenvalues().size(); ++i) {
    const std::complex<double> lambda = eigen.eigenvalues()[i];
    if (!(std::abs(lambda) > out.resolved)) ++n_slow;
    else if (!(lambda.imag() < 0)) out.modes.push_back(small_motion(system, lambda, eigen.eigenvectors().col(i)));
  }
  out.n_free = (n_slow + 1) / 2;
  std::stable_sort(out.modes.begin(), out.modes.end(), [](const CheckSmallMotion& a, const CheckSmallMotion& b) { return a.frequency < b.frequency; });
  return out;
}

}  // namespace pintle
