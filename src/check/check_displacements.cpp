// Joint displacements: Jacobians, rates, convective terms, rate gradients and geometric stiffness against differences.
#include <algorithm>
#include <cmath>

#include "check/check_batteries.h"
#include "check/check_differences.h"

namespace pintle {
namespace {

using S = Planar;
using Vec6 = DisturbedLink::Vec6;
using Mat36 = Eigen::Matrix<double, 3, 6>;

class DisplacementSlopes {
 public:
  explicit DisplacementSlopes(const System& system) : system_(system) {}

  void look(const CheckLink& link, const CheckState& state, std::vector<S::Motion>& scratch) {
    DisturbedLink bodies(system_, link, state, scratch);
    const RelativePose pose = bodies.pose();
    const LinkSteps steps = link_steps(link, pose, state.length);
    if (!(steps.length > 1e-12)) return;  // two coincident points have no direction
    const JointKinematics here = bodies.kinematics(Vec6::Zero());
    const CheckPlace place{link.kind, link.name, state.number};
    Vec6 step;
    step << steps.length, steps.length, steps.angle, steps.length, steps.length, steps.angle;
    Mat36 G;
    G << here.GA(), here.GB();
    look_at_gap(bodies, link, G, step, place);
    look_at_rates(bodies, link, state, here, G, steps, place);
    look_at_rate_gradient(bodies, link, state, pose, here, G, step, place);
    look_at_geometric(bodies, link, pose, step, place);
  }

  void report(CheckBattery& battery) const {
    for (const Comparisons* c : {&jacobian_, &rate_, &bias_, &rate_gradient_, &geometric_})
      battery.items.push_back(c->item());
  }

 private:
  // Columns of the ground are not used.
  static Eigen::MatrixXd used(const DisturbedLink& bodies, Eigen::MatrixXd columns) {
    for (int c = 0; c < 6; ++c)
      if (!bodies.moves(c)) columns.col(c).setZero();
    return columns;
  }

  // The rate of a slip is not the rate of a gap.
  static void leave_out_slip(const CheckLink& link, auto&& rows) {
    if (link.slip >= 0) rows.row(link.slip).setZero();
  }

  void look_at_gap(DisturbedLink& bodies, const CheckLink& link, const Mat36& G, const Vec6& step, const CheckPlace& place) {
    Mat36 of_gap = G;
    leave_out_slip(link, of_gap);
    jacobian_.slopes(
        used(bodies, of_gap), [&](int c, double s) { return bodies.kinematics(s * Vec6::Unit(c)).gap; }, step, 0, place);
  }

  void look_at_rates(DisturbedLink& bodies, const CheckLink& link, const CheckState& state, const JointKinematics& here, const Mat36& G, const LinkSteps& steps,
                     const CheckPlace& place) {
    constexpr double kRounding = 1e-9;  // as a fraction of lengths and angles, with a margin: differences cannot resolve less
    constexpr double kLeastHurry = 100;  // lower limit [1/s]: a joint at rest may be driven by functions of time that change within 10 ms
    constexpr double kAcross = 1e-3;  // as a fraction of the bodies' speeds: the rate of a gap is compared with this if they move across it
    const Vec6 v = bodies.velocities();
    const double spin = std::max(std::abs(v[2]), std::abs(v[5]));
    const double approach = here.rate.cwiseAbs().maxCoeff() + v.head<2>().norm() + v.segment<2>(3).norm();
    const double hurry = std::max(spin / steps.angle, approach / steps.length);  // steps per second
    const double dt = 1 / std::max(hurry, kLeastHurry);
    // If the bodies move across a gap, such as that of a spring on a ball circling its foot, the gap changes only by the roundoff of the motion.
    const double size = (G.cwiseAbs() * v.cwiseAbs()).maxCoeff() + here.rate.cwiseAbs().maxCoeff() + kAcross * approach + kRounding * std::max(state.length, 1.0) / dt;
    S::Vec of_gap = here.rate;
    leave_out_slip(link, of_gap);
    rate_.slope(
        of_gap, [&](double s) -> Eigen::VectorXd { return bodies.kinematics(Vec6::Zero(), s).gap; }, dt, size, place);
    bias_.slope(
        here.bias, [&](double s) -> Eigen::VectorXd { return bodies.kinematics(Vec6::Zero(), s).rate; }, dt,
        size * std::max(spin, 1e-3 / dt), place);
  }

  void look_at_rate_gradient(DisturbedLink& bodies, const CheckLink& link, const CheckState& state,
                             const RelativePose& pose, const JointKinematics& here, const Mat36& G, const Vec6& step,
                             const CheckPlace& place) {
    const Mat36 analytic = rate_gradient(link.displacement, pose, motion_of(link.at.a, state.m), motion_of(link.at.b, state.m));
    // Rates that cancel in a constant gap, as of a cam in its dwell, leave their roundoff.
    const double size = (G.cwiseAbs() * bodies.velocities().cwiseAbs()).maxCoeff() + here.rate.cwiseAbs().maxCoeff() + pose.rate.cwiseAbs().maxCoeff();
    rate_gradient_.slopes(
        used(bodies, analytic), [&](int c, double s) { return bodies.kinematics(s * Vec6::Unit(c)).rate; }, step,
        size / state.length * 1e-3, place);
  }

  void look_at_geometric(DisturbedLink& bodies, const CheckLink& link, const RelativePose& pose, const Vec6& step,
                         const CheckPlace& place) {
    const S::Vec f = std::holds_alternative<Selection>(link.displacement) ? S::Vec(0.7, -1.1, 0.4) : S::Vec(1.3, link.slip == kSlip ? -0.6 : 0, 0);
    const Eigen::MatrixXd analytic = geometric_stiffness(link.displacement, pose, f);
    geometric_.slopes(
        used(bodies, analytic),
        [&](int c, double s) {
          const JointKinematics r = bodies.kinematics(s * Vec6::Unit(c));
          Vec6 Q;
          Q << r.GA().transpose() * f, r.GB().transpose() * f;
          return Q;
        },
        step, f.norm(), place);
  }

  const System& system_;
  Comparisons jacobian_{"gap Jacobians", kSlopeTolerance}, rate_{"gap rates", kSlopeTolerance},
      bias_{"convective terms", kSlopeTolerance}, rate_gradient_{"rate gradients", kSlopeTolerance},
      geometric_{"geometric stiffness", kSlopeTolerance};
};

}  // namespace

void check_displacement_slopes(const System& system, const std::vector<CheckState>& states, CheckBattery& battery) {
  DisplacementSlopes slopes(system);
  const std::vector<CheckLink> links = check_links(system);
  for (const CheckState& state : states) {
    std::vector<S::Motion> scratch = state.m;
    for (const CheckLink& link : links) slopes.look(link, state, scratch);
  }
  slopes.report(battery);
}

}  // namespace pintle
