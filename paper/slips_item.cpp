// What the paper's equations leave out or get wrong, each with a number computed from the equations as printed.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "paper/ideal.h"
#include "paper/items.h"
#include "paper/runs.h"
#include "pintle/simulate.h"

namespace pintle::paper {
namespace {

// y' = f(y) by the classical Runge-Kutta method.
template <std::size_t N>
std::array<double, N> advance(std::array<double, N> y, double h, int steps,
                              const std::function<std::array<double, N>(const std::array<double, N>&)>& f) {
  const auto add = [](const auto& a, double s, const auto& b) {
    auto out = a;
    for (std::size_t i = 0; i < N; ++i) out[i] += s * b[i];
    return out;
  };
  for (int n = 0; n < steps; ++n) {
    const auto a = f(y), b = f(add(y, h / 2, a)), c = f(add(y, h / 2, b)), d = f(add(y, h, c));
    for (std::size_t i = 0; i < N; ++i) y[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  return y;
}

// Eqs. (24)-(33) as printed: u1..u6.
using Six = std::array<double, 6>;
struct PrintedPendulum {
  double k = 2e8, c = 3500, m = 1, r = 0.5, g = 9.81, J = m / 3 * 4 * r * r;
  Force stretch(const Six& u) const { return {-(u[0] - r * std::cos(u[4])), -(u[2] - r * std::sin(u[4]))}; }
  Force rate(const Six& u) const { return {u[1] + r * u[5] * std::sin(u[4]), u[3] - r * u[5] * std::cos(u[4])}; }
  Force force(const Six& u) const {
    const Force p = stretch(u), v = rate(u);
    return {k * p.x - c * v.x, k * p.y - c * v.y};
  }
  Six operator()(const Six& u) const {
    const Force p = stretch(u), v = rate(u), f = force(u);
    const double s = std::sin(u[4]), co = std::cos(u[4]);
    return {u[1], g + f.x / m, u[3], f.y / m, u[5], 4 * r / J * (k * (p.x * s - p.y * co) + c * (v.y * co - v.x * s))};
  }
};

// Largest distance of the printed equations' force from this program's, both from an unstretched pin, every 0.1 s.
double printed_pendulum_error() {
  Model model = mechanism("pendulum");
  model.simulate.start = Start::kRaw;
  model.simulate.tolerance = 1e-8;
  model.simulate.output_step = 0.1;
  const Trajectory r = run(model, true);
  const std::vector<double> fx = column(r, "joint.pin.on_rod.fx[world]"), fy = column(r, "joint.pin.on_rod.fy[world]");
  const PrintedPendulum equations;
  Six u{0, 0, 0.5, 0, std::numbers::pi / 2, 0};
  double error = 0;
  for (std::size_t row = 1; row < r.n_rows(); ++row) {
    u = advance<6>(u, 5e-6, 20000, equations);
    const Force f = equations.force(u);
    error = std::max(error, std::hypot(fx[row] - f.x, fy[row] - f.y));
  }
  return error;
}

// Two free bodies g and h: x, y, angle and their rates.
using Twelve = std::array<double, 12>;
struct Pair {
  double mg = 1, Ig = 0.05, mh = 2, Ih = 0.1;
  double momentum(const Twelve& y) const {  // angular, about the origin
    return mg * (y[0] * y[7] - y[1] * y[6]) + Ig * y[8] + mh * (y[3] * y[10] - y[4] * y[9]) + Ih * y[11];
  }
  double kinetic(const Twelve& y) const {
    return 0.5 * (mg * (y[6] * y[6] + y[7] * y[7]) + Ig * y[8] * y[8] + mh * (y[9] * y[9] + y[10] * y[10]) + Ih * y[11] * y[11]);
  }
  // Force on g at p, moment on g; the opposite ones on h at q.
  Twelve motion(const Twelve& y, const Force& f, double moment, const Force& p, const Force& q) const {
    const double on_g = (p.x - y[0]) * f.y - (p.y - y[1]) * f.x + moment, on_h = -((q.x - y[3]) * f.y - (q.y - y[4]) * f.x) - moment;
    return {y[6], y[7], y[8], y[9], y[10], y[11], f.x / mg, f.y / mg, on_g / Ig, -f.x / mh, -f.y / mh, on_h / Ih};
  }
};

// Characteristic points and how they move.
struct Points {
  Force a, b, va, vb, n, turn;  // n: along the perpendicular of h's axis; turn: its rate
  Points(const Twelve& y, double ra, double xa, double rb, double xb) {
    const double A = y[2] + xa, B = y[5] + xb;
    a = {y[0] + ra * std::cos(A), y[1] + ra * std::sin(A)};
    b = {y[3] + rb * std::cos(B), y[4] + rb * std::sin(B)};
    va = {y[6] - y[8] * ra * std::sin(A), y[7] + y[8] * ra * std::cos(A)};
    vb = {y[9] - y[11] * rb * std::sin(B), y[10] + y[11] * rb * std::cos(B)};
    n = {std::cos(B), std::sin(B)};
    turn = {-y[11] * n.y, y[11] * n.x};
  }
};

// Eqs. (13)-(20), the reaction on h at g's point a, or at h's own point b.
struct Slider {
  bool at_own_point = false;
  Pair pair;
  double k1 = 1e6, k2 = 1e4, c1 = 500, c2 = 5, ra = 0.1, rb = 0.1, xa = -std::numbers::pi / 2, xb = std::numbers::pi / 2;
  double gap(const Points& p) const { return (p.a.x - p.b.x) * p.n.x + (p.a.y - p.b.y) * p.n.y; }
  double tilt(const Twelve& y) const { return y[5] + xb - y[2] - xa - std::numbers::pi; }
  Twelve operator()(const Twelve& y) const {
    const Points p(y, ra, xa, rb, xb);
    const double rate = (p.va.x - p.vb.x) * p.n.x + (p.va.y - p.vb.y) * p.n.y + (p.a.x - p.b.x) * p.turn.x + (p.a.y - p.b.y) * p.turn.y;
    const double f = -k1 * gap(p) - c1 * rate;
    return pair.motion(y, {f * p.n.x, f * p.n.y}, k2 * tilt(y) + c2 * (y[11] - y[8]), p.a, at_own_point ? p.b : p.a);
  }
};

// Relative change of the angular momentum after some time.
double leak_of_slider(bool at_own_point, double seconds) {
  Slider slider;
  slider.at_own_point = at_own_point;
  constexpr double kSpin = 5, kSlide = 0.2, kOut = 0.3;
  const Twelve y{kOut, 0.2, 0, 0, 0, 0, kSlide - kSpin * 0.2, kSpin * kOut, kSpin, 0, 0, kSpin};
  const Twelve end = advance<12>(y, 1e-5, static_cast<int>(std::lround(1e5 * seconds)), slider);
  return slider.pair.momentum(end) / slider.pair.momentum(y) - 1;
}

// Eqs. (1)-(12): two equal rods on one pin, spinning as one, nothing else touching them. Spin lost in a second.
double spin_lost(double k, double c) {
  Pair pair{1, 1.0 / 12, 1, 1.0 / 12};
  constexpr double kSpin = 10, kHalf = 0.5;
  const double stretch = kHalf * kSpin * kSpin / (k - 0.5 * kSpin * kSpin);  // that carries the load
  const auto law = [&](const Twelve& y) {
    const Points p(y, kHalf, std::numbers::pi, kHalf, 0);
    return pair.motion(y, {k * (p.b.x - p.a.x) + c * (p.vb.x - p.va.x), k * (p.b.y - p.a.y) + c * (p.vb.y - p.va.y)}, 0, p.a, p.b);
  };
  const double x = kHalf + stretch / 2;
  const Twelve y{x, 0, 0, -x, 0, 0, 0, kSpin * x, kSpin, 0, -kSpin * x, kSpin};
  return 1 - pair.momentum(advance<12>(y, 1e-5, 100000, law)) / pair.momentum(y);
}

}  // namespace

Item make_slips() {
  Item item{"slips", "What the paper leaves open or gets wrong", {}, {}, {}, {}, {}};
  item.text = {"Each has a number from the equations as printed, integrated by an independent plain Runge-Kutta method. "
               "[Theory](../theory/README.md) describes what the library does instead."};
  const double critical = 2 * std::sqrt(1e8 * 4);
  Table t{"Errors and omissions", {"where", "printed", "correct", "number"}, {}};
  t.rows = {
      {"(13)-(20)", "force and moment on body g at its own point a; nothing about h",
       "the opposite force acts on h at the same point in space. At h's own point b the pair creates angular momentum in proportion to the slide",
       fmt::format("two free bodies turning at 5 rad/s, 0.3 m apart along the axis: angular momentum changes by {:+.1f} % in 0.1 s, {:+.0f} % in 0.3 s with the force "
                   "at b, by {:+.0e} with both at a",
                   100 * leak_of_slider(true, 0.1), 100 * leak_of_slider(true, 0.3), leak_of_slider(false, 0.3))},
      {"(17)", "phi = theta_h + xi_b - theta_g - xi_a - pi",
       "true only if the two centres of mass lie on opposite sides of the axis; on one side pi must be dropped, and with a centre on the axis xi is undefined",
       fmt::format("both centres on one side, k2 = 1e6 N m/rad: a moment of {:.2e} N m in the unloaded joint", 1e6 * std::numbers::pi)},
      {"(7)-(8)", "damping by the difference of the two points' velocities",
       "it damps a stretched joint that only rotates with its bodies, by a couple c omega d²: angular momentum is lost, little with bearings, more with rubber",
       fmt::format("two free rods at 10 rad/s lose {:.0e} of their spin in 1 s at k = 1e8, c = 3000, and {:.1e} at k = 1e5, c = 500", spin_lost(1e8, 3000),
                   spin_lost(1e5, 500))},
      {"(16), (20)", "moment on g by k2 phi and c2 (theta_h' - theta_g')", "signs agree with (17): both turn g towards h. No error", "-"},
      {"(29)", "factor 4r/J, J about the pin", "4r/J = r/I about the centre of mass: correct, and no angular term is missing",
       fmt::format("(24)-(33) as printed against this program over 2 s: {:.0e} N", printed_pendulum_error())},
      {"Fig. 7", "difference below 5e-5 from t = 0", "an unstretched pin carries nothing at first, an ideal one a quarter of the weight",
       fmt::format("{:.4f} N at t = 0; see `figure-7`", -ideal_pendulum(0).fx)},
      {"7", "Fd/Fk < 1e-4 throughout", "true relative to the peak of Fk, not at every angle", "see `dashpot`"},
      {"7", "N-m/s for c", "N s/m", "-"},
      {"7, 8", "gravity and the crank's first angle", "not printed; 9.81 m/s² and any angle give the figures", "-"},
      {"8", "start transients are gone after a few degrees", "some tens of degrees with the damping of the paper's own example", "see `start`"},
      {"8", "I = 5.333", "16/3 rounded; forces change by less than the paper's figures show", fmt::format("{:.0e} relative", 1 - 5.333 * 3 / 16)},
      {"10", "bearings have a few percent of critical damping", "true of rolling elements; lubricated journals are far above critical",
       fmt::format("4 kg, k = 1e8: c = 2e3 to 1e4 is {:.0f} to {:.0f} %; journals (1e5 to 5e5) {:.0f} to {:.0f} %", 100 * 2e3 / critical, 100 * 1e4 / critical,
                   100 * 1e5 / critical, 100 * 5e5 / critical)}};
  item.tables = {t};
  return item;
}

}  // namespace pintle::paper
