#include "bench/joint_errors.h"

#include <algorithm>
#include <cmath>

namespace pintle::bench {
namespace {

struct Difference {
  double force = 0, couple = 0, peak = 0, peak_couple = 0;
};

// Compares up to the time until which both runs promise the force.
// The couple of a pin with friction is a small part of the effect of its force, and the run states its error separately.
Difference compare(const Trajectory& run, const Trajectory& reference, const LoadSummary& joint, bool couples) {
  const auto same = std::find_if(reference.joints.begin(), reference.joints.end(), [&joint](const LoadSummary& j) { return j.name == joint.name; });
  const double until = std::min(joint.horizon, same == reference.joints.end() ? joint.horizon : same->horizon);
  const std::string prefix = "joint." + joint.name + ".on_" + joint.second_body + ".";
  const int fx = run.column(prefix + "fx[world]"), fy = run.column(prefix + "fy[world]"),
            m = couples ? run.column(prefix + "m[world]") : -1;
  Difference d;
  for (std::size_t i = 0; i < reference.n_rows() && reference.at(i, 0) <= until; ++i) {
    const double x = reference.at(i, fx), y = reference.at(i, fy);
    d.peak = std::max(d.peak, std::hypot(x, y));
    d.force = std::max(d.force, std::hypot(run.at(i, fx) - x, run.at(i, fy) - y));
    if (m < 0) continue;
    d.peak_couple = std::max(d.peak_couple, std::abs(reference.at(i, m)));
    d.couple = std::max(d.couple, std::abs(run.at(i, m) - reference.at(i, m)));
  }
  if (same != reference.joints.end() && until >= reference.at(reference.n_rows() - 1, 0)) {  // peaks may lie between the rows, such as those of impacts
    d.peak = std::max(d.peak, same->peak);
    d.peak_couple = std::max(d.peak_couple, m < 0 ? 0 : same->peak_moment);
  }
  return d;
}

double relative(double error, double peak, double least) {
  return error / std::max({peak, least, 1e-300});
}

bool has_couple(const Model& model, const std::string& name) {
  const auto joint = std::find_if(model.joints.begin(), model.joints.end(), [&name](const Joint& j) { return j.name == name; });
  if (joint == model.joints.end() || !joint->stops.word.empty()) return true;
  return joint->friction.word.empty() && joint->law.word != "clearance" && joint->law.word != "contact";
}

double radius_of_gyration(const Model& model) {
  double radius = 0;
  for (const Body& body : model.bodies) radius = std::max(radius, std::sqrt(body.inertia / body.mass));
  return radius;
}

}  // namespace

std::vector<JointError> joint_errors(const Model& model, const Trajectory& run, const Trajectory& reference,
                                     double negligible) {
  if (run.n_rows() != reference.n_rows()) return {};
  std::vector<Difference> differences;
  double force = 0, couple = 0;
  for (const LoadSummary& joint : run.joints) {
    differences.push_back(compare(run, reference, joint, has_couple(model, joint.name)));
    force = std::max(force, differences.back().peak);
    couple = std::max(couple, differences.back().peak_couple);
  }
  couple = std::max(couple, force * radius_of_gyration(model));
  std::vector<JointError> errors;
  for (std::size_t j = 0; j < differences.size(); ++j) {
    const Difference& d = differences[j];
    const double of_force = relative(d.force, d.peak, negligible * force);
    const double of_couple = relative(d.couple, d.peak_couple, negligible * couple);
    errors.push_back({run.joints[j].name, std::max(of_force, of_couple), of_force, of_couple > of_force,
                      run.joints[j].relative_error_estimate});
  }
  return errors;
}

const JointError& worst_of(const std::vector<JointError>& joints) {
  return *std::max_element(joints.begin(), joints.end(),
                           [](const JointError& a, const JointError& b) { return a.error < b.error; });
}

}  // namespace pintle::bench
