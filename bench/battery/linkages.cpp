#include "bench/battery/linkages.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace pintle::bench {
namespace {

// Rounds to the millimetre, so that files are easy to read.
Point rounded(Point p) { return {1e-3 * std::round(1e3 * p.x), 1e-3 * std::round(1e3 * p.y)}; }

Point random_point(Dice& dice, Point from, double least, double most) { return rounded(Polar{from, dice.uniform(least, most), dice.uniform(-kPi, kPi)}); }

// Whether two bars that meet in `at` are far enough out of line.
bool bent(Point a, Point at, Point b) { return std::abs(std::sin(direction(at, a) - direction(at, b))) > 0.2; }

// A place for pin C of the dyad B-C-D. If B and D nearly coincide, there is none.
Point dyad_pin(Dice& dice, Point B, Point D) {
  for (int i = 0; i < 1000; ++i) {
    const Point C = random_point(dice, B, 0.1, 0.5);
    if (bent(B, C, D) && distance(C, D) > 0.08 && distance(C, D) < 0.6) return C;
  }
  throw NoSuchLinkage("no dyad between points that nearly coincide");
}

// Two bars that connect `first` in B to `second` in D.
void add_dyad(MechanismText& m, Dice& dice, const std::string& first, Point B, const std::string& second, Point D, const std::array<std::string, 2>& bars, const std::array<std::string, 3>& pins) {
  const Point C = dyad_pin(dice, B, D);
  add_bar(m, dice, bars[0], B, C);
  add_bar(m, dice, bars[1], D, C);
  m.add_pin(pins[0], first, bars[0], B);
  m.add_pin(pins[1], bars[0], bars[1], C);
  m.add_pin(pins[2], second, bars[1], D);
}

Point add_crank(MechanismText& m, Dice& dice, const std::string& name, const std::string& pin, Point at) {
  const Point end = random_point(dice, at, 0.05, 0.3);
  add_bar(m, dice, name, at, end);
  m.add_pin(pin, "ground", name, at);
  return end;
}

Point other_pivot(Dice& dice, Point from) { return rounded(Polar{from, dice.uniform(0.1, 0.5), dice.uniform(-0.6, 0.6)}); }

}  // namespace

BodyText& add_bar(MechanismText& m, Dice& dice, const std::string& name, Point from, Point to) {
  const double length = distance(from, to), mass = dice.log_uniform(0.1, 3);
  const Point centre = middle(from, to, dice.chance(0.3) ? dice.uniform(0.2, 0.8) : 0.5);
  m.weight += 9.81 * mass * length;
  return m.add_body(name, centre, direction(from, to), mass, mass * length * length / 12 * dice.uniform(0.8, 1.6));
}

MechanismText open_chain(Dice& dice, int most_bars) {
  MechanismText m;
  Point at;
  std::string before = "ground";
  for (int i = 1, n = dice.integer(1, most_bars); i <= n; ++i) {
    const std::string name = i == 1 ? std::string("crank") : Text{"bar{}", i};
    const Point end = random_point(dice, at, 0.1, 0.6);
    BodyText& bar = add_bar(m, dice, name, at, end);
    bar.spin = dice.chance(0.4) ? 0 : dice.uniform(-5, 5);
    bar.held = true;
    m.add_pin(std::string(1, static_cast<char>('A' + i - 1)), before, name, at);
    before = name;
    at = end;
  }
  return m;
}

MechanismText four_bar(Dice& dice) {
  MechanismText m;
  const Point B = add_crank(m, dice, "crank", "A", {0, 0});
  add_dyad(m, dice, "crank", B, "ground", other_pivot(dice, {0, 0}), {"coupler", "rocker"}, {"B", "C", "D"});
  spin_crank(m, dice);
  return m;
}

MechanismText five_bar(Dice& dice) {
  MechanismText m;
  const Point B = add_crank(m, dice, "crank", "A", {0, 0}), D = add_crank(m, dice, "crank2", "E", other_pivot(dice, {0, 0}));
  add_dyad(m, dice, "crank", B, "crank2", D, {"coupler", "coupler2"}, {"B", "C", "D"});
  spin_crank(m, dice);
  m.body("crank2").spin = dice.uniform(-6, 6);
  m.body("crank2").held = true;
  return m;
}

MechanismText six_bar(Dice& dice) {
  MechanismText m = four_bar(dice);
  const std::string carrier = dice.chance(0.5) ? "coupler" : "rocker";
  const Point P = random_point(dice, m.body(carrier).centre, 0.05, 0.2);
  add_dyad(m, dice, carrier, P, "ground", other_pivot(dice, {0.2, -0.1}), {"link", "output"}, {"E", "F", "G"});
  return m;
}

