#include "run/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "joints/belt.h"
#include "joints/cam_profile.h"
#include "joints/edge_profile.h"
#include "system/applied_wrench.h"
#include "system/load_displacement.h"
#include "system/pose_joint.h"

namespace pintle {
namespace {

using S = Planar;

// Couples are reported if the joint holds an angle, meshes or rubs at a radius, or if something acts on the angle that it leaves free: friction, stops, a detent. About the
// axis of a cam the couple is its torque.
bool tells_couple(const JointData& joint) {
  const bool mesh = std::holds_alternative<Mesh>(joint.displacement) || std::holds_alternative<RackMesh>(joint.displacement) || belt_of(joint.displacement);
  return has_couple(joint) || mesh || joint.cam || joint.edge || (joint.free_mask[2] > 0 && (joint.law.rubs() || joint.law.has_stops()));
}

// Equations that keep a joint's gap at zero do not use its law, whose columns would show only what follows from its reaction.
bool asks_law(const Model& model, const JointData& joint) {
  return !joint.ideal || !has_constraints(model.simulate.equations) || joint.law.feeds() || joint.law.depends_on_reaction_alone();
}

// Whether a coordinate of the relative pose is free to slide. What a gap given by a function leaves free is reported by the law.
bool slides(const JointData& joint) { return joint.free_mask[0] > 0 && std::holds_alternative<Selection>(joint.displacement); }
// Pins whose position in their bush is of interest: those that are not held by springs.
bool has_orbit(const JointData& joint) { return is_pose_joint(joint) && joint.held[0] && joint.held[1] && !joint.held[2] && !joint.law.ideal_limit(); }
// Rods, ropes and other joints with a length or a stroke.
bool pushes_its_ends(const JointData& joint) { return std::holds_alternative<Distance>(joint.displacement) || (joint.free_mask[0] > 0 && !slides(joint)); }

bool is_servo(const JointData& joint) { return joint.servo >= 0; }

}  // namespace

Recorder::Recorder(const Model& model, const System& system, Recorded what)
    : ForceRecorder(system, what), model_(model), recording_(choose_recording(model, system)) {
  find_drives();
  index_applied_forces();
}

// Servos and efforts are in the system in the order of the motors.
void Recorder::find_drives() {
  std::size_t servo = model_.joints.size(), load = 0;
  for (const Motor& motor : model_.motors) {
    const bool effort = motor.kind == MotorKind::kEffort;
    drives_.push_back(effort ? Drive{-1, static_cast<int>(load++)} : Drive{static_cast<int>(servo++), -1});
  }
  for (std::size_t i = 0; i < system_.loads.size(); ++i)
    if (system_.loads[i].kind != LoadKind::kEffort) springs_.push_back(static_cast<int>(i));
}

void Recorder::index_applied_forces() {
  std::unordered_map<std::string_view, std::size_t> index;
  for (const AppliedForce& force : model_.forces) {
    index.emplace(force.name, applied_.size());
    applied_.emplace_back().has_torque = !force.torque.variables().empty() || force.torque.value({}) != 0;
  }
  for (std::size_t i = 0; i < system_.applied.size(); ++i) applied_[index.at(system_.applied[i].name)].functions = static_cast<int>(i);
  for (std::size_t i = 0; i < system_.loads.size(); ++i)
    if (const LoadData& load = system_.loads[i]; load.applied) applied_[index.at(load.name)].load[static_cast<std::size_t>(load.component)] = static_cast<int>(i);
}

double Recorder::effort_of(const Drive& drive, const State& state, const std::vector<S::Motion>& m) const {
  return drive.joint >= 0 ? state.force[drive.joint][component(drive)] : system_.load_effort(system_.loads[drive.load], state.t, m, state.sliding);
}

double Recorder::power_of(const Drive& drive, double effort, const std::vector<S::Motion>& m) const {
  const Placement& at = drive.joint >= 0 ? system_.joints[drive.joint].at : system_.loads[drive.load].at;
  return effort * system_.pose(at, m).rate[component(drive)];
}

// Tension, or moment on the second body.
double Recorder::effort_of_spring(const LoadData& spring, double t, const std::vector<S::Motion>& m) const {
  const double effort = system_.load_effort(spring, t, m);
  return spring.kind == LoadKind::kSpring ? -effort : effort;
}

void Recorder::put_signals(const State& state, const std::vector<S::Motion>& m, double* out) const {
  for (const int spring : springs_) *out++ = effort_of_spring(system_.loads[spring], state.t, m);
  for (const Drive& drive : drives_) {
    const double effort = effort_of(drive, state, m);
    *out++ = effort;
    *out++ = power_of(drive, effort, m);
  }
}

void Recorder::keep_forces_only() {
  ForceRecorder::keep_forces_only();
  values_.clear();
  values_.shrink_to_fit();
}

std::vector<Column> Recorder::columns() const {
  std::vector<Column> columns;
  const auto column = [&columns](std::string name, const char* unit, std::string about) {
    columns.push_back({std::move(name), unit, std::move(about)});
  };
  column("t", "s", "time");
  for (std::size_t i = 0; i < system_.bodies.size(); ++i) {
    if (!recording_.body[i]) continue;
    const BodyData& body = system_.bodies[i];
    const std::string p = "body." + body.name + ".";
    column(p + "x", "m", "centre of mass of " + body.name + ", world x");
    column(p + "y", "m", "centre of mass of " + body.name + ", world y");
    column(p + "angle", "rad", "angle of " + body.name + " in the world, counter-clockwise");
    column(p + "vx", "m/s", "velocity of the centre of mass of " + body.name + ", world x");
    column(p + "vy", "m/s", "velocity of the centre of mass of " + body.name + ", world y");
    column(p + "spin", "rad/s", "angular velocity of " + body.name);
  }
  for (std::size_t j = 0; j < system_.joints.size(); ++j) {
    const JointData& joint = system_.joints[j];
    if (is_servo(joint) || !recording_.joint[j]) continue;
    const std::string second = body_name(system_, joint.at.b), first = body_name(system_, joint.at.a);
    const std::string p = "joint." + joint.name + ".";
    const std::string what = "force that joint " + joint.name + " exerts on ";
    column(p + "on_" + second + ".fx[world]", "N", what + second + ", world x");
    column(p + "on_" + second + ".fy[world]", "N", what + second + ", world y");
    const bool couple = tells_couple(joint);
    if (couple) column(p + "on_" + second + ".m[world]", "N*m", "couple that joint " + joint.name + " exerts on " + second + ", about its marker " + (j < model_.joints.size() ? model_.joints[j].second.marker : ""));
    column(p + "on_" + second + ".f1[joint]", "N", what + second + ", along x of the joint's frame on " + first);
    column(p + "on_" + second + ".f2[joint]", "N", what + second + ", along y of the joint's frame on " + first);
    column(p + "on_" + first + ".fx[world]", "N", what + first + ", world x");
    column(p + "on_" + first + ".fy[world]", "N", what + first + ", world y");
    if (couple) column(p + "on_" + first + ".m[world]", "N*m", "couple that joint " + joint.name + " exerts on " + first + ", about its marker");
    if (slides(joint)) column(p + "slide", "m", "displacement along the axis of the joint's frame on " + first);
    if (joint.free_mask[2] > 0) column(p + "angle", "rad", "angle of " + second + "'s marker relative to " + first + "'s");
    if (slides(joint)) column(p + "slide_rate", "m/s", "rate of the slide");
    else if (joint.free_mask[2] > 0) column(p + "angle_rate", "rad/s", "rate of the angle");
    if (has_orbit(joint))
      for (const char* axis : {"x", "y"}) column(p + "pin_" + axis, "m", "where the pin is in its bush: the second marker, along " + std::string(axis) + " of the joint's frame on " + first);
    if (joint.cam) column(p + "cam_angle", "rad", "where the follower is on the cam, from its marker's x axis, -pi to pi");
    if (joint.cam && !joint.cam->flat()) column(p + "pressure_angle", "rad", "from the y axis of the second marker, along which the follower moves, to the normal of the contact");
    if (joint.edge) column(p + "contact_x", "m", "where the contact is, along the x axis of the first marker");
    if (joint.driven >= 0) {
      column(p + "length", "m", "length to which joint " + joint.name + " is driven");
      column(p + "drive_power", "W", "power that what drives the length of joint " + joint.name + " delivers");
    }
    if (belt_of(joint.displacement)) {
      column(p + "tension", "N", "tension of belt " + joint.name);
      column(p + "run", "m", "length of its free run");
    }
    if (pushes_its_ends(joint)) column(p + "force", "N", "with which joint " + joint.name + " pushes its ends apart; negative: it is in tension");
    if (asks_law(model_, joint))
      for (LawColumn& law : joint.law.columns()) column(p + law.name, law.unit.c_str(), std::move(law.meaning));
  }
  for (const LoadData& load : system_.loads) {
    if (load.kind == LoadKind::kEffort) continue;
    if (load.kind == LoadKind::kSpring) column("spring." + load.name + ".force", "N", "tension in spring " + load.name);
    else column("spring." + load.name + ".moment", "N*m", "moment of torsion spring " + load.name + " on the second body");
  }
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const Motor& motor = model_.motors[i];
    const bool linear = component(drives_[i]) == 0;
    column("motor." + motor.name + ".effort", linear ? "N" : "N*m", "what motor " + motor.name + " exerts on the second body of joint " + motor.joint);
    column("motor." + motor.name + ".power", "W", "power that motor " + motor.name + " delivers");
  }
  for (std::size_t i = 0; i < applied_.size(); ++i) {
    const AppliedForce& force = model_.forces[i];
    const std::string p = "force." + force.name + ".", what = " of force " + force.name + " on " + force.on.body;
    column(p + "fx[world]", "N", "component" + what + ", world x");
    column(p + "fy[world]", "N", "component" + what + ", world y");
    if (applied_[i].has_torque) column(p + "torque", "N*m", "torque" + what);
    column(p + "power", "W", "power that force " + force.name + " delivers");
  }
  column("energy.kinetic", "J", "kinetic energy");
  column("energy.potential", "J", "potential energy of gravity, springs and joints");
  column("energy.dissipated", "J", "dissipated in joints and dampers since the start");
  column("energy.supplied", "J", "delivered by motors and applied forces since the start");
  return columns;
}

