#include "bench/battery/mechanism_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pintle::bench {

double distance(Point a, Point b) { return std::hypot(b.x - a.x, b.y - a.y); }
double direction(Point from, Point to) { return std::atan2(to.y - from.y, to.x - from.x); }
Point middle(Point a, Point b, double share) { return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}; }

// Twelve digits: the text is the same on every machine, whatever the last bits of its cosine, and loops close to roundoff.
std::string number_text(double x) { return fmt::format("{:.12g}", x == 0 ? 0.0 : x); }
std::string in_quotes(const std::string& words) { return '"' + words + '"'; }

namespace {

std::string marker_text(double x, double y, double axis) {
  const auto tidy = [](double v) { return number_text(std::abs(v) < 1e-15 ? 0 : v); };
  return axis == 0 ? fmt::format("[{}, {}]", tidy(x), tidy(y)) : fmt::format("[{}, {}, {}]", tidy(x), tidy(y), tidy(axis));
}

template <class List>
auto& named(List& list, const std::string& name) {
  const auto it = std::find_if(list.begin(), list.end(), [&name](const auto& x) { return x.name == name; });
  if (it == list.end()) throw std::logic_error("no " + name);
  return *it;
}

}  // namespace

std::string MechanismText::on_ground(Point at, double axis) {
  ground_.emplace_back(fmt::format("P{}", ground_.size() + 1), marker_text(at.x, at.y, axis));
  return "ground." + ground_.back().first;
}

std::string MechanismText::on(const std::string& body_name, Point at, double axis) {
  if (body_name == "ground") return on_ground(at, axis);
  BodyText& b = body(body_name);
  const double dx = at.x - b.centre.x, dy = at.y - b.centre.y, c = std::cos(b.angle), s = std::sin(b.angle);
  b.markers.emplace_back(fmt::format("P{}", b.markers.size() + 1), marker_text(c * dx + s * dy, c * dy - s * dx, axis == 0 ? 0 : axis - b.angle));
  return b.name + "." + b.markers.back().first;
}

BodyText& MechanismText::add_body(const std::string& name, Point centre, double angle, double mass, double inertia) {
  return bodies.emplace_back(BodyText{name, centre, angle, mass, inertia});
}

JointText& MechanismText::add_joint(const std::string& name, const std::string& type, const std::string& first, const std::string& second) {
  return joints.emplace_back(JointText{name, type, first, second});
}

JointText& MechanismText::add_pin(const std::string& name, const std::string& first_body, const std::string& second_body, Point at) {
  const std::string first = on(first_body, at), second = on(second_body, at);
  return add_joint(name, "revolute", first, second);
}

bool MechanismText::has(const std::string& table) const {
  return std::any_of(others_.begin(), others_.end(), [&table](const auto& other) { return other.first.rfind(table, 0) == 0; });
}

BodyText& MechanismText::body(const std::string& name) { return named(bodies, name); }
JointText& MechanismText::joint(const std::string& name) { return named(joints, name); }

std::string MechanismText::text(const std::string& title) const {
  std::string out = fmt::format("format = 1\nname = {}\ngravity = [{}, {}]\n\n[simulate]\nduration = {}\n", in_quotes(title), number_text(gravity.x), number_text(gravity.y), number_text(duration));
  if (!start.empty()) out += fmt::format("start = {}\n", in_quotes(start));
  out += "\n[ground.markers]\n";
  for (const auto& [name, value] : ground_) out += fmt::format("{} = {}\n", name, value);
  for (const BodyText& b : bodies) {
    out += fmt::format("\n[body.{}]\nmass = {}\ninertia = {}\nposition = [{}, {}]\nangle = {}\n", b.name, number_text(b.mass), number_text(b.inertia), number_text(b.centre.x), number_text(b.centre.y),
                       number_text(b.angle));
    if (b.spin) out += fmt::format("spin = {}\n", number_text(*b.spin));
    if (b.velocity) out += fmt::format("velocity = [{}, {}]\n", number_text(b.velocity->x), number_text(b.velocity->y));
    if (b.held) out += "hold = [\"angle\"]\n";
    for (const auto& [name, value] : b.markers) out += fmt::format("markers.{} = {}\n", name, value);
  }
  const auto keys = [&out](const Keys& list) {
    for (const auto& [key, value] : list) out += fmt::format("{} = {}\n", key, value);
  };
  for (const JointText& j : joints) {
    out += fmt::format("\n[joint.{}]\ntype = {}\nbetween = [{}, {}]\n", j.name, in_quotes(j.type), in_quotes(j.first), in_quotes(j.second));
    keys(j.keys);
  }
  for (const auto& [table, list] : others_) {
    out += fmt::format("\n[{}]\n", table);
    keys(list);
  }
  return out;
}

}  // namespace pintle::bench
