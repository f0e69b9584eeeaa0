// Section 8: Figure 9, bearings from rubber to rolling elements, and how to find a stiffness.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "paper/four_bar_runs.h"
#include "paper/items.h"

namespace pintle::paper {
namespace {

constexpr double kFourFigures = 5e-4;  // half a unit of the fourth figure, at worst, of the leading figure 1

double closed_form_error(const char* table_name, double degrees) {
  const ReferenceTable table(table_name);
  const char* const names[] = {"F12", "F23", "F34", "F14"};
  double worst = 0;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const IdealFourBar ideal = ideal_four_bar(table.at(row, "theta2"), degrees * kDegree, 10);
    for (std::size_t j = 0; j < 4; ++j)
      worst = std::max({worst, std::abs(ideal.force[j].x - table.at(row, std::string(names[j]) + "x")),
                        std::abs(ideal.force[j].y - table.at(row, std::string(names[j]) + "y"))});
  }
  return worst;
}

Plot figure_9(const Trajectory& r) {
  Plot plot;
  plot.title = "Figure 9: force of the ground on the follower at O4";
  plot.subtitle = "four-bar of section 8, k = 1e8 N/m, c = 3000 N s/m; circles: ideal joints, closed form";
  plot.x_quantity = "crank angle theta2";
  plot.x_unit = "deg";
  Curve fx{"F", "14x", column(r, "joint.O4.on_follower.fx[world]")}, fy{"F", "14y", column(r, "joint.O4.on_follower.fy[world]")};
  Curve ideal_x{"ideal F", "14x", {}, true}, ideal_y{"ideal F", "14y", {}, true};
  const std::vector<double> theta = column(r, "body.crank.angle");
  for (std::size_t i = 0; i < theta.size(); ++i) {
    plot.x.push_back(theta[i] / kDegree);
    const Force force = ideal_four_bar(theta[i], 0, 10).force[3];
    ideal_x.y.push_back(i % 10 == 0 ? force.x : NAN);
    ideal_y.y.push_back(i % 10 == 0 ? force.y : NAN);
  }
  plot.panels = {{"Force", "N", {fx, fy, ideal_x, ideal_y}}};
  plot.panel_height = 380;
  return plot;
}

// The same by the program's own equations with Lagrange multipliers, where it has them.
void compare_with_multipliers(const Trajectory& compliant, Item& item) {
  Model model = four_bar({1e8, 3000}, 0);
  model.simulate.equations = Equations::kIdeal;
  try {
    const Trajectory ideal = run(model, true);
    const FromIdeal d = from_ideal(ideal, 0);
    item.claims.push_back({"8", "(additional check) equations with Lagrange multipliers give the closed form",
                           fmt::format("{:.1e} of each pin's peak", d.force), verdict(d.force < 1e-4)});
    (void)compliant;
  } catch (const std::invalid_argument&) {
    item.waiting.push_back("the ideal four-bar by Lagrange multipliers (`equations = \"ideal\"`); the closed form replaces it");
  }
}

struct Choice {
  const char* name;
  Bearing bearing;
};

}  // namespace

Item make_figure_9() {
  Item item{"figure-9", "Figure 9: the four-bar", {}, {}, {}, {}, {}};
  const Trajectory r = run(four_bar({1e8, 3000}, 0));
  const FromIdeal d = from_ideal(r, 0);
  const double peak_x = largest(column(r, "joint.O4.on_follower.fx[world]")), peak_y = largest(column(r, "joint.O4.on_follower.fy[world]"));
  const std::vector<double> speed = column(r, "body.crank.spin");
  const auto [slowest, fastest] = std::minmax_element(speed.begin(), speed.end());
  item.text = {
      "The paper does not print the initial crank angle; here it is 0°. The flywheel keeps the speed constant, so over the crank angle any start "
      "gives the same curve. Coupler and follower start with consistent velocities, and every pin with its load.",
      fmt::format("The ideal joints are computed from a closed form (one coordinate, energy integral, Newton-Euler); it agrees with the 30-digit "
                  "table in tests/reference to {:.0e} N.",
                  std::max(closed_form_error("four_bar_from_0", 0), closed_form_error("four_bar", 60)))};
  item.claims = {{"8, Fig. 9", "three programs agree within the noise of numerical integration",
                  fmt::format("F14 at k = 1e8, c = 3000 is {:.1e} of its peak from ideal joints; largest F14x {:.2f} N, F14y {:.2f} N",
                              d.by_pin[3], peak_x, peak_y),
                  verdict(d.by_pin[3] < 1e-4)},
                 {"8", "the crank's speed is close to constant", fmt::format("{:.5f} to {:.5f} rad/s", *slowest, *fastest),
                  verdict(*fastest - *slowest < 1e-3)}};
  compare_with_multipliers(r, item);
  item.pictures = {{"figure-9.svg", "Reaction at the follower's ground pin over one crank revolution.", figure_9(r)}};
  Table table{"F14 over the crank's angle", {"theta2 [deg]", "F14x [N]", "ideal [N]", "F14y [N]", "ideal [N]"}, {}};
  const std::vector<double> theta = column(r, "body.crank.angle"), fx = column(r, "joint.O4.on_follower.fx[world]"),
                            fy = column(r, "joint.O4.on_follower.fy[world]");
  for (std::size_t row = 0; row < theta.size(); row += 30) {
    const Force f = ideal_four_bar(theta[row], 0, 10).force[3];
    table.rows.push_back({fmt::format("{:.2f}", std::abs(theta[row] / kDegree)), fmt::format("{:.3f}", fx[row]), fmt::format("{:.3f}", f.x),
                          fmt::format("{:.3f}", fy[row]), fmt::format("{:.3f}", f.y)});
  }
  item.tables = {table};
  return item;
}

