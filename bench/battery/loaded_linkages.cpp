// Linkages dominated by the joint forces: redundant, preloaded, at their limits, through dead centres, toggles.
#include <cmath>

#include "base/constants.h"
#include "bench/battery/kinds.h"
#include "bench/battery/linkages.h"

namespace pintle::bench {
namespace {

// Equal cranks that carry one coupler: more than it needs.
MechanismText parallel_cranks(Dice& dice, int cranks, double misfit) {
  MechanismText m;
  const double length = 1e-2 * dice.integer(8, 30), angle = 0.1 * dice.integer(3, 28);
  const auto foot = [](int i) { return Point{0.12 * i, i % 2 == 0 ? 0.0 : 0.03}; };
  std::vector<Point> tops;
  for (int i = 0; i < cranks; ++i) {
    const std::string name = i == 0 ? std::string("crank") : Text{"crank{}", i + 1};
    tops.push_back(Polar{foot(i), length + (i > 1 ? misfit : 0), angle});
    add_bar(m, dice, name, foot(i), tops.back());
    m.add_pin(std::string(1, static_cast<char>('A' + i)), "ground", name, foot(i));
  }
  add_bar(m, dice, "coupler", tops.front(), tops.back());
  for (int i = 0; i < cranks; ++i) {
    const Point end = Polar{foot(i), length, angle};
    const std::string crank = i == 0 ? std::string("crank") : Text{"crank{}", i + 1};
    const std::string first = m.on(crank, tops[i]), second = m.on("coupler", end);
    m.add_joint(Text{"T{}", i + 1}, "revolute", first, second);
  }
  spin_crank(m, dice, 6);
  return m;
}

// A slider-crank whose slider has two guides.
MechanismText two_guides(Dice& dice) {
  MechanismText m = slider_crank(dice);
  const BodyText& slider = m.body("slider");
  const Point second{slider.centre.x + 0.1, slider.centre.y};
  const std::string guide = m.on_ground({0, second.y}), carriage = m.on("slider", second);
  m.add_joint("S2", "prismatic", guide, carriage);
  return m;
}

// Bars between two posts, pulled taut by a spring.
MechanismText taut_chain(Dice& dice) {
  MechanismText m;
  const int bars = dice.integer(2, 4);
  const double length = 1e-2 * dice.integer(8, 30), tension = dice.log_uniform(10, 1e5);
  std::string before = "ground";
  for (int i = 0; i < bars; ++i) {
    const std::string name = i == 0 ? std::string("crank") : Text{"bar{}", i + 1};
    add_bar(m, dice, name, {i * length, 0}, {(i + 1) * length, 0});
    m.add_pin(std::string(1, static_cast<char>('A' + i)), before, name, {i * length, 0});
    before = name;
  }
  const Point end{bars * length, 0};
  const std::string at = m.on(before, end), post = m.on_ground({end.x + 0.1, 0});
  m.add("spring.pull", {{"between", Text{"[{}, {}]", in_quotes(at), in_quotes(post)}}, {"stiffness", number_text(dice.log_uniform(1e3, 1e6))}, {"preload", number_text(tension)}});
  m.add("force.push", {{"on", in_quotes(m.on("crank", {length, 0}))}, {"force", Text{"[0, {}]", in_quotes(Text{"{:.4g}*sin({:.4g}*t)", tension * dice.uniform(0.01, 0.3), dice.uniform(2, 60)})}}});
  return m;
}

// A four-bar braced by a rod of the wrong length, so that nothing can move.
MechanismText braced_four_bar(Dice& dice) {
  MechanismText m = four_bar(dice);
  m.body("crank").spin = 0;
  const Point on_coupler = m.body("coupler").centre, post{0.1, -0.15};
  JointText& brace = m.add_joint("brace", "rod", m.on_ground(post), m.on("coupler", on_coupler));
  brace.keys["length"] = number_text(distance(post, on_coupler) * (1 + dice.signed_log_uniform(1e-6, 1e-3)));
  brace.keys["stiffness"] = number_text(dice.log_uniform(1e5, 1e8));
  brace.keys["damping"] = number_text(dice.log_uniform(10, 1e4));
  return m;
}

// Lengths a, b, c of crank, coupler and rocker, and g between the pivots, assembled at the given crank angle.
bool closed_four_bar(MechanismText& m, Dice& dice, double a, double b, double c, double g, double angle) {
  const Point B = Polar{{0, 0}, a, angle}, D{g, 0};
  const double d = distance(B, D);
  if (d > 0.97 * (b + c) || d < 1.05 * std::abs(b - c)) return false;
  const double at_B = std::acos((b * b + d * d - c * c) / (2 * b * d));
  const Point C = Polar{B, b, direction(B, D) + at_B};
  m = {};
  add_bar(m, dice, "crank", {0, 0}, B);
  add_bar(m, dice, "coupler", B, C);
  add_bar(m, dice, "rocker", D, C);
  m.add_pin("A", "ground", "crank", {0, 0});
  m.add_pin("B", "crank", "coupler", B);
  m.add_pin("C", "coupler", "rocker", C);
  m.add_pin("D", "ground", "rocker", D);
  return true;
}

}  // namespace

MechanismText redundant(Dice& dice) {
  MechanismText m = dice.chance(0.3) ? two_guides(dice) : parallel_cranks(dice, dice.integer(3, 4), 0);
  choose_duration(m, dice);
  fill_joints(m, dice);
  add_loads(m, dice);
  return m;
}

MechanismText pre_stressed(Dice& dice) {
  const int which = dice.integer(0, 2);
  MechanismText m = which == 0 ? parallel_cranks(dice, 3, dice.signed_log_uniform(1e-7, 1e-4)) : which == 1 ? taut_chain(dice) : braced_four_bar(dice);
  choose_duration(m, dice, 0.1, 1);
  fill_joints(m, dice, 1e6, which == 0 ? 1e8 : 1e10);
  if (which != 1) add_loads(m, dice);
  return m;
}

MechanismText locked(Dice& dice) {
  MechanismText m;
  for (double a = 0, b = 0, c = 0, g = 0;;) {
    a = dice.uniform(0.1, 0.3), b = dice.uniform(0.1, 0.35), c = dice.uniform(0.1, 0.35), g = dice.uniform(0.15, 0.4);
    if (a + g > 1.02 * (b + c) && closed_four_bar(m, dice, a, b, c, g, dice.uniform(0.3, kPi - 0.3))) break;
  }
  m.body("crank").held = true;
  m.body("crank").spin = dice.signed_uniform(1, 10);
  drive_crank(m, dice);
  choose_duration(m, dice, 0.3, 3);
  fill_joints(m, dice);
  return m;
}

// A crank turned through the positions in which all bars are collinear, or through those of a slider-crank of equal lengths.
MechanismText dead_centres(Dice& dice) {
  MechanismText m;
  const double a = 1e-2 * dice.integer(8, 25), g = 1e-2 * dice.integer(26, 40);
  const int which = dice.integer(0, 2);
  if (which == 2) {  // rod as long as the crank: the slider passes the crank's pivot
    const double angle = dice.uniform(0.3, 1.2);
    const Point B = Polar{{0, 0}, a, angle}, C{2 * a * std::cos(angle), 0};
    add_bar(m, dice, "crank", {0, 0}, B);
    add_bar(m, dice, "rod", B, C);
    const double mass = dice.log_uniform(0.1, 3);
    m.add_body("slider", C, 0, mass, 1e-2 * mass);
    m.add_pin("A", "ground", "crank", {0, 0});
    m.add_pin("B", "crank", "rod", B);
    m.add_pin("C", "rod", "slider", C);
    const std::string guide = m.on_ground({0, 0}), carriage = m.on("slider", C);
    m.add_joint("S", "prismatic", guide, carriage);
  } else {
    while (!closed_four_bar(m, dice, a, which == 0 ? g : a, which == 0 ? a : g, g, dice.uniform(0.5, 2.5))) continue;
  }
  m.body("crank").held = true;
  m.body("crank").spin = dice.signed_uniform(3, 15);
  drive_crank(m, dice);
  choose_duration(m, dice, 0.3, 2);
  fill_joints(m, dice, 1e6, 1e9);
  return m;
}

// A toggle that is pushed straight against a stiff spring.
MechanismText toggle(Dice& dice) {
  MechanismText m;
  const double a = dice.uniform(0.1, 0.3), b = dice.uniform(0.1, 0.3), bend = dice.log_uniform(0.02, 0.5);
  const Point B = Polar{{0, 0}, a, bend}, C{B.x + std::sqrt(b * b - B.y * B.y), 0};
  add_bar(m, dice, "crank", {0, 0}, B);
  add_bar(m, dice, "rod", B, C);
  m.add_body("slider", C, 0, dice.log_uniform(0.3, 10), 1e-3);
  m.add_pin("A", "ground", "crank", {0, 0});
  m.add_pin("B", "crank", "rod", B);
  m.add_pin("C", "rod", "slider", C);
  const std::string guide = m.on_ground({0, 0}), carriage = m.on("slider", C);
  m.add_joint("S", "prismatic", guide, carriage);
  const std::string post = m.on_ground({C.x + 0.2, 0}), nose = m.on("slider", C);
  m.add("spring.work", {{"between", Text{"[{}, {}]", in_quotes(nose), in_quotes(post)}}, {"stiffness", number_text(dice.log_uniform(1e4, 1e6))}, {"damping", number_text(dice.log_uniform(1, 1e3))},
                        {"free_length", number_text(0.2 + (dice.chance(0.5) ? 0 : dice.uniform(-0.01, 0.01)))}});
  choose_duration(m, dice, 0.1, 1);
  const double push = dice.log_uniform(10, 5e3);
  m.add("force.push", {{"on", in_quotes(m.on("crank", B))}, {"force", Text{"[0, {}]", in_quotes(Text{"-{:.4g}*sin({:.4g}*t)", push, dice.uniform(2, 12) / m.duration})}}});
  fill_joints(m, dice);
  return m;
}

}  // namespace pintle::bench
