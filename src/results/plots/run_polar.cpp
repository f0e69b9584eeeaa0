#include "results/plots/run_polar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "results/plots/plot_ticks.h"
#include "results/text_table.h"

namespace pintle {
namespace {

const LoadSummary& find_pin(const Trajectory& run, const std::string& name) {
  const LoadSummary& joint = find_joint(run, name);
  if (joint.type == "revolute") return joint;
  throw PlotRequestError(fmt::format("found joint \"{}\" of type {}: polar load diagrams are of pins.\n    Choose a revolute joint, or plot --joint {}.", name, joint.type, name));
}

// Transforms a vector along the axes of the first marker to those of the second, which are rotated by the joint's angle. theory/bearing_life Eq. (4.1)
PolarCurve in_axes_of_second(const std::string& label, const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& angle) {
  PolarCurve curve{label, {}, {}};
  for (std::size_t i = 0; i < angle.size(); ++i) {
    const double c = std::cos(angle[i]), s = std::sin(angle[i]);
    curve.x.push_back(c * x[i] + s * y[i]);
    curve.y.push_back(-s * x[i] + c * y[i]);
  }
  return curve;
}

void add_curves(const Trajectory& run, const LoadSummary& joint, const std::string& label, PolarPlot& plot) {
  const std::string path = "joint." + joint.name + ".", on = path + "on_" + joint.second_body + ".";
  const auto column = [&run](const std::string& name) { return values_of(run, find_column(run, name)); };
  plot.panels[0].curves.push_back({label, column(on + "fx[world]"), column(on + "fy[world]")});
  const std::vector<double> f1 = column(on + "f1[joint]"), f2 = column(on + "f2[joint]");
  PolarCurve first{label, {}, {}};
  for (std::size_t i = 0; i < f1.size(); ++i) {
    first.x.push_back(-f1[i]);
    first.y.push_back(-f2[i]);
  }
  plot.panels[1].curves.push_back(std::move(first));
  plot.panels[2].curves.push_back(in_axes_of_second(label, f1, f2, column(path + "angle")));
}

// From what the law reports of the pin's distance: its penetration beyond the clearance, or its eccentricity as a fraction of it. 0: nothing reported.
double radial_clearance(const Trajectory& run, const std::string& path) {
  const auto column = [&](const char* name) { return run.column(path + name); };
  const int x = column("pin_x"), y = column("pin_y"), beyond = column("penetration"), share = column("eccentricity");
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    const auto at = [&run, i](int c) { return run.at(i, static_cast<std::size_t>(c)); };
    const double distance = std::hypot(at(x), at(y));
    if (beyond >= 0) return distance - at(beyond);
    if (share >= 0 && at(share) > 0.01) return distance / at(share);
  }
  return 0;
}

const JointWear& find_wear(const Trajectory& run, const LoadSummary& joint) {
  const auto found = std::find_if(run.wear.begin(), run.wear.end(), [&joint](const JointWear& one) { return one.joint == joint.name; });
  if (found != run.wear.end()) return *found;
  throw PlotRequestError(fmt::format("joint \"{}\" has no wear: only pins with law = \"clearance\" record it.\n    Choose another joint; runs of older versions have no wear, so run their models again.", joint.name));
}

// Sectors as arcs about the centre.
PolarCurve around(const std::string& label, const std::vector<double>& sectors) {
  constexpr int kPerSector = 6;  // even: one is in the middle
  PolarCurve curve{label, {}, {}};
  const double width = 2 * std::numbers::pi / static_cast<double>(sectors.size());
  for (std::size_t i = 0; i <= sectors.size(); ++i)
    for (int k = 0; k <= kPerSector && (i < sectors.size() || k == 0); ++k) {
      const double radius = sectors[i % sectors.size()], angle = width * (static_cast<double>(i) + static_cast<double>(k) / kPerSector);
      curve.x.push_back(radius * std::cos(angle));
      curve.y.push_back(radius * std::sin(angle));
    }
  return curve;
}

}  // namespace

