// Models of any size, to show how cost grows with size: a chain, a tree, a ladder of loops and a lattice. All bars are uniform and slender, 1 m and 1 kg.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "pintle/model.h"

namespace pintle::sample {

class LargeModel {
 public:
  explicit LargeModel(std::string name, double stiffness = 1e8) : stiffness_(stiffness) {
    model_.name = std::move(name);
    model_.gravity = {0, -9.81};
    model_.simulate.duration = 10;
    model_.simulate.output_step = 0.05;
    model_.simulate.tolerance = 1e-3;
  }

  void add_ground(const std::string& marker, double x, double y, double angle = 0) { model_.ground.push_back({marker, {x, y}, angle}); }
  /// Its markers are A and B, half a metre to either side of the middle.
  Body& add_bar(const std::string& name, double x, double y, double angle) {
    Body bar;
    bar.name = name;
    bar.mass = 1;
    bar.inertia = 1.0 / 12;
    bar.position = Vec2{x, y};
    bar.angle = angle;
    bar.markers = {{"A", {-0.5, 0}, 0}, {"B", {0.5, 0}, 0}};
    return model_.bodies.emplace_back(std::move(bar));
  }
  Joint& add_pin(const std::string& name, const MarkerRef& first, const MarkerRef& second) {
    Joint pin;
    pin.name = name;
    pin.type = "revolute";
    pin.first = first;
    pin.second = second;
    pin.law.values = {{"stiffness", {stiffness_}}, {"damping", {3000.0}}};
    return model_.joints.emplace_back(std::move(pin));
  }
  Model model() && { return std::move(model_); }

 private:
  Model model_;
  double stiffness_;
};

/// n level bars in a row, the first on a ground pin, released from rest.
inline Model chain_model(int n) {
  LargeModel out("Chain of " + std::to_string(n) + " bars");
  out.add_ground("O", 0, 0);
  for (int i = 0; i < n; ++i) out.add_bar("bar" + std::to_string(i), i + 0.5, 0, 0);
  for (int i = 0; i < n; ++i)
    out.add_pin("pin" + std::to_string(i), i == 0 ? MarkerRef{"ground", "O"} : MarkerRef{"bar" + std::to_string(i - 1), "B"},
                {"bar" + std::to_string(i), "A"});
  return std::move(out).model();
}

/// n bars, bar i on the end of bar (i - 1) / 2, hanging slightly askew. The root carries all of them, hence the stiffness.
inline Model tree_model(int n) {
  LargeModel out("Tree of " + std::to_string(n) + " bars", 1e10);
  out.add_ground("O", 0, 0);
  std::vector<Vec2> end(n);
  for (int i = 0; i < n; ++i) {
    const Vec2 from = i == 0 ? Vec2{0, 0} : end[(i - 1) / 2];
    const double angle = -1.57 + (i % 2 == 1 ? 1.0 : -0.5) / (1 + std::floor(std::log2(i + 1)));
    const Vec2 along{std::cos(angle), std::sin(angle)};
    end[i] = {from[0] + along[0], from[1] + along[1]};
    out.add_bar("bar" + std::to_string(i), from[0] + 0.5 * along[0], from[1] + 0.5 * along[1], angle);
    out.add_pin("pin" + std::to_string(i), i == 0 ? MarkerRef{"ground", "O"} : MarkerRef{"bar" + std::to_string((i - 1) / 2), "B"},
                {"bar" + std::to_string(i), "A"});
  }
  return std::move(out).model();
}

/// The n-four-bar: n + 1 upright cranks joined by n couplers, as mechanisms/n_four_bar.py makes it.
inline Model ladder_model(int n) {
  LargeModel out("N-four-bar, N = " + std::to_string(n));
  for (int i = 0; i <= n; ++i) {
    const std::string crank = "crank" + std::to_string(i);
    out.add_ground("A" + std::to_string(i), i, 0);
    Body& bar = out.add_bar(crank, i, 0.5, std::acos(0.0));
    bar.velocity = Vec2{0.5, 0};
    bar.spin = -1;
    out.add_pin("A" + std::to_string(i), {"ground", "A" + std::to_string(i)}, {crank, "A"});
  }
  for (int i = 0; i < n; ++i) {
    const std::string coupler = "coupler" + std::to_string(i);
    Body& bar = out.add_bar(coupler, i + 0.5, 1, 0);
    bar.velocity = Vec2{1, 0};
    bar.spin = 0;
    out.add_pin("B" + std::to_string(i) + "right", {"crank" + std::to_string(i), "B"}, {coupler, "A"});
    out.add_pin("B" + std::to_string(i + 1) + "left", {"crank" + std::to_string(i + 1), "B"}, {coupler, "B"});
  }
  return std::move(out).model();
}

/// n x n parallelograms of pinned bars, the lower edge on the ground. At each node all bars are pinned to one of them.
inline Model grid_model(int n) {
  LargeModel out("Lattice of " + std::to_string(n) + " x " + std::to_string(n) + " parallelograms");
  const double slant = 1.4, dx = std::cos(slant), dy = std::sin(slant);
  std::map<std::array<int, 2>, std::vector<MarkerRef>> ends;
  for (int i = 0; i <= n; ++i) {
    out.add_ground("O" + std::to_string(i), i, 0);
    for (int j = 0; j <= n; ++j) {
      const double x = i + j * dx, y = j * dy;
      const std::string place = std::to_string(i) + "_" + std::to_string(j);
      const auto add = [&](const std::string& name, double along_x, double along_y, double angle, std::array<int, 2> other) {
        out.add_bar(name, x + 0.5 * along_x, y + 0.5 * along_y, angle);
        ends[{i, j}].push_back({name, "A"});
        ends[other].push_back({name, "B"});
      };
      if (i < n && j > 0) add("level" + place, 1, 0, 0, {i + 1, j});
      if (j < n) add("slant" + place, dx, dy, slant, {i, j + 1});
    }
  }
  for (const auto& [node, bars] : ends) {
    const std::string place = std::to_string(node[0]) + "_" + std::to_string(node[1]);
    if (node[1] == 0) out.add_pin("foot" + place, {"ground", "O" + std::to_string(node[0])}, bars[0]);
    for (std::size_t k = 1; k < bars.size(); ++k) out.add_pin("pin" + place + "_" + std::to_string(k), bars[0], bars[k]);
  }
  return std::move(out).model();
}

}  // namespace pintle::sample
