// The paper's procedure: raise the stiffness tenfold until the wanted digits of the chosen quantities agree. theory/ideal
// section 4.
#include "pintle/stiffen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "base/text/did_you_mean.h"
#include "check/modes/check_frequencies.h"
#include "joints/catalog.h"
#include "laws/catalog.h"
#include "laws/least_stated.h"
#include "mobility/constraint_rows.h"
#include "mobility/mobility.h"
#include "pintle/compare.h"
#include "pintle/complaint.h"
#include "pintle/simulate.h"
#include "start/start.h"

namespace pintle {
namespace {

constexpr double kTenfold = 10;
constexpr double kOwnError = 0.05;        // tolerance of each run, as a fraction of the wanted agreement
constexpr std::size_t kMostInfluences = 24;  // with more joints than this they are not tried one by one
constexpr double kGrowth = 5;             // if a peak grows by more than this per tenfold stiffness, it is proportional to the stiffness
constexpr const char* kInterrupted = "interrupted";
constexpr double kStiffEnough = 1e9;      // for finding the influence of soft joints if no stiffness was found [N/m]
constexpr double kTooLong = 30;           // a run is stopped when it has taken this many times as long as the longest before it ...
constexpr double kShortRun = 0.1;         // ... which counts as this long at least [s]
constexpr double kNoLongerFalls = 0.5;            // a change above this fraction of the previous step's is no longer falling

double wanted_agreement(const StiffenRequest& request) { return 0.5 * std::pow(10.0, -request.digits); }

bool holds_angle(const std::string& type) {
  const JointTypeInfo* info = find_joint_type(type);
  return info && std::any_of(info->gap.begin(), info->gap.end(), [](const ComponentInfo& component) { return component.angular; });
}

const std::vector<Difference>& chosen_list(const Comparison& c, const StiffenRequest& request) {
  return request.motion_only ? c.coordinates : c.forces;
}

bool is_chosen(const std::string& name, const StiffenRequest& request) {
  return request.motion_only || request.joints.empty() || std::find(request.joints.begin(), request.joints.end(), name) != request.joints.end();
}

class Procedure {
 public:
  Procedure(const Model& model, const StiffenRequest& request, const Observer& observer) : model_(model), observer_(observer) {
    out_.request = request;
    if (out_.request.first <= 0) out_.request.first = request.motion_only ? 1e5 : 1e6;
    model_.simulate.equations = Equations::kNewtonian;
    model_.simulate.method = "auto";
    model_.simulate.tolerance = std::clamp(kOwnError * wanted_agreement(request), 1e-9, model_.simulate.tolerance);
  }

  Stiffening go() {
    check_names();
    measure_mechanism();
    if (nothing_to_raise()) return std::move(out_);
    ask_ideal_joints();
    raise();
    if (out_.found) relax();
    else if (out_.steps.size() < 2) out_.reason += out_.reason.empty() ? "fewer than two stiffnesses could be run" : "";
    else if (out_.reason.empty()) explain();
    if (out_.steps.size() > 1 && out_.reason != kInterrupted) weigh_kept();
    note_servos();
    return std::move(out_);
  }

 private:
  const StiffenRequest& request() const { return out_.request; }

  void check_names() const {
    for (const std::string& name : request().joints) {
      std::vector<std::string> names;
      for (const Joint& joint : model_.joints) names.push_back(joint.name);
      if (std::find(names.begin(), names.end(), name) != names.end()) continue;
      Complaint complaint;
      complaint.path = "joint." + name;
      complaint.found = "\"" + name + "\"";
      complaint.because = "the model has no such joint";
      complaint.suggestion = did_you_mean(name, names).value_or("");
      throw InputError({complaint});
    }
  }

