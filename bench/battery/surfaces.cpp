// Curved surfaces and teeth with friction: followers on cams, wheels and skids on edges, gears.
#include <array>
#include <cmath>

#include "base/constants.h"
#include "bench/battery/kinds.h"
#include "bench/battery/linkages.h"

namespace pintle::bench {
namespace {

void choose_surfaces(Dice& dice, Keys& keys) {
  keys["law"] = in_quotes("contact");
  keys["contact_stiffness"] = number_text(dice.log_uniform(1e5, 1e8));
  keys["contact_exponent"] = "1";
  if (dice.chance(0.5)) keys["restitution"] = number_text(dice.uniform(0.3, 0.9));
  else keys["contact_model"] = in_quotes("linear"), keys["contact_damping"] = number_text(dice.log_uniform(100, 3e3));
  const double kinetic = dice.uniform(0.05, 0.6);
  keys["friction_coefficient"] = number_text(kinetic);
  if (dice.chance(0.5)) keys["static_friction"] = number_text(kinetic * dice.uniform(1, 1.5)), keys["stick_stiffness"] = number_text(dice.log_uniform(1e5, 1e7)), keys["stick_damping"] = number_text(dice.log_uniform(100, 1e3));
  else keys["friction_full_speed"] = number_text(dice.log_uniform(1e-3, 3e-2));
}

void choose_friction(Dice& dice, Keys& keys) {
  const double kinetic = dice.uniform(0.02, 0.15);
  keys["friction"] = in_quotes(dice.pick(std::array{"lugre", "coulomb", "brown-mcphee", "stribeck"}));
  keys["friction_coefficient"] = number_text(kinetic);
  keys["static_friction"] = number_text(kinetic * dice.uniform(1, 1.4));
}

// A wheel that rolls through a valley or over hills, alone or with a bar on its axle.
MechanismText wheel(Dice& dice) {
  MechanismText m;
  const double radius = dice.uniform(0.03, 0.15), mass = dice.log_uniform(0.3, 5), wave = dice.uniform(6, 15) * radius, deep = wave * wave / (4 * kPi * kPi) / radius * dice.uniform(0.03, 0.35);
  BodyText& body = m.add_body("wheel", {0, radius}, 0, mass, mass * radius * radius * dice.uniform(0.4, 1));
  const double speed = dice.uniform(-1, 1) * std::sqrt(9.81 * wave);
  body.velocity = Point{speed, 0};
  body.spin = dice.chance(0.7) ? -speed / radius : 0;
  body.held = true;
  const std::string road = m.on_ground({0, 0}), centre = m.on("wheel", {0, radius});
  JointText& edge = m.add_joint("road", "edge", road, centre);
  edge.keys["height"] = in_quotes(Text{"{:.5g}*(1 - cos(2*pi*x/({:.5g} m)))", (dice.chance(0.5) ? 0.5 : -0.5) * deep, wave});
  edge.keys["from"] = number_text(-2 * wave);
  edge.keys["to"] = number_text(2 * wave);
  edge.keys["roller_radius"] = number_text(radius);
  choose_surfaces(dice, edge.keys);
  m.weight = mass * 9.81 * radius;
  choose_duration(m, dice, 0.1, 1);
  if (dice.chance(0.4)) {
    const double angle = dice.uniform(-2.5, -0.6);
    add_bar(m, dice, "bar", {0, radius}, Polar{{0, radius}, dice.uniform(0.1, 0.3), angle});
    m.body("bar").velocity = Point{speed, 0};
    m.add_pin("axle", "wheel", "bar", {0, radius});
  }
  fill_joints(m, dice, 1e6, 1e9);
  return m;
}

// A cam that drags its follower along.
MechanismText dragged_follower(Dice& dice) {
  MechanismText m = cams(dice);
  Keys& keys = m.joint("cam").keys;
  if (keys.contains("law")) {
    keys.erase("restitution");
    choose_surfaces(dice, keys);
  } else {
    choose_friction(dice, keys);
  }
  return m;
}

MechanismText rubbing_gears(Dice& dice) {
  MechanismText m = gears(dice);
  for (JointText& joint : m.joints)
    if (joint.type == "gear" || joint.type == "rack") choose_friction(dice, joint.keys), joint.keys["sliding_distance"] = number_text(dice.uniform(1e-3, 4e-3));
  return m;
}

}  // namespace

MechanismText surfaces(Dice& dice) {
  const double share = dice.uniform(0, 1);
  return share < 0.4 ? wheel(dice) : share < 0.7 ? dragged_follower(dice) : rubbing_gears(dice);
}

}  // namespace pintle::bench
