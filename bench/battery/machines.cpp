// Belts, cylinders, detents, and elements that depend on the motion: controllers and walls.
#include <cmath>

#include "base/constants.h"
#include "bench/battery/kinds.h"
#include "bench/battery/linkages.h"

namespace pintle::bench {
namespace {

void add_pulley(MechanismText& m, Dice& dice, const std::string& name, const std::string& pin, Point centre, double radius) {
  const double mass = dice.log_uniform(0.5, 10);
  BodyText& pulley = m.add_body(name, centre, 0, mass, 0.5 * mass * radius * radius * dice.uniform(0.7, 3));
  pulley.held = true;
  pulley.spin = 0;
  m.add_pin(pin, "ground", name, centre);
}

}  // namespace

// Two pulleys and the belt runs between them, or a drum that lifts a load.
MechanismText belts(Dice& dice) {
  MechanismText m;
  choose_duration(m, dice, 0.3, 1.5);
  const double r1 = 1e-3 * dice.integer(20, 80);
  add_pulley(m, dice, "crank", "A", {0, 0}, r1);
  const double stiffness = dice.log_uniform(1e4, 1e6), damping = stiffness * dice.log_uniform(1e-4, 2e-3), torque = dice.uniform(0.5, 8);
  const auto run = [&](const std::string& name, const std::string& first, const std::string& second) -> Keys& {
    JointText& joint = m.add_joint(name, "belt", first, second);
    joint.keys["first_radius"] = number_text(r1);
    joint.keys["stiffness"] = number_text(stiffness);
    joint.keys["damping"] = number_text(damping);
    return joint.keys;
  };
  if (dice.chance(0.5)) {
    const double r2 = 1e-3 * dice.integer(20, 120), apart = r1 + r2 + dice.uniform(0.05, 0.4);
    add_pulley(m, dice, "fan", "B", {apart, 0}, r2);
    const bool crossed = dice.chance(0.3);
    const double pretension = torque / r1 * dice.uniform(1.2, 3);
    for (const std::string side : {"left", "right"}) {
      Keys& keys = run(side, m.on("crank", {0, 0}), m.on("fan", {apart, 0}));
      keys["second_radius"] = number_text(r2);
      keys["first_side"] = in_quotes(side);
      if (crossed) keys["second_side"] = in_quotes(side == "left" ? "right" : "left");
      keys["stretch"] = number_text(pretension / stiffness);
    }
    m.add("motor.air", {{"joint", in_quotes("B")}, {"torque", in_quotes(Text{"-{:.3g}*rate", dice.log_uniform(1e-3, 0.1)})}});
  } else {
    const double mass = dice.log_uniform(0.5, 20);
    BodyText& load = m.add_body("load", {r1, -dice.uniform(0.2, 0.8)}, 0, mass, 1e-2 * mass);
    load.held = true;
    load.spin = 0;
    Keys& keys = run("rope", m.on("crank", {0, 0}), m.on("load", load.centre));
    keys["first_side"] = in_quotes("left");
    keys["stretch"] = number_text(mass * 9.81 / stiffness);
    m.add("motor.brake", {{"joint", in_quotes("A")}, {"torque", in_quotes(Text{"{:.4g}*(1 + {:.2g}*sin({:.3g}*t)) - {:.3g}*rate", mass * 9.81 * r1, dice.uniform(0.02, 0.3), dice.uniform(3, 15) / m.duration, dice.log_uniform(0.01, 1)})}});
    fill_joints(m, dice, 1e6, 1e9);
    return m;
  }
  m.add("motor.drive", {{"joint", in_quotes("A")}, {"torque", in_quotes(Text{"{:.3g}*(1 - rate/{:.3g})", torque, dice.uniform(20, 150)})}});
  fill_joints(m, dice, 1e6, 1e9);
  return m;
}

// A boom on a cylinder, with an oscillating supply or enclosed gas.
MechanismText cylinders(Dice& dice) {
  MechanismText m;
  choose_duration(m, dice, 0.3, 1.5);
  const double length = dice.uniform(0.3, 0.8), angle = dice.uniform(0, 0.9);
  const Point tip = Polar{{0, 0}, length, angle}, foot{dice.uniform(0, 0.15), -dice.uniform(0.15, 0.3)}, hook = middle({0, 0}, tip, dice.uniform(0.4, 0.8));
  BodyText& boom = add_bar(m, dice, "crank", {0, 0}, tip);
  boom.held = true;
  boom.spin = 0;
  m.add_pin("A", "ground", "crank", {0, 0});
  JointText& ram = m.add_joint("ram", "cylinder", m.on_ground(foot), m.on("crank", hook));
  const double out = distance(foot, hook), stroke = 0.4 * out, at = stroke * dice.uniform(0.3, 0.7), bore = dice.uniform(0.02, 0.05), area = 0.25 * kPi * bore * bore;
  const double pressure = m.weight / (length * area) * dice.uniform(1, 3);
  Keys& keys = ram.keys;
  keys["bore"] = number_text(bore);
  keys["rod_diameter"] = number_text(bore * dice.uniform(0.3, 0.7));
  keys["closed_length"] = number_text(out - at);
  keys["stroke"] = number_text(stroke);
  if (dice.chance(0.5)) keys["cap_pressure"] = in_quotes(Text{"{:.4g}*({:.4g}/({:.4g} + stroke))^1.3", pressure, 0.05 + at, 0.05});
  else keys["cap_pressure"] = in_quotes(Text{"{:.4g}*(1 + {:.2g}*sin({:.3g}*t)) - {:.3g}*stroke_rate", pressure, dice.uniform(0.05, 0.4), dice.uniform(3, 20) / m.duration, pressure * dice.uniform(0.1, 2)});
  keys["stops"] = in_quotes("cushioned");
  keys["stop_stiffness"] = number_text(dice.log_uniform(1e4, 1e6));
  keys["stop_damping"] = number_text(dice.log_uniform(100, 3e3));
  keys["stop_cushion"] = number_text(stroke * dice.uniform(0.02, 0.1));
  if (dice.chance(0.5)) {
    keys["friction"] = in_quotes("brown-mcphee");
    const double kinetic = dice.uniform(0.02, 0.2);
    keys["friction_coefficient"] = number_text(kinetic);
    keys["static_friction"] = number_text(kinetic * dice.uniform(1, 1.5));
    keys["friction_preload"] = number_text(dice.uniform(1, 50));
  }
  fill_joints(m, dice, 1e6, 1e9);
  return m;
}

// A knob that a soft spring drags through its notches.
MechanismText detents(Dice& dice) {
  MechanismText m;
  m.gravity = {0, 0};
  const double mass = dice.log_uniform(0.05, 1), speed = dice.signed_uniform(0.5, 3), ball = dice.uniform(2e-3, 4e-3);
  BodyText& knob = m.add_body("crank", {0, 0}, 0, mass, mass * dice.log_uniform(5e-5, 1e-3));
  knob.held = true;
  knob.spin = 0;
  m.add_pin("A", "ground", "crank", {0, 0});
  Keys& keys = m.joint("A").keys;
  keys["detent"] = in_quotes("ball-detent");
  keys["ball_radius"] = number_text(ball);
  keys["notch_radius"] = number_text(ball * dice.uniform(1.2, 2));
  keys["notch_width"] = number_text(ball * dice.uniform(1.2, 1.8));
  keys["detent_preload"] = number_text(dice.uniform(5, 40));
  keys["detent_rate"] = number_text(dice.uniform(1e3, 1e4));
  keys["detent_radius"] = number_text(0.02);
  keys["detent_pitch"] = number_text(2 * kPi / dice.integer(8, 12));
  m.duration = 1e-3 * std::round(1e3 * dice.uniform(0.8, 1.5) / std::abs(speed));
  m.add("motor.hand", {{"joint", in_quotes("A")}, {"torque", in_quotes(Text{"{:.3g}*({:.4g}*t - angle) - {:.3g}*angle_rate", dice.uniform(0.4, 1.5), speed, dice.log_uniform(1e-3, 1e-2)})}});
  fill_joints(m, dice, 1e6, 1e9);
  return m;
}

// A linkage whose crank follows a controller, and whose last bar is pushed back by a soft wall.
MechanismText controlled(Dice& dice) {
  MechanismText m = any_linkage(dice);
  choose_duration(m, dice);
  BodyText& crank = m.body("crank");
  crank.spin = 0;
  const double gain = m.weight * dice.uniform(2, 10) + 0.5;
  m.add("motor.lead", {{"joint", in_quotes("A")}, {"torque", in_quotes(Text{"{:.4g}*({:.6g} + {:.2g}*sin({:.3g}*t) - angle) - {:.3g}*angle_rate", gain, crank.angle, dice.uniform(0.05, 0.5), dice.uniform(2, 15) / m.duration, 0.1 * gain * dice.uniform(0.5, 2)})}});
  BodyText& last = m.bodies.back();
  const std::string point = m.on(last.name, last.centre);
  m.add("force.wall", {{"on", in_quotes(point)}, {"force", Text{"[{}, 0]", in_quotes(Text{"-{:.3g}*({}.x - {:.5g}) - {:.3g}*{}.vx", dice.log_uniform(30, 3e3), point, last.centre.x, dice.log_uniform(0.1, 30), point})}}});
  fill_joints(m, dice);
  return m;
}

}  // namespace pintle::bench