  // Lengths, masses, and which joints are intentionally soft.
  void measure_mechanism() {
    const Assembly start = start_of_run(model_);
    length_ = arm_length(start.system, kinematics_at_rest(start.system, start.state.q));
    redundancies_ = check_mobility(start.system, start.state.q).redundancies;
    for (const CheckComponent& c : check_frequencies(start.system, start.state, -1).components) {
      double& mass = mass_[c.component == "angle" ? c.joint + ".angle" : c.joint];
      mass = mass > 0 ? std::min(mass, c.effective_mass) : c.effective_mass;
    }
    for (const Joint& joint : model_.joints) {
      StiffenJoint& j = out_.joints.emplace_back();
      j.name = joint.name;
      j.type = joint.type;
      j.stated = least_value(joint.law, "stiffness");
      const bool fixed_law = !find_law(joint.law.word)->stiffens || find_joint_type(joint.type)->one_sided;
      if (fixed_law) as_it_is_.insert(joint.name);
      j.kept = fixed_law || j.stated < request().first ||
               (holds_angle(joint.type) && least_value(joint.law, "angular_stiffness") < request().first * length_ * length_);
      set(j, request().first);
      if (!j.kept) continue;
      j.stiffness = j.stated;
      j.damping = least_value(joint.law, "damping");
      j.angular_stiffness = holds_angle(joint.type) ? least_value(joint.law, "angular_stiffness") : 0;
      j.angular_damping = holds_angle(joint.type) ? least_value(joint.law, "angular_damping") : 0;
    }
  }

  // The limit is that of a mechanism whose motors are still compliant.
  void note_servos() {
    std::string names;
    for (const Motor& motor : model_.motors)
      if (motor.kind != MotorKind::kEffort) names += (names.empty() ? "" : ", ") + motor.name;
    if (!names.empty()) out_.notes.push_back("servos are not stiffened (" + names + "): the limit includes their deflection. With ideal joints they would follow exactly");
  }

  // If no joint has a stiffness that may be raised, a comparison would be pointless.
  bool nothing_to_raise() {
    if (std::any_of(out_.joints.begin(), out_.joints.end(), [](const StiffenJoint& joint) { return !joint.kept; })) return false;
    out_.reason = "no joint has a stiffness to raise: all have laws of their own, or are softer than the starting stiffness; try --law joint.NAME=linear for those that are to be rigid";
    return true;
  }

  // Runs with ideal joints: if the motion passes singular positions, forces need not have a limit.
  void ask_ideal_joints() {
    Model ideal = model_;
    ideal.simulate.equations = Equations::kIdeal;
    ideal.simulate.tolerance = std::max(ideal.simulate.tolerance, 1e-6);
    Trajectory run;
    try {
      run = simulate(ideal, observer_);
    } catch (const AssemblyError&) {
      return;  // some joint has no ideal limit
    }
    for (const std::string& note : run.notes) {
      if (!note.starts_with("ideal joints:")) continue;
      ideal_notes_.push_back(note);
      singular_ = singular_ || note.find("singular") != std::string::npos;
    }
  }

  // Sets a stiffness with its damping; those of angles are scaled by the mechanism's length.
  void set(StiffenJoint& joint, double stiffness) const {
    const auto mass_of = [this](const std::string& name) {
      const auto it = mass_.find(name);
      return it == mass_.end() ? 1.0 : it->second;
    };
    const auto damping_of = [&](double k, double plain, const std::string& name) {
      return request().damping_ratio ? 2 * *request().damping_ratio * std::sqrt(k * mass_of(name)) : plain;
    };
    const double area = length_ * length_;
    joint.stiffness = stiffness;
    joint.damping = damping_of(stiffness, request().damping, joint.name);
    joint.angular_stiffness = holds_angle(joint.type) ? stiffness * area : 0;
    joint.angular_damping = joint.angular_stiffness > 0 ? damping_of(stiffness * area, request().damping * area, joint.name + ".angle") : 0;
  }

  void set_all(double stiffness) {
    for (StiffenJoint& joint : out_.joints)
      if (!joint.kept) set(joint, stiffness);
  }

