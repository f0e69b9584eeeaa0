// What every law must satisfy, at random gaps and rates. The battery runs over the alternatives of Law, so a new law is
// tested as soon as it stands there; it states its usual parameters as typical().
#include "laws/law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "base/random_for_tests.h"
#include "laws/catalog.h"

namespace pintle {
namespace {

using Vec = Planar::Vec;
using Mat = Planar::Mat;
using sample::Random;

constexpr int kPoints = 500;

template <class V>
struct TypesOf;
template <class... L>
struct TypesOf<std::variant<L...>> {
  using type = testing::Types<L...>;
  static std::vector<std::string_view> words() { return {L::kWord...}; }
};

struct Point {
  Vec gap, rate;
};

Point random_point(Random& random) {
  Point p;
  for (int k = 0; k < 3; ++k) {
    p.gap[k] = random.of_any_size(1e-9, 1e-2);
    p.rate[k] = random.of_any_size(1e-7, 1e2);
  }
  return p;
}

template <class L>
class JointLaw : public testing::Test {
 protected:
  L law_ = L::typical();
  Random random_{20080803};
};
TYPED_TEST_SUITE(JointLaw, TypesOf<Law>::type);

// Across a kink that the law declares there is no difference quotient; anywhere else there must be.
template <class L>
bool crosses_kink(const L& law, const Point& a, const Point& b) {
  return law.branch(a.gap, a.rate) != law.branch(b.gap, b.rate);
}

TYPED_TEST(JointLaw, TangentsAreDifferencesOfTheForce) {
  int kinks = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Point p = random_point(this->random_);
    const Response r = this->law_.respond(p.gap, p.rate);
    for (int k = 0; k < 3; ++k)
      for (const bool in_rate : {false, true}) {
        const double h = 1e-5 * std::abs(in_rate ? p.rate[k] : p.gap[k]);
        const auto moved = [&](double x) {
          Point q = p;
          (in_rate ? q.rate : q.gap)[k] += x;
          return q;
        };
        if (crosses_kink(this->law_, moved(2 * h), moved(-2 * h))) {
          ++kinks;
          continue;
        }
        const Vec slope = sample::slope_at_zero(h, [&](double x) {
          const Point q = moved(x);
          return this->law_.force(q.gap, q.rate);
        });
        const Vec stated = -(in_rate ? r.damping : r.stiffness).col(k);
        const double rounding = 1e-14 * r.force.cwiseAbs().maxCoeff() / h;
        EXPECT_LE((slope - stated).cwiseAbs().maxCoeff(), 1e-6 * stated.cwiseAbs().maxCoeff() + rounding) << k << in_rate;
      }
  }
  EXPECT_LE(kinks, TypeParam::kHasBranches ? kPoints / 10 : 0);
}

TYPED_TEST(JointLaw, ElasticForceIsDownhillInTheEnergy) {
  for (int i = 0; i < kPoints; ++i) {
    const Point p = random_point(this->random_);
    const Vec still = Vec::Zero();
    const Vec force = this->law_.force(p.gap, still);
    const double energy = this->law_.respond(p.gap, still).energy;
    EXPECT_GE(energy, 0);
    for (int k = 0; k < 3; ++k) {
      const double h = 1e-4 * std::abs(p.gap[k]);
      const double slope = sample::slope_at_zero(h, [&](double x) {
        return this->law_.respond(p.gap + x * Vec::Unit(k), still).energy;
      });
      EXPECT_NEAR(force[k], -slope, 1e-7 * std::abs(slope) + 1e-14 * energy / h);
    }
  }
}

// Power put in by the force = what the energy loses less what turns into heat.
TYPED_TEST(JointLaw, PowerIsAccountedForAndNeverCreated) {
  for (int i = 0; i < kPoints; ++i) {
    const Point p = random_point(this->random_);
    const Response r = this->law_.respond(p.gap, p.rate);
    EXPECT_GE(r.loss, 0);
    const double energy_rate = -this->law_.force(p.gap, Vec::Zero()).dot(p.rate);
    const double size = std::abs(energy_rate) + r.loss;
    EXPECT_NEAR(r.force.dot(p.rate) + energy_rate + r.loss, 0, 1e-12 * size);
  }
}

TYPED_TEST(JointLaw, ForceAloneIsTheForceOfTheResponse) {
  for (int i = 0; i < kPoints; ++i) {
    const Point p = random_point(this->random_);
    EXPECT_EQ(this->law_.force(p.gap, p.rate), this->law_.respond(p.gap, p.rate).force);
    const Law any = this->law_;
    EXPECT_EQ(law_force(any, p.gap, p.rate), respond(any, p.gap, p.rate).force);
  }
}

TYPED_TEST(JointLaw, IsFiniteAtZeroAndFarOut) {
  for (const double gap : {0.0, 1e-300, -1e-300, 1e3, -1e3, 1e9, -1e9})
    for (const double rate : {0.0, 1e-300, 1e6, -1e6}) {
      const Response r = this->law_.respond(Vec::Constant(gap), Vec::Constant(rate));
      EXPECT_TRUE(r.force.allFinite() && r.stiffness.allFinite() && r.damping.allFinite());
      EXPECT_TRUE(std::isfinite(r.energy) && std::isfinite(r.loss));
    }
  const Response rest = this->law_.respond(Vec::Zero(), Vec::Zero());
  EXPECT_EQ(rest.force, Vec(Vec::Zero()));
  EXPECT_EQ(rest.energy, 0);
  EXPECT_EQ(rest.loss, 0);
}

TYPED_TEST(JointLaw, TangentsDoNotFeedEnergyIn) {
  for (int i = 0; i < kPoints; ++i) {
    const Point p = random_point(this->random_);
    const Response r = this->law_.respond(p.gap, p.rate);
    EXPECT_EQ(r.stiffness, Mat(r.stiffness.transpose()));
    const Vec x = this->random_.template vector<Vec>(-1, 1);
    EXPECT_GE(x.dot(r.damping * x), 0);
  }
}

TEST(LawCatalog, EveryWordIsALaw) {
  const auto words = TypesOf<Law>::words();
  for (const LawInfo& info : law_catalog()) {
    EXPECT_NE(std::find(words.begin(), words.end(), info.word), words.end()) << info.word;
    EXPECT_EQ(find_law(info.word), &info);
    EXPECT_FALSE(info.meaning.empty());
    for (const KeyInfo& key : info.keys) EXPECT_FALSE(key.meaning.empty() || key.unit.empty()) << key.key;
  }
  EXPECT_EQ(find_law("lineer"), nullptr);
}

TEST(LinearLaw, ByHand) {
  const LinearLaw law{{100, 200, 3}, {10, 20, 0.5}};
  const Response r = law.respond({0.1, -0.2, 2}, {1, 2, -4});
  EXPECT_EQ(r.force, Vec(-20, 0, -4));
  EXPECT_DOUBLE_EQ(r.energy, 0.5 + 4 + 6);
  EXPECT_DOUBLE_EQ(r.loss, 10 + 80 + 8);
}

TEST(TensionLaw, PullsAndNeverPushes) {
  const TensionLaw rope{1000, 10};
  EXPECT_DOUBLE_EQ(rope.force({0.01, 0, 0}, {0, 0, 0})[0], -10);
  EXPECT_DOUBLE_EQ(rope.force({0.01, 0, 0}, {2, 0, 0})[0], -30);
  EXPECT_DOUBLE_EQ(rope.force({0.01, 0, 0}, {-0.5, 0, 0})[0], -5);
  EXPECT_EQ(rope.force({0.01, 0, 0}, {-2, 0, 0})[0], 0);   // the damper would push
  EXPECT_EQ(rope.force({-0.01, 0, 0}, {50, 0, 0})[0], 0);  // slack
  EXPECT_EQ(rope.respond({-0.01, 0, 0}, {50, 0, 0}).energy, 0);
}

TEST(TensionLaw, HasItsKinksWhereStated) {
  const TensionLaw rope{1000, 10};
  for (const double rate : {-1.0, 0.0, 1.0}) {
    const double vanishes = std::max(0.0, -rope.c * rate / rope.k);  // gap at which the pull begins
    EXPECT_NE(rope.branch({vanishes - 1e-9, 0, 0}, {rate, 0, 0}), rope.branch({vanishes + 1e-9, 0, 0}, {rate, 0, 0}));
    EXPECT_EQ(rope.respond({vanishes - 1e-9, 0, 0}, {rate, 0, 0}).stiffness(0, 0), 0);
    EXPECT_EQ(rope.respond({vanishes + 1e-9, 0, 0}, {rate, 0, 0}).stiffness(0, 0), rope.k);
  }
}

}  // namespace
}  // namespace pintle
