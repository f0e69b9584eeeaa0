// Gears, ropes, rods and cams.
#include <cmath>

#include "base/constants.h"
#include "bench/battery/kinds.h"
#include "bench/battery/linkages.h"

namespace pintle::bench {
namespace {

void add_wheel(MechanismText& m, Dice& dice, const std::string& name, Point centre, double radius) {
  const double mass = dice.log_uniform(0.2, 3);
  BodyText& wheel = m.add_body(name, centre, 0, mass, 0.5 * mass * radius * radius * dice.uniform(0.7, 3));
  wheel.held = name == "crank";
  m.add_pin(name == "crank" ? "A" : "O_" + name, "ground", name, centre);
}

// Wheels in a row, driven by a torque and braked by a spring; with a rack or a bar at the end.
MechanismText gear_row(Dice& dice, bool with_play) {
  MechanismText m;
  double radius = 1e-3 * dice.integer(15, 50), x = 0;
  std::string before = "crank";
  add_wheel(m, dice, before, {0, 0}, radius);
  m.weight = 0.3;
  for (int i = 2, n = dice.integer(2, 3); i <= n; ++i) {
    const double next = 1e-3 * dice.integer(15, 70);
    const std::string name = Text{"gear{}", i};
    const bool internal = !with_play && i == 2 && next > radius + 5e-3 && dice.chance(0.3);
    const double apart = internal ? next - radius : radius + next, at = internal ? x - apart : x + apart;
    add_wheel(m, dice, name, {at, 0}, next);
    const std::string first = m.on(before, {x, 0}), second = m.on(name, {at, 0});
    JointText& mesh = m.add_joint(Text{"mesh{}", i - 1}, "gear", first, second);
    mesh.keys["radii"] = Text{"[{}, {}]", number_text(radius), number_text(next)};
    if (internal) mesh.keys["mesh"] = in_quotes("internal");
    before = name, radius = next, x = at;
  }
  m.body("crank").spin = dice.chance(0.3) ? 0 : dice.uniform(-20, 20);
  if (dice.chance(0.3)) {
    const double mass = dice.log_uniform(0.5, 10);
    m.add_body("carriage", {x - radius, 0}, 0.5 * kPi, mass, 1e-2 * mass);
    const std::string ways = m.on_ground({x - radius, 0}, 0.5 * kPi), slide = m.on("carriage", {x - radius, 0}), teeth = m.on("carriage", {x - radius, 0}), wheel = m.on(before, {x, 0});
    m.add_joint("ways", "prismatic", ways, slide);
    m.add_joint("rack", "rack", wheel, teeth).keys["radius"] = number_text(radius);
  } else if (dice.chance(0.6)) {
    const JointText& pin = m.joint("O_" + before);
    m.add("torsion_spring.brake", {{"between", Text{"[{}, {}]", in_quotes(pin.first), in_quotes(pin.second)}}, {"stiffness", number_text(dice.log_uniform(0.3, 30))}, {"damping", number_text(dice.log_uniform(1e-3, 0.1))}});
  }
  return m;
}

// Teeth that push their wheels apart.
void choose_pressure_angle(MechanismText& m, Dice& dice) {
  const bool stated = dice.chance(0.6);
  const double angle = dice.uniform(0.25, 0.45);
  for (JointText& joint : m.joints)
    if (stated && (joint.type == "gear" || joint.type == "rack")) joint.keys["pressure_angle"] = number_text(angle);
}

}  // namespace

MechanismText gears(Dice& dice) {
  MechanismText m = gear_row(dice, false);
  choose_duration(m, dice, 0.1, 1);
  m.add("motor.drive", {{"joint", in_quotes("A")}, {"torque", in_quotes(Text{"{:.3g}*sin({:.3g}*t + {:.2g})", dice.uniform(0.2, 5), dice.uniform(2, 20) / m.duration, dice.uniform(0, 3)})}});
  fill_joints(m, dice);
  choose_pressure_angle(m, dice);
  return m;
}

MechanismText backlash(Dice& dice) {
  MechanismText m = gear_row(dice, true);
  choose_duration(m, dice, 0.05, 0.4);
  JointText& mesh = m.joint("mesh1");
  mesh.keys["law"] = in_quotes("backlash");
  mesh.keys["backlash"] = number_text(dice.log_uniform(5e-5, 5e-4));
  mesh.keys["contact_stiffness"] = number_text(dice.log_uniform(1e6, 1e8));
  mesh.keys["restitution"] = number_text(dice.uniform(0.3, 0.9));
  m.add("motor.drive", {{"joint", in_quotes("A")}, {"torque", in_quotes(Text{"{:.3g}*sin({:.3g}*t)", dice.uniform(0.2, 5), dice.uniform(4, 30) / m.duration})}});
  fill_joints(m, dice, 1e6, 1e9);
  choose_pressure_angle(m, dice);
  return m;
}

// A load on a rope or on ropes in series, or a bar caught by a slack rope.
MechanismText ropes(Dice& dice) {
  MechanismText m;
  const auto rope = [&](const std::string& name, const std::string& first, const std::string& second, double length) {
    JointText& joint = m.add_joint(name, "rope", first, second);
    joint.keys["length"] = number_text(length);
    joint.keys["stiffness"] = number_text(dice.log_uniform(1e4, 1e7));
    joint.keys["damping"] = number_text(dice.log_uniform(1, 1e3));
  };
  choose_duration(m, dice, 0.3, 2);
  if (dice.chance(0.5)) {
    const Point tip = Polar{{0, 0}, dice.uniform(0.2, 0.5), dice.uniform(-0.3, 1)};
    add_bar(m, dice, "crank", {0, 0}, tip).spin = dice.uniform(-2, 2);
    m.body("crank").held = true;
    m.add_pin("A", "ground", "crank", {0, 0});
    const Point post = Polar{{0, 0}, dice.uniform(0.3, 0.6), dice.uniform(0.8, 2.5)};
    const std::string first = m.on_ground(post), second = m.on("crank", tip);
    rope("rope", first, second, distance(post, tip) * dice.uniform(1.01, 1.3));
  } else {
    const double angle = -0.5 * kPi + dice.uniform(-0.8, 0.8), length = dice.uniform(0.3, 1);
    const Point end = Polar{{0, 0}, length, angle};
    BodyText& load = add_bar(m, dice, "load", end, Polar{end, dice.uniform(0.1, 0.4), angle});
    load.spin = 0;
    load.held = true;
    const std::string first = m.on_ground({0, 0}), second = m.on("load", end);
    rope("rope", first, second, length * (dice.chance(0.5) ? 1 : 1.02));
    if (dice.chance(0.5)) m.add("force.gust", {{"on", in_quotes(m.on("load", load.centre))}, {"force", Text{"[{}, 0]", in_quotes(Text{"{:.3g}*sin({:.3g}*t)", load.mass * dice.uniform(1, 10), dice.uniform(2, 12)})}}});
  }
  fill_joints(m, dice, 1e6, 1e9);
  return m;
}

// A crank and a rocker connected by a massless rod, a hanging rod, or an actuator.
MechanismText rods(Dice& dice) {
  MechanismText m;
  choose_duration(m, dice);
  const Point D{1e-2 * dice.integer(15, 40), 0}, C = Polar{D, dice.uniform(0.1, 0.3), dice.uniform(0.8, 2.3)};
  add_bar(m, dice, "crank", D, C).held = true;
  m.body("crank").spin = 0;
  m.add_pin("A", "ground", "crank", D);
  if (dice.chance(0.5)) {  // driven
    const Point foot{0, -0.05};
    const double length = distance(foot, C);
    const std::string first = m.on_ground(foot), second = m.on("crank", C);
    m.add_joint("actuator", "rod", first, second).keys["length"] = in_quotes(Text{"{} + {:.3g}*(1 - cos({:.3g}*t))", number_text(length), dice.signed_uniform(2e-3, 2e-2), dice.uniform(3, 20) / m.duration});
  } else {
    const Point B = Polar{{0, 0}, dice.uniform(0.05, 0.2), dice.uniform(-kPi, kPi)};
    BodyText& driver = add_bar(m, dice, "driver", {0, 0}, B);
    driver.held = true;
    driver.spin = dice.uniform(-8, 8);
    m.body("crank").held = false;
    m.body("crank").spin.reset();
    m.add_pin("O", "ground", "driver", {0, 0});
    const std::string first = m.on("driver", B), second = m.on("crank", C);
    m.add_joint("rod", "rod", first, second);
  }
  fill_joints(m, dice);
  const bool turned = m.has("motor.");
  if (!turned) {
    BodyText& crank = m.body("crank");
    m.add("torsion_spring.t", {{"between", Text{"[{}, {}]", in_quotes(m.joints.front().first), in_quotes(m.joints.front().second)}}, {"stiffness", number_text(dice.log_uniform(0.5, 50))}, {"free_angle", number_text(crank.angle + dice.uniform(-0.5, 0.5))}});
  }
  return m;
}

MechanismText cams(Dice& dice) {
  MechanismText m;
  const double base = 1e-3 * dice.integer(25, 60), roller = dice.chance(0.3) ? 0 : 1e-3 * dice.integer(5, 15), lift = dice.uniform(0.1, 0.4) * base, speed = dice.signed_uniform(2, 30);
  const bool flat = dice.chance(0.25);
  const double height = base + (flat ? 0 : roller);
  const double cam_mass = dice.log_uniform(0.5, 3);
  BodyText& cam = m.add_body("crank", {0, 0}, 0, cam_mass, cam_mass * dice.log_uniform(1e-3, 1e-2));
  cam.spin = speed;
  cam.held = true;
  m.add_pin("A", "ground", "crank", {0, 0});
  const double mass = dice.log_uniform(0.2, 2);
  m.add_body("follower", {0, height + 0.04}, 0, mass, 1e-3 * mass);
  const std::string guide = m.on_ground({0, 0.12}, 0.5 * kPi), stem = m.on("follower", {0, height + 0.04}, 0.5 * kPi);
  m.add_joint("guide", "prismatic", guide, stem);
  const std::string wheel = m.on("crank", {0, 0}, 0.5 * kPi), edge = m.on("follower", {0, height});
  JointText& touch = m.add_joint("cam", "cam", wheel, edge);
  const int harmonic = flat ? 1 : dice.integer(1, 2);
  touch.keys["base_radius"] = number_text(base);
  touch.keys["lift"] = in_quotes(Text{"{:.4g}*(1 - cos({}*angle))", 0.5 * lift / (harmonic * harmonic), harmonic});
  if (flat) touch.keys["follower"] = in_quotes("flat");
  else touch.keys["roller_radius"] = number_text(roller);
  if (dice.chance(0.6)) {
    touch.keys["law"] = in_quotes("contact");
    touch.keys["contact_stiffness"] = number_text(dice.log_uniform(1e6, 3e8));
    touch.keys["contact_exponent"] = "1";
    touch.keys["restitution"] = number_text(dice.uniform(0.3, 0.9));
  }
  const std::string seat = m.on_ground({0, height + 0.2}), top = m.on("follower", {0, height + 0.05});
  m.add("spring.return", {{"between", Text{"[{}, {}]", in_quotes(seat), in_quotes(top)}}, {"stiffness", number_text(dice.log_uniform(500, 2e4))}, {"preload", number_text(-dice.log_uniform(10, 500))}});
  m.add("motor.drive", {{"joint", in_quotes("A")}, {"speed", number_text(speed)}, {"stiffness", number_text(dice.log_uniform(1e3, 1e6))}, {"damping", number_text(dice.log_uniform(1, 100))}});
  m.duration = 1e-3 * std::round(1e3 * dice.uniform(0.5, 1.5) * 2 * kPi / std::abs(speed));
  fill_joints(m, dice, 1e6, 1e9);
  return m;
}

}  // namespace pintle::bench