  // False if the procedure cannot continue; the reason then says why.
  bool run(const std::vector<StiffenJoint>& joints, double stiffness, Trajectory& out) {
    const double most = out_.steps.empty() ? std::numeric_limits<double>::infinity() : kTooLong * std::max(longest_run_, kShortRun);
    bool too_long = false;
    out = simulate(stiffened(model_, joints), [&](const Progress& progress) {
      too_long = progress.wall_seconds > most;
      return !too_long && (!observer_ || observer_(progress));
    });
    longest_run_ = std::max(longest_run_, out.wall_seconds);
    if (too_long) {
      out_.reason = fmt::format("the run with {:.0e} N/m was stopped after {:.2g} s, {:g} times as long as the longest before it: joints this stiff ring without end. Try a higher --damping, or --damping-ratio 0.1", stiffness, out.wall_seconds, kTooLong);
      return false;
    }
    if (out.outcome == Outcome::kInterrupted) out_.reason = kInterrupted;
    const bool wrong = out.outcome == Outcome::kFailed || out.outcome == Outcome::kRunaway || out.outcome == Outcome::kEnergyOpen;
    if (wrong) out_.reason = fmt::format("the run with {:.0e} N/m failed: {}", stiffness, out.message);
    if (out.outcome == Outcome::kHorizon) out_.reason = fmt::format("with {:.0e} N/m {}; the peaks of two such runs cannot be compared: try a duration within that time", stiffness, out.message);
    return out_.reason.empty();
  }

  void raise() {
    Trajectory before, now;
    for (double k = request().first; k <= request().last * 1.001; k *= kTenfold) {
      set_all(k);
      if (!run(out_.joints, k, now)) {
        if (!out_.steps.empty() || out_.reason == kInterrupted) return;
        out_.notes.push_back(std::exchange(out_.reason, ""));  // too soft for this mechanism: continue
        continue;
      }
      add_step(k, out_.steps.empty() ? now : before, now);
      find_limits();
      out_.stiffness = k;
      stiffest_ = now;
      if (out_.steps.size() > 1 && out_.steps.back().change <= wanted_agreement(request())) {
        out_.found = true;
        return;
      }
      if (no_longer_falls()) return;
      before = std::move(now);
    }
  }

  // Whether some quantity still changes by nearly as much as in the previous step. The changes are absolute, because a peak that goes to zero changes by the same
  // fraction of itself in every step.
  bool changes_as_before(std::size_t i) const {
    const StiffenStep &now = out_.steps[i], &before = out_.steps[i - 1];
    for (std::size_t q = 0; q < now.changes.size(); ++q)
      if (now.changes[q] > wanted_agreement(request()) && now.changes[q] * now.peaks[q] > kNoLongerFalls * before.changes[q] * before.peaks[q]) return true;
    return false;
  }

  // Two successive steps that each changed nearly as much as the previous one; one such step if the motion is known to be singular.
  bool no_longer_falls() const {
    const std::size_t n = out_.steps.size();
    const auto still = [this](std::size_t i) { return changes_as_before(i); };
    return singular_ ? n > 2 && still(n - 1) : n > 3 && still(n - 1) && still(n - 2);
  }

  void add_step(double stiffness, const Trajectory& before, const Trajectory& now) {
    const Comparison c = compare(model_, before, now, Equations::kNewtonian);
    StiffenStep step;
    step.stiffness = stiffness;
    const bool first = out_.steps.empty();
    step.change = first ? std::numeric_limits<double>::quiet_NaN() : 0;
    for (const Difference& d : chosen_list(c, request())) {
      if (!is_chosen(d.name, request())) continue;
      if (first) {
        out_.quantities.push_back(d.name);
        out_.limits.push_back({d.name, d.unit});
      }
      step.peaks.push_back(d.peak);
      step.changes.push_back(d.relative);
      if (first || d.relative < step.change) continue;
      step.change = d.relative;
      step.where = d.name;
    }
    for (const LoadSummary& joint : now.joints)
      if (is_chosen(joint.name, request())) step.error_estimate = std::max(step.error_estimate, joint.relative_error_estimate);
    out_.steps.push_back(std::move(step));
  }

  // theory/ideal Eq. (4.1): the part that falls as 1/stiffness is subtracted.
  void find_limits() {
    const std::size_t n = out_.steps.size();
    const auto extrapolated = [this](std::size_t step, std::size_t i) {
      return (kTenfold * out_.steps[step].peaks[i] - out_.steps[step - 1].peaks[i]) / (kTenfold - 1);
    };
    for (std::size_t i = 0; i < out_.limits.size(); ++i) {
      StiffenLimit& limit = out_.limits[i];
      const StiffenStep& last = out_.steps.back();
      limit.peak = limit.limit = last.peaks[i];
      limit.error = std::numeric_limits<double>::infinity();
      limit.digits = n > 1 ? agreeing_digits(last.changes[i]) : 0;
      if (n < 2) continue;
      limit.limit = extrapolated(n - 1, i);
      const double own = 1.3 * (request().motion_only ? model_.simulate.tolerance : last.error_estimate) * last.peaks[i];
      limit.error = own + (n < 3 ? std::abs(limit.limit - last.peaks[i]) : std::abs(limit.limit - extrapolated(n - 2, i)) / kTenfold);
    }
  }

