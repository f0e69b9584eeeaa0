#include "run/record/force_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "integrators/thresholds.h"
#include "run/record/creeping_contacts.h"
#include "system/size_about_origin.h"

namespace pintle {

namespace {

// Of the joint that is stiffest against rotation [N*m/rad].
template <class S>
double largest_angular_stiffness(const BasicSystem<S>& system) {
  double stiffest = 0;
  for (const BasicJointData<S>& joint : system.joints) stiffest = std::max(stiffest, joint.law.engaged_stiffness().template tail<S::kDof - S::kDim>().maxCoeff());
  return stiffest;
}

}  // namespace

template <class S>
BasicForceRecorder<S>::BasicForceRecorder(const BasicSystem<S>& system, Recorded what)
    : system_(system), what_(what),
      stuck_joints_(system), lost_equilibria_(system), wound_belts_(system), edge_overruns_(system), drive_peaks_(system) {}

template <class S>
void BasicForceRecorder<S>::start(const BasicState<S>& state, const LoadSampling& sampling) {
  loads_.emplace(system_, sampling, what_ != Recorded::kForces, what_ == Recorded::kColumns ? signals() : nullptr);
  loads_->start(state);
  add(state);
}

template <class S>
void BasicForceRecorder<S>::see_step(BasicStepper<S>& stepper) {
  step_ = stepper.state().t - stepper.previous().t;
  // Borders are crossed before a step; the heat of the step itself comes after them.
  for (std::size_t i = heat_at_crossings_.size(); what_ != Recorded::kForces && i < stepper.crossings().size(); ++i)
    heat_at_crossings_.push_back(loads_->heat(stepper.crossings()[i].joint, stepper.previous()));
  loads_->add_step(stepper);
  if (what_ == Recorded::kForces) return;
  const BasicState<S>& state = stepper.state();
  stuck_joints_.see(state);
  lost_equilibria_.see(state);
  wound_belts_.see(state);
  edge_overruns_.see(state);
  drive_peaks_.see(state);
}

template <class S>
void BasicForceRecorder<S>::finish(const BasicStepper<S>& stepper) {
  const BasicState<S>& state = stepper.state();
  for (const typename S::Vec& load : stepper.load_scale().body) forces_.largest_load = std::max(forces_.largest_load, load[0]);
  forces_.rounding = kLastBits * largest_stiffness(system_) * size_about_origin(system_, state.q);
  forces_.rounding_couple = kLastBits * largest_angular_stiffness(system_) * largest_angle<S>(state.q);
  if (state.t > forces_.t.back()) add(state);
  if (what_ == Recorded::kForces) return;
  note_on_creeping_ = note_on_creeping_contacts(system_, state, state.t - forces_.t.front());
  for (int j = 0; j < system_.n_joints(); ++j) heat_.push_back(loads_->heat(j, state));
}

template <class S>
void BasicForceRecorder<S>::add(const BasicState<S>& state) {
  system_.motions(state.q, state.v, m_);
  forces_.t.push_back(state.t);
  forces_.step.push_back(step_);
  forces_.place.insert(forces_.place.end(), state.q.begin(), state.q.end());
  if (what_ == Recorded::kStates) forces_.velocity.insert(forces_.velocity.end(), state.v.begin(), state.v.end());
  for (int j = 0; j < system_.n_joints(); ++j) forces_.world.push_back(joint_load(system_, j, m_, state.force[j]));
  if (what_ != Recorded::kForces) add_energies(state);
}

template <class S>
void BasicForceRecorder<S>::add_energies(const BasicState<S>& state) {
  const ExternalWork loads = system_.external_work(state.t, state.q, m_, state.sliding);
  energies_.push_back({system_.kinetic(state.v), loads.potential + energy_of_joints(system_, state), state.dissipated, state.supplied});
  stuck_joints_.see(state);
  lost_equilibria_.see(state);
  wound_belts_.see(state);
  edge_overruns_.see(state);
}

template <class S>
void BasicForceRecorder<S>::keep_forces_only() {
  energies_ = {};
  forces_.velocity = {};
}

template <class S>
void BasicForceRecorder<S>::fill(Trajectory& out) {
  for (std::string& note : stuck_joints_.notes()) out.notes.push_back(std::move(note));
  for (std::string& note : lost_equilibria_.notes()) out.notes.push_back(std::move(note));
  if (!note_on_creeping_.empty()) out.notes.push_back(note_on_creeping_);
  for (const std::string& note : edge_overruns_.notes()) out.notes.push_back(note);
  for (std::string& note : wound_belts_.notes()) out.notes.push_back(std::move(note));
  out.joints.clear();
  for (int j = 0; j < system_.n_joints(); ++j) {
    const BasicJointData<S>& joint = system_.joints[j];
    if (joint.servo >= 0) continue;
    LoadSummary s;
    s.name = joint.name;
    s.type = joint.type;
    s.first_body = body_name(system_, joint.at.a);
    s.second_body = body_name(system_, joint.at.b);
    s.has_moment = has_couple(joint);
    const LoadStatistics force = loads_->force(j), couple = loads_->couple(j);
    s.peak = force.peak;
    s.peak_time = force.peak_time;
    s.mean = force.mean;
    s.rms = force.rms;
    if (s.has_moment) {
      s.peak_moment = couple.peak;
      s.mean_moment = couple.mean;
      s.rms_moment = couple.rms;
    }
    if (!heat_.empty()) s.heat = heat_[j];
    if (s.peak == 0 && joint.law.starts_free() && !joint.law.engaged_stiffness().isZero(0) && loads_->span() > 0)
      out.notes.push_back(fmt::format("joint {} ({}) carries no load from start to end: it is slack, or out of contact, all the time; if that was not meant, check the signs and sides of its loads", joint.name, joint.type));
    out.joints.push_back(s);
  }
  if (what_ != Recorded::kForces) {
    out.wear = loads_->wear().result();
    out.duty = loads_->duty().result();
  }
  if (!energies_.empty()) fill_account(out.energy);
}

template <class S>
void BasicForceRecorder<S>::fill_account(EnergyAccount& e) const {
  const Energies &first = energies_.front(), &last = energies_.back();
  e.kinetic_start = first.kinetic;
  e.kinetic_end = last.kinetic;
  e.potential_start = first.potential;
  e.potential_end = last.potential;
  e.dissipated = last.dissipated;
  e.supplied = last.supplied;
  e.kinetic_peak = e.drift = 0;
  const auto total = [](const Energies& row) { return row.kinetic + row.potential + row.dissipated - row.supplied; };
  for (const Energies& row : energies_) {
    e.kinetic_peak = std::max(e.kinetic_peak, row.kinetic);
    e.drift = std::max(e.drift, std::abs(total(row) - total(first)));
  }
}

template class BasicForceRecorder<Planar>;
PINTLE_IN_SPACE(template class BasicForceRecorder<Spatial>;)

}  // namespace pintle