MechanismText two_loops(Dice& dice) {
  MechanismText m;
  const Point B = add_crank(m, dice, "crank", "A", {0, 0}), D = other_pivot(dice, {0, 0});
  const Point C = dyad_pin(dice, B, D);
  add_bar(m, dice, "coupler", B, C);
  add_bar(m, dice, "rocker", D, C);
  m.add_pin("B", "crank", "coupler", B);
  m.add_pin("C", "coupler", "rocker", C);
  m.add_pin("D", "ground", "rocker", D);
  add_dyad(m, dice, "rocker", C, "ground", other_pivot(dice, D), {"coupler2", "rocker2"}, {"E", "F", "G"});
  spin_crank(m, dice);
  return m;
}

MechanismText slider_crank(Dice& dice) {
  MechanismText m;
  const Point B = add_crank(m, dice, "crank", "A", {0, 0});
  const double offset = dice.chance(0.4) ? 0 : dice.uniform(-0.04, 0.04), rod = distance({0, 0}, B) * dice.uniform(1.5, 4) + std::abs(offset);
  const Point C{B.x + std::sqrt(rod * rod - (offset - B.y) * (offset - B.y)), offset};
  add_bar(m, dice, "rod", B, C);
  const double mass = dice.log_uniform(0.1, 3);
  m.add_body("slider", C, 0, mass, mass * 1e-3 * dice.uniform(0.3, 3));
  m.weight += 9.81 * mass * distance({0, 0}, B);
  m.add_pin("B", "crank", "rod", B);
  m.add_pin("C", "rod", "slider", C);
  const std::string guide = m.on_ground({0, offset}), carriage = m.on("slider", C);
  if (dice.chance(0.25)) m.add_joint("S", "slot", guide, carriage);
  else m.add_joint("S", "prismatic", guide, carriage);
  if (m.joints.back().type == "slot") m.body("slider").spin = 0;
  spin_crank(m, dice);
  return m;
}

// The crank's end slides along a bar that swings about a pivot, in a slot or with a block.
MechanismText inverted_slider_crank(Dice& dice) {
  MechanismText m;
  const Point B = add_crank(m, dice, "crank", "A", {0, 0});
  const Point D = rounded(Polar{{0, 0}, distance({0, 0}, B) * dice.uniform(0.4, 2.5) + 0.03, dice.uniform(-kPi, kPi)});
  const double along = direction(D, B);
  add_bar(m, dice, "swing", D, Polar{D, dice.uniform(0.2, 0.6), along});
  m.add_pin("D", "ground", "swing", D);
  const Point on_swing = Polar{D, 0.05, along};
  if (dice.chance(0.5)) {
    m.add_joint("S", "slot", m.on("swing", on_swing, along), m.on("crank", B));
  } else {
    const double mass = dice.log_uniform(0.05, 1);
    m.add_body("block", B, along, mass, 4e-4 * mass);
    m.add_pin("B", "crank", "block", B);
    const std::string guide = m.on("swing", on_swing, along), slide = m.on("block", B, along);
    m.add_joint("S", "prismatic", guide, slide);
  }
  spin_crank(m, dice);
  return m;
}

MechanismText one_loop(Dice& dice) { return dice.chance(0.5) ? four_bar(dice) : slider_crank(dice); }

MechanismText any_linkage(Dice& dice) {
  switch (dice.integer(0, 4)) {
    case 0: return open_chain(dice, 2);
    case 1: return five_bar(dice);
    case 2: return slider_crank(dice);
    case 3: return inverted_slider_crank(dice);
    default: return four_bar(dice);
  }
}

void spin_crank(MechanismText& m, Dice& dice, double fastest) {
  BodyText& crank = m.body("crank");
  crank.spin = dice.chance(0.2) ? 0 : dice.signed_log_uniform(0.3, fastest);
  crank.held = true;
}

void add_spring_and_damper(Dice& dice, JointText& joint, double softest, double stiffest) {
  const double k = dice.log_uniform(softest, stiffest), c = dice.chance(0.3) ? 0 : dice.log_uniform(10, 1e5);
  joint.keys["stiffness"] = number_text(k);
  joint.keys["damping"] = number_text(c);
  if (joint.type != "prismatic" && joint.type != "fixed") return;
  const double lever = dice.log_uniform(0.01, 0.1);
  joint.keys["angular_stiffness"] = number_text(k * lever * lever);
  joint.keys["angular_damping"] = number_text(c * lever * lever);
}

void fill_joints(MechanismText& m, Dice& dice, double softest, double stiffest) {
  for (JointText& joint : m.joints)
    if (joint.keys.count("law") == 0 && joint.keys.count("stiffness") == 0) add_spring_and_damper(dice, joint, softest, stiffest);
}

