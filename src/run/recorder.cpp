#include "run/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pintle {
namespace {

using S = Planar;

// Couples are told where the joint holds an angle, meshes, or rubs.
bool tells_couple(const JointData& joint) {
  const bool mesh = std::holds_alternative<Mesh>(joint.displacement) || std::holds_alternative<RackMesh>(joint.displacement);
  return transmits_couple(joint) || mesh || (joint.law.rubs() && joint.free_mask[2] > 0);
}

std::string body_name(const System& system, int body) { return body == kGround ? "ground" : system.bodies[body].name; }

bool is_servo(const JointData& joint) { return joint.servo >= 0; }

// Mean, RMS and peak over rows that may be unevenly spaced (the last one): trapezoidal weights in time.
struct Sums {
  double peak = 0, peak_time = 0, mean = 0, square = 0;
  void add(double t, double weight, double x) {
    if (std::abs(x) > std::abs(peak)) {
      peak = x;
      peak_time = t;
    }
    mean += weight * x;
    square += weight * x * x;
  }
};

std::vector<double> time_weights(const std::vector<double>& t) {
  std::vector<double> w(t.size(), 0);
  if (t.size() < 2 || t.back() <= t.front()) {
    if (!w.empty()) w[0] = 1;
    return w;
  }
  const double span = t.back() - t.front();
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    w[i] += 0.5 * (t[i + 1] - t[i]) / span;
    w[i + 1] += 0.5 * (t[i + 1] - t[i]) / span;
  }
  return w;
}

}  // namespace

bool transmits_couple(const JointData& joint) {
  return joint.held[2] && joint.law.engaged_stiffness()[2] > 0;
}

JointLoad joint_load(const System& system, int j, double, const std::vector<S::Motion>& m, const S::Vec& force) {
  const JointData& joint = system.joints[j];
  const RelativePose pose = system.pose(joint.at, m);
  const S::Vec f = to_pose_force(joint.displacement, pose, force);
  const S::Point world = pose.world_force(f);
  return {world.x(), world.y(), f[2]};
}

Recorder::Recorder(const Model& model, const System& system, Recorded what)
    : model_(model), system_(system), what_(what), recording_(choose_recording(model, system)), missed_peaks_(system), stuck_joints_(system) {
  find_drives();
}

// Servos and efforts stand in the system in the order of the motors.
void Recorder::find_drives() {
  std::size_t servo = model_.joints.size(), load = 0;
  for (const Motor& motor : model_.motors) {
    const bool effort = motor.kind == MotorKind::kEffort;
    drives_.push_back(effort ? Drive{-1, static_cast<int>(load++)} : Drive{static_cast<int>(servo++), -1});
  }
}

void Recorder::clear() {
  values_.clear();
  forces_ = {};
}

void Recorder::keep_forces_only() {
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
    if (joint.free_mask[0] > 0) column(p + "slide", "m", "displacement along the axis of the joint's frame on " + first);
    if (joint.free_mask[2] > 0) column(p + "angle", "rad", "angle of " + second + "'s marker relative to " + first + "'s");
    if (joint.free_mask[0] > 0) column(p + "slide_rate", "m/s", "rate of the slide");
    else if (joint.free_mask[2] > 0) column(p + "angle_rate", "rad/s", "rate of the angle");
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
  column("energy.kinetic", "J", "kinetic energy");
  column("energy.potential", "J", "potential energy of gravity, springs and joints");
  column("energy.dissipated", "J", "dissipated in joints and dampers since the start");
  column("energy.supplied", "J", "delivered by motors and applied forces since the start");
  return columns;
}

void Recorder::put_joint(int j, const JointLoad& load) {
  const JointData& joint = system_.joints[j];
  const RelativePose pose = system_.pose(joint.at, m_);
  const bool couple = tells_couple(joint);
  put(load.fx);
  put(load.fy);
  if (couple) put(load.couple);
  put(pose.c * load.fx + pose.s * load.fy);
  put(-pose.s * load.fx + pose.c * load.fy);
  put(-load.fx);
  put(-load.fy);
  // The reaction acts at the second marker; about the first one it has the moment of the gap as well.
  const S::Point d(pose.c * pose.z[0] - pose.s * pose.z[1], pose.s * pose.z[0] + pose.c * pose.z[1]);
  if (couple) put(-load.couple - S::cross(d, {load.fx, load.fy}));
  if (joint.free_mask[0] > 0) put(pose.z[0]);
  if (joint.free_mask[2] > 0) put(pose.z[2]);
  if (joint.free_mask[0] > 0) put(pose.rate[0]);
  else if (joint.free_mask[2] > 0) put(pose.rate[2]);
}

void Recorder::add(const State& state) {
  system_.motions(state.q, state.v, m_);
  forces_.t.push_back(state.t);
  if (model_.simulate.tolerance_of == ToleranceOf::kMotion)
    for (const S::Vec& q : state.q) forces_.place.insert(forces_.place.end(), q.data(), q.data() + S::kDof);
  for (int j = 0; j < system_.n_joints(); ++j) {
    const JointLoad load = joint_load(system_, j, state.t, m_, state.force[j]);
    for (const double x : {load.fx, load.fy, load.couple}) forces_.world.push_back(x);
  }
  if (what_ == Recorded::kColumns) put_row(state);
}