void Recorder::put_joint(int j, const S::Vec& load) {
  const JointData& joint = system_.joints[j];
  const RelativePose pose = system_.pose(joint.at, m_);
  const bool couple = tells_couple(joint);
  put(load[0]);
  put(load[1]);
  if (couple) put(load[2]);
  put(pose.c * load[0] + pose.s * load[1]);
  put(-pose.s * load[0] + pose.c * load[1]);
  put(-load[0]);
  put(-load[1]);
  // The reaction acts at the second marker; about the first one it has the moment of the gap as well.
  const S::Point d(pose.c * pose.z[0] - pose.s * pose.z[1], pose.s * pose.z[0] + pose.c * pose.z[1]);
  if (couple) put(-load[2] - S::cross(d, {load[0], load[1]}));
  if (slides(joint)) put(pose.z[0]);
  if (joint.free_mask[2] > 0) put(pose.z[2]);
  if (slides(joint)) put(pose.rate[0]);
  else if (joint.free_mask[2] > 0) put(pose.rate[2]);
  if (has_orbit(joint))
    for (int k : {0, 1}) put(pose.z[k]);
  if (joint.cam) {
    const CamContactPlace at = joint.cam->place(pose.z);
    put(at.angle);
    if (!joint.cam->flat()) put(at.pressure_angle);
  }
  if (joint.edge) put(joint.edge->nearest({pose.z[0], pose.z[1]}));
}

