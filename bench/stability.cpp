// The effect of the end of a step on motions across taut joints: the spectral radius of the step, without and with the bodies held.
// theory/time section 4.1.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "bench/commands.h"
#include "integrators/radau/linear_step.h"
#include "results/plots/svg_plot.h"

namespace pintle::bench {
namespace {

constexpr double kOutOfLine = 0.1;  // omega_c relative to omega_N, Eq. (4.9)

double largest_radius(const RadauTable& table, double pull, bool held) {
  double largest = 0;
  for (int i = 0; i <= 70; ++i)
    for (const double sign : {-1.0, 1.0}) {
      const linear_step::Gap joint{1, sign * std::pow(10.0, -0.1 * i), std::pow(kOutOfLine * pull, 2)};
      largest = std::max(largest, linear_step::spectral_radius(table, pull * pull, {joint}, held));
    }
  return largest;
}

}  // namespace

nlohmann::ordered_json study_stability(const std::string& file) {
  Plot plot;
  plot.title = "Growth of a motion across taut joints in one step";
  plot.subtitle = "spectral radius of the step, the largest over all gaps at its end";
  plot.x_quantity = "step times the frequency that the joints' force makes";
  plot.log_x = true;
  for (int i = 0; i <= 80; ++i) plot.x.push_back(std::pow(10.0, -1 + 0.05 * i));
  Panel panel{"spectral radius", "", {}, true};
  nlohmann::ordered_json out;
  for (const bool held : {false, true})
    for (const int stages : {3, 5}) {
      Curve curve{fmt::format("{} stages, {}", stages, held ? "bodies held" : "bodies free"), "", {}};
      for (const double pull : plot.x) curve.y.push_back(largest_radius(RadauTable::of(stages), pull, held));
      out[curve.label] = curve.y;
      panel.curves.push_back(std::move(curve));
    }
  plot.panels = {panel};
  plot.panel_height = 320;
  std::ofstream to(file, std::ios::binary);
  to << to_svg(plot);
  if (!to.flush()) throw std::runtime_error("cannot write " + file);
  fmt::print("{}\n", file);
  return out;
}

}  // namespace pintle::bench
