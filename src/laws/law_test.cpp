// Properties that every law must have, at random gaps, rates and states. The battery runs over the laws of the list, with their typical() parameters.
#include "laws/law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "base/expression/expression_parser.h"
#include "base/random_for_tests.h"
#include "base/units.h"
#include "laws/friction/brown_mcphee.h"
#include "laws/bushing.h"
#include "laws/catalog.h"
#include "laws/flexures/cross_spring.h"
#include "laws/flexures/leaf_spring.h"
#include "laws/flexures/notch_hinge.h"
#include "laws/friction/coulomb.h"
#include "laws/contact/gap_contact.h"
#include "laws/contact/guide_contact.h"
#include "laws/bearings/journal_film.h"
#include "laws/friction/lugre.h"
#include "laws/law_setting_for_tests.h"
#include "laws/maxwell.h"
#include "laws/pressure.h"
#include "laws/separating_force.h"
#include "laws/contact/backlash.h"
#include "laws/contact/detent.h"
#include "laws/contact/pin_contact.h"
#include "laws/contact/stops.h"
#include "laws/bearings/rolling_bearing.h"
#include "laws/friction/stribeck.h"
#include "laws/bearings/table.h"
#include "laws/tension.h"

namespace pintle {
namespace {

using Vec = Planar::Vec;
using Mat = Planar::Mat;
using sample::Random;

constexpr int kSamplePoints = 300;

// A law for tests only: two states, a border, full matrices.
struct ClutchLaw {
  static constexpr std::string_view kWord = "clutch_of_a_test";
  double k = 1e5, c = 50, grip = 3e4, rate = 20;

  static ClutchLaw typical() { return {}; }
  int n_states() const { return 2; }
  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    const T x = in.gap[0] - in.state[0], y = in.gap[1] - in.state[1];
    out.force[0] = -(k * in.gap[0] + c * in.rate[0] + 0.2 * k * in.gap[1]) - grip * law_math::where_positive(in.gap[0], x, 0.5 * x);
    out.force[1] = -(k * in.gap[1] + c * in.rate[1] + 0.2 * k * in.gap[0]) - grip * y;
    out.state_rate[0] = rate * x + 0.3 * rate * y;
    out.state_rate[1] = rate * y;
  }
  void rest(const LawInput<double>& in, double* state) const {
    state[0] = in.gap[0];
    state[1] = in.gap[1];
  }
  int n_borders() const { return 1; }
  void borders(const LawInput<double>& in, double* value) const { value[0] = in.gap[0]; }
};

// A slider whose moment presses the edges of its guide.
struct LuGreGuide : LuGreLaw {
  static LuGreGuide typical() {
    LuGreGuide law;
    law.free = 0;
    law.radius = 1;
    law.guide = 0.05;
    law.preload = 3;
    return law;
  }
};
// Surfaces that stick.
struct GrippingPin : ClearanceLaw {
  static GrippingPin typical() {
    GrippingPin law;
    static_cast<ClearanceLaw&>(law) = ClearanceLaw::typical();
    law.grip = StickSlip{0.1, 0.15, 0, 1e7, 300};
    return law;
  }
};
struct GrippingGuide : GuideContactLaw {
  static GrippingGuide typical() {
    GrippingGuide law;
    static_cast<GuideContactLaw&>(law) = GuideContactLaw::typical();
    law.grip = StickSlip{0.15, 0.2, 0, 1e7, 300};
    return law;
  }
};
// Other formulas for the bearings.
struct LongFilmLaw : JournalFilmLaw {
  static LongFilmLaw typical() { return {{0.03, 0.2, 4e-5, 0.05, 2e-6, 5e8, Flow::kAround}}; }
};
struct FiniteFilmLaw : JournalFilmLaw {
  static FiniteFilmLaw typical() { return {{0.03, 0.06, 4e-5, 0.05, 2e-6, 1e9, Flow::kBoth}}; }
};
struct LooseBearingLaw : RollingBearingLaw {
  static LooseBearingLaw typical() { return {{5e9, 10.0 / 9, 300, 2e-5, 0, 1e-6, 0.5, {}}}; }
};
struct WholeBearingLaw : RollingBearingLaw {
  static WholeBearingLaw typical() { return {{5e9, 1.5, 300, 0, 0, 1e-6, 0.5, {}}}; }
};

ChamberPressure pressure(std::string_view text) {
  ParseScope scope;
  for (const char* variable : {"t", "stroke", "stroke_rate", "x"}) scope.variables.emplace_back(variable, kBareNumber);
  return ChamberPressure(std::get<ParsedExpression>(parse_expression(text, scope)).expression);
}

// Pressures that are functions of all variables they may read.
struct GasPressureLaw : PressureLaw {
  static GasPressureLaw typical() {
    return {{std::make_shared<const Chambers>(0.05, 0.03, 1e5, pressure("2e6*(1 + 0.3*sin(20*t))/(1 + 4*stroke^2)"), pressure("3e5 + 1e4*stroke_rate*abs(stroke_rate)"))}};
  }
};

struct Point {
  Vec gap, rate, before;
  std::array<double, kMostLawStates> state{};
};

Point random_point(Random& random) {
  Point p;
  for (int k = 0; k < 3; ++k) {
    p.gap[k] = random.of_any_size(1e-9, 1e-2);
    p.rate[k] = random.of_any_size(1e-7, 1e1);
    p.before[k] = random.of_any_size(1, 1e4);
  }
  for (double& z : p.state) z = random.of_any_size(1e-9, 1e-3);
  return p;
}

// The law together with a spring that presses, so that friction has a normal force.
template <class P>
Law pressed(const P& part) {
  Law law(LinearLaw{{1e6, 2e6, 3e3}, {10, 20, 0.5}});
  law.add(std::make_unique<LawPartOf<P>>(part));
  return law;
}

template <class P>
class AnyLaw : public testing::Test {
 protected:
  Law law_ = pressed(P::typical());
  Random random_{20080803};