void Recorder::put_applied_force(const Applied& force, const State& state) {
  S::Point f(0, 0);
  double torque = 0, power = 0;
  if (force.functions >= 0) {
    const AppliedData& given = system_.applied[force.functions];
    const PlanarWrench w = wrench(given, state.t, m_[given.body]);
    f = w.force;
    torque = w.couple;
    power = system_.power_of(given, state.t, m_);
  }
  for (int k = 0; k < 3; ++k) {
    const int at = force.load[static_cast<std::size_t>(k)];
    if (at < 0) continue;
    const LoadData& load = system_.loads[at];
    const double effort = system_.load_effort(load, state.t, m_, state.sliding);
    power += system_.work_of(load, state.t, m_, state.sliding).supplied;
    if (k == 2) {
      torque = effort;
      continue;
    }
    const S::Point along = effort * S::Point::Unit(k);
    f += acts_in_body_axes(load) ? m_[load.at.a].turned(along) : along;
  }
  put(f[0]);
  put(f[1]);
  if (force.has_torque) put(torque);
  put(power);
}

void Recorder::add(const State& state) {
  ForceRecorder::add(state);
  if (what_ == Recorded::kColumns) put_row(state);
}

// Call once the forces and energies of the row are in their tables.
void Recorder::put_row(const State& state) {
  const S::Vec* load = forces_.world.data() + forces_.world.size() - system_.joints.size();
  put(state.t);
  for (int i = 0; i < system_.n_bodies(); ++i) {
    if (!recording_.body[i]) continue;
    for (int k = 0; k < 3; ++k) put(state.q[i][k]);
    for (int k = 0; k < 3; ++k) put(state.v[i][k]);
  }
  for (int j = 0; j < system_.n_joints(); ++j, ++load) {
    if (is_servo(system_.joints[j]) || !recording_.joint[j]) continue;
    put_joint(j, *load);
    if (const JointData& joint = system_.joints[j]; joint.driven >= 0) {
      put(target_of(joint, state.t)[0]);
      put(system_.drive_power(joint, state.t, m_, state.force[j]));
    }
    if (const auto belt = belt_of(system_.joints[j].displacement)) {
      put(-state.force[j][0]);
      put(belt->run(system_.pose(system_.joints[j].at, m_).z));
    }
    if (pushes_its_ends(system_.joints[j])) put(state.force[j][0]);
    if (asks_law(model_, system_.joints[j])) system_.joints[j].law.observe(law_point(system_, j, state), state.force[j], values_);
  }
  for (const int spring : springs_) put(effort_of_spring(system_.loads[spring], state.t, m_));
  for (const Drive& drive : drives_) {
    const double effort = effort_of(drive, state, m_);
    put(effort);
    put(power_of(drive, effort, m_));
  }
  for (const Applied& force : applied_) put_applied_force(force, state);
  const Energies& energies = energies_.back();
  put(energies.kinetic);
  put(energies.potential);
  put(energies.dissipated);
  put(energies.supplied);
}

