// A mechanism under construction, described in its start position in world axes, and the model file made from it.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pintle::bench {

struct Point {
  double x = 0, y = 0;
};
double distance(Point a, Point b);
double direction(Point from, Point to);  // [rad]
/// The point at a distance in a direction. Used with braces, so that random arguments are drawn in their order.
struct Polar : Point {
  Polar(Point from, double length, double angle) : Point{from.x + length * std::cos(angle), from.y + length * std::sin(angle)} {}
};
Point middle(Point a, Point b, double share = 0.5);

/// Values as written in a model file.
using Keys = std::map<std::string, std::string>;
std::string number_text(double x);
std::string in_quotes(const std::string& words);
/// The result of fmt::format. Used with braces, so that random arguments are drawn in their order.
struct Text : std::string {
  template <class... Values>
  Text(fmt::format_string<const Values&...> pattern, const Values&... values) : std::string(fmt::format(pattern, values...)) {}
};

struct BodyText {
  std::string name;
  Point centre;
  double angle = 0, mass = 1, inertia = 1;
  std::optional<double> spin{};
  std::optional<Point> velocity{};
  bool held = false;  // its angle and spin are those of the start; assembly finds the others
  std::vector<std::pair<std::string, std::string>> markers{};
};

struct JointText {
  std::string name, type, first, second;
  Keys keys{};
  double length = 0;  // scale for the angular stiffness [m]
};

class MechanismText {
 public:
  /// `axis` is in world axes [rad]. Both return "body.marker".
  std::string on_ground(Point at, double axis = 0);
  std::string on(const std::string& body, Point at, double axis = 0);

  BodyText& add_body(const std::string& name, Point centre, double angle, double mass, double inertia);
  JointText& add_joint(const std::string& name, const std::string& type, const std::string& first, const std::string& second);
  JointText& add_pin(const std::string& name, const std::string& first_body, const std::string& second_body, Point at);  // also "ground"
  /// "spring.s1", "motor.drive" ..
  void add(const std::string& table, Keys keys) { others_.emplace_back(table, std::move(keys)); }
  bool has(const std::string& table) const;

  BodyText& body(const std::string& name);
  JointText& joint(const std::string& name);
  std::vector<BodyText> bodies;
  std::vector<JointText> joints;
  Point gravity{0, -9.81};
  double duration = 1;  // [s]
  std::string start;    // simulate.start; empty: the default
  double weight = 0;    // largest possible moment of gravity: the scale of loads [N*m]

  std::string text(const std::string& title) const;

 private:
  std::vector<std::pair<std::string, std::string>> ground_;
  std::vector<std::pair<std::string, Keys>> others_;
};

}  // namespace pintle::bench