PolarPlot make_wear_plot(const std::vector<PolarRun>& runs, const std::string& joint) {
  const RunRecord& leading = *runs.front().run;
  const LoadSummary& pin = find_pin(leading.trajectory, joint);
  PolarPlot plot;
  plot.title = fmt::format("Joint {}: wear of bush and pin", joint);
  plot.subtitle = fmt::format("{}normal force times way of slip, per {:g} deg", leading.stamp.model_name.empty() ? "" : leading.stamp.model_name + " – ",
                              360.0 / static_cast<double>(find_wear(leading.trajectory, pin).bush.size()));
  plot.unit = "J";
  plot.panels = {{"Bush on " + pin.first_body, "axes of its marker", {}}, {"Pin on " + pin.second_body, "axes of its marker", {}}};
  for (const PolarRun& one : runs) {
    const JointWear& wear = find_wear(one.run->trajectory, find_pin(one.run->trajectory, joint));
    const std::string label = runs.size() == 1 ? "" : one.name;
    plot.panels[0].curves.push_back(around(label, wear.bush));
    plot.panels[1].curves.push_back(around(label, wear.pin));
  }
  return plot;
}

bool has_orbit(const Trajectory& run, const std::string& joint) { return run.column("joint." + joint + ".pin_x") >= 0; }

PolarPlot make_orbit_plot(const std::vector<PolarRun>& runs, const std::string& joint) {
  const RunRecord& leading = *runs.front().run;
  const LoadSummary& pin = find_pin(leading.trajectory, joint);
  PolarPlot plot;
  plot.title = fmt::format("Joint {}: orbit of the pin in its bush", joint);
  plot.subtitle = leading.stamp.model_name.empty() ? leading.stamp.model_path : leading.stamp.model_name;
  plot.unit = "m";
  plot.panels = {{"Pin on " + pin.second_body, "axes of the bush's marker on " + pin.first_body, {}}, {"Pin on " + pin.second_body, "axes of its own marker", {}}};
  for (const PolarRun& one : runs) {
    const Trajectory& run = one.run->trajectory;
    find_pin(run, joint);
    if (!has_orbit(run, joint))
      throw PlotRequestError(fmt::format("joint \"{}\" has no orbit: only pins that are not held by springs record one, such as those with law = \"clearance\".\n    Choose another joint; runs of older versions have no orbits, so run their models again.", joint));
    const std::string path = "joint." + joint + ".", label = runs.size() == 1 ? "" : one.name;
    const auto column = [&](const char* name) { return values_of(run, find_column(run, path + name)); };
    const std::vector<double> x = column("pin_x"), y = column("pin_y");
    if (&one == &runs.front()) plot.panels[0].limit = plot.panels[1].limit = radial_clearance(run, path);
    plot.panels[0].curves.push_back({label, x, y});
    plot.panels[1].curves.push_back(in_axes_of_second(label, x, y, column("angle")));
  }
  return plot;
}

PolarPlot make_polar_plot(const std::vector<PolarRun>& runs, const std::string& joint) {
  constexpr double kPrinted = 1 - 1e-4;  // fraction of the peak: the picture states it with five digits
  const RunRecord& leading = *runs.front().run;
  const LoadSummary& pin = find_pin(leading.trajectory, joint);
  PolarPlot plot;
  plot.title = fmt::format("Joint {}: polar load diagrams", joint);
  plot.subtitle = leading.stamp.model_name.empty() ? leading.stamp.model_path : leading.stamp.model_name;
  if (runs.size() == 1 && pin.relative_error_estimate > 0)
    plot.subtitle += fmt::format("{}estimated error {} of the peak", plot.subtitle.empty() ? "" : " – ", printed_number(exponent(pin.relative_error_estimate)));
  if (const std::string more = peak_between_rows(leading.trajectory, pin, kPrinted); !more.empty()) plot.subtitle += (plot.subtitle.empty() ? "" : " – ") + more;
  plot.unit = "N";
  plot.panels = {{"Force on " + pin.second_body, "world axes", {}},
                 {"Force on " + pin.first_body, "axes of its marker on " + pin.first_body, {}},
                 {"Force on " + pin.second_body, "axes of its marker on " + pin.second_body, {}}};
  for (const PolarRun& one : runs) {
    const Trajectory& run = one.run->trajectory;
    add_curves(run, find_pin(run, joint), runs.size() == 1 ? "" : one.name, plot);
  }
  return plot;
}

}  // namespace pintle
