// Mechanisms at rest until something happens, and controllers that switch all the time.
#include <array>

#include "bench/battery/kinds.h"
#include "bench/battery/linkages.h"

namespace pintle::bench {
namespace {

// Holds the bar in place: by a pin that sticks, or by a stop that it rests on.
void hold_still(MechanismText& m, Dice& dice, double angle) {
  Keys& keys = m.joint("A").keys;
  if (dice.chance(0.3)) {
    keys["stops"] = in_quotes("hard");
    keys["lower_stop"] = number_text(angle);
    keys["stop_stiffness"] = number_text(dice.log_uniform(1e3, 1e6));
    keys["stop_restitution"] = number_text(dice.uniform(0.1, 0.8));
    return;
  }
  const double stuck = dice.uniform(0.1, 0.5), radius = dice.uniform(5e-3, 2e-2);
  keys["friction"] = in_quotes(dice.pick(std::array{"coulomb", "lugre"}));
  keys["static_friction"] = number_text(stuck);
  keys["friction_coefficient"] = number_text(stuck * dice.uniform(0.6, 1));
  keys["pin_radius"] = number_text(radius);
  keys["friction_preload"] = number_text(m.weight / (stuck * radius) * dice.uniform(1.2, 3));
}

}  // namespace

// A bar at rest until the cord at its tip has been wound in far enough or a force has grown.
MechanismText waiting(Dice& dice) {
  MechanismText m;
  choose_duration(m, dice, 0.5, 3);
  m.start = dice.chance(0.7) ? "settled" : "assembled";
  const double length = dice.uniform(0.2, 0.8), angle = dice.uniform(-1, 1);
  const Point tip = Polar{{0, 0}, length, angle};
  BodyText& bar = add_bar(m, dice, "crank", {0, 0}, tip);
  bar.held = true;
  if (m.start != "settled") bar.spin = 0;
  m.add_pin("A", "ground", "crank", {0, 0});
  hold_still(m, dice, angle);
  const double comes = m.duration * dice.uniform(0.1, 0.6);  // approximate time
  if (dice.chance(0.6)) {
    const Point winch{tip.x + dice.uniform(-0.2, 0.2), tip.y + dice.uniform(0.2, 0.5)};
    JointText& cord = m.add_joint("cord", "rope", m.on_ground(winch), m.on("crank", tip));
    const double rate = dice.uniform(0.02, 0.2);
    cord.keys["length"] = in_quotes(Text{"{:.6g} - {:.4g}*t", distance(winch, tip) + rate * comes, rate});
    cord.keys["stiffness"] = number_text(dice.log_uniform(1e4, 1e6));
    cord.keys["damping"] = number_text(dice.log_uniform(10, 300));
  } else {
    const double force = m.weight / length * dice.uniform(5, 20);
    const Text load = dice.chance(0.5) ? Text{"{:.4g}*max(0, t - {:.4g})", force / m.duration, comes} : Text{"if(t < {:.4g}, 0, {:.4g})", comes, force};
    m.add("force.push", {{"on", in_quotes(m.on("crank", tip))}, {"force", Text{"[0, {}]", in_quotes(load)}}});
  }
  fill_joints(m, dice, 1e6, 1e9);
  return m;
}

// A crank with a bang-bang controller.
MechanismText relays(Dice& dice) {
  MechanismText m = dice.chance(0.5) ? open_chain(dice, 2) : one_loop(dice);
  choose_duration(m, dice, 0.2, 0.8);
  BodyText& crank = m.body("crank");
  crank.spin = 0;
  const double target = crank.angle + dice.signed_uniform(0.05, 0.5);
  m.add("motor.relay", {{"joint", in_quotes("A")}, {"torque", in_quotes(Text{"{:.4g}*sign({:.6g} - angle - {:.3g}*angle_rate)", m.weight * dice.uniform(1.5, 5) + 0.5, target, dice.log_uniform(0.01, 0.2)})}});
  fill_joints(m, dice, 1e6, 1e9);
  return m;
}

}  // namespace pintle::bench
