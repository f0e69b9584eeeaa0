// Section 9: the inverted slider-crank.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper/items.h"
#include "paper/runs.h"

namespace pintle::paper {
namespace {

struct Row {
  const char *about, *column, *ideal_column, *unit;
};
constexpr Row kRows[] = {{"crank pin O2, x", "joint.O2.on_crank.fx[world]", "F12x", "N"},
                         {"crank pin O2, y", "joint.O2.on_crank.fy[world]", "F12y", "N"},
                         {"block pin A, x", "joint.A.on_block.fx[world]", "F23x", "N"},
                         {"block pin A, y", "joint.A.on_block.fy[world]", "F23y", "N"},
                         {"guide pin O4, x", "joint.O4.on_guide.fx[world]", "F14x", "N"},
                         {"guide pin O4, y", "joint.O4.on_guide.fy[world]", "F14y", "N"},
                         {"guide on block, across", "joint.P.on_block.f2[joint]", "N43", "N"},
                         {"guide on block, moment", "joint.P.on_block.m[world]", "M43", "N m"}};

Trajectory turn(double factor) {
  Model model = mechanism("inverted_slider_crank", {"simulate.duration=pi/10"});
  model.simulate.tolerance = 1e-6;
  for (Joint& joint : model.joints)
    for (auto& [name, values] : joint.law.values)
      for (double& x : values) x *= name.ends_with("stiffness") ? factor : std::sqrt(factor);
  return run(model, true);
}

std::size_t row_at(const Trajectory& r, double t) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < r.n_rows(); ++i)
    if (std::abs(r.at(i, 0) - t) < std::abs(r.at(best, 0) - t)) best = i;
  return best;
}

struct Difference {
  double error = 0, peak = 0;
  double relative() const { return error / peak; }
};

Difference difference(const Trajectory& r, const ReferenceTable& ideal, const Row& what) {
  const std::vector<double> values = column(r, what.column);
  Difference d;
  for (double x : values) d.peak = std::max(d.peak, std::abs(x));
  for (std::size_t i = 0; i < ideal.size(); ++i)
    d.error = std::max(d.error, std::abs(values[row_at(r, ideal.at(i, "t"))] - ideal.at(i, what.ideal_column)));
  return d;
}

Plot picture(const Trajectory& r, const ReferenceTable& ideal) {
  Plot plot;
  plot.title = "Inverted slider-crank: guide on block";
  plot.subtitle = "k = 1e8 N/m and 1e6 N m/rad, c = 3000 N s/m and 30 N m s/rad; circles: ideal joints";
  plot.x_quantity = "crank angle theta2";
  plot.x_unit = "deg";
  plot.x = column(r, "body.crank.angle");
  for (double& x : plot.x) x /= kDegree;
  plot.panel_height = 220;
  for (const auto& [quantity, unit, row] : {std::tuple{"Force across", "N", kRows[6]}, std::tuple{"Moment", "N*m", kRows[7]}}) {
    Curve dots{"ideal", "", std::vector<double>(r.n_rows(), NAN), true};
    for (std::size_t i = 0; i < ideal.size(); ++i) dots.y[row_at(r, ideal.at(i, "t"))] = ideal.at(i, row.ideal_column);
    plot.panels.push_back({quantity, unit, {{"compliant", "", column(r, row.column)}, dots}});
  }
  return plot;
}

}  // namespace

Item make_slider() {
  Item item{"slider", "Section 9: the inverted slider-crank", {}, {}, {}, {}, {}};
  const ReferenceTable ideal("inverted_slider_crank");
  const Trajectory file = turn(1), stiffer = turn(100);
  item.text = {"The paper prints no dimensions; mechanisms/inverted_slider_crank.toml assumes them, with every offset of its Figure 10 nonzero. "
               "Ideal joints: a 40-digit table, tests/reference/inverted_slider_crank.csv."};
  Table table{"Largest difference from ideal joints over a turn",
              {"what", "peak", "k = 1e8", "of the peak", "k = 1e10", "of the peak"},
              {}};
  double one = 0, hundred = 0;
  for (const Row& row : kRows) {
    const Difference d = difference(file, ideal, row), s = difference(stiffer, ideal, row);
    one = std::max(one, d.relative());
    hundred = std::max(hundred, s.relative());
    table.rows.push_back({row.about, fmt::format("{:.4g} {}", d.peak, row.unit), fmt::format("{:.1e}", d.error), fmt::format("{:.1e}", d.relative()),
                          fmt::format("{:.1e}", s.error), fmt::format("{:.1e}", s.relative())});
  }
  item.claims = {{"9", "results identical to ideal joints to within the usual tolerances of numerical integration",
                  fmt::format("{:.1e} of the peak at k = 1e8 N/m, {:.1e} at 1e10: {:.1f} and {:.1f} digits", one, hundred, digits(one), digits(hundred)),
                  one < 1e-4 ? Verdict::kHolds : one < 1e-3 ? Verdict::kPartly : Verdict::kFails}};
  item.pictures = {{"slider.svg", "Force and moment of the prismatic pair over one crank revolution.", picture(file, ideal)}};
  item.tables = {table};
  return item;
}

}  // namespace pintle::paper
