#include "studio/kernel/sessions.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "pintle/read_model.h"

namespace pintle::studio {
namespace {

constexpr std::size_t kMostSessions = 8;  // of each kind; the oldest makes room
constexpr double kLongestFrame = 10;      // [s]

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <class Row>
std::vector<double> flat(const std::vector<Row>& rows) {
  std::vector<double> out;
  out.reserve(3 * rows.size());
  for (const Row& row : rows) out.insert(out.end(), row.begin(), row.end());
  return out;
}

template <class Session>
Session& find(std::map<int, Session>& sessions, const Json& arguments) {
  const auto it = sessions.find(static_cast<int>(number_argument(arguments, "id")));
  if (it == sessions.end()) throw CallFault("This motion is closed.", "Start it again.");
  return it->second;
}

template <class Session>
void make_room(std::map<int, Session>& sessions) {
  while (sessions.size() >= kMostSessions) sessions.erase(sessions.begin());
}

template <class Session>
Json close(std::map<int, Session>& sessions, const Json& arguments) {
  return sessions.erase(static_cast<int>(number_argument(arguments, "id"))) > 0;
}

const Json* part(const Json& arguments, const char* key) {
  const auto it = arguments.find(key);
  return it == arguments.end() || it->is_null() ? nullptr : &*it;
}

std::string name_argument(const Json& arguments, const char* key) {
  const auto it = arguments.find(key);
  if (it == arguments.end() || !it->is_string()) throw CallFault(fmt::format("The call lacks \"{}\".", key), "This is a fault of the page: reload it.");
  return it->get<std::string>();
}

// The largest joint force, or the weight where there is none.
double force_scale(const Model& model, const std::vector<JointForce>& forces) {
  double scale = 0, mass = 0;
  for (const JointForce& force : forces) scale = std::max(scale, std::hypot(force[0], force[1]));
  for (const Body& body : model.bodies) mass += body.mass;
  const double weight = mass * std::hypot(model.gravity[0], model.gravity[1]);
  return scale > 1e-6 * weight && scale > 0 ? scale : std::max(weight, 1e-300);
}

}  // namespace

int MotionSessions::Names::body(const std::string& name) const {
  const auto it = std::find(bodies.begin(), bodies.end(), name);
  if (it == bodies.end()) throw CallFault(fmt::format("There is no movable body \"{}\".", name), "Drag another one.");
  return static_cast<int>(it - bodies.begin());
}

MotionSessions::Names MotionSessions::names_of(const Model& model) {
  Names names;
  for (const Body& body : model.bodies) names.bodies.push_back(body.name);
  for (const Joint& joint : model.joints) names.joints.push_back(joint.name);
  return names;
}

Json MotionSessions::open_drag(Exchange& call) {
  const std::string text = text_argument(call, "text");
  const Model model = parse_model(text, name_for(text), {}, files_argument(call));
  if (model.bodies.empty()) throw CallFault("There is nothing to move: the model has no bodies.", "Draw a link first.");
  make_room(drags_);
  const int id = next_++;
  const Drag& drag = drags_.emplace(id, Drag{names_of(model), KinematicDrag(model)}).first->second;
  return {{"id", id}, {"bodies", drag.names.bodies}, {"joints", drag.names.joints}};
}

Json MotionSessions::drag(Exchange& call) {
  Drag& drag = find(drags_, call.arguments);
  if (const Json* from = part(call.arguments, "from")) {
    const auto numbers = from->get<std::vector<double>>();
    std::vector<PlanarPose> poses;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) poses.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    drag.linkage.set_poses(poses);
  }
  std::optional<KinematicDrag::Hold> hold;
  if (const Json* held = part(call.arguments, "hold"))
    hold = {drag.names.body(name_argument(*held, "body")), point_argument(*held, "point"), point_argument(*held, "target")};
  const bool ok = drag.linkage.assemble(hold);
  Json out = {{"ok", ok}, {"poses", call.array(flat(drag.linkage.poses()))}, {"gaps", call.array(drag.linkage.gaps())}};
  if (ok) return out;
  const std::vector<std::string> open = drag.linkage.open_joints();
  out["reason"] = hold ? fault("The joints do not reach that far.", "Pull in another direction, or let go.", open)
                       : fault(fmt::format("The joints {} stay open.", fmt::join(open, ", ")), "Change lengths so that the loop closes, or place its bodies closer to their intended positions.", open);
  return out;
}

