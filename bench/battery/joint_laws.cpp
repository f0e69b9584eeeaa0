// Linkages in which some joints have laws other than a spring and a damper.
#include <array>
#include <cmath>
#include <numbers>

#include "bench/battery/kinds.h"
#include "bench/battery/linkages.h"

namespace pintle::bench {
namespace {

constexpr std::array<const char*, 6> kContactModels{"exact", "lankarani-nikravesh", "hunt-crossley", "flores", "gonthier", "linear"};

bool guides(const JointText& joint) { return joint.type == "prismatic"; }

void turn_stiffness(Dice& dice, JointText& joint) {
  if (!guides(joint)) return;
  joint.keys["angular_stiffness"] = number_text(dice.log_uniform(1e2, 1e5));
  joint.keys["angular_damping"] = number_text(dice.log_uniform(0.1, 50));
}

void make_soft(Dice& dice, JointText& joint) {
  Keys& keys = joint.keys;
  // Slots have no bushings, sliders no rubber bushings.
  constexpr std::array kLaws{"bushing", "maxwell", "table", "rubber-bushing"};
  const std::string word = kLaws[joint.type == "slot" ? dice.integer(1, 2) : dice.integer(0, guides(joint) ? 2 : 3)];
  keys["law"] = in_quotes(word);
  turn_stiffness(dice, joint);
  const double k = word == "rubber-bushing" ? dice.log_uniform(5e4, 1e6) : dice.log_uniform(1e5, 5e7), c = k * dice.log_uniform(1e-5, 1e-3);
  keys["damping"] = number_text(c);
  if (word != "table") keys["stiffness"] = number_text(k);
  if (word == "bushing" && joint.type == "revolute") {
    keys["stiffness_xy"] = number_text(k * dice.uniform(-0.5, 0.5));
    if (dice.chance(0.4)) keys["preload_x"] = number_text(dice.uniform(-200, 200));
    if (dice.chance(0.3)) keys["offset_y"] = number_text(dice.uniform(-1e-3, 1e-3));
  } else if (word == "maxwell") {
    keys["branch_ratio"] = Text{"[{:.4g}, {:.4g}]", dice.log_uniform(0.1, 3), dice.log_uniform(0.1, 3)};
    keys["branch_time"] = Text{"[{:.4g}, {:.4g}]", dice.log_uniform(1e-4, 1e-2), dice.log_uniform(1e-2, 1)};
  } else if (word == "table") {
    keys["displacement"] = "[0, 1e-5, 5e-5, 2e-4, 1e-3]";
    const double f = k * 1e-5;
    keys["force"] = Text{"[0, {:.4g}, {:.4g}, {:.4g}, {:.4g}]", f, f * dice.uniform(4, 10), f * dice.uniform(15, 80), f * dice.uniform(100, 400)};
  }
}

void make_bearing(Dice& dice, JointText& joint) {
  Keys& keys = joint.keys;
  if (guides(joint)) {
    keys["law"] = in_quotes("linear-guide");
    keys["carriage_length"] = number_text(dice.uniform(0.04, 0.15));
    return;
  }
  if (joint.type != "revolute") return;
  const bool rolling = dice.chance(0.6), detailed = dice.chance(0.6);
  keys["law"] = in_quotes(rolling ? "rolling-bearing" : "journal-bearing");
  if (rolling && detailed) {
    const bool balls = dice.chance(0.7), sum = dice.chance(0.4);
    keys[balls ? "balls" : "rollers"] = std::to_string(dice.integer(7, 14));
    keys[balls ? "ball_diameter" : "roller_length"] = number_text(dice.uniform(5e-3, 12e-3));
    keys["damping"] = number_text(dice.log_uniform(1e3, 1e4));
    if (sum) keys["elements"] = in_quotes("sum");
    if (dice.chance(0.5)) keys["play"] = number_text(dice.uniform(2e-6, 2e-5));
    else if (sum) keys["preload"] = number_text(dice.uniform(5, 100));
  } else if (detailed) {
    const double share = dice.uniform(0, 1);
    keys["film"] = in_quotes(share < 0.4 ? "short" : share < 0.7 ? "finite" : "long");
    const double radius = dice.uniform(5e-3, 2e-2);
    keys["journal_radius"] = number_text(radius);
    keys["bearing_length"] = number_text(radius * dice.uniform(0.5, 1));
    if (keys["film"] == "\"long\"") keys["bearing_length"] = number_text(radius * dice.uniform(4, 6));
    keys["radial_clearance"] = number_text(radius * dice.uniform(1e-3, 4e-3));
    keys["viscosity"] = number_text(dice.log_uniform(0.01, 0.3));
  } else {
    keys["stiffness"] = number_text(rolling ? dice.log_uniform(1e8, 3e9) : dice.log_uniform(1e7, 1e8));
    keys["damping"] = number_text(rolling ? dice.log_uniform(2e3, 1e4) : dice.log_uniform(1e5, 5e5));
  }
}

// `prefix` is "contact_" or "stop_".
void choose_contact_model(Dice& dice, Keys& keys, const std::string& prefix) {
  const std::string model = dice.pick(kContactModels);
  const bool stop = prefix == "stop_";
  keys[prefix + "model"] = in_quotes(model);
  if (model == "linear") keys[prefix + "damping"] = number_text(stop ? dice.log_uniform(0.1, 10) : dice.log_uniform(100, 5e3));
  else keys[stop ? "stop_restitution" : "restitution"] = number_text(dice.uniform(0.3, 0.95));
}

// Gives a slider clearance in its guide as well.
void loosen_guide(MechanismText& m, Dice& dice) {
  for (JointText& joint : m.joints) {
    if (!guides(joint)) continue;
    joint.keys["law"] = in_quotes("clearance");
    joint.keys["clearance"] = number_text(dice.log_uniform(3e-5, 3e-4));
    joint.keys["guide_length"] = number_text(dice.uniform(0.03, 0.1));
    choose_contact_model(dice, joint.keys, "contact_");
    if (joint.keys["contact_model"] == "\"linear\"") joint.keys["contact_exponent"] = "1";
    joint.keys["contact_stiffness"] = number_text(dice.log_uniform(1e6, 1e8));
  }
}

}  // namespace

MechanismText soft_joints(Dice& dice) {
  MechanismText m = any_linkage(dice);
  choose_duration(m, dice);
  bool any = false;
  for (JointText& joint : m.joints)
    if (!any || dice.chance(0.4)) make_soft(dice, joint), any = true;
  fill_joints(m, dice, 1e6, 1e9);
  add_loads(m, dice);
  return m;
}

MechanismText bearings(Dice& dice) {
  MechanismText m = any_linkage(dice);
  choose_duration(m, dice, 0.1, 1);
  for (JointText& joint : m.joints)
    if (dice.chance(0.6)) make_bearing(dice, joint);
  fill_joints(m, dice, 1e6, 1e9);
  add_loads(m, dice);
  return m;
}

MechanismText clearance(Dice& dice) {
  MechanismText m = one_loop(dice);
  JointText& worn = m.joints[static_cast<std::size_t>(dice.integer(1, 2))];
  worn.keys["law"] = in_quotes("clearance");
  worn.keys["clearance"] = number_text(dice.log_uniform(5e-5, 5e-4));
  worn.keys["pin_radius"] = number_text(dice.uniform(5e-3, 1.5e-2));
  choose_contact_model(dice, worn.keys, "contact_");
  if (worn.keys["contact_model"] == "\"linear\"") worn.keys["contact_stiffness"] = number_text(dice.log_uniform(1e6, 1e8)), worn.keys["contact_exponent"] = "1";
  if (dice.chance(0.5)) worn.keys["friction_coefficient"] = number_text(dice.uniform(0.02, 0.2));
  if (dice.chance(0.7)) drive_crank(m, dice);
  m.duration = 1e-3 * std::round(1e3 * dice.log_uniform(0.02, 0.2));
  if (dice.chance(0.4)) loosen_guide(m, dice);
  fill_joints(m, dice, 1e6, 1e9);
  return m;
}

// A bar that swings down onto an edge, or a loose block that falls onto it.
MechanismText contact(Dice& dice) {
  MechanismText m;
  const double radius = dice.uniform(0, 0.02), floor = -dice.uniform(0.05, 0.3);
  const std::string edge = m.on_ground({0, floor});
  std::string touching;
  if (dice.chance(0.6)) {
    const double angle = dice.uniform(-0.1, 1.2);
    const Point tip = Polar{{0, 0}, 0.3, angle};
    add_bar(m, dice, "crank", {0, 0}, tip).spin = dice.uniform(-3, 1);
    m.body("crank").held = true;
    m.add_pin("A", "ground", "crank", {0, 0});
    touching = m.on("crank", tip);
  } else {
    const double mass = dice.log_uniform(0.1, 3);
    BodyText& block = m.add_body("block", {0, floor + radius + dice.uniform(0.001, 0.1)}, 0, mass, 1e-3 * mass);
    block.spin = dice.uniform(-2, 2);
    block.held = true;
    m.weight = mass;
    touching = m.on("block", block.centre);
  }
  JointText& joint = m.add_joint("floor", "slot", edge, touching);
  joint.keys["law"] = in_quotes("contact");
  joint.keys["pin_radius"] = number_text(radius);
  choose_contact_model(dice, joint.keys, "contact_");
  joint.keys["contact_stiffness"] = number_text(dice.log_uniform(1e5, 1e9));
  joint.keys["contact_exponent"] = joint.keys["contact_model"] == "\"linear\"" || dice.chance(0.5) ? "1" : "1.5";
  if (dice.chance(0.5)) joint.keys["friction_coefficient"] = number_text(dice.uniform(0.05, 0.4));
  choose_duration(m, dice, 0.2, 1);
  fill_joints(m, dice, 1e6, 1e9);
  return m;
}

MechanismText friction(Dice& dice) {
  MechanismText m = any_linkage(dice);
  choose_duration(m, dice, 0.2, 1);
  const std::string law = dice.pick(std::array{"lugre", "coulomb", "brown-mcphee", "stribeck"});
  const bool mixed = dice.chance(0.3);
  bool any = false;
  for (JointText& joint : m.joints) {
    if (joint.type == "slot" || (any && dice.chance(0.5))) continue;
    any = true;
    const double kinetic = dice.uniform(0.03, 0.4);
    joint.keys["friction"] = in_quotes(mixed ? dice.pick(std::array{"lugre", "coulomb", "brown-mcphee", "stribeck"}) : law);
    joint.keys["friction_coefficient"] = number_text(kinetic);
    joint.keys["static_friction"] = number_text(kinetic * dice.uniform(1, 1.6));
    if (joint.type == "revolute") joint.keys["pin_radius"] = number_text(dice.uniform(4e-3, 2e-2));
    if (joint.type == "prismatic" && dice.chance(0.4)) joint.keys["guide_length"] = number_text(dice.uniform(0.03, 0.1));
    if (dice.chance(0.3)) joint.keys["viscous_friction"] = number_text(dice.uniform(0, 0.1));
    if (dice.chance(0.2)) joint.keys["friction_preload"] = number_text(dice.uniform(0, 30));
  }
  fill_joints(m, dice, 1e6, 1e9);
  add_loads(m, dice);
  return m;
}

MechanismText stops(Dice& dice) {
  MechanismText m = dice.chance(0.5) ? open_chain(dice, 2) : one_loop(dice);
  choose_duration(m, dice, 0.2, 1.5);
  JointText& joint = m.joints.front();
  const double angle = m.bodies.front().angle;
  const bool hard = dice.chance(0.6);
  joint.keys["stops"] = in_quotes(hard ? "hard" : "cushioned");
  if (dice.chance(0.8)) joint.keys["lower_stop"] = number_text(angle - dice.uniform(0.05, 0.6));
  if (dice.chance(0.8) || joint.keys.count("lower_stop") == 0) joint.keys["upper_stop"] = number_text(angle + dice.uniform(0.05, 0.6));
  joint.keys["stop_stiffness"] = number_text(dice.log_uniform(300, 1e6));
  if (hard) {
    choose_contact_model(dice, joint.keys, "stop_");
  } else {
    joint.keys["stop_cushion"] = number_text(dice.log_uniform(1e-3, 0.1));
    joint.keys["stop_damping"] = number_text(dice.log_uniform(1, 100));
  }
  fill_joints(m, dice, 1e6, 1e9);
  add_loads(m, dice);
  return m;
}

// A table on two blades, a pendulum on a flexure pivot or neck, a rod pinned to it.
MechanismText flexures(Dice& dice) {
  MechanismText m;
  m.gravity = {0, dice.chance(0.3) ? 0 : -9.81};
  choose_duration(m, dice, 0.2, 2);
  constexpr double kDown = -0.5 * std::numbers::pi;
  const double length = dice.uniform(0.04, 0.15), mass = dice.log_uniform(0.05, 2);
  const auto blade = [&](JointText& joint) {
    joint.keys["width"] = number_text(dice.uniform(5e-3, 3e-2));
    joint.keys["damping_time"] = number_text(dice.log_uniform(1e-6, 1e-3));
  };
  const int which = dice.integer(0, 2);
  const double thickness = dice.log_uniform(2e-4, 1e-3);
  if (which == 0) {
    m.add_body("table", {0, -length - 0.015}, 0, mass, mass * 3e-3);
    for (const double x : {-0.08, 0.08}) {
      const std::string top = m.on_ground({x, 0}, kDown), low = m.on("table", {x, -length}, kDown);
      JointText& joint = m.add_joint(x < 0 ? "left" : "right", "fixed", top, low);
      joint.keys["law"] = in_quotes("leaf-spring");
      joint.keys["length"] = number_text(length);
      joint.keys["thickness"] = number_text(thickness);
      blade(joint);
    }
  } else {
    m.add_body("table", {0, -length}, 0, mass, mass * 1e-3);
    const std::string top = m.on_ground({0, 0}, kDown), low = m.on("table", {0, 0}, kDown);
    JointText& joint = m.add_joint("pivot", "fixed", top, low);
    joint.keys["law"] = in_quotes(which == 1 ? "cross-spring" : "notch-hinge");
    joint.keys["thickness"] = number_text(which == 1 ? thickness : dice.uniform(3e-4, 2e-3));
    if (which == 1) joint.keys["length"] = number_text(0.05);
    else joint.keys["radius"] = number_text(dice.uniform(5e-3, 2e-2));
    blade(joint);
  }
  const double push = mass * dice.log_uniform(0.1, 3);
  m.add("force.push", {{"on", in_quotes(m.on("table", m.body("table").centre))}, {"force", Text{"[{}, 0]", in_quotes(Text{"{:.4g}*sin({:.4g}*t)", push, dice.uniform(2, 30) / m.duration})}}});
  if (dice.chance(0.5)) {
    const Point hook = m.body("table").centre;
    add_bar(m, dice, "rod", hook, Polar{hook, dice.uniform(0.05, 0.2), kDown + dice.uniform(-0.3, 0.3)}).spin = 0;
    m.add_pin("H", "table", "rod", hook);
    fill_joints(m, dice);
  }
  return m;
}

}  // namespace pintle::bench
