// The film of a bearing of finite length compared with Reynolds' equation itself, with its two limits, and with the published chart.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/constants.h"
#include "laws/bearings/journal_film.h"
#include "laws/law.h"

namespace pintle {
namespace {

using Vec = Planar::Vec;
using Flow = JournalFilmLaw::Flow;
constexpr double kRadius = 0.02, kClearance = 20e-6, kViscosity = 0.03;

Law bearing(double slender, Flow flow) {
  JournalFilmLaw law;
  law.radius = kRadius;
  law.length = slender * 2 * kRadius;
  law.clearance = kClearance;
  law.viscosity = kViscosity;
  law.roughness = 1e-3 * kClearance;
  law.flow = flow;
  return Law(law);
}

// Components along and across a velocity at the angle `turn` to the eccentricity e (over the clearance), in units of mu R^3 L |u| / c^3.
struct Resistance {
  double along, across;
  double size() const { return std::hypot(along, across); }
};
Resistance of_law(double slender, Flow flow, double e, double turn) {
  const double speed = 1e-3;
  const Vec gap(e * kClearance * std::cos(turn), -e * kClearance * std::sin(turn), 0), rate(speed, 0, 0);
  LawTangents out;
  bearing(slender, flow).linearize({0, gap, rate, nullptr}, out);
  const double size = kViscosity * std::pow(kRadius / kClearance, 3) * slender * 2 * kRadius * speed;
  return {-out.force[0] / size, -out.force[1] / size};
}

// Reynolds' equation (h^3 p')' + h^3 p_zz = -12 cos(psi) over the half film, in units of the radius and the clearance; p = 0 at its edges. A series of cosines along
// the axis is exact; around it finite differences, with their second-order error extrapolated away. The remainder of the series is taken from the short film.
Resistance reynolds(double slender, double e, double turn, int n) {
  const double ex = e * std::cos(turn), ey = -e * std::sin(turn), dx = kPi / n, length = 2 * slender;
  const auto cubed = [&](double psi) { return std::pow(1 - ex * std::cos(psi) - ey * std::sin(psi), 3); };
  std::vector<double> below(n), diagonal(n), source(n), here(n), factor(n), rest(n);
  Resistance sum{0, 0};
  for (int i = 1; i < n; ++i) {
    const double psi = -kPi / 2 + i * dx;
    below[i] = cubed(psi - dx / 2) / (dx * dx);
    diagonal[i] = below[i] + cubed(psi + dx / 2) / (dx * dx);
    here[i] = cubed(psi);
    source[i] = std::cos(psi);
    sum.along += dx * length * length * source[i] * source[i] / here[i];
    sum.across += dx * length * length * source[i] * std::sin(psi) / here[i];
  }
  for (int k = 1; k < 60; k += 2) {  // cos(k pi z / L); its contribution to the source and to the force
    const double wave = std::pow(k * kPi / length, 2), share = 12 * 8 / std::pow(k * kPi, 2);
    for (int i = 1; i < n; ++i) {
      const double pivot = diagonal[i] + wave * here[i] - (i > 1 ? below[i] * factor[i - 1] : 0);
      factor[i] = (i + 1 < n ? below[i + 1] : 0) / pivot;
      rest[i] = (source[i] + (i > 1 ? below[i] * rest[i - 1] : 0)) / pivot;
    }
    double p = 0;
    for (int i = n - 1; i >= 1; --i) {
      p = rest[i] + factor[i] * p;
      const double change = share * dx * (p - source[i] / (wave * here[i])), psi = -kPi / 2 + i * dx;
      sum.along += change * std::cos(psi);
      sum.across += change * std::sin(psi);
    }
  }
  return sum;
}
Resistance reynolds(double slender, double e, double turn) {
  const Resistance coarse = reynolds(slender, e, turn, 150), fine = reynolds(slender, e, turn, 300);
  return {(4 * fine.along - coarse.along) / 3, (4 * fine.across - coarse.across) / 3};
}

constexpr std::array<double, 6> kSlender{0.25, 0.5, 1, 2, 4, 8};

// The equations above reduce to the limits, and to the centred pin: 12 pi/2 (1 - tanh(L/D)/(L/D)).
TEST(FiniteFilm, ReynoldsEquationHasBothLimits) {
  for (const double turn : {0.0, 1.0, 2.0}) {
    const Resistance narrow = reynolds(1e-3, 0.6, turn), shorter = of_law(1e-3, Flow::kAxial, 0.6, turn), longer = of_law(16, Flow::kAround, 0.6, turn);
    EXPECT_NEAR(narrow.along, shorter.along, 1e-5 * shorter.size());
    EXPECT_NEAR(narrow.across, shorter.across, 1e-5 * shorter.size());
    const Resistance wide = reynolds(8, 0.6, turn), wider = reynolds(16, 0.6, turn);  // the effect of the ends is the same in both
    EXPECT_NEAR(2 * wider.along - wide.along, longer.along, 1e-3 * longer.size());
    EXPECT_NEAR(2 * wider.across - wide.across, longer.across, 1e-3 * longer.size());
  }
  for (const double slender : kSlender) EXPECT_NEAR(reynolds(slender, 0, 0).along, 6 * kPi * (1 - std::tanh(slender) / slender), 1e-4) << slender;
}

TEST(FiniteFilm, TendsToTheShortAndTheLongFilm) {
  for (const double e : {0.0, 0.3, 0.9, 0.99})
    for (const double turn : {0.0, 0.7, kPi / 2, 2.5, kPi}) {
      const auto expect_same = [&](double slender, Flow flow, double accuracy) {
        const Resistance finite = of_law(slender, Flow::kBoth, e, turn), limit = of_law(slender, flow, e, turn);
        EXPECT_NEAR(finite.along, limit.along, accuracy * limit.size()) << e << ' ' << turn;
        EXPECT_NEAR(finite.across, limit.across, accuracy * limit.size()) << e << ' ' << turn;
      };
      expect_same(1e-5, Flow::kAxial, 1e-6);
      expect_same(1e6, Flow::kAround, 1e-5);
    }
}

TEST(FiniteFilm, IsExactWhereThePinIsCentred) {
  for (const double slender : kSlender) {
    const Resistance finite = of_law(slender, Flow::kBoth, 0, 0);
    EXPECT_NEAR(finite.along, 6 * kPi * (1 - std::tanh(slender) / slender), 1e-12 * finite.along);
    EXPECT_NEAR(finite.across, 0, 1e-12);
    LawTangents out;
    bearing(slender, Flow::kBoth).linearize({0, Vec::Zero(), Vec::Zero(), nullptr}, out);  // at rest half of a whole film, in all directions
    const double size = kViscosity * std::pow(kRadius / kClearance, 3) * slender * 2 * kRadius;
    EXPECT_TRUE((out.damping.topLeftCorner<2, 2>().isApprox(size * finite.along * Eigen::Matrix2d::Identity(), 1e-12)));
  }
}

// With a second way out for the oil, the film resists less.
TEST(FiniteFilm, ResistsLessThanBothOfItsLimits) {
  for (const double slender : kSlender)
    for (const double e : {0.01, 0.5, 0.95, 0.999})
      for (double turn = 0; turn < 3.15; turn += 0.21) {
        const Resistance finite = of_law(slender, Flow::kBoth, e, turn), narrow = of_law(slender, Flow::kAxial, e, turn), wide = of_law(slender, Flow::kAround, e, turn);
        EXPECT_GT(finite.along, 0);
        EXPECT_LT(finite.along, std::min(narrow.along, wide.along));
        EXPECT_LE(std::abs(finite.across), std::min(std::abs(narrow.across), std::abs(wide.across)));
        EXPECT_GE(finite.across * narrow.across, 0);
      }
}

// Along its velocity the film never resists less than Reynolds' equation says, theory/bearings Eq. (3.7). The
// deviation, as a fraction of the force: squeezed, turning steadily, and where the pin leaves the thin film.
TEST(FiniteFilm, IsCloseToReynoldsEquation) {
  struct Region {
    double least_turn, most_turn, most_e, allowed;
  };
  for (const Region& region : {Region{0, 60, 0.9, 0.07}, {75, 90, 0.5, 0.09}, {75, 90, 0.9, 0.20}, {105, 180, 0.9, 0.30}}) {
    double most = 0;
    for (const double slender : kSlender)
      for (const double e : {0.1, 0.3, 0.5, 0.7, 0.9})
        for (double turn = region.least_turn; turn <= region.most_turn && e <= region.most_e; turn += 15) {
          const Resistance exact = reynolds(slender, e, turn * kDegree), finite = of_law(slender, Flow::kBoth, e, turn * kDegree);
          const double along = (finite.along - exact.along) / exact.size(), across = (finite.across - exact.across) / exact.size();
          EXPECT_GT(along, -1e-3) << slender << ' ' << e << ' ' << turn;  // accuracy of the finite differences
          most = std::max(most, std::hypot(along, across));
        }
    EXPECT_LT(most, region.allowed);
    EXPECT_GT(most, 0.8 * region.allowed);  // the figure on the theory page is neither too small nor much too large
  }
}

// A. A. Raimondi, J. Boyd, ASLE Transactions 1 (1958) 159-209, parts I to III: full bearings, Reynolds' condition at the end of the film. Sommerfeld number of
// the load at an eccentricity, and attitude angle in degrees.
TEST(FiniteFilm, CarriesTheLoadOfRaimondiAndBoydsChart) {
  struct Point {
    double slender, e, sommerfeld, attitude;
  };
  for (const Point& p : {Point{0.25, 0.1, 16.2, 82.31}, {0.25, 0.2, 7.57, 75.18}, {0.25, 0.4, 2.83, 60.86}, {0.25, 0.6, 1.07, 46.72}, {0.25, 0.8, 0.261, 31.04}, {0.25, 0.9, 0.0736, 21.85},
                         {0.5, 0.1, 4.31, 81.62},  {0.5, 0.2, 2.03, 74.94},  {0.5, 0.4, 0.779, 61.45}, {0.5, 0.6, 0.319, 48.14}, {0.5, 0.8, 0.0923, 33.31}, {0.5, 0.9, 0.0313, 23.66},
                         {1, 0.1, 1.33, 79.5},     {1, 0.2, 0.631, 74.02},   {1, 0.4, 0.264, 63.10},   {1, 0.6, 0.121, 50.58},   {1, 0.8, 0.0446, 36.24},   {1, 0.9, 0.0188, 26.45}}) {
    const Law law = bearing(p.slender, Flow::kBoth);
    const Vec gap(p.e * kClearance, 0, 0), rate(0, 0, 200);
    LawTangents out;
    law.linearize({0, gap, rate, nullptr}, out);
    std::vector<double> columns;
    law.observe({0, gap, rate, nullptr}, out.force, columns);
    EXPECT_NEAR(columns[2] / p.sommerfeld, 1, 0.06) << p.slender << ' ' << p.e;
    EXPECT_NEAR(std::atan2(out.force[1], -out.force[0]) * 180 / kPi, p.attitude, 7) << p.slender << ' ' << p.e;
  }
}

}  // namespace
}  // namespace pintle
