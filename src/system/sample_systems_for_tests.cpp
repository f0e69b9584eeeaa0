#include "system/sample_systems_for_tests.h"

#include <stdexcept>
#include <utility>

#include "base/expression/expression_parser.h"
#include "base/units.h"

namespace pintle::sample {

Expression expression(const std::string& text, const std::vector<std::string>& variables) {
  ParseScope scope;
  for (const std::string& name : variables) scope.variables.emplace_back(name, kBareNumber);
  const auto parsed = parse_expression(text, scope);
  if (const auto* good = std::get_if<ParsedExpression>(&parsed)) return good->expression;
  throw std::logic_error(text + ": " + std::get<ParseProblem>(parsed).because);
}

Joint joint(const std::string& name, const std::string& type, const MarkerRef& first, const MarkerRef& second, double k, double c) {
  Joint j;
  j.name = name;
  j.type = type;
  j.first = first;
  j.second = second;
  j.law.values = {{"stiffness", {k}}, {"damping", {c}}, {"angular_stiffness", {k}}, {"angular_damping", {c}}};
  return j;
}

Body body(const std::string& name, double mass, double inertia, const std::vector<Marker>& markers) {
  Body b;
  b.name = name;
  b.mass = mass;
  b.inertia = inertia;
  b.markers = markers;
  return b;
}

void put_at(Body& b, double x, double y, double angle) {
  b.position = Vec2{x, y};
  b.angle = angle;
}

Model pendulum(double k, double c, double g) {
  Model model;
  model.gravity = {0, -g};
  model.ground = {{"O", {0, 0}, 0}};
  model.bodies = {body("rod", 1, 1.0 / 12, {{"O", {-0.5, 0}, 0}})};
  put_at(model.bodies[0], 0.5, 0, 0);
  model.joints = {joint("pin", "revolute", {"ground", "O"}, {"rod", "O"}, k, c)};
  return model;
}

Model four_bar(double k, double c, double theta2) {
  Model model;
  model.gravity = {0, 0};
  model.ground = {{"O2", {0, 0}, 0}, {"O4", {6, 0}, 0}};
  model.bodies = {body("crank", 1, 1e5, {{"O2", {-0.5, 0}, 0}, {"A", {0.5, 0}, 0}}),
                  body("coupler", 4, 5.333, {{"A", {-2, 0}, 0}, {"B", {2, 0}, 0}}),
                  body("follower", 4, 5.333, {{"O4", {-2, 0}, 0}, {"B", {2, 0}, 0}})};
  model.joints = {joint("O2", "revolute", {"ground", "O2"}, {"crank", "O2"}, k, c),
                  joint("A", "revolute", {"crank", "A"}, {"coupler", "A"}, k, c),
                  joint("B", "revolute", {"coupler", "B"}, {"follower", "B"}, k, c),
                  joint("O4", "revolute", {"ground", "O4"}, {"follower", "O4"}, k, c)};
  const FourBarPose p(theta2);
  const double ax = std::cos(theta2), ay = std::sin(theta2);
  const auto bar = [](Body& b, double x0, double y0, double vx0, double vy0, double r, double angle, double spin) {
    put_at(b, x0 + r * std::cos(angle), y0 + r * std::sin(angle), angle);
    b.velocity = Vec2{vx0 - spin * r * std::sin(angle), vy0 + spin * r * std::cos(angle)};
    b.spin = spin;
  };
  bar(model.bodies[0], 0, 0, 0, 0, 0.5, theta2, 10);
  bar(model.bodies[1], ax, ay, -10 * ay, 10 * ax, 2, p.theta3, p.omega3);
  bar(model.bodies[2], 6, 0, 0, 0, 2, p.theta4, p.omega4);
  return model;
}

Spring spring(const std::string& name, bool torsion, const MarkerRef& first, const MarkerRef& second, double k, double c) {
  Spring s;
  s.name = name;
  s.torsion = torsion;
  s.first = first;
  s.second = second;
  s.stiffness = k;
  s.damping = c;
  return s;
}

Motor motor(const std::string& name, const std::string& of, MotorKind kind, Expression law) {
  Motor m;
  m.name = name;
  m.joint = of;
  m.kind = kind;
  m.law = std::move(law);
  m.stiffness = 50;
  m.damping = 7;
  return m;
}

Model everything(bool free) {
  Model model;
  model.gravity = {free ? 0 : 0.4, free ? 0 : -9.8};
  model.ground = {{"P", {0.3, -0.2}, 0.3}, {"Q", {1.5, 0.7}, -0.4}};
  for (int i = 0; i < 6; ++i)
    model.bodies.push_back(body(std::string(1, static_cast<char>('a' + i)), 1 + 0.3 * i, 0.2 + 0.1 * i,
                                {{"P", {0.3 - 0.1 * i, 0.2}, 0.4 * i}, {"Q", {-0.2, 0.1 * i}, 0.7 - i}}));
  const auto add = [&model](const char* name, const char* type, const char* first, const char* second) {
    model.joints.push_back(joint(name, type, {first, "P"}, {second, "Q"}, 90, 4));
  };
  if (!free) add("g", "revolute", "ground", "a");
  if (!free) add("h", "prismatic", "b", "ground");
  add("r", "revolute", "a", "b");
  add("p", "prismatic", "b", "c");
  add("f", "fixed", "c", "d");
  add("s", "slot", "d", "a");
  add("d", "rod", "e", "b");
  add("t", "rope", "e", "c");
  add("m", "gear", "e", "f");
  add("n", "gear", "a", "e");
  add("k", "rack", "f", "a");
  for (Joint& j : model.joints) {
    if (j.type == "rod" || j.type == "rope") j.geometry = {{"length", 0.8}};
    if (j.type == "gear") j.geometry = {{"radius_first", 0.3}, {"radius_second", 0.7}, {"internal", j.name == "n" ? 1.0 : 0.0}};
    if (j.type == "rack") j.geometry = {{"radius", 0.4}};
  }
  model.springs = {spring("S", false, {"a", "P"}, {"d", "Q"}, 30, 2), spring("T", true, {"b", "P"}, {"e", "Q"}, 20, 3)};
  if (!free) model.springs.push_back(spring("G", false, {"ground", "Q"}, {"f", "P"}, 15, 1));
  if (!free) model.springs.push_back(spring("U", true, {"c", "P"}, {"ground", "Q"}, 12, 0.5));
  for (Spring& s : model.springs) s.free_length = 0.6;
  model.springs.push_back(spring("C", false, {"c", "Q"}, {"e", "P"}, 0, 0));
  model.springs.back().preload = 25;
  model.motors = {
      motor("E", "r", MotorKind::kEffort, expression("5*sin(t) - 0.4*rate + angle^2 + 2*p.slide - s.rate", {"t", "rate", "angle", "p.slide", "s.rate"})),
      motor("L", "p", MotorKind::kEffort, expression("3 - slide*r.angle - 0.2*rate", {"slide", "r.angle", "rate"})),
      motor("V", "r", MotorKind::kSpeed, expression("1.7", {})), motor("W", "s", MotorKind::kPosition, expression("0.2*sin(3*t)"))};
  if (!free) {
    AppliedForce world, follower;
    world.name = "X";
    world.on = {"b", "Q"};
    world.force = {expression("2*cos(t)"), expression("t^2")};
    world.torque = expression("3*t");
    follower = world;
    follower.name = "Y";
    follower.on = {"d", "P"};
    follower.body_axes = true;
    model.forces = {world, follower};
  }
  return model;
}

System with_ideal(System system, const std::vector<std::string>& names) {
  for (JointData& joint : system.joints)
    for (const std::string& name : names) joint.ideal = joint.ideal || joint.name == name;
  return system;
}

Eigen::VectorXd random_vector(Random& random, int n, double size) {
  Eigen::VectorXd x(n);
  for (double& value : x) value = random.uniform(-size, size);
  return x;
}

void random_state(Random& random, std::size_t n_bodies, Vecs& q, Vecs& v) {
  q.clear();
  v.clear();
  while (q.size() < n_bodies) {
    const Planar::Vec x = random.vector<Planar::Vec>(-3, 3);
    bool apart = true;
    for (const Planar::Vec& y : q) apart = apart && (x - y).head<2>().norm() > 1;
    if (!apart) continue;
    q.push_back(x);
    v.push_back(random.vector<Planar::Vec>(-2, 2));
  }
}

}  // namespace pintle::sample
