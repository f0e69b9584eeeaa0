#include "pintle/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "integrators/thresholds.h"
#include "joints/catalog.h"
#include "laws/least_stated.h"
#include "start/start.h"

namespace pintle {
namespace {

constexpr double kBeyond = 2;         // as a multiple of the error estimates: larger differences are physical
constexpr double kSameMotion = 0.01;  // fraction of its range by which a coordinate may differ between two runs of one motion: what joints of usual stiffness yield
constexpr int kMostDigits = 15;

// The columns of one quantity: components whose differences are combined.
struct Quantity {
  std::string name, unit;
  std::vector<std::pair<std::size_t, std::size_t>> columns;  // in the first and the second run
};

bool add_column(const Comparison& c, const std::string& name, Quantity& quantity) {
  const int a = c.first.column(name), b = c.second.column(name);
  if (a < 0 || b < 0) return false;
  quantity.columns.emplace_back(a, b);
  quantity.unit = c.first.columns[static_cast<std::size_t>(a)].unit;
  return true;
}

// The time up to which forces are valid [s].
double horizon_of(const Trajectory& run) { return run.outcome == Outcome::kHorizon ? run.growth.horizon : std::numeric_limits<double>::infinity(); }

// Pairs of rows of both runs at the same time, up to `until`.
std::vector<std::pair<std::size_t, std::size_t>> common_rows(const Trajectory& a, const Trajectory& b, double until) {
  std::vector<std::pair<std::size_t, std::size_t>> rows;
  for (std::size_t i = 0, j = 0; i < a.n_rows() && j < b.n_rows();) {
    const double ta = a.at(i, 0), tb = b.at(j, 0), close = 1e-12 * std::max(std::abs(ta), std::abs(tb));
    if (ta > until) break;
    if (std::abs(ta - tb) <= close) rows.emplace_back(i++, j++);
    else if (ta < tb) ++i;
    else ++j;
  }
  return rows;
}

Difference measure(const Comparison& c, const Quantity& quantity, const std::vector<std::pair<std::size_t, std::size_t>>& rows) {
  Difference d;
  d.name = quantity.name;
  d.unit = quantity.unit;
  double square = 0;
  for (const auto& [i, j] : rows) {
    double size = 0, gap = 0;
    for (const auto& [a, b] : quantity.columns) {
      size = std::hypot(size, c.second.at(j, b));
      gap = std::hypot(gap, c.first.at(i, a) - c.second.at(j, b));
    }
    d.peak = std::max(d.peak, size);
    square += gap * gap;
    if (gap > d.largest) {
      d.largest = gap;
      d.largest_time = c.first.at(i, 0);
    }
  }
  d.rms = rows.empty() ? 0 : std::sqrt(square / static_cast<double>(rows.size()));
  return d;
}

// Relative to the peak; for negligible quantities, to `part` of the largest with the same unit; if the second run has none of it at all, to the
// difference.
void relate(std::vector<Difference>& list, double part) {
  std::map<std::string, double> largest;
  for (const Difference& d : list) largest[d.unit] = std::max(largest[d.unit], d.peak);
  for (Difference& d : list) {
    const double base = largest[d.unit] > 0 ? d.peak > kNegligible * largest[d.unit] ? d.peak : part * largest[d.unit] : std::max(d.largest, 1e-300);
    d.relative = d.largest / base;
    d.relative_rms = d.rms / base;
    d.digits = agreeing_digits(d.relative);
  }
}

Cause cause_of(double difference, double error_estimate, const LoadSummary& a, const LoadSummary& b) {
  if (difference <= kBeyond * error_estimate) return Cause::kNumerical;
  if (!a.unique || !b.unique) return Cause::kNotUnique;
  return std::isnan(error_estimate) ? Cause::kNoEstimate : Cause::kPhysical;
}

// `error`: of a force or of a couple.
void judge(const LoadSummary& a, const LoadSummary& b, double LoadSummary::*error, Difference& d) {
  d.error_estimate = a.*error + b.*error;
  d.cause = cause_of(d.largest, d.error_estimate, a, b);
}

void add_joints(Comparison& c, const std::vector<std::pair<std::size_t, std::size_t>>& rows) {
  for (std::size_t j = 0; j < std::min(c.first.joints.size(), c.second.joints.size()); ++j) {
    const LoadSummary &a = c.first.joints[j], &b = c.second.joints[j];
    const std::string path = "joint." + a.name + ".on_" + a.second_body + ".";
    Quantity force{a.name, "", {}}, couple{a.name, "", {}};
    if (add_column(c, path + "fx[world]", force) && add_column(c, path + "fy[world]", force)) {
      c.forces.push_back(measure(c, force, rows));
      if (std::isinf(c.until)) c.forces.back().peak = std::max(c.forces.back().peak, b.peak);
      judge(a, b, &LoadSummary::error_estimate, c.forces.back());
    }
    if (a.has_moment && add_column(c, path + "m[world]", couple)) {
      c.couples.push_back(measure(c, couple, rows));
      if (std::isinf(c.until)) c.couples.back().peak = std::max(c.couples.back().peak, b.peak_moment);
      judge(a, b, &LoadSummary::moment_error_estimate, c.couples.back());
    }
  }
  relate(c.forces, kNegligible);
  relate(c.couples, kNegligible);
}

void add_coordinates(Comparison& c, const std::vector<std::pair<std::size_t, std::size_t>>& rows) {
  const auto is_coordinate = [](const std::string& name) {
    const auto dot = name.rfind('.');
    const std::string word = dot == std::string::npos ? "" : name.substr(dot + 1);
    const bool of_body = name.starts_with("body.") && (word == "x" || word == "y" || word == "angle");
    return of_body || (name.starts_with("joint.") && (word == "angle" || word == "slide"));
  };
  for (const Column& column : c.first.columns) {
    Quantity quantity{column.name, "", {}};
    if (is_coordinate(column.name) && add_column(c, column.name, quantity)) c.coordinates.push_back(measure(c, quantity, rows));
  }
  relate(c.coordinates, 1);  // the scale of coordinates at rest is the largest moving one
}

// Where the runs move differently, as where one of them has no friction, loads differ for that reason, whatever ideal joints leave undetermined.
void judge_by_motion(Comparison& c) {
  if (std::none_of(c.coordinates.begin(), c.coordinates.end(), [](const Difference& d) { return d.relative > kSameMotion; })) return;
  for (std::vector<Difference>* list : {&c.forces, &c.couples})
    for (Difference& d : *list)
      if (d.cause == Cause::kNotUnique) d.cause = Cause::kPhysical;
}

void find_softness(const Model& model, Comparison& c) {
  double all = 0;
  for (const Joint& joint : model.joints) {
    const auto load = std::find_if(c.first.joints.begin(), c.first.joints.end(), [&](const LoadSummary& l) { return l.name == joint.name; });
    if (load == c.first.joints.end() || joint.law.word != "linear" || find_joint_type(joint.type)->gap.empty()) continue;
    double energy = load->peak * load->peak / (2 * least_value(joint.law, "stiffness"));
    if (load->has_moment) energy += load->peak_moment * load->peak_moment / (2 * least_value(joint.law, "angular_stiffness"));
    all += energy;
    c.softness.push_back({joint.name, energy});
  }
  for (Softness& s : c.softness) s.share = all > 0 ? s.share / all : 0;
  std::stable_sort(c.softness.begin(), c.softness.end(), [](const Softness& a, const Softness& b) { return a.share > b.share; });
}

VariantLoad variant_load(const LoadSummary& load, const LoadSummary* base) {
  VariantLoad out{true, load};
  const LoadSummary none;
  const LoadSummary& from = base == nullptr ? none : *base;
  // A value that does not exceed its own error is no basis for a relative change.
  const auto change = [&from](double x, double of) { return of > from.error_estimate ? (x - of) / of : std::numeric_limits<double>::quiet_NaN(); };
  out.peak_change = change(load.peak, from.peak);
  out.mean_change = change(load.mean, from.mean);
  out.rms_change = change(load.rms, from.rms);
  const auto is_late = [](const LoadSummary& one) { return one.peak_time > one.horizon; };
  if (base != nullptr) out.cause = is_late(load) || is_late(*base) ? Cause::kChaotic : cause_of(std::abs(load.peak - base->peak), load.error_estimate + base->error_estimate, load, *base);
  return out;
}

// Ideal joints have no settled start: they are assembled where the compliant mechanism rests.
void start_where_it_settles(const Model& model, Model& other) {
  const Assembly rest = start_of_run(model);
  other.simulate.start = Start::kAssembled;
  for (std::size_t i = 0; i < other.bodies.size(); ++i) {
    other.bodies[i].position = Vec2{rest.state.q[i][0], rest.state.q[i][1]};
    other.bodies[i].angle = rest.state.q[i][2];
  }
}

}  // namespace

Variants compare(std::vector<NamedRun> runs) {
  Variants out;
  std::map<std::string, std::size_t> places;
  for (const NamedRun& one : runs)
    for (const LoadSummary& load : one.run.joints)
      if (places.emplace(load.name, out.joints.size()).second) out.joints.push_back({load.name, std::vector<VariantLoad>(runs.size())});
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (const LoadSummary& load : runs[i].run.joints) {
      std::vector<VariantLoad>& loads = out.joints[places.at(load.name)].loads;
      const VariantLoad& base = loads.front();
      loads[i] = variant_load(load, i == 0 ? &load : base.there ? &base.load : nullptr);
    }
  out.runs = std::move(runs);
  return out;
}

int agreeing_digits(double relative_difference) {
  if (!(relative_difference < 0.5)) return 0;
  const double digits = -std::log10(2 * std::max(relative_difference, 1e-300));
  return std::clamp(static_cast<int>(std::floor(digits + 1e-12)), 0, kMostDigits);
}

Comparison compare(const Model& model, Trajectory first, Trajectory second, Equations against) {
  Comparison c;
  c.first = std::move(first);
  c.second = std::move(second);
  c.against = against;
  c.until = std::min(horizon_of(c.first), horizon_of(c.second));
  const auto rows = common_rows(c.first, c.second, c.until);
  add_joints(c, rows);
  add_coordinates(c, rows);
  judge_by_motion(c);
  find_softness(model, c);
  return c;
}

Comparison compare(const Model& model, Equations against, const Observer& observer) {
  Model compliant = model, other = model;
  compliant.simulate.record = other.simulate.record = {"all"};
  compliant.simulate.equations = Equations::kNewtonian;
  other.simulate.equations = against;
  other.simulate.method = "auto";
  if (model.simulate.start == Start::kSeated && has_constraints(against)) other.simulate.start = Start::kAssembled;  // without play
  if (model.simulate.start == Start::kSettled) start_where_it_settles(model, other);
  Trajectory first = simulate(compliant, observer);
  if (first.outcome == Outcome::kInterrupted) return compare(model, first, first, against);
  Trajectory second = simulate(other, observer);
  return compare(model, std::move(first), std::move(second), against);
}

}  // namespace pintle