  // The largest relative difference of the chosen quantities.
  std::pair<double, std::string> difference(const Trajectory& a, const Trajectory& b) const {
    std::pair<double, std::string> worst{0, ""};
    const Comparison c = compare(model_, a, b, Equations::kNewtonian);
    for (const Difference& d : chosen_list(c, request()))
      if (is_chosen(d.name, request()) && d.relative > worst.first) worst = {d.relative, d.name};
    return worst;
  }

  // Joints whose compliance matters little may be softer. Each joint's influence is proportional to 1 / its stiffness.
  void relax() {
    const double k = out_.stiffness;
    const auto free = static_cast<std::size_t>(std::count_if(out_.joints.begin(), out_.joints.end(), [](const StiffenJoint& j) { return !j.kept; }));
    if (free < 2 || free > kMostInfluences) return;
    double all = 0;
    for (StiffenJoint& joint : out_.joints) {
      if (joint.kept) continue;
      std::vector<StiffenJoint> softer = out_.joints;
      set(softer[static_cast<std::size_t>(&joint - out_.joints.data())], k / kTenfold);
      Trajectory trial;
      if (!run(softer, k / kTenfold, trial)) return give_up_relaxing();
      joint.influence = difference(trial, stiffest_).first / (kTenfold - 1);
      all += joint.influence;
    }
    const std::vector<StiffenJoint> uniform = out_.joints;
    while (StiffenJoint* joint = least_loss()) {
      const double loss = (kTenfold - 1) * joint->influence;
      if (all + loss > 0.5 * wanted_agreement(request())) break;
      all += loss;
      joint->influence *= kTenfold;
      set(*joint, joint->stiffness / kTenfold);
    }
    Trajectory relaxed;
    const bool good = run(out_.joints, k, relaxed) && difference(relaxed, stiffest_).first <= wanted_agreement(request());
    if (!good) {
      out_.joints = uniform;
      give_up_relaxing();
    }
  }

  StiffenJoint* least_loss() {
    StiffenJoint* least = nullptr;
    for (StiffenJoint& joint : out_.joints)
      if (!joint.kept && joint.stiffness > 1.5 * request().first && (!least || joint.influence < least->influence)) least = &joint;
    return least;
  }

  void give_up_relaxing() {
    if (out_.reason != kInterrupted) out_.reason.clear();
    out_.notes.push_back("softening individual joints would lose digits: the same stiffness is recommended for all");
  }

  // The change if the intentionally soft joints were stiff as well.
  void weigh_kept() {
    std::string names;
    std::vector<StiffenJoint> stiff = out_.joints;
    for (StiffenJoint& joint : stiff) {
      if (!joint.kept || as_it_is_.contains(joint.name)) continue;
      names += (names.empty() ? "" : ", ") + joint.name;
      joint.kept = false;
    }
    if (names.empty()) return;
    const double stiffness = out_.found ? out_.stiffness : std::min(out_.stiffness, kStiffEnough);
    for (StiffenJoint& joint : stiff)
      if (!joint.kept) set(joint, stiffness);
    const std::string before = std::exchange(out_.reason, "");
    Trajectory all_stiff;
    if (!run(stiff, stiffness, all_stiff)) {
      out_.notes.push_back("with " + names + " stiffened too: " + out_.reason);
      out_.reason = before;
      return;
    }
    const auto [change, where] = difference(all_stiff, stiffest_);
    out_.kept_influence = change;
    out_.kept_where = where;
    const std::string verdict = change <= wanted_agreement(request())
                      ? fmt::format("{}: softer than the starting stiffness, left as stated; it does not affect the chosen quantities", names)
                      : fmt::format("{}: its own flexibility matters. Stiffening it too would change {} by {:.2g} of its peak: its real stiffness must be known, a larger one is no substitute",
                                    names, where, change);
    out_.reason = before.empty() ? verdict : before + "; " + verdict;
  }