// Once the forces of the row are in their table.
void Recorder::put_row(const State& state) {
  const double* world = forces_.world.data() + forces_.world.size() - 3 * system_.joints.size();
  put(state.t);
  for (int i = 0; i < system_.n_bodies(); ++i) {
    if (!recording_.body[i]) continue;
    for (int k = 0; k < 3; ++k) put(state.q[i][k]);
    for (int k = 0; k < 3; ++k) put(state.v[i][k]);
  }
  double stored = 0;
  for (int j = 0; j < system_.n_joints(); ++j, world += 3) {
    if (is_servo(system_.joints[j])) continue;
    if (recording_.joint[j]) {
      put_joint(j, {world[0], world[1], world[2]});
      system_.joints[j].law.observe(law_point(system_, j, state), state.force[j], values_);
    }
    stored += system_.joints[j].law.energy(law_point(system_, j, state));
  }
  for (const LoadData& load : system_.loads)
    if (load.kind == LoadKind::kSpring) put(-system_.load_effort(load, state.t, m_));
    else if (load.kind == LoadKind::kTorsionSpring) put(system_.load_effort(load, state.t, m_));
  const ExternalWork loads = system_.external_work(state.t, state.q, m_, state.sliding);
  double supply = loads.supplied;
  for (const Drive& drive : drives_) {
    const bool servo = drive.joint >= 0;
    const double effort = servo ? state.force[drive.joint][component(drive)]
                                : system_.load_effort(system_.loads[drive.load], state.t, m_, state.sliding);
    const Placement& at = servo ? system_.joints[drive.joint].at : system_.loads[drive.load].at;
    const double power = effort * system_.pose(at, m_).rate[component(drive)];
    put(effort);
    put(power);
    if (servo) supply += power;
  }
  const double kinetic = system_.kinetic(state.v);
  put(kinetic);
  put(loads.potential + stored);
  put(state.dissipated);
  put(state.supplied);
  missed_peaks_.add_row(state, supply, kinetic);
  stuck_joints_.see(state);
}

void Recorder::fill(Trajectory& out) {
  if (what_ == Recorded::kColumns) out.columns = columns();
  out.values = std::move(values_);
  for (std::string note : {recording_.note, missed_peaks_.note(output_step_of(model_.simulate, system_.joints.size()))})
    if (!note.empty()) out.notes.push_back(std::move(note));
  for (std::string& note : stuck_joints_.notes()) out.notes.push_back(std::move(note));
  const std::size_t rows = forces_.t.size(), n = system_.joints.size();
  const std::vector<double> weight = time_weights(forces_.t);
  out.joints.clear();
  for (std::size_t j = 0; j < n; ++j) {
    const JointData& joint = system_.joints[j];
    if (is_servo(joint)) continue;
    LoadSummary s;
    s.name = joint.name;
    s.type = joint.type;
    s.first_body = body_name(system_, joint.at.a);
    s.second_body = body_name(system_, joint.at.b);
    s.has_moment = transmits_couple(joint) || joint.law.lever() > 0;
    Sums force, moment;
    for (std::size_t i = 0; i < rows; ++i) {
      const double* f = &forces_.world[3 * (i * n + j)];
      force.add(forces_.t[i], weight[i], std::hypot(f[0], f[1]));
      moment.add(forces_.t[i], weight[i], std::abs(f[2]));
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
  if (what_ == Recorded::kForces) return;
  const auto column_sums = [&](const std::string& name) {
    Sums sums;
    const int c = out.column(name);
    for (std::size_t i = 0; c >= 0 && i < rows; ++i) sums.add(forces_.t[i], weight[i], out.at(i, c));
    return sums;
  };
  out.springs.clear();
  for (const Spring& spring : model_.springs) {
    const Sums s = column_sums("spring." + spring.name + (spring.torsion ? ".moment" : ".force"));
    LoadSummary summary;
    summary.name = spring.name;
    summary.type = spring.torsion ? "torsion_spring" : "spring";
    summary.first_body = spring.first.body;
    summary.second_body = spring.second.body;
    summary.peak_time = s.peak_time;
    summary.has_moment = spring.torsion;
    (spring.torsion ? summary.peak_moment : summary.peak) = std::abs(s.peak);
    (spring.torsion ? summary.rms_moment : summary.rms) = std::sqrt(s.square);
    (spring.torsion ? summary.mean_moment : summary.mean) = s.mean;
    out.springs.push_back(summary);
  }
  out.motors.clear();
  const double span = rows > 0 ? forces_.t.back() - forces_.t.front() : 0;
  for (const Motor& motor : model_.motors) {
    const Sums effort = column_sums("motor." + motor.name + ".effort"), power = column_sums("motor." + motor.name + ".power");
    const int c = out.column("motor." + motor.name + ".effort");
    out.motors.push_back({motor.name, motor.joint, c >= 0 ? out.columns[c].unit : "", effort.peak, std::sqrt(effort.square), effort.mean,
                          power.peak, power.mean, power.mean * span});
  }
  if (rows == 0) return;
  const int kinetic = out.column("energy.kinetic");
  EnergyAccount& e = out.energy;
  e.kinetic_start = out.at(0, kinetic);
  e.kinetic_end = out.at(rows - 1, kinetic);
  e.potential_start = out.at(0, kinetic + 1);
  e.potential_end = out.at(rows - 1, kinetic + 1);
  e.dissipated = out.at(rows - 1, kinetic + 2);
  e.supplied = out.at(rows - 1, kinetic + 3);
  e.kinetic_peak = e.drift = 0;
  const auto total = [&](std::size_t i) { return out.at(i, kinetic) + out.at(i, kinetic + 1) + out.at(i, kinetic + 2) - out.at(i, kinetic + 3); };
  for (std::size_t i = 0; i < rows; ++i) {
    e.kinetic_peak = std::max(e.kinetic_peak, out.at(i, kinetic));
    e.drift = std::max(e.drift, std::abs(total(i) - total(0)));
  }
}

}  // namespace pintle
