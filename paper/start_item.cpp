// Section 8: the crank turns while coupler and follower rest. How long the forces remember it, by the damping.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper/four_bar_runs.h"
#include "paper/items.h"

namespace pintle::paper {
namespace {

constexpr double kFew = 10;     // "a few degrees", generously
constexpr double kLimit = 0.01;  // force error over the pin's ideal peak

Model inconsistent(const Bearing& bearing) {
  Model model = four_bar(bearing, 60);
  for (Body& body : model.bodies) {
    if (body.name == "crank") continue;
    body.velocity = Vec2{0, 0};
    body.spin = 0;
  }
  model.simulate.start = Start::kRaw;
  model.simulate.output_step = model.simulate.duration / 3600;
  return model;
}

struct Decay {
  std::vector<double> degrees, error;
  double first = 0, settled = 0, last = 0;  // error at the start; degrees until 1 %; largest error in the last 10 degrees
  double speed = 0, shock = 0;              // of the crank in the end [rad/s]; largest joint force [N]
};

Decay decay_of(const Bearing& bearing) {
  const Trajectory r = run(inconsistent(bearing), true);
  Decay d;
  const std::vector<double> crank = column(r, "body.crank.angle");
  for (std::size_t row = 0; row < r.n_rows(); ++row) {
    d.degrees.push_back((crank[row] - crank[0]) / kDegree);
    d.error.push_back(force_error(r, row, 60));
    if (d.error.back() >= kLimit) d.settled = d.degrees.back();
    if (d.degrees.back() > 350) d.last = std::max(d.last, d.error.back());
  }
  d.first = largest(d.error);
  d.speed = column(r, "body.crank.spin").back();
  for (const LoadSummary& joint : r.joints) d.shock = std::max(d.shock, joint.peak);
  return d;
}

// The largest in each degree, so that a curve shows the envelope of a vibration.
std::vector<double> envelope(const Decay& d) {
  std::vector<double> out(360, NAN);
  for (std::size_t i = 0; i < d.error.size(); ++i) {
    const auto degree = static_cast<std::size_t>(std::max(0.0, d.degrees[i]));
    if (degree < out.size() && !(out[degree] > d.error[i])) out[degree] = d.error[i];
  }
  return out;
}

}  // namespace

Item make_start() {
  Item item{"start", "Section 8: an inconsistent start", {}, {}, {}, {}, {}};
  item.text = {
      "The crank starts at 60° with 10 rad/s, coupler and follower at rest, k = 1e8 N/m in every pin. The error is that of the worst pin's force "
      "relative to ideal joints at the same crank angle, over that pin's peak; settled means below 1 % from then on."};
  const double dampings[] = {0, 500, 2e3, 3e3, 1e4, 1e5, 5e5};
  Table table{"Crank rotation until every joint force is within 1 %",
              {"c [N s/m]", "largest force [N]", "error at first", "settled after [deg]", "error in the last 10 deg", "crank in the end [rad/s]"},
              {}};
  Plot plot;
  plot.title = "Inconsistent start: decay of the force error";
  plot.subtitle = "worst pin, over its peak, the largest in each degree; four-bar of section 8, k = 1e8 N/m";
  plot.x_quantity = "crank angle since the start";
  plot.x_unit = "deg";
  for (int i = 0; i < 360; ++i) plot.x.push_back(i);
  Panel panel{"force error", "", {}, true};
  double undamped = 0, lightest = 0, rolling = 0;
  for (const double c : dampings) {
    const Decay d = decay_of({1e8, c});
    const bool never = d.settled > 350;
    table.rows.push_back({short_number(c), fmt::format("{:.3g}", d.shock), fmt::format("{:.0f}", d.first),
                          never ? "not within the turn" : fmt::format("{:.1f}", d.settled), fmt::format("{:.1e}", d.last), fmt::format("{:.5f}", d.speed)});
    panel.curves.push_back({"c = " + short_number(c), "", envelope(d)});
    if (c == 0) undamped = d.last;
    if (c == 2e3) lightest = d.settled;
    if (c == 1e4) rolling = d.settled;
  }
  plot.panels = {panel};
  plot.panel_height = 380;
  item.claims = {{"8", "c = 0: the start induces vibrations that are significant beside the solution",
                  fmt::format("still {:.0f} times the peak force after a full turn", undamped), verdict(undamped > 0.1)},
                 {"8", "the most lightly damped real bearing (c = 2e3): only the desired solution after a few degrees of crank",
                  fmt::format("within 1 % after {:.1f} degrees", lightest), verdict(lightest < kFew)},
                 {"8", "the same with the most damped rolling bearing (c = 1e4)", fmt::format("within 1 % after {:.1f} degrees", rolling),
                  verdict(rolling < kFew)}};
  item.pictures = {{"start.svg", "The decay rate is proportional to c up to critical damping; beyond it the decay is slower again.", plot}};
  item.tables = {table};
  return item;
}

}  // namespace pintle::paper
