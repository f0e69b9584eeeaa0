// Bearings and tables against closed forms and published formulas, made from their keys.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <string>

#include "base/constants.h"
#include "laws/catalog.h"
#include "laws/bearings/journal_film.h"
#include "laws/gap_at_force.h"

namespace pintle {
namespace {

using Vec = Planar::Vec;
using Values = std::map<std::string, std::vector<double>>;

LawSetting bearing_setting(const LawInfo& info, const Values& values, std::string_view type = "revolute") {
  LawSetting at;
  at.joint_type = type;
  at.held = {type != "prismatic", true, type != "revolute"};
  at.free = {type == "prismatic", false, type == "revolute"};
  at.values = &values;
  at.keys = info.keys;
  return at;
}

Law made(const char* word, const Values& values, std::string_view type = "revolute") {
  const LawInfo& info = *find_law(word);
  const LawSetting at = bearing_setting(info, values, type);
  EXPECT_EQ(info.fault ? info.fault(at).key : "", "");
  Law law;
  info.make(at, law);
  return law;
}

LawFault fault_of(const char* word, const Values& values, std::string_view type = "revolute") {
  const LawInfo& info = *find_law(word);
  const LawFault fault = info.fault(bearing_setting(info, values, type));
  EXPECT_EQ(fault.key.empty(), fault.remedy.empty());
  return fault;
}

Vec force(const Law& law, const Vec& gap, const Vec& rate = Vec::Zero()) { return law.force({0, gap, rate, nullptr}); }

// G. H. Sutherland, DETC2008-49020, section 4: radial stiffness and damping of rolling and of lubricated bearings.
TEST(Bearings, DefaultsLieInThePapersRanges) {
  const auto within = [](const Law& law, int k, double low, double high, double damping_low, double damping_high) {
    const LinearLaw* linear = law.as_linear();
    ASSERT_NE(linear, nullptr);
    EXPECT_TRUE(linear->k[k] >= low && linear->k[k] <= high);
    EXPECT_TRUE(linear->c[k] >= damping_low && linear->c[k] <= damping_high);
  };
  within(made("rolling-bearing", {}), 0, 1e8, 30e8, 2e3, 10e3);
  within(made("journal-bearing", {}), 1, 1e7, 10e7, 1e5, 5e5);
  within(made("linear-guide", {}, "prismatic"), 1, 1e8, 30e8, 2e3, 10e3);
  within(made("rubber-bushing", {}), 0, 1e5, 1e6, 500, 500);
}

TEST(LinearGuide, TurnsAgainstAnEvenLoadOverItsCarriage) {
  const Law guide = made("linear-guide", {{"stiffness", {1e8}}, {"damping", {2e3}}, {"carriage_length", {0.12}}}, "prismatic");
  EXPECT_TRUE(guide.as_linear()->k.isApprox(Vec(0, 1e8, 1.2e5), 1e-14));  // 1e8 * 0.12^2 / 12
  EXPECT_TRUE(guide.as_linear()->c.isApprox(Vec(0, 2e3, 2.4), 1e-14));
  EXPECT_EQ(made("linear-guide", {{"angular_stiffness", {7}}}, "prismatic").as_linear()->k[2], 7);
}

// T. A. Harris, Rolling Bearing Analysis: d = 4.36e-4 Q^(2/3) / (D^(1/3) cos a) mm, Q = 5 F / (Z cos a); for line contact 7.68e-5 Q^0.9 / l^0.8.
TEST(RollingBearing, GivesHarrisDeflections) {
  const double load = 2000, angle = 0.3, play = 15e-6;
  const double Q = 5 * load / (9 * std::cos(angle)), d = 1e-3 * 4.36e-4 * std::pow(Q, 2.0 / 3) / (std::cbrt(12.0) * std::cos(angle));
  const Law balls = made("rolling-bearing", {{"balls", {9}}, {"ball_diameter", {0.012}}, {"contact_angle", {angle}}, {"play", {play}}});
  const double e = d + play / 2;
  EXPECT_TRUE(force(balls, {0.6 * e, 0.8 * e, 1}).isApprox(Vec(-0.6 * load, -0.8 * load, 0), 1e-12));
  const double roller = 4.08 * load / 14, line = 1e-3 * 7.68e-5 * std::pow(roller, 0.9) / std::pow(11.0, 0.8);
  const Law rollers = made("rolling-bearing", {{"rollers", {14}}, {"roller_length", {0.011}}});
  EXPECT_NEAR(force(rollers, {0, line, 0})[1], -load, 1e-12 * load);
}

// Many elements without play: the load of one at its place on the circle is K_1 (d cos)^n, whose mean over the circle is a Beta function. Its inverse is
// Stribeck's number, 4.37 for balls and 4.08 for rollers (Harris; R. Stribeck, Z. VDI 1901).
TEST(RollingBearing, TheSumOverManyElementsHasStribecksNumber) {
  for (const bool ball : {true, false}) {
    const double n = ball ? 1.5 : 10.0 / 9, e = 2e-5, play = 0;
    const Values keys = ball ? Values{{"balls", {60}}, {"ball_diameter", {0.01}}, {"elements", {1}}, {"play", {play}}} : Values{{"rollers", {60}}, {"roller_length", {0.01}}, {"elements", {1}}, {"play", {play}}};
    Values whole = keys;
    whole["elements"] = {0};
    const double mean = std::tgamma((n + 2) / 2) / (2 * std::sqrt(kPi) * std::tgamma((n + 3) / 2));
    EXPECT_NEAR(1 / mean, ball ? 4.37 : 4.08, 5e-3);
    const double lumped = force(made("rolling-bearing", whole), {e, 0, 0})[0], summed = force(made("rolling-bearing", keys), {e, 0, 0})[0];
    EXPECT_NEAR(summed / lumped, mean * (ball ? 4.37 : 4.08), 1e-5);
    const double turn = 0.013;  // between elements
    EXPECT_NEAR(force(made("rolling-bearing", keys), {e * std::cos(turn), e * std::sin(turn), 0}).norm(), -summed, 1e-5 * -summed);
  }
}

// Three elements or more, evenly preloaded: stiffness n Z K_1 d_0^(n-1) / 2 in every direction; each carries K_1 d_0^n.
TEST(RollingBearing, PreloadMakesItStiffWhereItIsCentred) {
  const double preload = 120;
  const Law bearing = made("rolling-bearing", {{"balls", {7}}, {"ball_diameter", {0.008}}, {"elements", {1}}, {"preload", {preload}}, {"cage_angle", {0.2}}});
  const double K1 = std::pow(1e3 * std::cbrt(8.0) / 4.36e-4, 1.5), d0 = std::pow(preload / K1, 2.0 / 3);
  LawTangents r;
  const Vec centred = Vec::Zero();
  bearing.linearize({0, centred, centred, nullptr}, r);
  EXPECT_LT(r.force.norm(), 1e-11 * preload);
  const double stiff = 1.5 * 7 * K1 * std::sqrt(d0) / 2;
  EXPECT_TRUE(r.stiffness.isApprox(Vec(stiff, stiff, 0).asDiagonal().toDenseMatrix(), 1e-12));
  EXPECT_TRUE(r.damping.isApprox(Vec(3500, 3500, 0).asDiagonal().toDenseMatrix(), 1e-12));
  std::vector<double> load;
  bearing.observe({0, centred, centred, nullptr}, centred, load);
  EXPECT_NEAR(load.at(0), preload, 1e-10 * preload);
}

TEST(RollingBearing, IsFreeInItsPlayAndNeverPulls) {
  const Law bearing = made("rolling-bearing", {{"stiffness", {1e8}}, {"damping", {1e4}}, {"play", {4e-5}}});
  const auto border = [&](const Vec& gap, const Vec& rate) {
    double value = 0;
    bearing.borders({0, gap, rate, nullptr}, &value);
    return value;
  };
  EXPECT_EQ(force(bearing, {1.9e-5, 0, 0}, {-3, 2, 5}), Vec(0, 0, 0));
  EXPECT_NEAR(force(bearing, {0, -2.5e-5, 0})[1], 500, 1e-9);                            // 1e8 * 5e-6
  EXPECT_NEAR(force(bearing, {2.5e-5, 0, 0}, {0.01, 3, 0})[0], -600, 1e-9);              // plus 1e4 * 0.01, nothing along the wall
  EXPECT_EQ(force(bearing, {2.5e-5, 0, 0}, {0.01, 3, 0})[1], 0);
  EXPECT_EQ(force(bearing, {2.5e-5, 0, 0}, {-0.06, 0, 0})[0], 0);                        // would pull
  EXPECT_LT(border({1.9e-5, 0, 0}, {1, 0, 0}), 0);
  EXPECT_GT(border({2.5e-5, 0, 0}, {-0.04, 0, 0}), 0);
  EXPECT_LT(border({2.5e-5, 0, 0}, {-0.06, 0, 0}), 0);
}

constexpr double kR = 0.025, kBushLength = 0.02, kC = 40e-6, kMu = 0.04, kSpin = 150;
Values oil(double film) {
  return {{"film", {film}}, {"journal_radius", {kR}}, {"bearing_length", {kBushLength}}, {"radial_clearance", {kC}}, {"viscosity", {kMu}}, {"roughness", {1e-7}}};
}

// DuBois and Ocvirk, NACA Report 1157: S (L/D)^2 = (1-e^2)^2 / (pi e sqrt(pi^2 (1-e^2) + 16 e^2)), tan(attitude) = pi sqrt(1-e^2) / (4 e).
TEST(JournalBearing, HasOcvirksSommerfeldNumberAndAttitude) {
  const Law bearing = made("journal-bearing", oil(1));
  for (const double e : {1e-3, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97})
    for (const double turn : {0.0, 2.2}) {
      const Vec gap(e * kC * std::cos(turn), e * kC * std::sin(turn), 0.4), rate(0, 0, kSpin), f = force(bearing, gap, rate);
      std::vector<double> columns;
      bearing.observe({0, gap, rate, nullptr}, f, columns);
      const double ratio = kBushLength / (2 * kR), chart = (1 - e * e) * (1 - e * e) / (kPi * e * std::sqrt(kPi * kPi * (1 - e * e) + 16 * e * e));
      EXPECT_NEAR(columns[2] * ratio * ratio, chart, 1e-11 * chart) << e;
      EXPECT_NEAR(columns[0], e, 1e-12);
      EXPECT_NEAR(columns[1], kC * (1 - e), 1e-12 * kC);
      const double outward = f[0] * std::cos(turn) + f[1] * std::sin(turn), ahead = -f[0] * std::sin(turn) + f[1] * std::cos(turn);
      EXPECT_LT(outward, 0);
      EXPECT_NEAR(ahead / -outward, kPi * std::sqrt(1 - e * e) / (4 * e), 1e-10 * ahead / -outward);  // carried along by the spin
      EXPECT_NEAR(columns[3], -f[2] * kSpin, 1e-12 * columns[3]);
    }
}

// Sommerfeld's half film: 6 pi e and 12 e^2 over (2 + e^2), times mu w R L (R/c)^2.
TEST(JournalBearing, ALongFilmHasSommerfeldsForces) {
  const Law bearing = made("journal-bearing", oil(2));
  const double size = kMu * kSpin * kR * kBushLength * kR * kR / (kC * kC);
  for (const double e : {1e-3, 0.2, 0.5, 0.8, 0.95}) {
    const Vec f = force(bearing, {e * kC, 0, 0}, {0, 0, kSpin});
    EXPECT_NEAR(f[0], -size * 12 * e * e / ((2 + e * e) * (1 - e * e)), 1e-9 * size * e);
    EXPECT_NEAR(f[1], size * 6 * kPi * e / ((2 + e * e) * std::sqrt(1 - e * e)), 1e-9 * size * e);
  }
}

// A centred pin is resisted with pi/2 mu R L^3 / c^3 against its motion, and rotation alone causes no force (only Petroff's couple).
TEST(JournalBearing, IsRegularWhereThePinIsCentred) {
  const Law bearing = made("journal-bearing", oil(1));
  const double c = kPi / 2 * kMu * kR * kBushLength * kBushLength * kBushLength / (kC * kC * kC), petroff = 2 * kPi * kMu * kR * kR * kR * kBushLength / kC;
  const Vec f = force(bearing, Vec::Zero(), {0.003, -0.004, kSpin});
  EXPECT_TRUE(f.isApprox(Vec(-0.003 * c, 0.004 * c, -petroff * kSpin), 1e-12));
  LawTangents r;
  const Vec centred = Vec::Zero(), rate(0.003, -0.004, kSpin);
  bearing.linearize({0, centred, rate, nullptr}, r);
  const Eigen::Matrix2d damping = Eigen::Matrix2d::Identity() * c;
  EXPECT_TRUE((r.damping.topLeftCorner<2, 2>().isApprox(damping, 1e-12)));
  bearing.linearize({0, centred, centred, nullptr}, r);
  EXPECT_TRUE((r.damping.topLeftCorner<2, 2>().isApprox(damping, 1e-12)));  // at rest: the mean over all directions
}

// The forces of squeezing to and fro add up to those of a film without cavitation: pi (1 + 2 e^2) / (1 - e^2)^(5/2) and pi / (1 - e^2)^(3/2).
TEST(JournalBearing, HalfFilmsMakeAWholeOne) {
  const Law bearing = made("journal-bearing", oil(1));
  const double e = 0.6, size = kMu * kR * kBushLength * kBushLength * kBushLength / (kC * kC * kC), s = 1 - e * e;
  for (const double angle : {0.0, 0.4, 1.1, kPi / 2, 2.0, 3.0}) {
    const Vec rate(0.01 * std::cos(angle), 0.01 * std::sin(angle), 0), gap(e * kC, 0, 0);
    const Vec whole = force(bearing, gap, rate) - force(bearing, gap, -rate);
    EXPECT_NEAR(whole[0], -size * rate[0] * kPi * (1 + 2 * e * e) / std::pow(s, 2.5), 1e-12 * size * 0.1);
    EXPECT_NEAR(whole[1], -size * rate[1] * kPi / std::pow(s, 1.5), 1e-12 * size * 0.1);
  }
}

// Only relative motion matters: the bush may carry F or the pin may, with any common rotation.
TEST(JournalBearing, DoesNotCareWhichBodyIsThePin) {
  for (const double film : {1.0, 2.0, 3.0}) {
    const Law bearing = made("journal-bearing", oil(film));
    const Eigen::Vector2d e(1.3e-5, -2.1e-5), v(0.002, 0.001);  // of the pin, in axes that turn with the bush at wb
    const double wb = 40, wp = 150;
    const Vec on_pin = force(bearing, {e[0], e[1], 0}, {v[0], v[1], wp - wb});
    // In axes that turn with the pin the bush is at -e, and moves at -(v + (wb - wp) z x e).
    const Eigen::Vector2d back = -(v + (wb - wp) * Eigen::Vector2d(-e[1], e[0]));
    const Vec on_bush = force(bearing, {-e[0], -e[1], 0}, {back[0], back[1], wb - wp});
    EXPECT_TRUE(on_bush.head<2>().isApprox(-on_pin.head<2>(), 1e-12));
    // Moments about the bush: that on the pin about its centre, that of its force at the arm e, and that on the bush.
    EXPECT_NEAR(on_pin[2] + (e[0] * on_pin[1] - e[1] * on_pin[0]) + on_bush[2], 0, 1e-12 * std::abs(on_pin[2]));
  }
}

TEST(JournalBearing, SurfacesTouchWhereTheFilmIsAsThinAsTheyAreRough) {
  Values keys = oil(1);
  keys["roughness"] = {2e-6};
  keys["contact_stiffness"] = {1e8};
  const Law bearing = made("journal-bearing", keys);
  EXPECT_EQ(force(bearing, {0, 37.9e-6, 0}), Vec(0, 0, 0));
  EXPECT_NEAR(force(bearing, {0, 40e-6, 0})[1], -200, 1e-9);  // 1e8 * 2e-6
  EXPECT_NEAR(force(bearing, {0, 39e-6, 0}, {0, 0, kSpin})[0], force(bearing, {0, 38e-6, 0}, {0, 0, kSpin})[0], 1e-9);  // the film keeps its thickness
}

// M. I. Friswell, J. E. T. Penny, S. D. Garvey, A. W. Lees, Dynamics of Rotating Machines, Cambridge 2010, section 5.5.1: stiffness and damping
// of a loaded short bearing, u across the load and v along it, in units of f/c and f/(c w).
struct Published {
  Eigen::Matrix2d K, C;
  explicit Published(double e) {
    const double p = kPi * kPi, s = 1 - e * e, q = e * e, h = std::pow(p * s + 16 * q, -1.5), root = std::sqrt(s);
    K << 4 * (p * (2 - q) + 16 * q), kPi * (p * s * s - 16 * q * q) / (e * root),
        -kPi * (p * s * (1 + 2 * q) + 32 * q * (1 + q)) / (e * root), 4 * (p * (1 + 2 * q) + 32 * q * (1 + q) / s);
    C << 2 * kPi * root * (p * (1 + 2 * q) - 16 * q) / e, -8 * (p * (1 + 2 * q) - 16 * q), -8 * (p * (1 + 2 * q) - 16 * q), 2 * kPi * (p * s * s + 48 * q) / (e * root);
    K *= h;
    C *= h;
  }
};

struct Whirl {
  double mass_speed2 = 0, ratio = 0;  // m w^2 c/f at the threshold, and the ratio of whirl to spin there
};

// The stability threshold of a rigid rotor: m s^2 + C s + K has a root i r w.
Whirl threshold(const Eigen::Matrix2d& K, const Eigen::Matrix2d& C) {
  const double stiff = (K(0, 0) * C(1, 1) + K(1, 1) * C(0, 0) - K(0, 1) * C(1, 0) - K(1, 0) * C(0, 1)) / C.trace();
  const double ratio2 = ((K(0, 0) - stiff) * (K(1, 1) - stiff) - K(0, 1) * K(1, 0)) / C.determinant();
  return {stiff / ratio2, std::sqrt(ratio2)};
}

TEST(JournalBearing, TangentsAreThePublishedCoefficients) {
  const Law bearing = made("journal-bearing", oil(1));
  for (const double e : {1e-3, 0.1, 0.35, 0.6, 0.8, 0.93}) {
    const Vec gap(e * kC, 0, 0), rate(0, 0, kSpin), f = force(bearing, gap, rate);
    LawTangents r;
    bearing.linearize({0, gap, rate, nullptr}, r);
    // v along the load, which the film carries with f; u such that the spin turns u into v.
    const Eigen::Vector2d v = f.head<2>().normalized(), u(v[1], -v[0]);
    Eigen::Matrix2d axes;
    axes << u, v;
    const double load = f.head<2>().norm();
    const Eigen::Matrix2d K = axes.transpose() * r.stiffness.topLeftCorner<2, 2>() * axes * kC / load;
    const Eigen::Matrix2d C = axes.transpose() * r.damping.topLeftCorner<2, 2>() * axes * kC * kSpin / load;
    const Published book(e);
    EXPECT_TRUE(K.isApprox(book.K, 1e-9)) << e << '\n' << K << "\n\n" << book.K;
    EXPECT_TRUE(C.isApprox(book.C, 1e-9)) << e << '\n' << C << "\n\n" << book.C;
    const Whirl own = threshold(K, C), published = threshold(book.K, book.C);
    EXPECT_NEAR(own.mass_speed2, published.mass_speed2, 1e-8 * std::abs(published.mass_speed2));
    if (e < 0.01) {
      EXPECT_NEAR(own.ratio, 0.5, 1e-4);  // oil whirl at half the spin
    }
  }
}

TEST(Table, FollowsItsPointsAndTheirEndSlopes) {
  const Law pin = made("table", {{"displacement", {0, 1e-4, 2e-4}}, {"force", {0, 100, 400}}});
  EXPECT_TRUE(force(pin, {0.6e-4, -0.8e-4, 0}).isApprox(Vec(-60, 80, 0), 1e-12));
  EXPECT_TRUE(force(pin, Vec::Zero()).isZero());
  const Law rod = made("table", {{"displacement", {-1e-3, 1e-3}}, {"force", {-50, 10}}, {"damping", {3}}}, "prismatic");
  EXPECT_NEAR(force(rod, {7, 2e-3, 0}, {1, 2, 0})[1], -(10 + 30) - 6, 1e-12);  // straight on beyond the end, plus the damper
  EXPECT_NEAR(rod.energy({0, Vec(0, 1e-3, 0), Vec::Zero(), nullptr}), -20 * 1e-3 + 0.5 * 3e4 * 1e-6, 1e-15);
}

// At its centre a ball bearing has next to no stiffness, so that Newton's method would jump by metres.
TEST(RollingBearing, TheGapAtAForceIsFoundFromNearTheCentre) {
  const Law law = made("rolling-bearing", {{"balls", {9}}, {"ball_diameter", {0.007}}});
  const Vec load(3, 19.6, 0);
  for (const double off : {0.0, 1e-24, 7.7e-21, 1e-15, 1e-12, 1e-9}) {
    Vec gap(0, -off, 0);
    EXPECT_TRUE(gap_at_force(law, load, Vec(Vec::Zero()), gap)) << off;
    EXPECT_LT(gap.norm(), 1e-5) << off;
    EXPECT_LT((force(law, gap) - load).norm(), 1e-9 * load.norm()) << off;
    Vec once(0, -off, 0);
    newton_step_to_force(law, load, Vec(Vec::Zero()), Vec(Vec::Ones()), once);
    EXPECT_LT(once.norm(), 1e-4) << off;
  }
}

TEST(Bearings, SayWhatIsWrongAndWhatToTry) {
  EXPECT_EQ(fault_of("rolling-bearing", {{"balls", {8}}}).key, "balls");
  EXPECT_EQ(fault_of("rolling-bearing", {{"ball_diameter", {0.01}}}).key, "ball_diameter");
  EXPECT_EQ(fault_of("rolling-bearing", {{"roller_length", {0.01}}}).key, "roller_length");
  EXPECT_EQ(fault_of("rolling-bearing", {{"balls", {7.5}}, {"ball_diameter", {0.01}}}).key, "balls");
  EXPECT_EQ(fault_of("rolling-bearing", {{"balls", {8}}, {"ball_diameter", {0.01}}, {"rollers", {8}}, {"roller_length", {0.01}}}).key, "rollers");
  EXPECT_EQ(fault_of("rolling-bearing", {{"balls", {8}}, {"ball_diameter", {0.01}}, {"contact_angle", {kPi / 2}}}).key, "contact_angle");
  EXPECT_EQ(fault_of("rolling-bearing", {{"balls", {8}}, {"ball_diameter", {0.01}}, {"preload", {10}}}).key, "preload");
  EXPECT_EQ(fault_of("rolling-bearing", {{"balls", {8}}, {"ball_diameter", {0.01}}, {"preload", {10}}, {"play", {1e-5}}, {"elements", {1}}}).key, "preload");
  EXPECT_EQ(fault_of("rolling-bearing", {{"elements", {1}}}).key, "elements");
  for (const char* key : {"journal_radius", "bearing_length", "radial_clearance", "viscosity"}) {
    Values keys = oil(1);
    keys.erase(key);
    EXPECT_EQ(fault_of("journal-bearing", keys).key, key);
    EXPECT_EQ(fault_of("journal-bearing", {{key, {1}}}).key, key);
  }
  Values keys = oil(1);
  keys["radial_clearance"] = {0.01};
  EXPECT_EQ(fault_of("journal-bearing", keys).key, "radial_clearance");
  keys = oil(2);
  keys["roughness"] = {3e-5};
  EXPECT_EQ(fault_of("journal-bearing", keys).key, "roughness");
  const auto table = [](const std::vector<double>& x, const std::vector<double>& f, const char* type = "revolute") { return fault_of("table", {{"displacement", x}, {"force", f}}, type).key; };
  EXPECT_EQ(table({0}, {0}), "displacement");
  EXPECT_EQ(table({0, 1, 2}, {0, 1}), "force");
  EXPECT_EQ(table({0, 2, 1}, {0, 1, 2}), "displacement");
  EXPECT_EQ(table({0, 1, 2}, {0, 2, 1}), "force");
  EXPECT_EQ(table({0, 1, 2}, {0, 0, 0}), "force");
  EXPECT_EQ(table({0, 1}, {1, 2}), "force");
  EXPECT_EQ(table({-1, 1}, {-1, 2}), "displacement");
  EXPECT_EQ(table({-1, 1}, {-1, 2}, "prismatic"), "");
}

}  // namespace
}  // namespace pintle
