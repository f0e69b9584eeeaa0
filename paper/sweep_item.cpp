// Section 10: k from 1e4 to 1e12 N/m and c from none to 1e5 N s/m on the four-bar. Where flexibility begins to show, and where
// parasitic vibration.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper/four_bar_runs.h"
#include "paper/items.h"

namespace pintle::paper {
namespace {

constexpr double kTolerance = 1e-5;
constexpr double kVisible = 0.01;  // of a pin's peak: a line's width in a plot
const std::vector<double> kStiffness{1e4, 3e4, 1e5, 3e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12};
const std::vector<double> kDamping{0, 3, 30, 300, 3e3, 3e4, 1e5};

// Worst pin over the second half of a turn, from pins that carry their load or from unstretched ones.
double late_error(const Bearing& bearing, Start start) {
  Model model = four_bar(bearing, 60);
  model.simulate.start = start;
  model.simulate.output_step = model.simulate.duration / 1440;
  const SingleRun r = run_once(model, "radau", kTolerance, 0);
  if (!r.completed) return NAN;
  return from_ideal(r.trajectory, 60, 0.5 * model.simulate.duration).force;
}

Table table_of(const std::string& title, const std::vector<double>& stiffness, const std::vector<std::vector<double>>& errors) {
  Table table{title, {"k \\ c [N s/m]"}, {}};
  for (const double c : kDamping) table.head.push_back(short_number(c));
  for (std::size_t i = 0; i < stiffness.size(); ++i) {
    std::vector<std::string> row{short_number(stiffness[i])};
    for (const double error : errors[i]) {
      const std::string text = std::isfinite(error) ? fmt::format("{:.0e}", error) : "-";
      row.push_back(error > kVisible ? "**" + text + "**" : text);
    }
    table.rows.push_back(row);
  }
  return table;
}

Plot picture_of(const std::string& title, const std::vector<double>& stiffness, const std::vector<std::vector<double>>& errors) {
  Plot plot;
  plot.title = title;
  plot.subtitle = "four-bar of section 8, second half of a turn, worst pin over its peak";
  plot.x_quantity = "stiffness k";
  plot.x_unit = "N/m";
  plot.x = stiffness;
  plot.log_x = true;
  Panel panel{"joint forces minus ideal", "", {}, true};
  for (std::size_t j = 0; j < kDamping.size(); ++j) {
    Curve curve{"c = " + short_number(kDamping[j]), "", {}};
    for (const auto& row : errors) curve.y.push_back(row[j]);
    panel.curves.push_back(curve);
  }
  plot.panels = {panel};
  plot.panel_height = 380;
  return plot;
}

std::vector<std::vector<double>> sweep(const std::vector<double>& stiffness, Start start) {
  std::vector<std::vector<double>> errors;
  for (const double k : stiffness) {
    errors.emplace_back();
    for (const double c : kDamping) errors.back().push_back(late_error({k, c}, start));
  }
  return errors;
}

double at(const std::vector<double>& stiffness, const std::vector<std::vector<double>>& errors, double k, double c) {
  const auto i = std::find(stiffness.begin(), stiffness.end(), k) - stiffness.begin();
  const auto j = std::find(kDamping.begin(), kDamping.end(), c) - kDamping.begin();
  return errors[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
}

// Largest change of the result by c within a bearing's range.
double spread(const std::vector<std::vector<double>>& errors, std::size_t row) {
  const std::vector<double>& e = errors[row];
  return std::max({e[3], e[4], e[5]});
}

}  // namespace

Item make_sweep() {
  Item item{"sweep", "Section 10: sweep of stiffness and damping", {}, {}, {}, {}, {}};
  const std::vector<double> shaken(kStiffness.begin(), kStiffness.begin() + 7);  // to 1e8 N/m
  const auto loaded = sweep(kStiffness, Start::kAssembled), unstretched = sweep(shaken, Start::kUnloaded);
  item.text = {
      "The error is that of the worst pin, over its ideal peak, in the second half of a turn; bold: above 1 %, visible in a plot. With loaded pins "
      "nothing excites the mechanism, and the error comes from flexibility alone. With unstretched pins the missing load rings until damping has "
      "removed it, for a time proportional to 1/c: some tens of degrees of crank rotation at c = 3000, about a turn at 300, many turns below. So "
      "vibration appears at a tenth of a bearing's damping if the start excites it, and not at all otherwise."};
  item.claims = {
      {"10", "k from 1e5 to 1e6 N/m gives results similar to higher k", fmt::format("c = 3000: {:.1e} of the peak at 1e5, {:.1e} at 1e6",
       at(kStiffness, loaded, 1e5, 3e3), at(kStiffness, loaded, 1e6, 3e3)),
       at(kStiffness, loaded, 1e6, 3e3) > kVisible   ? Verdict::kFails
       : at(kStiffness, loaded, 1e5, 3e3) > kVisible ? Verdict::kPartly
                                                     : Verdict::kHolds},
      {"10", "below 1e5 N/m joint flexibility starts to be noticeable", fmt::format("c = 3000: {:.1e} of the peak at 1e5, {:.1e} at 3e4, {:.1e} at 1e4",
       at(kStiffness, loaded, 1e5, 3e3), at(kStiffness, loaded, 3e4, 3e3), at(kStiffness, loaded, 1e4, 3e3)),
       verdict(at(kStiffness, loaded, 1e4, 3e3) > kVisible && at(kStiffness, loaded, 1e6, 3e3) < kVisible)},
      {"10", "c within a reasonable range has no effect on the results", fmt::format("k = 1e8, c = 300 to 3e4: at most {:.1e} of the peak from ideal",
       spread(loaded, 6)), verdict(spread(loaded, 6) < 5e-4)},
      {"10", "c below a thousandth of a bearing's: parasitic vibration appears", fmt::format("k = 1e8, unstretched: {:.1e} of the peak at c = 3, {:.1e} at 30, {:.1e} at 300, {:.1e} at 3000; with loaded pins none at any c",
       at(shaken, unstretched, 1e8, 3), at(shaken, unstretched, 1e8, 30), at(shaken, unstretched, 1e8, 300), at(shaken, unstretched, 1e8, 3e3)),
       at(shaken, unstretched, 1e8, 3) < kVisible ? Verdict::kFails : at(shaken, unstretched, 1e8, 30) > kVisible ? Verdict::kPartly : Verdict::kHolds}};
  item.pictures = {{"sweep-loaded.svg", "With loaded pins: flexibility only.", picture_of("Sweep: loaded pins at the start", kStiffness, loaded)},
                   {"sweep-unstretched.svg", "With unstretched pins: flexibility and ringing.",
                    picture_of("Sweep: unstretched pins at the start", shaken, unstretched)}};
  item.tables = {table_of("With loaded pins", kStiffness, loaded), table_of("With unstretched pins", shaken, unstretched)};
  return item;
}

}  // namespace pintle::paper