namespace {

std::string waving(Dice& dice, double size, double duration) {
  const double w = dice.uniform(1, 12) / duration;
  switch (dice.integer(0, 3)) {
    case 0: return number_text(size);
    case 1: return in_quotes(Text{"{:.4g}*sin({:.4g}*t + {:.3g})", size, w, dice.uniform(0, 6)});
    case 2: return in_quotes(Text{"{:.4g}*smoothstep({:.4g}, {:.4g}, t)", size, 0.1 * duration, dice.uniform(0.2, 0.6) * duration});
    default: return in_quotes(Text{"if(t < {:.4g}, {:.4g}, 0)", dice.uniform(0.1, 0.8) * duration, size});
  }
}

void add_motor(MechanismText& m, Dice& dice) {
  BodyText& crank = m.body("crank");
  Keys motor{{"joint", in_quotes("A")}};
  const double torque = m.weight * dice.signed_log_uniform(0.1, 3);
  if (dice.chance(0.4)) return drive_crank(m, dice);
  if (dice.chance(0.5)) {
    motor["torque"] = in_quotes(Text{"{:.4g}*(1 - rate/({:.4g}))", torque, torque > 0 ? dice.uniform(5, 40) : -dice.uniform(5, 40)});
  } else {
    crank.spin = 0;
    motor["position"] = in_quotes(Text{"{} + {:.3g}*(1 - cos({:.4g}*t))", number_text(crank.angle), dice.uniform(-0.6, 0.6), dice.uniform(2, 10) / m.duration});
    motor["stiffness"] = number_text(dice.log_uniform(1e3, 1e6));
    motor["damping"] = number_text(dice.log_uniform(1, 1e3));
  }
  m.add("motor.drive", motor);
}

}  // namespace

void drive_crank(MechanismText& m, Dice& dice) {
  BodyText& crank = m.body("crank");
  if (!crank.spin || *crank.spin == 0) crank.spin = dice.signed_uniform(1, 12);
  Keys motor{{"joint", in_quotes("A")}, {"speed", number_text(*crank.spin)}};
  if (dice.chance(0.5)) {
    motor["stiffness"] = number_text(dice.log_uniform(1e2, 1e6));
    motor["damping"] = number_text(dice.log_uniform(0.1, 1e3));
  }
  m.add("motor.drive", motor);
}

void choose_duration(MechanismText& m, Dice& dice, double shortest, double longest) { m.duration = 1e-3 * std::round(1e3 * dice.log_uniform(shortest, longest)); }

void add_loads(MechanismText& m, Dice& dice) {
  if (dice.chance(0.25)) m.gravity = {0, 0};
  const double reach = 0.3, force = m.weight / reach;
  for (int i = 1, n = dice.integer(0, 2); i <= n; ++i) {
    const std::string body = dice.pick(m.bodies).name;
    const Point at = m.body(body).centre, post = Polar{at, dice.uniform(0.2, 0.6), dice.uniform(-kPi, kPi)};
    Keys spring{{"between", Text{"[{}, {}]", in_quotes(m.on_ground(post)), in_quotes(m.on(body, at))}}, {"stiffness", number_text(dice.log_uniform(10, 5e3))}};
    if (dice.chance(0.5)) spring["damping"] = number_text(dice.log_uniform(0.1, 100));
    spring["free_length"] = number_text(distance(at, post) * dice.uniform(0.5, 1.2));
    m.add(Text{"spring.s{}", i}, spring);
  }
  const JointText& A = m.joints.front();
  if (A.type == "revolute" && dice.chance(0.2))
    m.add("torsion_spring.t", {{"between", Text{"[{}, {}]", in_quotes(A.first), in_quotes(A.second)}}, {"stiffness", number_text(m.weight * dice.log_uniform(0.3, 10))},
                               {"damping", number_text(dice.chance(0.5) ? 0 : dice.log_uniform(1e-3, 0.3))}, {"free_angle", number_text(m.bodies.front().angle + dice.uniform(-1, 1))}});
  if (dice.chance(0.35)) {
    const std::string body = dice.pick(m.bodies).name;
    Keys load{{"on", in_quotes(m.on(body, m.body(body).centre))}};
    if (dice.chance(0.5)) load["torque"] = waving(dice, m.weight * dice.signed_log_uniform(0.05, 2), m.duration);
    else load["force"] = Text{"[{}, {}]", waving(dice, force * dice.signed_log_uniform(0.05, 2), m.duration), waving(dice, force * dice.uniform(-1, 1), m.duration)};
    if (load.count("force") != 0 && dice.chance(0.3)) load["axes"] = in_quotes("body");
    m.add("force.push", load);
  }
  if (!m.has("motor.") && m.bodies.front().name == "crank" && dice.chance(0.4)) add_motor(m, dice);
}

}  // namespace pintle::bench