void Recorder::fill(Trajectory& out) {
  if (what_ == Recorded::kColumns) out.columns = columns();
  out.values = std::move(values_);
  if (!recording_.note.empty()) out.notes.push_back(recording_.note);
  ForceRecorder::fill(out);
  if (what_ != Recorded::kColumns) return;
  int signal = 0;
  out.springs.clear();
  for (const Spring& spring : model_.springs) {
    const LoadStatistics of = loads().signal(signal++);
    LoadSummary summary;
    summary.name = spring.name;
    summary.type = spring.torsion ? "torsion_spring" : "spring";
    summary.first_body = spring.first.body;
    summary.second_body = spring.second.body;
    summary.peak_time = of.peak_time;
    summary.has_moment = spring.torsion;
    (spring.torsion ? summary.peak_moment : summary.peak) = std::abs(of.peak);
    (spring.torsion ? summary.rms_moment : summary.rms) = of.rms;
    (spring.torsion ? summary.mean_moment : summary.mean) = of.mean;
    out.springs.push_back(summary);
  }
  out.motors.clear();
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const Motor& motor = model_.motors[i];
    const LoadStatistics effort = loads().signal(signal++), power = loads().signal(signal++);
    out.motors.push_back({motor.name, motor.joint, component(drives_[i]) == 0 ? "N" : "N*m", effort.peak, effort.rms, effort.mean, power.peak, power.mean,
                          power.mean * loads().span()});
  }
}

}  // namespace pintle
