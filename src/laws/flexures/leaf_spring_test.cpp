// Leaf springs against closed forms: small deflections, elasticas, beam-columns, buckling.
#include <array>
#include <cmath>
#include <functional>

#include "base/constants.h"
#include "base/random_for_tests.h"
#include "laws/flexures/blade_basis.h"
#include "laws/flexures/flexure_laws_for_tests.h"
#include "laws/gap_at_force.h"

namespace pintle {
namespace {

using namespace flexure;
constexpr double kL = 0.2, kB = 0.03, kT = 4e-3, kE = 200e9;
constexpr double kEI = kE * kB * kT * kT * kT / 12, kEA = kE * kB * kT;
constexpr double kStretch = kEI / (kEA * kL * kL);  // dimensionless axial compliance of the blade

Values blade(double thickness = kT) { return {{"length", {kL}}, {"width", {kB}}, {"thickness", {thickness}}, {"elastic_modulus", {kE}}, {"damping_time", {1e-3}}}; }
Law leaf() { return made("leaf-spring", blade()); }

double root_of(const std::function<double(double)>& f, double low, double high) {
  const bool falls = f(low) > 0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0) == falls ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// The end of a blade bent into a circular arc.
Vec arc(double angle) { return {kL * (std::sin(angle) / angle - 1), 2 * kL * std::pow(std::sin(0.5 * angle), 2) / angle, angle}; }

TEST(LeafSpring, HasTheStiffnessOfABeamAtSmallDeflections) {
  Mat K;
  K << kEA / kL, 0, 0, 0, 12 * kEI / (kL * kL * kL), -6 * kEI / (kL * kL), 0, -6 * kEI / (kL * kL), 4 * kEI / kL;
  const LawTangents r = tangents(leaf(), Vec::Zero());
  EXPECT_TRUE(r.stiffness.isApprox(K, 1e-12));
  EXPECT_TRUE(r.damping.isApprox(1e-3 * K, 1e-12));
  EXPECT_TRUE(leaf().engaged_stiffness().isApprox(K.diagonal(), 1e-12));
}

// S. P. Timoshenko's beam, with 5/6 of the section effective in shear.
TEST(LeafSpring, DeformsByShearWhereAsked) {
  Values values = blade(0.03);
  values["shear"] = {1};
  values["plane"] = {1};
  const double modulus = kE / (1 - 0.09), I = kB * 0.03 * 0.03 * 0.03 / 12, EI = modulus * I, GA = 5.0 / 6 * kE / 2.6 * kB * 0.03, phi = 12 * EI / (GA * kL * kL);
  Mat K;
  K << modulus * kB * 0.03 / kL, 0, 0, 0, 12 * EI / (kL * kL * kL), -6 * EI / (kL * kL), 0, -6 * EI / (kL * kL), (4 + phi) * EI / kL;
  K.bottomRightCorner<2, 2>() /= 1 + phi;
  EXPECT_TRUE(tangents(made("leaf-spring", values), Vec::Zero()).stiffness.isApprox(K, 1e-12));
}

TEST(LeafSpring, BendsIntoACircleUnderAMoment) {
  const Law law = leaf();
  for (const double angle : {1e-3, 0.1, 0.7, 2.0, 4.0, 2 * kPi}) {
    const Vec f = force(law, arc(angle));
    EXPECT_NEAR(f[2], -kEI / kL * angle, 1e-10 * kEI / kL * angle);
    EXPECT_LT(f.head<2>().norm(), 1e-9 * kEI / (kL * kL) * angle);
    EXPECT_NEAR(observed(law, arc(angle))[0], kE * kT / (2 * kL) * angle, 1e-8 * kE * kT / (2 * kL) * angle);
    EXPECT_NEAR(law.energy({0, arc(angle), Vec::Zero(), nullptr}), 0.5 * kEI / kL * angle * angle, 1e-10 * kEI / kL * angle * angle);
  }
}

// A cantilever with a transverse force P at its end, from the first integral of the elastica with stretch,
//   1/2 slope'^2 = P (sin end - sin slope) + 1/2 stretch P^2 (sin^2 end - sin^2 slope),
// in dimensionless form; `end` is the slope at the end.
struct Cantilever {
  double length = 0, x = 0, y = 0;  // length of the blade that this load bends so far; position of its end
  Cantilever(double end, double P, double stretch) {
    const GaussLegendre gauss(80);
    for (int q = 0; q < 80; ++q) {
      const double u = 0.5 * (1 + gauss.x[q]), slope = end * (1 - u * u), sine = std::sin(slope);
      const double apart = 2 * std::cos(0.5 * (end + slope)) * std::sin(0.5 * (end - slope));  // sin end - sin slope
      const double ds = 0.5 * gauss.w[q] * 2 * end * u / std::sqrt(2 * P * apart + stretch * P * P * apart * (std::sin(end) + sine));
      length += ds;
      x += (1 + stretch * P * sine) * std::cos(slope) * ds;
      y += (1 + stretch * P * sine) * sine * ds;
    }
  }
};

TEST(LeafSpring, FollowsTheElasticaUnderAForceAcross) {
  const Law law = leaf();
  for (const double end : {0.05, 0.4, 0.9, 1.3}) {
    const double P = root_of([&](double load) { return Cantilever(end, load, kStretch).length - 1; }, 1e-6, 100);
    const Cantilever bent(end, P, kStretch);
    const Vec f = force(law, Vec(kL * (bent.x - 1), kL * bent.y, end)), expected = Vec(0, -P, 0) * kEI / (kL * kL);
    EXPECT_LT((f - expected).head<2>().norm(), 1e-8 * expected.norm()) << end;
    EXPECT_LT(std::abs(f[2]), 1e-8 * expected.norm() * kL);
    const std::vector<double> seen = observed(law, Vec(kL * (bent.x - 1), kL * bent.y, end));
    EXPECT_NEAR(seen[0], kE * kT / (2 * kL) * P * bent.x, 1e-6 * seen[0]);  // at the root, where the axial force is zero
    EXPECT_EQ(seen[1], 1);
  }
}

// K. E. Bisshopp and D. C. Drucker, Quarterly of Applied Mathematics 3 (1945) 272-275: without stretch the reference above equals theirs, in elliptic integrals.
TEST(LeafSpring, HasAReferenceThatIsBisshoppsAndDruckers) {
  for (const double end : {0.2, 0.9, 1.3}) {
    const double k = std::sqrt(0.5 * (1 + std::sin(end))), first = std::asin(1 / (k * std::sqrt(2.0))), alpha = std::comp_ellint_1(k) - std::ellint_1(k, first);
    const Cantilever bent(end, alpha * alpha, 0);
    EXPECT_NEAR(bent.length, 1, 1e-12);
    EXPECT_NEAR(bent.y, 1 - 2 / alpha * (std::comp_ellint_2(k) - std::ellint_2(k, first)), 1e-12);
    EXPECT_NEAR(bent.x, std::sqrt(2 * std::sin(end)) / alpha, 1e-12);
  }
}

// A straight blade under a compression P (negative: tension): its transverse stiffness with the angle guided, and its rotational stiffness with the
// end on its line. The slope satisfies slope'' + P (1 - stretch P) slope = const.
TEST(LeafSpring, IsABeamColumnUnderAxialLoad) {
  const Law law = leaf();
  for (const double P : {-400.0, -30.0, -1.0, 1.0, 9.0, 20.0, 35.0}) {
    const double e = 1 - kStretch * P, square = P * e, k = std::sqrt(std::abs(square));
    const Mat K = tangents(law, Vec(-kL * kStretch * P, 0, 0)).stiffness;
    const double half = 0.5 * k, across = P > 0 ? k * k * k / (2 * (std::tan(half) - half)) : k * k * k / (2 * (half - std::tanh(half)));
    EXPECT_NEAR(K(1, 1), across / (e * e) * kEI / (kL * kL * kL), 1e-9 * std::abs(K(1, 1))) << P;
    const double turning = P > 0 ? k * (std::sin(k) - k * std::cos(k)) / (2 * (1 - std::cos(k)) - k * std::sin(k))
                                 : k * (k * std::cosh(k) - std::sinh(k)) / (2 * (1 - std::cosh(k)) + k * std::sinh(k));
    EXPECT_NEAR(K(2, 2), turning * kEI / kL, 1e-9 * std::abs(K(2, 2))) << P;
    EXPECT_NEAR(K(0, 0), kEA / kL, 1e-9 * kEA / kL);
  }
}

// Euler: pi^2/4 for a blade with a free end, where the tangent becomes singular; 4 pi^2 between clamps, where the equilibrium ceases. For a blade
// that shortens, P (1 - stretch P) takes the place of P.
TEST(LeafSpring, BucklesAtEulersLoads) {
  const Law law = leaf();
  const auto at = [](double P) { return Vec(-kL * kStretch * P, 0, 0); };
  const double free = root_of([&](double P) { return tangents(law, at(P)).stiffness.bottomRightCorner<2, 2>().determinant(); }, 1, 9);
  EXPECT_NEAR(free * (1 - kStretch * free), kPi * kPi / 4, 1e-9);
  const double clamped = root_of([&](double P) {
    double border = 0;
    const Vec gap = at(P), still = Vec::Zero();
    law.borders({0, gap, still, nullptr}, &border);
    return border;
  }, 20, 60);
  EXPECT_NEAR(clamped * (1 - kStretch * clamped), 4 * kPi * kPi, 1e-6);
  const Vec beyond = at(1.01 * clamped);
  EXPECT_EQ(observed(law, beyond)[1], 0);
  EXPECT_TRUE(force(law, beyond).isApprox(-leaf().engaged_stiffness().cwiseProduct(beyond), 1e-12));
}

// Guided in angle, the end comes nearer by 3/5 of the square of the transverse displacement over the length.
TEST(LeafSpring, ShortensAsItMovesAcross) {
  const Law law = leaf();
  for (const double across : {0.002, 0.02}) {
    const double y = across * kL, nearer = root_of([&](double x) { return force(law, Vec(x, y, 0))[0]; }, -y * y / kL, 0);
    EXPECT_NEAR(nearer / (-0.6 * y * y / kL), 1, 2 * across * across + 60 * kStretch);
  }
}

TEST(LeafSpring, StoresWhatIsDoneOnIt) {
  const Law law = leaf();
  const GaussLegendre gauss(12);
  const auto place = [](double s) { return Vec(-0.02 * s * s, 0.05 * std::sin(2 * s), 0.8 * s); };
  const auto along = [](double s) { return Vec(-0.04 * s, 0.1 * std::cos(2 * s), 0.8); };
  double work = 0;
  constexpr int kParts = 20;
  for (int i = 0; i < kParts; ++i)
    for (int q = 0; q < 12; ++q) {
      const double s = (i + 0.5 * (1 + gauss.x[q])) / kParts;
      work -= 0.5 / kParts * gauss.w[q] * force(law, place(s)).dot(along(s));
    }
  const double stored = law.energy({0, place(1), Vec::Zero(), nullptr});
  EXPECT_GT(stored, 0.01);
  EXPECT_NEAR(work, stored, 1e-9 * stored);
}

TEST(LeafSpring, DoesNotKnowWhichEndIsFirst) {
  const Law law = leaf();
  sample::Random random(7);
  for (int i = 0; i < 40; ++i) {
    const double y = random.of_any_size(1e-4, 0.06), angle = random.of_any_size(1e-3, 1);
    const double nearer = 0.6 * y * y / kL - 0.1 * y * angle + angle * angle * kL / 15;
    const Vec gap(-nearer + random.of_any_size(1e-7, 2e-5), y, angle), f = force(law, gap);
    const Exchanged other = exchange_ends(gap, f, {kL, 0});
    EXPECT_LT((force(law, other.gap) - other.force).head<2>().norm(), 1e-9 * f.head<2>().norm() + 1e-6) << i;
    EXPECT_NEAR(force(law, other.gap)[2], other.force[2], 1e-8 * f.norm() * kL + 1e-8);
  }
}

// On its way into a circle only its curvature changes, at the rate of the angle over the length.
TEST(LeafSpring, LosesByTheRateOfItsStrain) {
  const Law law = leaf();
  for (const double angle : {0.3, 1.5, 4.0}) {
    const double rate = 3, h = 1e-5;
    const Vec moves = rate / (2 * h) * (arc(angle + h) - arc(angle - h)), still = arc(angle);
    EXPECT_NEAR(law.loss({0, still, moves, nullptr}), 1e-3 * kEI / kL * rate * rate, 1e-6 * 1e-3 * kEI / kL * rate * rate);
    EXPECT_NEAR(force(law, still, moves)[2] - force(law, still)[2], -1e-3 * kEI / kL * rate, 1e-5 * 1e-3 * kEI / kL * rate);
  }
}

// From the unloaded blade to loads that bend it strongly, for blades whose stiffnesses differ by up to a million.
TEST(LeafSpring, IsFoundUnderItsLoad) {
  for (const double thickness : {0.01, 1e-3, 2e-4}) {
    const Law law = made("leaf-spring", blade(thickness));
    const double EI = kE * kB * thickness * thickness * thickness / 12;
    for (const double across : {0.1, 2.0, 10.0})
      for (const double along : {30.0, 0.0, -1.5}) {
        const Vec wanted = -EI / (kL * kL) * Vec(along, across, 0.2 * across * kL), still = Vec::Zero();
        Vec gap = Vec::Zero();
        gap_at_force(law, wanted, still, gap);
        EXPECT_LT((force(law, gap) - wanted).norm(), 1e-9 * wanted.norm()) << thickness << ' ' << across << ' ' << along;
        EXPECT_EQ(observed(law, gap)[1], 1);
      }
  }
}

TEST(LeafSpring, SaysWhatIsWrongAndWhatToTry) {
  EXPECT_EQ(fault_of("leaf-spring", blade(kL / 5)).key, "thickness");
  EXPECT_EQ(fault_of("leaf-spring", blade(kL / 5.01)).key, "");
  Values values = blade();
  values["poisson_ratio"] = {0.6};
  EXPECT_EQ(fault_of("leaf-spring", values).key, "poisson_ratio");
  EXPECT_EQ(find_law("leaf-spring")->rest(setting_of(*find_law("leaf-spring"), values)), Planar::Point(kL, 0));
  EXPECT_FALSE(suits(*find_law("leaf-spring"), "revolute"));
}

}  // namespace
}  // namespace pintle