Json MotionSessions::close_drag(Exchange& call) { return close(drags_, call.arguments); }

void MotionSessions::start_like(const Live& other, Model& model) {
  const std::vector<PlanarPose> poses = other.motion.poses(), velocities = other.motion.velocities();
  for (Body& body : model.bodies) {
    const auto it = std::find(other.names.bodies.begin(), other.names.bodies.end(), body.name);
    if (it == other.names.bodies.end()) continue;
    const auto i = static_cast<std::size_t>(it - other.names.bodies.begin());
    body.position = Vec2{poses[i][0], poses[i][1]};
    body.angle = poses[i][2];
    body.velocity = Vec2{velocities[i][0], velocities[i][1]};
    body.spin = velocities[i][2];
    body.hold = {false, false, false};
  }
}

Json MotionSessions::open_live(Exchange& call) {
  const std::string text = text_argument(call, "text");
  Model model = parse_model(text, name_for(text), {}, files_argument(call));
  if (model.bodies.empty()) throw CallFault("There is nothing to move: the model has no bodies.", "Draw a link first.");
  if (call.arguments.contains("like")) {
    const auto it = lives_.find(static_cast<int>(number_argument(call.arguments, "like")));
    if (it != lives_.end()) start_like(it->second, model);
  }
  Live live{names_of(model), LiveMotion(model)};
  make_room(lives_);
  const int id = next_++;
  const Live& kept = lives_.emplace(id, std::move(live)).first->second;
  return {{"id", id},
          {"bodies", kept.names.bodies},
          {"joints", kept.names.joints},
          {"poses", call.array(flat(kept.motion.poses()))},
          {"force_scale", force_scale(model, kept.motion.joint_forces())},
          {"notes", kept.motion.notes()}};
}

Json MotionSessions::advance(Exchange& call) {
  const double began = seconds_now();
  Live& live = find(lives_, call.arguments);
  LiveMotion& motion = live.motion;
  const double dt = std::clamp(number_argument(call.arguments, "dt"), 0.0, kLongestFrame);
  const double budget = call.arguments.contains("budget") ? number_argument(call.arguments, "budget") : 0;
  std::optional<Pull> pull;
  if (const Json* pulled = part(call.arguments, "pull")) {
    const double stiffness = pulled->contains("stiffness") ? number_argument(*pulled, "stiffness") : 0;
    pull = {live.names.body(name_argument(*pulled, "body")), point_argument(*pulled, "point"), point_argument(*pulled, "target"), stiffness};
  }
  const double wanted = motion.time() + dt;
  motion.pull(pull);
  const bool ok = motion.advance(dt, budget);
  const LiveMotion::Energies energy = motion.energies();
  Json out = {{"t", motion.time()},
              {"poses", call.array(flat(motion.poses()))},
              {"velocities", call.array(flat(motion.velocities()))},
              {"joint_forces", call.array(flat(motion.joint_forces()))},
              {"energy", {{"kinetic", energy.kinetic}, {"potential", energy.potential}, {"dissipated", energy.dissipated}, {"supplied", energy.supplied}}},
              {"behind", ok && motion.time() < wanted - 1e-6 * dt},
              {"cost", seconds_now() - began}};
  out["error"] = ok ? Json(nullptr)
                    : fault("The motion cannot go on: " + motion.failure(), pull ? "Let go, or pull more gently." : "Check the loads that act now, or start again.",
                            joints_named_in(motion.failure(), &live.names.joints));
  return out;
}

Json MotionSessions::close_live(Exchange& call) { return close(lives_, call.arguments); }

}  // namespace pintle::studio
