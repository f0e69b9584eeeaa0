#include "run/record/force_recorder.h"

#include <algorithm>
#include <cmath>

#include "run/record/time_averages.h"
#include "run/recording.h"

namespace pintle {

template <class S>
BasicForceRecorder<S>::BasicForceRecorder(const BasicSystem<S>& system, const SimulateSettings& settings, Recorded what)
    : system_(system), what_(what), keeps_places_(what == Recorded::kStates || settings.tolerance_of == ToleranceOf::kMotion),
      output_step_(output_step_of(settings, system.joints.size())), missed_peaks_(system), stuck_joints_(system), lost_equilibria_(system), drive_peaks_(system) {}

template <class S>
void BasicForceRecorder<S>::add(const BasicState<S>& state) {
  system_.motions(state.q, state.v, m_);
  forces_.t.push_back(state.t);
  if (keeps_places_) forces_.place.insert(forces_.place.end(), state.q.begin(), state.q.end());
  if (what_ == Recorded::kStates) forces_.velocity.insert(forces_.velocity.end(), state.v.begin(), state.v.end());
  for (int j = 0; j < system_.n_joints(); ++j) forces_.world.push_back(joint_load(system_, j, m_, state.force[j]));
  if (what_ != Recorded::kForces) add_energies(state);
}

template <class S>
void BasicForceRecorder<S>::add_energies(const BasicState<S>& state) {
  const ExternalWork loads = system_.external_work(state.t, state.q, m_, state.sliding);
  double supply = loads.supplied;
  for (int j = 0; j < system_.n_joints(); ++j) supply += system_.drive_power(system_.joints[j], state.t, m_, state.force[j]);
  const double kinetic = system_.kinetic(state.v);
  energies_.push_back({kinetic, loads.potential + energy_of_joints(system_, state), state.dissipated, state.supplied});
  missed_peaks_.add_row(state, supply, kinetic);
  stuck_joints_.see(state);
  lost_equilibria_.see(state);
}

template <class S>
void BasicForceRecorder<S>::keep_forces_only() {
  energies_ = {};
  forces_.velocity = {};
}

template <class S>
void BasicForceRecorder<S>::fill(Trajectory& out) {
  if (std::string note = missed_peaks_.note(output_step_); !note.empty()) out.notes.push_back(std::move(note));
  for (std::string& note : stuck_joints_.notes()) out.notes.push_back(std::move(note));
  for (std::string& note : lost_equilibria_.notes()) out.notes.push_back(std::move(note));
  const std::size_t rows = forces_.t.size(), n = system_.joints.size();
  const std::vector<double> weight = time_weights(forces_.t);
  out.joints.clear();
  for (std::size_t j = 0; j < n; ++j) {
    const BasicJointData<S>& joint = system_.joints[j];
    if (joint.servo >= 0) continue;
    LoadSummary s;
    s.name = joint.name;
    s.type = joint.type;
    s.first_body = body_name(system_, joint.at.a);
    s.second_body = body_name(system_, joint.at.b);
    s.has_moment = transmits_couple(joint) || joint.law.lever() > 0;
    TimeAverages force, moment;
    for (std::size_t i = 0; i < rows; ++i) {
      const typename S::Vec& load = forces_.world[i * n + j];
      force.add(forces_.t[i], weight[i], linear_magnitude<S>(load));
      moment.add(forces_.t[i], weight[i], angular_magnitude<S>(load));
    }
    s.peak = force.peak;
    s.peak_time = force.peak_time;
    s.mean = force.mean;
    s.rms = std::sqrt(force.square);
    if (s.has_moment) {
      s.peak_moment = moment.peak;
      s.mean_moment = moment.mean;
      s.rms_moment = std::sqrt(moment.square);
    }
    out.joints.push_back(s);
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
template class BasicForceRecorder<Spatial>;

}  // namespace pintle
