// Section 7's comparison of solvers on the pendulum, with the paper's damping and with none.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "paper/ideal.h"
#include "paper/items.h"
#include "paper/runs.h"

namespace pintle::paper {
namespace {

constexpr double kRelative = 1e-5;     // tolerance, as the paper's
constexpr double kSample = 2.5e-5;     // between outputs: the pin's fastest vibration has a period of 2.2e-4 s
constexpr double kWindow = 2e-3;       // in which a cubic is taken off
constexpr double kSettled = 0.05;      // a start's shock at c = 3500 is over [s]
constexpr double kPeak = 2.5 * 9.81;   // [N]

struct Measured {
  double error = NAN;   // largest |F - F ideal| after kSettled [N]
  double ripple = NAN;  // peak to peak of what is faster than kWindow, after 0.5 s [N]
  std::uint64_t steps = 0;
  std::string trouble;
};

// Takes the least-squares cubic off y and returns what is left, peak to peak.
double ripple_of(const double* y, int n) {
  Eigen::MatrixXd powers(n, 4);
  for (int i = 0; i < n; ++i) {
    const double x = 2.0 * i / (n - 1) - 1;
    powers.row(i) << 1, x, x * x, x * x * x;
  }
  const Eigen::Map<const Eigen::VectorXd> values(y, n);
  const Eigen::VectorXd left = values - powers * powers.householderQr().solve(values);
  return left.maxCoeff() - left.minCoeff();
}

double largest_ripple(const std::vector<double>& y) {
  const int n = static_cast<int>(kWindow / kSample);
  double ripple = 0;
  for (std::size_t i = static_cast<std::size_t>(0.5 / kSample); i + n < y.size(); i += 10 * n)
    ripple = std::max(ripple, ripple_of(&y[i], n));
  return ripple;
}

std::optional<Measured> measure(const std::string& method, double c, Start start, double max_step) {
  Model model = mechanism("pendulum");
  set_bearings(model, {2e8, c});
  model.simulate.start = start;
  model.simulate.output_step = kSample;
  Measured out;
  try {
    const SingleRun r = run_once(model, method, kRelative, max_step);
    out.steps = r.trajectory.counters.steps;
    if (!r.completed) {
      out.trouble = r.message;
      return out;
    }
    std::vector<double> t = column(r.trajectory, "t"), fx = column(r.trajectory, "joint.pin.on_rod.fx[world]"),
                        fy = column(r.trajectory, "joint.pin.on_rod.fy[world]");
    out.error = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const IdealPendulum exact = ideal_pendulum(t[i]);
      fx[i] -= exact.fx;
      fy[i] -= exact.fy;
      if (t[i] > kSettled) out.error = std::max(out.error, std::hypot(fx[i], fy[i]));
    }
    out.ripple = std::max(largest_ripple(fx), largest_ripple(fy));
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
  return out;
}

std::string number(double x) {
  return std::isfinite(x) ? fmt::format("{:.1e}", x) : "-";
}

struct Case {
  double c;
  Start start;
  double max_step;
};
const std::vector<Case> kExplicit{{3500, Start::kAssembled, 0},
                                  {3500, Start::kAssembled, 1e-5},
                                  {0, Start::kAssembled, 0},
                                  {0, Start::kAssembled, 1e-5},
                                  {0, Start::kUnloaded, 1e-5}};
const std::vector<Case> kImplicit{{3500, Start::kAssembled, 0}, {0, Start::kAssembled, 0}, {0, Start::kAssembled, 1e-5}};

class Study {
 public:
  explicit Study(Item& item) : item_(item) {}

  // All cases of one method; empty if there is no such method.
  std::vector<Measured> measure_all(const std::string& method, const std::vector<Case>& cases) {
    std::vector<Measured> all;
    for (const Case& at : cases) {
      const std::optional<Measured> m = measure(method, at.c, at.start, at.max_step);
      if (!m) {
        item_.waiting.push_back(fmt::format("the method `{}`", method));
        return {};
      }
      table_.rows.push_back({method, short_number(at.c), at.start == Start::kAssembled ? "loaded" : "unstretched",
                             at.max_step > 0 ? short_number(at.max_step) : "none", number(m->error),
                             number(m->error / kPeak), number(m->ripple),
                             m->trouble.empty() ? fmt::format("{}", m->steps) : m->trouble});
      all.push_back(*m);
    }
    return all;
  }

  void claim(const std::string& text, const Measured& m, bool holds) { claim(text, m, verdict(holds)); }
  void claim(const std::string& text, const Measured& m, Verdict found) {
    item_.claims.push_back({"7", text,
                            m.trouble.empty() ? fmt::format("error {} of the peak, ripple {} N", number(m.error / kPeak), number(m.ripple))
                                              : m.trouble,
                            found});
  }

  void finish() { item_.tables.push_back(std::move(table_)); }

 private:
  Item& item_;
  Table table_{"2 s at a relative tolerance of 1e-5. Error: of the joint force relative to the ideal pin after 0.05 s (1.7e-5 N of it is the pin's "
               "own compliance). Ripple: peak to peak of the force in 2 ms after subtracting a cubic",
               {"method", "c", "pin at start", "largest step [s]", "error [N]", "of the peak", "ripple [N]", "steps"},
               {}};
};

}  // namespace

Item make_solvers() {
  Item item{"solvers", "Section 7: the solvers", {}, {}, {}, {}, {}};
  item.text = {
      "`ode45`, `ode23t`, `ode15s` and `ode113` are this program's methods of those names; MATLAB's own may differ in step control. `radau` and "
      "`dopri5` control the error of the joint force, the others that of the state. The claims at c = 0 are tested with a pin preloaded at the "
      "start: with an unstretched one the missing 2.45 N oscillate forever, and only numerical damping can remove them."};
  Study study(item);
  if (const auto m = study.measure_all("ode45", kExplicit); !m.empty()) {
    study.claim("ode45, c = 3500, steps of 1e-5 s: accurate to six figures", m[1], m[1].error / kPeak < 2e-6);
    study.claim("(10) ode45 without a step limit: obviously in error", m[0], m[0].error / kPeak > 1e-3);
    study.claim("ode45, c = 0: stable, parasitic vibration below 3e-6 N peak to peak", m[3], m[3].ripple < 3e-6);
    study.claim("the same with an unstretched pin", m[4], m[4].ripple < 3e-6);
  }
  if (const auto m = study.measure_all("ode23t", kImplicit); !m.empty())
    study.claim("ode23t, c = 0: no vibration, but different at the 5th significant figure", m[1],
                m[1].ripple < 3e-6 && m[1].error / kPeak < 1e-3 && m[1].error / kPeak > 5e-6);
  if (const auto m = study.measure_all("ode15s", kImplicit); !m.empty())
    study.claim("ode15s, c = 0: no vibration, one significant figure only", m[1], m[1].ripple < 3e-6 && m[1].error / kPeak > 5e-3);
  if (const auto m = study.measure_all("ode113", kExplicit); !m.empty())
    study.claim("ode113, c = 0: accurate, vibration of about 1e-5 N", m[3], m[3].ripple < 3e-5 && m[3].ripple > 3e-6);
  study.measure_all("dopri5", kExplicit);
  if (const auto m = study.measure_all("radau", kImplicit); !m.empty())
    study.claim("the stiff solvers do worse on this problem than the non-stiff ones (not true of `radau`, c = 0)", m[1],
                m[1].error / kPeak > 1e-5 ? Verdict::kHolds : Verdict::kPartly);
  study.finish();
  return item;
}

}  // namespace pintle::paper
