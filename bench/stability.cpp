// What the end of a step does to motions across taut joints: the spectral radius of the step, without and with the bodies held.
// theory/time section 4.1.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "bench/commands.h"
#include "integrators/radau/radau_table.h"
#include "integrators/radau/step_error.h"
#include "results/plots/svg_plot.h"

namespace pintle::bench {
namespace {

constexpr double kOutOfLine = 0.1;  // omega_c over omega_N, Eq. (4.9)

// One coordinate of unit mass in a step of 1 s, pulled back with the frequency `pull`; a joint whose gap it changes by 1 in the stages
// and by `end` at the end. Eqs. (3.5), (4.2), (4.7), (4.8).
double spectral_radius(const RadauTable& table, double pull, double end, bool held) {
  using Eigen::MatrixXd;
  using Eigen::VectorXd;
  const int n = table.n;
  const double k = std::pow(kOutOfLine * pull, 2), mu = kProjectionShare * table.real_eigenvalue;
  const double hold = held ? std::max(0.0, pull * pull - std::pow(table.real_eigenvalue, 2)) : 0, Z = mu * mu + hold + k * end * end;
  const MatrixXd A = table.A, A2 = table.A2, matrix = MatrixXd::Identity(n, n) + (pull * pull + k) * A2;
  const auto answer = [&](double gap) {
    double x = 0;
    for (double rest = k * end * gap / Z; const int pass : {0, 1, 2}) {
      if (pass > 0) rest *= hold / Z;
      x += rest;
    }
    return x;
  };
  Eigen::Matrix2d step;
  for (int column = 0; column < 2; ++column) {
    const double x0 = 1 - column, v0 = column;
    const VectorXd a = matrix.partialPivLu().solve(-(pull * pull + k * end) * (VectorXd::Constant(n, x0) + v0 * VectorXd(table.c)));
    const double moved = A2.row(n - 1).dot(a), gained = A.row(n - 1).dot(a);
    double x = x0 + v0 + moved, v = v0 + gained;
    for (int pass = 0; pass < 2; ++pass) {
      x += answer(end * (x0 + v0) + moved - end * x);
      v += answer(end * v0 + gained - end * v);
    }
    step.col(column) << x, v;
  }
  return step.eigenvalues().cwiseAbs().maxCoeff();
}

double largest_radius(const RadauTable& table, double pull, bool held) {
  double largest = 0;
  for (int i = 0; i <= 70; ++i)
    for (const double sign : {-1.0, 1.0}) largest = std::max(largest, spectral_radius(table, pull, sign * std::pow(10.0, -0.1 * i), held));
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