Item make_bearings() {
  Item item{"bearings", "Section 8: bearings from rubber to rolling elements", {}, {}, {}, {}, {}};
  const Choice choices[] = {{"rubber mounting, soft", {1e5, 500}},
                            {"rubber mounting, firm", {1e6, 1e3}},
                            {"journal, lightest", {1e7, 1e5}},
                            {"journal, soft, heavily damped", {1e7, 5e5}},
                            {"journal, stiffest", {1e8, 1e5}},
                            {"journal, stiff, heavily damped", {1e8, 5e5}},
                            {"rolling element, softest", {1e8, 2e3}},
                            {"the paper's four-bar", {1e8, 3e3}},
                            {"rolling element, soft, most damped", {1e8, 1e4}},
                            {"rolling element, stiffest", {3e9, 1e4}}};
  Table table{"Largest difference of joint forces from ideal joints over a turn, relative to each pin's peak; the digits are those "
              "in which the worst pin agrees",
              {"bearing", "k [N/m]", "c [N s/m]", "O2", "A", "B", "O4", "digits", "angles [rad]"},
              {}};
  double commercial = 0, journal = 0, rubber = 0, rolling_angle = 0;
  for (const Choice& choice : choices) {
    const FromIdeal d = from_ideal(run(four_bar(choice.bearing, 60), true), 60);
    std::vector<std::string> row{choice.name, short_number(choice.bearing.k), short_number(choice.bearing.c)};
    for (const double e : d.by_pin) row.push_back(fmt::format("{:.1e}", e));
    row.push_back(fmt::format("{:.1f}", digits(d.force)));
    row.push_back(fmt::format("{:.1e}", d.angle));
    table.rows.push_back(row);
    const std::string name = choice.name;
    if (name.starts_with("rolling") || name.starts_with("the paper")) {
      commercial = std::max(commercial, d.force);
      rolling_angle = std::max(rolling_angle, d.angle);
    }
    if (name.starts_with("journal")) journal = std::max(journal, d.force);
    if (name.starts_with("rubber")) rubber = std::max(rubber, d.force);
  }
  item.text = {"Stiffness and damping are the paper's ranges (section 4); it gives none for rubber, so two values are assumed. Every pin has the same bearing."};
  item.claims = {{"8", "k and c of commercial bearings: forces as with ideal ones to 4 significant figures (rolling elements)",
                  fmt::format("worst pin {:.1e} of its peak: {:.1f} digits", commercial, digits(commercial)), verdict(commercial < kFourFigures)},
                 {"8", "the same, lubricated journal bearings", fmt::format("worst pin {:.1e} of its peak at k = 1e7, the softest: {:.1f} digits; see the table", journal, digits(journal)),
                  journal < kFourFigures ? Verdict::kHolds : Verdict::kPartly},
                 {"8", "displacements and velocities agree even closer", fmt::format("angles to {:.1e} rad (rolling elements)", rolling_angle),
                  verdict(rolling_angle < commercial)},
                 {"8", "with rubber-mounted bearings the joint forces vary substantially", fmt::format("by {:.0f} % of the peak at k = 1e5 N/m", 100 * rubber),
                  verdict(rubber > 0.05)}};
  item.tables = {table};
  return item;
}

Item make_procedure() {
  Item item{"stiffness", "Section 8: unknown stiffness", {}, {}, {}, {}, {}};
  item.text = {"c = 500 N s/m, k tenfold from 1e6 N/m (1e5 when only the motion matters) until the digits agree. The change is that of the "
               "largest O4 force over a turn."};
  Table table{"Each k compared with the previous one and with ideal joints",
              {"k [N/m]", "largest F14 [N]", "change", "forces minus ideal, of peak", "angles minus ideal [rad]", "steps of all passes"},
              {}};
  double before = NAN, angle_soft = 0, at_1e6 = 0, at_1e8 = 0;
  std::uint64_t most = 0, least = ~0ULL;
  for (const double k : {1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12}) {
    const Trajectory r = run(four_bar({k, 500}, 60), true);
    const FromIdeal d = from_ideal(r, 60);
    const double peak = r.joints.back().peak;
    table.rows.push_back({short_number(k), fmt::format("{:.5f}", peak), std::isfinite(before) ? fmt::format("{:.1e}", std::abs(peak - before) / peak) : "-",
                          fmt::format("{:.1e}", d.force), fmt::format("{:.1e}", d.angle), fmt::format("{}", r.counters.steps)});
    before = peak;
    if (k == 1e5) angle_soft = d.angle;
    if (k == 1e6) at_1e6 = d.force;
    if (k == 1e8) at_1e8 = d.force;
    if (k > 1e6) {
      most = std::max(most, r.counters.steps);
      least = std::min(least, r.counters.steps);
    }
  }
  item.claims = {{"8", "raising k tenfold brings the results together", fmt::format("forces {:.1e} of the peak from ideal at 1e6, {:.1e} at 1e8", at_1e6, at_1e8),
                  verdict(at_1e8 < 0.05 * at_1e6)},
                 {"8", "for the motion alone k = 1e5 N/m is enough to start from", fmt::format("angles to {:.1e} rad", angle_soft), verdict(angle_soft < 1e-2)},
                 {"8", "above 1e6 N/m the step must be limited", fmt::format("not here: {} to {} steps from 1e7 to 1e12 N/m", least, most), Verdict::kPartly}};
  item.tables = {table};
  return item;
}

}  // namespace pintle::paper