  LawPoint at(const Point& p) const { return {0.1, p.gap, p.rate, p.state.data()}; }
  bool crosses_border(const Point& a, const Point& b) const {
    std::vector<double> before(law_.n_borders()), after(law_.n_borders());
    law_.borders(at(a), before.data());
    law_.borders(at(b), after.data());
    return !std::equal(before.begin(), before.end(), after.begin(), [](double x, double y) { return (x > 0) == (y > 0); });
  }
};
using Laws = testing::Types<TensionLaw, BushingLaw, MaxwellLaw, LuGreLaw, CoulombLaw, BrownMcPheeLaw, StribeckLaw, LuGreGuide, ClearanceLaw, EdgeContactLaw, GapContactLaw, RoadContactLaw, GuideContactLaw, HardStops, CushionedStops, BacklashLaw, ClutchLaw,
                             TableLaw, RollingBearingLaw, LooseBearingLaw, WholeBearingLaw, JournalFilmLaw, LongFilmLaw, FiniteFilmLaw, LeafSpringLaw, NotchHingeLaw, CrossSpringLaw, PressureLaw, GasPressureLaw, DetentLaw, SeparatingForce, GrippingPin, GrippingGuide>;
TYPED_TEST_SUITE(AnyLaw, Laws);

// Across a border that the law declares the difference quotient is not defined; everywhere else it must match.
TYPED_TEST(AnyLaw, TangentsAreDifferences) {
  int borders = 0;
  for (int i = 0; i < kSamplePoints; ++i) {
    const Point p = random_point(this->random_);
    LawTangents r;
    this->law_.linearize(this->at(p), r);
    const int n = this->law_.n_states();
    for (int column = 0; column < 6 + n; ++column) {
      const auto value = [&](Point& q) -> double& { return column < 3 ? q.gap[column] : column < 6 ? q.rate[column - 3] : q.state[column - 6]; };
      Point displacement = p;
      const double h = 1e-5 * std::abs(value(displacement));
      const auto moved = [&](double x) {
        Point q = p;
        value(q) += x;
        return q;
      };
      if (this->crosses_border(moved(2 * h), moved(-2 * h))) {
        ++borders;
        continue;
      }
      const auto answer = [&](double x) {
        const Point q = moved(x);
        Eigen::VectorXd all(3 + n);
        all.head<3>() = this->law_.force(this->at(q));
        if (n > 0) this->law_.state_rates(this->at(q), all.data() + 3);
        return all;
      };
      Eigen::VectorXd stated(3 + n);
      for (int k = 0; k < 3; ++k) stated[k] = column < 3 ? -r.stiffness(k, column) : column < 6 ? -r.damping(k, column - 3) : r.force_by_state[k][column - 6];
      for (int z = 0; z < n; ++z) stated[3 + z] = column < 3 ? r.by_gap[z][column] : column < 6 ? r.by_rate[z][column - 3] : r.by_state[z][column - 6];
      const Eigen::VectorXd slope = sample::slope_at_zero(h, answer), now = answer(0);
      for (int row = 0; row < 3 + n; ++row) {
        const double rounding = 1e-13 * (std::abs(now[row]) + r.force.cwiseAbs().maxCoeff() * (row < 3)) / h;
        EXPECT_NEAR(slope[row], stated[row], 2e-6 * std::abs(stated[row]) + rounding) << row << ' ' << column;
      }
    }
  }
  EXPECT_LE(borders, this->law_.n_borders() > 0 ? kSamplePoints / 4 : 0);
}

TYPED_TEST(AnyLaw, HoldsByAForceThatIsDownhillInItsEnergy) {
  if (this->law_.parts().front()->word() == ClutchLaw::kWord) return;  // it has no energy account
  for (int i = 0; i < kSamplePoints; ++i) {
    const Point p = random_point(this->random_);
    const Vec still = Vec::Zero();
    const Response r = respond(this->law_, p.gap, still);
    for (int k = 0; k < 3; ++k) {
      const double h = 1e-4 * std::abs(p.gap[k]);
      const double slope = sample::slope_at_zero(h, [&](double x) { return respond(this->law_, p.gap + x * Vec::Unit(k), still).energy; });
      EXPECT_NEAR(r.force[k], -slope, 1e-6 * std::abs(slope) + 1e-14 * std::abs(r.energy) / h);
    }
  }
}

// Power of the force = decrease of the energy, minus what turns into heat, plus what is supplied; the energy changes with gap and states.
TYPED_TEST(AnyLaw, PowerIsAccountedFor) {
  if (this->law_.parts().front()->word() == ClutchLaw::kWord) return;
  for (int i = 0; i < kSamplePoints; ++i) {
    const Point p = random_point(this->random_);
    const Vec force = this->law_.force(this->at(p));
    std::array<double, kMostLawStates> z_rate{};
    this->law_.state_rates(this->at(p), z_rate.data());
    const int n = this->law_.n_states();
    double energy_rate = 0, size = 0, rounding = 0;
    for (int column = 0; column < 3 + n; ++column) {
      const auto value = [&](Point& q) -> double& { return column < 3 ? q.gap[column] : q.state[column - 3]; };
      Point displacement = p;
      const double h = 1e-4 * std::abs(value(displacement));
      const double slope = sample::slope_at_zero(h, [&](double x) {
        Point q = p;
        value(q) += x;
        return this->law_.energy(this->at(q));
      });
      const double part = slope * (column < 3 ? p.rate[column] : z_rate[column - 3]);
      energy_rate += part;
      size += std::abs(part);
      rounding += 1e-14 * std::abs(this->law_.energy(this->at(p))) * std::abs(column < 3 ? p.rate[column] : z_rate[column - 3]) / h;
    }
    const double loss = this->law_.loss(this->at(p)), supplied = this->law_.supply(this->at(p), force);
    size += std::abs(loss) + force.cwiseAbs().dot(p.rate.cwiseAbs());
    EXPECT_NEAR(force.dot(p.rate) + energy_rate + loss - supplied, 0, 1e-6 * size + rounding);
    if (this->law_.parts().front()->holds()) {
      EXPECT_GE(loss, -1e-12 * size);
    }
  }
}

TYPED_TEST(AnyLaw, LanesGiveTheSameNumbers) {
  for (int i = 0; i < 20; ++i) {
    std::array<Point, 5> points;
    for (Point& p : points) p = random_point(this->random_);
    LawInput<Lanes<5>> in;
    std::array<Lanes<5>, kMostLawStates> state;
    in.t = Lanes<5>::all(0.1);
    for (int s = 0; s < 5; ++s) {
      for (int k = 0; k < 3; ++k) {
        in.gap[k].set(s, points[s].gap[k]);
        in.rate[k].set(s, points[s].rate[k]);
      }
      for (int z = 0; z < kMostLawStates; ++z) state[z].set(s, points[s].state[z]);
    }
    in.state = state.data();
    LawOutput<Lanes<5>> out;
    this->law_.evaluate(in, out);
    for (int s = 0; s < 5; ++s) {
      const Vec force = this->law_.force(this->at(points[s]));
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(out.force[k][s], force[k], 1e-14 * force.cwiseAbs().maxCoeff());
      std::array<double, kMostLawStates> rate{};
      this->law_.state_rates(this->at(points[s]), rate.data());
      for (int z = 0; z < this->law_.n_states(); ++z) EXPECT_NEAR(out.state_rate[z][s], rate[z], 1e-13 * std::abs(rate[z]));
    }
  }
}

TYPED_TEST(AnyLaw, IsFiniteAtZeroAndFarOut) {
  for (const double gap : {0.0, 1e-300, -1e-300, 1e3, -1e3, 1e9, -1e9})
    for (const double rate : {0.0, 1e-300, 1e6, -1e6}) {
      Point p;
      p.gap.setConstant(gap);
      p.rate.setConstant(rate);
      LawTangents r;
      this->law_.linearize(this->at(p), r);
      EXPECT_TRUE(r.force.allFinite() && r.stiffness.allFinite() && r.damping.allFinite());
      EXPECT_TRUE(std::isfinite(r.energy) && std::isfinite(r.loss));
      for (int z = 0; z < r.n; ++z)
        for (int y = 0; y < r.n; ++y) EXPECT_TRUE(std::isfinite(r.state_rate[z]) && std::isfinite(r.by_state[z][y]));
    }
}

TYPED_TEST(AnyLaw, RestsWhereItsStatesDoNotChange) {
  for (int i = 0; i < kSamplePoints; ++i) {
    Point p = random_point(this->random_);
    p.rate.setZero();
    this->law_.rest(this->at(p), p.state.data());
    std::array<double, kMostLawStates> rate{};
    this->law_.state_rates(this->at(p), rate.data());
    for (int z = 0; z < this->law_.n_states(); ++z) EXPECT_EQ(rate[z], 0);
    const Response held = respond(this->law_, p.gap, p.rate);
    if (this->law_.parts().front()->holds()) {
      EXPECT_LE((held.force - this->law_.force(this->at(p))).norm(), 1e-12 * held.force.norm());
    }
  }
}

// Eq. (3.9) against the law itself: states at mu dz = g - g_0 for a small change of the gap, with rates mu times as large.
TYPED_TEST(AnyLaw, ImpedanceIsWhatALinearisedStepFinds) {
  for (int i = 0; i < 50; ++i) {
    const Point p = random_point(this->random_);
    LawTangents r;
    this->law_.linearize(this->at(p), r);
    for (const double mu : {1e-2, 1.0, 1e3, 1e6}) {
      LawImpedance<double> impedance;
      impedance.reserve(r.n);
      impedance.find(r, mu);
      Eigen::MatrixXd system(r.n, r.n), right(r.n, 3), by_state(3, r.n);
      for (int z = 0; z < r.n; ++z) {
        for (int y = 0; y < r.n; ++y) system(z, y) = (z == y ? mu : 0) - r.by_state[z][y];
        for (int k = 0; k < 3; ++k) {
          right(z, k) = r.by_gap[z][k] + mu * r.by_rate[z][k];
          by_state(k, z) = r.force_by_state[k][z];
        }
      }
      Mat expected = r.stiffness + mu * r.damping;
      if (r.n > 0) expected -= by_state * system.partialPivLu().solve(right);
      for (int k = 0; k < 9; ++k) EXPECT_NEAR(impedance.weight[k], expected(k / 3, k % 3), 1e-9 * (r.stiffness + mu * r.damping).cwiseAbs().maxCoeff() + 1e-9 * expected.cwiseAbs().maxCoeff());
    }
  }
}

TEST(LawCatalog, EveryWordIsALaw) {
  for (const LawInfo& info : law_catalog()) {
    EXPECT_EQ(find_law(info.word), &info);
    EXPECT_FALSE(info.meaning.empty());
    EXPECT_NE(info.make, nullptr);
    for (const KeyInfo& key : info.keys) EXPECT_FALSE(key.meaning.empty()) << key.key;
  }
  EXPECT_EQ(find_law("lineer"), nullptr);
  EXPECT_THROW(register_law({.word = "linear", .meaning = "twice", .keys = {}}), std::logic_error);
}

TEST(LinearLaw, ByHand) {
  const LinearLaw law{{100, 200, 3}, {10, 20, 0.5}};
  const Response r = law.respond({0.1, -0.2, 2}, {1, 2, -4});
  EXPECT_EQ(r.force, Vec(-20, 0, -4));
  EXPECT_DOUBLE_EQ(r.energy, 0.5 + 4 + 6);
  EXPECT_DOUBLE_EQ(r.loss, 10 + 80 + 8);
}

TEST(TensionLaw, PullsAndNeverPushes) {
  const Law rope = TensionLaw{1000, 10};
  const auto force = [&](double gap, double rate) {
    const Vec e(gap, 0, 0), v(rate, 0, 0);
    return rope.force({0, e, v, nullptr})[0];
  };
  EXPECT_DOUBLE_EQ(force(0.01, 0), -10);
  EXPECT_DOUBLE_EQ(force(0.01, 2), -30);
  EXPECT_DOUBLE_EQ(force(0.01, -0.5), -5);
  EXPECT_EQ(force(0.01, -2), 0);   // the damper would push
  EXPECT_EQ(force(-0.01, 50), 0);  // slack
  EXPECT_EQ(respond(rope, {-0.01, 0, 0}, {50, 0, 0}).energy, 0);
}

TEST(TensionLaw, HasItsBorderWhereStated) {
  const TensionLaw law{1000, 10};
  const Law rope = law;
  for (const double rate : {-1.0, 0.0, 1.0}) {
    const double vanishes = std::max(0.0, -law.c * rate / law.k);  // gap at which the pull begins
    const Vec below(vanishes - 1e-9, 0, 0), above(vanishes + 1e-9, 0, 0), v(rate, 0, 0);
    ASSERT_EQ(rope.n_borders(), 2);
    double slack[2], taut[2];
    rope.borders({0, below, v, nullptr}, slack);
    rope.borders({0, above, v, nullptr}, taut);
    EXPECT_LT(slack[0], 0);
    EXPECT_GT(taut[0], 0);
    EXPECT_LT(taut[1], 0);
    EXPECT_EQ(slack[1] > 0, rate < 0);  // stretched but not pulling, it loses power
    EXPECT_EQ(rope.loss({0, below, v, nullptr}) > 0, slack[1] > 0);
    EXPECT_EQ(respond(rope, below, v).stiffness(0, 0), 0);
    EXPECT_EQ(respond(rope, above, v).stiffness(0, 0), law.k);
  }
}

// A spring of 100 N*m/rad behind stops at -1 and 2 rad; damping 3 (0.5)^2 - 2 (0.5)^3 = 1/2 of 8 N*m*s/rad in the middle of the cushion.
TEST(Stops, ByHand) {
  CushionedStops stops;
  stops.contact.stiffness = 100;
  stops.contact.exponent = 1;
  stops.contact.viscous = 8;
  stops.contact.cushion = 0.2;
  stops.lower = -1;
  stops.upper = 2;
  const Law law = stops;
  std::array<double, 2> state{};
  const auto moment = [&](double angle, double rate, bool touched) {
    const Vec gap(0, 0, angle), speed(0, 0, rate);
    law.rest({0, gap, speed, state.data()}, state.data());
    if (!touched) state = {};
    return law.force({0, gap, speed, state.data()})[2];
  };
  EXPECT_NEAR(moment(2.1, 0.3, true), -(100 * 0.1 + 0.5 * 8 * 0.3), 1e-12);
  EXPECT_DOUBLE_EQ(moment(2.5, 0.3, true), -(100 * 0.5 + 8 * 0.3));
  EXPECT_DOUBLE_EQ(moment(2.1, -3, true), 0);  // the damper would pull
  EXPECT_NEAR(moment(-1.1, -0.3, true), 100 * 0.1 + 0.5 * 8 * 0.3, 1e-12);
  EXPECT_EQ(moment(0.5, 4, true), 0);
  EXPECT_EQ(moment(2.1, 0.3, false), 0);
  ASSERT_TRUE(law.breach({0, 0, -1.25}));
  EXPECT_FALSE(law.breach({0, 0, -1.25})->upper);
  EXPECT_DOUBLE_EQ(law.breach({0, 0, -1.25})->depth, 0.25);
  EXPECT_FALSE(law.breach({5, 5, 1.9}));
}

// Straight and tilted: the deeper of the two ends counts.
TEST(GuideContact, OverlapsByHand) {
  const GuideContactLaw law = GuideContactLaw::typical();
  EXPECT_DOUBLE_EQ(law.penetration({0, 0, 0}), -law.clearance);
  EXPECT_NEAR(law.penetration({0, -law.clearance - 1e-3, 0}), 1e-3, 1e-15);
  EXPECT_NEAR(law.penetration({0, 1e-4, 0.1}), 1e-4 + 0.5 * law.length * std::sin(0.1) - law.clearance, 1e-15);
}

// A piston of 100 mm on a rod of 60 mm: areas of 25 pi and 16 pi cm^2.
TEST(PressureLaw, ByHand) {
  const PressureLaw law{std::make_shared<const Chambers>(0.1, 0.06, 1e5, ChamberPressure(Expression::constant(2.1e6)), ChamberPressure(Expression::constant(0.6e6)))};
  const double pi = std::numbers::pi, push = 25e-4 * pi * 2e6 - 16e-4 * pi * 0.5e6;
  const Vec stroke(0.2, 0, 0), rate(-0.3, 0, 0);
  const LawPoint at{0, stroke, rate};
  EXPECT_NEAR(Law(law).force(at)[0], push, 1e-9);
  EXPECT_NEAR(Law(law).supply(at, Vec::Zero()), -0.3 * push, 1e-9);
  std::vector<double> columns;
  Law(law).observe(at, {push, 0, 0}, columns);
  const std::vector<double> expected{0.2, -0.3, 2.1e6, 0.6e6, 5e3 * pi, 0.8e3 * pi, -7.5e-4 * pi, 4.8e-4 * pi, -0.3 * push};
  ASSERT_EQ(columns.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(columns[i], expected[i], 1e-12 * std::abs(expected[i])) << i;
  EXPECT_THROW(pressure("2*x"), std::invalid_argument);
}

// K = [2 1 0; 1 3 -1; 0 -1 4], preload (1, 0, 2), rest at (0.1, 0, 0): by hand.
TEST(BushingLaw, ByHand) {
  const std::map<std::string, std::vector<double>> values{{"stiffness", {2, 3}}, {"angular_stiffness", {4}}, {"stiffness_xy", {1}}, {"stiffness_ya", {-1}},
                                                          {"damping", {0}}, {"angular_damping", {0}}, {"preload_x", {1}}, {"preload_moment", {2}}, {"offset_x", {0.1}}};
  const LawInfo& info = *find_law("bushing");
  EXPECT_EQ(info.fault(setting_of(info, values)).key, "");
  Law law;
  info.make(setting_of(info, values), law);
  const Vec gap(1.1, 2, 3), still = Vec::Zero();
  EXPECT_TRUE(law.force({0, gap, still, nullptr}).isApprox(Vec(1 - 4, 0 - 4, 2 - 10), 1e-15));
  // The gap that carries a force: K e = preload - f.
  const Vec carried = respond(law, gap, still).stiffness.lu().solve(Vec(1, 0, 2) - law.force({0, gap, still, nullptr}));
  EXPECT_TRUE(carried.isApprox(gap - Vec(0.1, 0, 0), 1e-14));
}

TEST(BushingLaw, EnergyClosesInALoopOfLoading) {
  const Law law = BushingLaw::typical();
  double work = 0;
  constexpr int kSteps = 20000;
  const auto place = [](double s) { return Vec(1e-3 * std::sin(s), 2e-3 * std::cos(2 * s), 0.02 * std::sin(3 * s + 1)); };
  const double whole = 2 * 3.14159265358979323846;
  Vec last = place(0);
  const Vec still = Vec::Zero();
  double size = 0;
  for (int i = 1; i <= kSteps; ++i) {
    const Vec now = place(whole * i / kSteps), middle = 0.5 * (last + now);  // exact: the force is linear
    const double part = law.force({0, middle, still, nullptr}).dot(now - last);
    work += part;
    size += std::abs(part);
    last = now;
  }
  EXPECT_LE(std::abs(work), 1e-12 * size);
}

TEST(BushingLaw, RefusesWhatFeedsEnergy) {
  const LawInfo& info = *find_law("bushing");
  const std::map<std::string, std::vector<double>> values{{"stiffness", {100}}, {"angular_stiffness", {1}}, {"stiffness_xa", {11}}};
  EXPECT_EQ(info.fault(setting_of(info, values)).key, "stiffness_xa");
  // Two terms are too large: the one with the larger excess is named.
  const std::map<std::string, std::vector<double>> two{{"stiffness", {100}}, {"angular_stiffness", {1}}, {"stiffness_xy", {101}}, {"stiffness_ya", {30}}};
  EXPECT_EQ(info.fault(setting_of(info, two)).key, "stiffness_ya");
  const std::map<std::string, std::vector<double>> just{{"stiffness", {100}}, {"angular_stiffness", {1}}, {"stiffness_xa", {10}}};
  EXPECT_EQ(info.fault(setting_of(info, just)).key, "");
}

}  // namespace
}  // namespace pintle