  // Names of joints that are stuck at the end of the stiffest run.
  std::string stuck_at_end() const {
    constexpr std::string_view kBefore = "joint.", kAfter = ".stuck";
    std::string names;
    for (std::size_t i = 0; i < stiffest_.columns.size() && stiffest_.n_rows() > 0; ++i) {
      const std::string& name = stiffest_.columns[i].name;
      if (!name.starts_with(kBefore) || !name.ends_with(kAfter) || !(stiffest_.at(stiffest_.n_rows() - 1, i) > 0)) continue;
      names += (names.empty() ? "" : ", ") + name.substr(kBefore.size(), name.size() - kBefore.size() - kAfter.size());
    }
    return names;
  }

  // Explains why no stiffness was sufficient.
  void explain() {
    const StiffenStep &last = out_.steps.back(), &before = out_.steps[out_.steps.size() - 2];
    const auto worst = static_cast<std::size_t>(std::find(out_.quantities.begin(), out_.quantities.end(), last.where) - out_.quantities.begin());
    out_.reason = fmt::format("{} still changes by {:.2g} of its peak from {:.0e} to {:.0e} N/m", last.where, last.change, before.stiffness, last.stiffness);
    if (last.peaks[worst] > kGrowth * before.peaks[worst]) {
      out_.reason += "; the change grows with the stiffness: a misfit preloads the joints, and only their real stiffness determines how much";
      for (const CheckRedundancy& group : redundancies_) {
        std::string names;
        for (const auto& member : group.members)
          if (names.find(member.joint) == std::string::npos) names += (names.empty() ? "" : ", ") + member.joint;
        out_.notes.push_back(fmt::format("{} redundant constraint{} among {}", group.degree, group.degree == 1 ? "" : "s", names));
      }
      return;
    }
    out_.notes.insert(out_.notes.end(), ideal_notes_.begin(), ideal_notes_.end());
    if (last.change < before.change / 5)
      out_.reason += fmt::format("; the change falls as 1/stiffness: {:.0e} N/m is within {:.1g} of the limit, and the extrapolated limit below is closer", last.stiffness, last.change / (kTenfold - 1));
    else if (singular_) out_.reason += "; the mechanism passes singular positions, where forces depend on the joints' compliance";
    else if (const std::string stuck = stuck_at_end(); !stuck.empty())
      out_.reason += fmt::format("; friction holds {} at the end, and the load of joints that stick depends on how they came to rest: with friction = \"none\" the limit is unique", stuck);
    else if (changes_as_before(out_.steps.size() - 1)) out_.reason += "; the change no longer falls: check for vibration, impact or slack, or ask for fewer digits";
  }

  Model model_;
  const Observer& observer_;
  Stiffening out_;
  Trajectory stiffest_;
  double length_ = 1;
  double longest_run_ = 0;              // [s]
  std::set<std::string> as_it_is_;      // joints whose laws do not scale with stiffness
  std::map<std::string, double> mass_;  // effective, by joint and by "joint.angle" [kg], [kg*m^2]
  std::vector<CheckRedundancy> redundancies_;
  std::vector<std::string> ideal_notes_;
  bool singular_ = false;
};

}  // namespace

Model stiffened(const Model& model, const std::vector<StiffenJoint>& joints) {
  Model out = model;
  for (const StiffenJoint& from : joints) {
    const auto joint = std::find_if(out.joints.begin(), out.joints.end(), [&](const Joint& j) { return j.name == from.name; });
    if (joint == out.joints.end() || from.kept) continue;
    joint->law.values["stiffness"] = {from.stiffness};
    joint->law.values["damping"] = {from.damping};
    if (from.angular_stiffness <= 0) continue;
    joint->law.values["angular_stiffness"] = {from.angular_stiffness};
    joint->law.values["angular_damping"] = {from.angular_damping};
  }
  return out;
}

Stiffening stiffen(const Model& model, const StiffenRequest& request, const Observer& observer) {
  return Procedure(model, request, observer).go();
}

}  // namespace pintle
