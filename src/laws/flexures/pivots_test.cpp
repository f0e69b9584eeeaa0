// Notch hinges and cross-spring pivots against published formulas.
#include <cmath>
#include <functional>

#include "base/constants.h"
#include "base/random_for_tests.h"
#include "laws/flexures/flexure_laws_for_tests.h"
#include "laws/flexures/notch_hinge.h"
#include "laws/gap_at_force.h"

namespace pintle {
namespace {

using namespace flexure;
constexpr double kAluminium = 71e9, kNeckWidth = 0.012;

NotchSize notch(double thickness, double x, double y) { return {thickness, x, y, kNeckWidth, kAluminium, kAluminium / 2.66}; }

// J. M. Paros and L. Weisbord, Machine Design 37 (1965): bending and stretching of a hinge of two half circles, with b = t/(2 R).
TEST(NotchHinge, HasParosAndWeisbordsCompliance) {
  const double R = 5e-3;
  for (const double t : {1e-5, 1e-4, 1e-3, 5e-3}) {
    const double b = t / (2 * R), g = 1 + b, d = 2 * b + b * b;
    const double bending = 3 / (2 * kAluminium * kNeckWidth * R * R) / d * ((1 + b) / (g * g) + (3 + 2 * b + b * b) / (g * d) + 6 * (1 + b) / std::pow(d, 1.5) * std::atan(std::sqrt((2 + b) / b)));
    const double axial = (2 * (1 + b) / std::sqrt(d) * std::atan(std::sqrt((2 + b) / b)) - kPi / 2) / (kAluminium * kNeckWidth);
    const NotchCompliance hinge = compliance_of(notch(t, R, R));
    EXPECT_NEAR(hinge.bending, bending, 1e-11 * bending) << t;
    EXPECT_NEAR(hinge.axial, axial, 1e-11 * axial) << t;
  }
  const NotchCompliance thin = compliance_of(notch(5e-5, R, R));  // their short forms, for thin necks
  EXPECT_NEAR(thin.bending / (9 * kPi * std::sqrt(R) / (2 * kAluminium * kNeckWidth * std::pow(5e-5, 2.5))), 1, 0.01);
  EXPECT_NEAR(thin.axial / ((kPi * std::sqrt(R / 5e-5) - 2.57) / (kAluminium * kNeckWidth)), 1, 0.01);
}

// S. T. Smith, V. G. Badami, J. S. Dale, Y. Xu, Review of Scientific Instruments 68 (1997) 1474-1483: elliptic hinges.
TEST(NotchHinge, OfAnEllipseIsThatOfACircleDrawnOut) {
  for (const double t : {2e-4, 2e-3}) {
    const NotchCompliance circle = compliance_of(notch(t, 4e-3, 4e-3)), ellipse = compliance_of(notch(t, 12e-3, 4e-3));
    EXPECT_NEAR(ellipse.bending, 3 * circle.bending, 1e-12 * ellipse.bending);
    EXPECT_NEAR(ellipse.axial, 3 * circle.axial, 1e-12 * ellipse.axial);
    const double shear = 1.2 * circle.axial * kAluminium / (kAluminium / 2.66), bent = circle.transverse - shear;
    EXPECT_NEAR(ellipse.transverse, 27 * bent + 3 * shear, 1e-12 * ellipse.transverse);
  }
}

// A transverse force at the middle bends each half by x times it: the integral of 12 x^2/(E b h^3), here by Simpson's rule, plus shear.
TEST(NotchHinge, GivesAcrossByBendingAndShear) {
  const double t = 1e-3, R = 5e-3;
  constexpr int kParts = 20000;
  double sum = 0, thin = 0;
  for (int i = 0; i <= kParts; ++i) {
    const double angle = -0.5 * kPi + kPi * i / kParts, h = t + 2 * R * (1 - std::cos(angle)), x = R * std::sin(angle), weight = (i == 0 || i == kParts ? 1 : i % 2 == 1 ? 4 : 2) * kPi / kParts / 3;
    sum += weight * R * std::cos(angle) * 12 * x * x / (h * h * h);
    thin += weight * R * std::cos(angle) / h;
  }
  EXPECT_NEAR(compliance_of(notch(t, R, R)).transverse, sum / (kAluminium * kNeckWidth) + 1.2 * thin / (kAluminium / 2.66 * kNeckWidth), 1e-9 * sum / (kAluminium * kNeckWidth));
}

// R. E. Peterson's factor for two deep notches in bending, as S. T. Smith, Flexures (2000) prints it for these hinges: (2.7 t + 5.4 R)/(8 R + t) + 0.325.
TEST(NotchHinge, ConcentratesStressAsPetersonSays) {
  for (const double t : {1e-4, 1e-3, 5e-3}) {
    const double R = 5e-3, k = NotchHingeLaw::of(notch(t, R, R), 0).stress_by_moment / (6 / (kNeckWidth * t * t));
    EXPECT_NEAR(k / ((2.7 * t + 5.4 * R) / (8 * R + t) + 0.325), 1, 0.03) << t;
  }
}

TEST(NotchHinge, ByItsKeys) {
  const Law hinge = made("notch-hinge", {{"thickness", {1e-3}}, {"radius", {5e-3}}, {"width", {kNeckWidth}}, {"elastic_modulus", {kAluminium}}, {"poisson_ratio", {0.33}}, {"plane", {1}}, {"damping_time", {2e-4}}});
  const NotchCompliance narrow = compliance_of(notch(1e-3, 5e-3, 5e-3));
  const Vec k = hinge.engaged_stiffness();
  EXPECT_NEAR(k[2], 1 / narrow.bending / (1 - 0.33 * 0.33), 1e-9 * k[2]);
  EXPECT_TRUE(tangents(hinge, Vec::Zero()).stiffness.isApprox(k.asDiagonal().toDenseMatrix(), 1e-12));
  EXPECT_TRUE(tangents(hinge, Vec::Zero()).damping.isApprox((2e-4 * k).asDiagonal().toDenseMatrix(), 1e-12));
  const double stress = observed(hinge, {1e-7, 0, 1e-3})[0];
  EXPECT_NEAR(stress, std::pow(1.1, 0.45) * 6 * k[2] * 1e-3 / (kNeckWidth * 1e-6) + (k[0] * 1e-7) / (kNeckWidth * 1e-3), 1e-3 * stress);
}

TEST(Pivots, DoNotKnowWhichEndIsFirst) {
  const Law hinge = NotchHingeLaw::typical();
  const Values cross{{"length", {0.05}}, {"width", {0.01}}, {"thickness", {1e-3}}, {"crossing", {0.3}}};
  Values turned = cross;
  turned["crossing"] = {0.7};
  const Law pivot = made("cross-spring", cross), other_pivot = made("cross-spring", turned);
  sample::Random random(3);
  for (int i = 0; i < 40; ++i) {
    const Vec gap(random.of_any_size(1e-7, 2e-6), random.of_any_size(1e-7, 2e-6), random.of_any_size(1e-4, 0.2));
    for (const auto& [one, two] : {std::pair(&hinge, &hinge), std::pair(&pivot, &other_pivot)}) {
      const Vec f = force(*one, gap);
      const Exchanged other = exchange_ends(gap, f, {0, 0});
      EXPECT_LT((force(*two, other.gap) - other.force).head<2>().norm(), 1e-9 * f.norm()) << i;
      EXPECT_NEAR(force(*two, other.gap)[2], other.force[2], 1e-9 * f.norm()) << i;
    }
  }
}

// J. A. Haringx (1949), W. H. Wittrick (Aeronautical Quarterly 1951): the rotational stiffness of both blades together is 8 E I/L (1 - 3 c + 3 c^2),
// where c is the fraction up to the crossing; 2 E I/L if they cross in the middle.
TEST(CrossSpring, HasTheStiffnessOfHaringxAndWittrick) {
  const double L = 0.05, b = 0.008, t = 4e-4, E = 207e9, EI = E * b * t * t * t / 12;
  for (const double c : {0.0, 0.1273, 0.5, 0.8})
    for (const double angle : {0.5 * kPi, 0.3 * kPi}) {
      const Law pivot = made("cross-spring", {{"length", {L}}, {"width", {b}}, {"thickness", {t}}, {"crossing", {c}}, {"crossing_angle", {angle}}});
      // Without a force: the point of the second body that was at the crossing is free to move.
      const Mat K = tangents(pivot, Vec::Zero()).stiffness;
      const double held = K(2, 2), free = 1 / K.inverse()(2, 2);
      EXPECT_NEAR(held, 8 * EI / L * (1 - 3 * c + 3 * c * c), 1e-10 * held);
      if (c == 0.5) {
        EXPECT_NEAR(free, 2 * EI / L, 1e-10 * free);
      }
      EXPECT_NEAR(free / held, 1, 1e-3);  // blades hardly stretch
    }
}

// Turned by a moment alone, the crossing moves along the bisector by L angle^2/(12 cos(half of the crossing angle)), to second order: sqrt(2)/12 L angle^2
// for blades at right angles (J. A. Haringx; plotted by B. D. Jensen and L. L. Howell, Mechanism and Machine Theory 37 (2002) 461-476).
TEST(CrossSpring, ShiftsItsCentre) {
  const double L = 0.05, t = 1e-4;
  for (const double crossing : {0.5 * kPi, 0.25 * kPi}) {
    const Law pivot = made("cross-spring", {{"length", {L}}, {"width", {0.01}}, {"thickness", {t}}, {"crossing_angle", {crossing}}});
    for (const double angle : {0.02, 0.1}) {
      Vec gap(L * angle * angle / (12 * std::cos(0.5 * crossing)), 0, angle);
      for (int i = 0; i < 20; ++i) {
        const LawTangents r = tangents(pivot, gap);
        gap.head<2>() += r.stiffness.topLeftCorner<2, 2>().lu().solve(r.force.head<2>()).eval();
      }
      EXPECT_LT(force(pivot, gap).head<2>().norm(), 1e-6);
      EXPECT_NEAR(gap[0] / (L * angle * angle / (12 * std::cos(0.5 * crossing))), 1, 2 * angle * angle + 2e-3);
      EXPECT_LT(std::abs(gap[1]), 0.1 * gap[0]);
    }
  }
}

// Work of the pull on the shift of the centre, (4.4): a separating pull F along the bisector reduces the stiffness by F L/(6 cos(half of the crossing angle)).
TEST(CrossSpring, IsSofterWhenPulledApart) {
  const double L = 0.05, EI = 207e9 * 0.01 * 1e-12 / 12;
  const Law pivot = made("cross-spring", {{"length", {L}}, {"width", {0.01}}, {"thickness", {1e-4}}});
  for (const double pull : {-0.02, 0.01, 0.02}) {
    Vec gap = Vec::Zero();
    gap_at_force(pivot, Vec(-pull, 0, 0), Vec(Vec::Zero()), gap);
    const double stiffness = 1 / tangents(pivot, gap).stiffness.inverse()(2, 2), loaded = 2 * EI / L - pull * L / (6 * std::cos(0.25 * kPi));  // (4.5)
    EXPECT_NEAR(stiffness, loaded, 2e-3 * loaded) << pull;
  }
}

TEST(Pivots, SayWhatIsWrongAndWhatToTry) {
  const Values hinge{{"thickness", {1e-3}}, {"radius", {5e-3}}, {"width", {0.01}}};
  const auto fault = [](Values values, const char* key, double x, const char* word) {
    values[key] = {x};
    return fault_of(word, values).key;
  };
  EXPECT_EQ(fault_of("notch-hinge", hinge).key, "");
  EXPECT_EQ(fault(hinge, "thickness", 6e-3, "notch-hinge"), "thickness");
  EXPECT_EQ(fault(hinge, "semi_axis_y", 6e-3, "notch-hinge"), "semi_axis_y");
  EXPECT_EQ(fault(hinge, "radius", 0, "notch-hinge"), "radius");
  EXPECT_EQ(fault(hinge, "poisson_ratio", 0.7, "notch-hinge"), "poisson_ratio");
  EXPECT_EQ(fault_of("notch-hinge", {{"thickness", {1e-3}}, {"semi_axis_x", {5e-3}}, {"width", {0.01}}}).key, "semi_axis_y");
  const Values pivot{{"length", {0.05}}, {"width", {0.01}}, {"thickness", {1e-3}}};
  EXPECT_EQ(fault_of("cross-spring", pivot).key, "");
  EXPECT_EQ(fault(pivot, "crossing", 1.1, "cross-spring"), "crossing");
  EXPECT_EQ(fault(pivot, "crossing_angle", kPi, "cross-spring"), "crossing_angle");
  EXPECT_EQ(fault(pivot, "thickness", 0.01, "cross-spring"), "thickness");
}

}  // namespace
}  // namespace pintle
