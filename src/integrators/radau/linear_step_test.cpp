// The linear model of the whole step over the plane of ratios: a joint, a redundant second one, a servo in the same step, geometric
// stiffness of either sign. theory/time section 4.1.
#include "integrators/radau/linear_step.h"

#include <gtest/gtest.h>

#include <limits>

namespace pintle {
namespace {

using linear_step::Gap;

constexpr double kOutOfLine = 0.1;  // omega_0 over omega_N

// A joint, one like it that opens the other way, or one that sees the whole motion.
enum class Beside { kNothing, kMirrored, kStraight };

std::vector<Gap> gaps_of(double across, double stages, double end, double servo, Beside beside) {
  const double k = kOutOfLine * kOutOfLine * std::abs(across);
  std::vector<Gap> gaps{{stages, end, k}};
  if (beside == Beside::kMirrored) gaps.push_back({stages, -end, k});
  if (beside == Beside::kStraight) gaps.push_back({1, 1, k});
  if (servo > 0) gaps.push_back({1, 1, servo});
  return gaps;
}

template <class Check>
void over_the_plane(Check check) {
  for (const double servo : {0.0, 0.01, 1.0, 1e4})
    for (const Beside beside : {Beside::kNothing, Beside::kMirrored, Beside::kStraight})
      for (int i = 0; i <= 40; i += 2)
        for (int e = 0; e <= 60; e += 4)
          for (const double sign : {-1.0, 1.0}) check(std::pow(10.0, -1 + 0.1 * i), sign * std::pow(10.0, -0.1 * e), servo, beside);
}

// Gaps that are the same at the end as in the stages: the step is the collocation, which is A-stable.
TEST(LinearStep, NothingGrowsWhereGapsStayLinear) {
  for (const int stages : {3, 5})
    for (const bool held : {false, true})
      over_the_plane([&](double pull, double gap, double servo, Beside beside) {
        if (beside == Beside::kMirrored) return;
        const std::vector<Gap> gaps = gaps_of(pull * pull, gap, gap, servo, beside);
        EXPECT_LT(linear_step::spectral_radius(RadauTable::of(stages), pull * pull, gaps, held), 1 + 1e-9) << pull << " " << gap << " " << servo;
        double stiffness = -pull * pull;  // pushed: only where the other stiffnesses keep it from buckling
        for (const Gap& g : gaps) stiffness += g.stiffness * g.end * g.end;
        if (stiffness > 0) {
          EXPECT_LT(linear_step::spectral_radius(RadauTable::of(stages), -pull * pull, gaps, held), 1 + 1e-9) << -pull << " " << gap << " " << servo;
        }
      });
}

// Gaps that change over the step: with bodies free, the remainder grows with the step; with bodies held it does not, whatever the servo and the
// second joint.
TEST(LinearStep, HeldBodiesDampWhatIsLeftAcrossLongSteps) {
  for (const int stages : {3, 5}) {
    const RadauTable& table = RadauTable::of(stages);
    double free = 0, held = 0;
    over_the_plane([&](double pull, double gap, double servo, Beside beside) {
      if (pull < 2 * table.real_eigenvalue) return;
      const std::vector<Gap> gaps = gaps_of(pull * pull, 1, gap, servo, beside);
      free = std::max(free, linear_step::spectral_radius(table, pull * pull, gaps, false));
      held = std::max(held, linear_step::spectral_radius(table, pull * pull, gaps, true));
    });
    EXPECT_GT(free, 1000);
    EXPECT_LT(held, 1);
  }
}

// A stiffer servo leaves less growth.
TEST(LinearStep, AServoInTheSameStepOnlyHelps) {
  for (const int stages : {3, 5}) {
    double before = std::numeric_limits<double>::infinity();
    for (const double servo : {0.0, 0.01, 1.0, 1e4}) {
      double largest = 0;
      over_the_plane([&](double pull, double gap, double with, Beside beside) {
        if (with == servo && beside == Beside::kNothing) largest = std::max(largest, linear_step::spectral_radius(RadauTable::of(stages), pull * pull, gaps_of(pull * pull, 1, gap, servo, beside), true));
      });
      EXPECT_LE(largest, before * (1 + 1e-9)) << servo;
      before = largest;
    }
    EXPECT_LE(before, 1);
  }
}

}  // namespace
}  // namespace pintle
