// Mechanisms that pass singular positions again and again. Each has one degree of freedom, so that its smooth branch is known as a function
// of the crank's angle, and its speed follows from the energy. theory/ideal section 3.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "pintle/read_model.h"
#include "pintle/simulate.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

constexpr double kSpin = 5;       // of the crank at the start [rad/s]

struct Pose {
  double x, y, angle;
};

struct PinnedBar {
  std::string name, markers;
};

struct Kind {
  std::string name, ground, joints;
  double start;  // angle of the crank
  std::vector<PinnedBar> bars;  // the crank first
  std::function<std::vector<Pose>(double)> branch;  // poses of the bars at a crank angle
};

std::string text(const Kind& kind, double gravity, const std::string& settings) {
  constexpr double kDifference = 1e-6;
  const std::vector<Pose> at = kind.branch(kind.start), next = kind.branch(kind.start + kDifference);
  std::string out = fmt::format("format = 1\nname = \"{}\"\ngravity = [0, {}]\n[simulate]\n{}\n[ground.markers]\n{}\n", kind.name, -gravity, settings, kind.ground);
  for (std::size_t i = 0; i < kind.bars.size(); ++i)
    out += fmt::format("[body.{}]\nmass = 1\ninertia = 0.01\nposition = [{:.16g}, {:.16g}]\nangle = {:.16g}\nspin = {:.12g}\n{}{}\n", kind.bars[i].name, at[i].x, at[i].y, at[i].angle,
                       kSpin * (next[i].angle - at[i].angle) / kDifference, i == 0 ? "hold = [\"angle\"]\n" : "", kind.bars[i].markers);
  return out + kind.joints;
}

std::string pin(const std::string& name, const std::string& first, const std::string& second) {
  return fmt::format("[joint.{}]\ntype = \"revolute\"\nbetween = [\"{}\", \"{}\"]\n", name, first, second);
}

// Its bars come to lie on each other: the slider is then at the crank's pivot, and both bars could turn as one.
Kind equal_slider_crank() {
  return {"Slider-crank of equal bars", "O = [0, 0]",
          pin("O", "ground.O", "crank.O") + pin("A", "crank.A", "rod.A") + pin("B", "rod.B", "slider.c") + "[joint.S]\ntype = \"prismatic\"\nbetween = [\"ground.O\", \"slider.c\"]\n",
          0.5,
          {{"crank", "markers.O = [-0.1, 0]\nmarkers.A = [0.1, 0]"}, {"rod", "markers.A = [-0.1, 0]\nmarkers.B = [0.1, 0]"}, {"slider", "markers.c = [0, 0]"}},
          [](double a) {
            const double c = std::cos(a), s = std::sin(a);
            return std::vector<Pose>{{0.1 * c, 0.1 * s, a}, {0.3 * c, 0.1 * s, -a}, {0.4 * c, 0, 0}};
          }};
}

// A four-bar of these lengths, on the branch given by `angles` of coupler and rocker.
Kind four_bar_kind(const std::string& name, double ground, double crank, double coupler, double rocker, double start, std::function<std::pair<double, double>(double)> angles) {
  const auto half = [](double length) { return fmt::format("markers.from = [{:.16g}, 0]\nmarkers.to = [{:.16g}, 0]", -length / 2, length / 2); };
  return {name, fmt::format("O2 = [0, 0]\nO4 = [{:.16g}, 0]", ground),
          pin("O2", "ground.O2", "crank.from") + pin("A", "crank.to", "coupler.from") + pin("B", "coupler.to", "rocker.to") + pin("O4", "ground.O4", "rocker.from"), start,
          {{"crank", half(crank)}, {"coupler", half(coupler)}, {"rocker", half(rocker)}},
          [=](double a) {
            const auto [phi, psi] = angles(a);
            return std::vector<Pose>{{crank / 2 * std::cos(a), crank / 2 * std::sin(a), a},
                                     {crank * std::cos(a) + coupler / 2 * std::cos(phi), crank * std::sin(a) + coupler / 2 * std::sin(phi), phi},
                                     {ground + rocker / 2 * std::cos(psi), rocker / 2 * std::sin(psi), psi}};
          }};
}

Kind parallelogram() {
  return four_bar_kind("Parallelogram", 0.5, 0.2, 0.5, 0.2, 1.0, [](double a) { return std::pair{0.0, a}; });
}

// Short crank and rocker that turn in opposite senses: tan(psi/2) = k tan(a/2), with k the ratio of the sum to the difference of the lengths.
Kind antiparallelogram() {
  const double ground = 0.5, crank = 0.2, k = (ground + crank) / (ground - crank);
  return four_bar_kind("Antiparallelogram", ground, crank, ground, crank, 1.0, [=](double a) {
    const double turns = std::floor((a + M_PI) / (2 * M_PI)), psi = -2 * (std::atan(k * std::tan(a / 2)) + M_PI * turns);
    const double x = ground + crank * (std::cos(psi) - std::cos(a)), y = crank * (std::sin(psi) - std::sin(a));
    return std::pair{std::atan2(y, x), psi};
  });
}

// Crank and ground are equal, and so are coupler and rocker: these come to lie on each other at every turn.
Kind kite() {
  return four_bar_kind("Kite", 0.2, 0.2, 0.4, 0.4, 1.0, [](double a) {
    const double along = 0.2 * std::cos(a / 2) + std::sqrt(0.16 - 0.04 * std::pow(std::sin(a / 2), 2));
    const double straight = std::atan2(-0.2 * std::sin(a / 2), along - 0.2 * std::cos(a / 2));  // from the line of symmetry
    return std::pair{a / 2 + straight, a / 2 - straight};
  });
}

// The crank's pin goes through the pivot of the slotted lever, where the lever could turn alone.
Kind slotted_lever() {
  return {"Lever with a slot through its pivot", "O2 = [0, 0]\nO4 = [-0.2, 0]",
          pin("O2", "ground.O2", "crank.O") + pin("O4", "ground.O4", "lever.c") + "[joint.A]\ntype = \"slot\"\nbetween = [\"lever.c\", \"crank.A\"]\n", 1.0,
          {{"crank", "markers.O = [-0.1, 0]\nmarkers.A = [0.1, 0]"}, {"lever", "markers.c = [-0.1, 0]"}},
          [](double a) {
            return std::vector<Pose>{{0.1 * std::cos(a), 0.1 * std::sin(a), a}, {-0.2 + 0.1 * std::cos(a / 2), 0.1 * std::sin(a / 2), a / 2}};
          }};
}

// With a third crank the parallelogram has a redundant constraint.
Kind three_cranks() {
  const auto crank = [](double at, double a) { return Pose{at + 0.1 * std::cos(a), 0.1 * std::sin(a), a}; };
  const std::string bar = "markers.from = [-0.1, 0]\nmarkers.to = [0.1, 0]";
  return {"Parallelogram with three cranks", "O1 = [0, 0]\nO2 = [0.3, 0]\nO3 = [0.5, 0]",
          pin("O1", "ground.O1", "crank.from") + pin("O2", "ground.O2", "second.from") + pin("O3", "ground.O3", "third.from") + pin("A", "crank.to", "coupler.A") + pin("B", "second.to", "coupler.B") +
              pin("C", "third.to", "coupler.C"),
          1.0,
          {{"crank", bar}, {"second", bar}, {"third", bar}, {"coupler", "markers.A = [-0.25, 0]\nmarkers.B = [0.05, 0]\nmarkers.C = [0.25, 0]"}},
          [=](double a) {
            return std::vector<Pose>{crank(0, a), crank(0.3, a), crank(0.5, a), {0.25 + 0.2 * std::cos(a), 0.2 * std::sin(a), 0}};
          }};
}

std::vector<Kind> kinds() { return {equal_slider_crank(), parallelogram(), antiparallelogram(), kite(), slotted_lever(), three_cranks()}; }

double angle_from(double angle) { return std::remainder(angle, 2 * M_PI); }

// Kinetic energy divided by half the square of the crank's speed.
double inertia(const Kind& kind, double angle) {
  constexpr double kStep = 1e-3;
  const std::vector<Pose> p[4] = {kind.branch(angle - 2 * kStep), kind.branch(angle - kStep), kind.branch(angle + kStep), kind.branch(angle + 2 * kStep)};
  double sum = 0;
  for (std::size_t i = 0; i < kind.bars.size(); ++i) {
    const auto slope = [&](double Pose::*of, bool turn) {
      const double inner = p[2][i].*of - p[1][i].*of, outer = p[3][i].*of - p[0][i].*of;
      return (8 * (turn ? angle_from(inner) : inner) - (turn ? angle_from(outer) : outer)) / (12 * kStep);
    };
    sum += std::pow(slope(&Pose::x, false), 2) + std::pow(slope(&Pose::y, false), 2) + 0.01 * std::pow(slope(&Pose::angle, true), 2);
  }
  return sum;
}

double height(const Kind& kind, double angle) {
  double sum = 0;
  for (const Pose& pose : kind.branch(angle)) sum += pose.y;
  return sum;
}

void expect_on_branch(const Kind& kind, double gravity, const Trajectory& run, double within) {
  const double energy = inertia(kind, kind.start) * kSpin * kSpin + 2 * gravity * height(kind, kind.start);
  for (std::size_t row = 0; row < run.n_rows(); ++row) {
    const double angle = reference::value(run, row, "body.crank.angle");
    const std::vector<Pose> at = kind.branch(angle);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const std::string body = "body." + kind.bars[i].name;
      ASSERT_NEAR(reference::value(run, row, body + ".x"), at[i].x, within) << body << row;
      ASSERT_NEAR(reference::value(run, row, body + ".y"), at[i].y, within) << body << row;
      ASSERT_NEAR(angle_from(reference::value(run, row, body + ".angle") - at[i].angle), 0, 10 * within) << body << row;
    }
    ASSERT_NEAR(reference::value(run, row, "body.crank.spin"), std::sqrt((energy - 2 * gravity * height(kind, angle)) / inertia(kind, angle)), 100 * within) << row;
  }
  EXPECT_GT(std::abs(reference::value(run, run.n_rows() - 1, "body.crank.angle") - kind.start), 2.5 * M_PI) << "more than a turn";
}

bool names_singular_positions(const Trajectory& run) {
  return std::any_of(run.notes.begin(), run.notes.end(), [](const std::string& note) { return note.find("singular position at t = ") != std::string::npos; });
}

Trajectory ideal_run_of(const Kind& kind, double gravity) {
  return simulate(parse_model(text(kind, gravity, "duration = 2.5\noutput_step = 0.01\ntolerance = 1e-3\nequations = \"ideal\""), kind.name));
}

TEST(SingularPositionsSlow, IdealJointsGoOnAlongTheSmoothBranch) {
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.name);
    const Trajectory run = ideal_run_of(kind, 0);
    EXPECT_EQ(run.outcome, Outcome::kCompleted) << run.message;
    EXPECT_LT(run.energy.drift, 1e-7 * run.energy.kinetic_peak);
    EXPECT_TRUE(names_singular_positions(run));
    expect_on_branch(kind, 0, run, 1e-7);
  }
}

// Bars that could move alone at the position are held there with lever arms of zero length: reactions to a load across the branch have no bound.
TEST(SingularPositionsSlow, IdealJointsGoOnUnderLoadsToo) {
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.name);
    const Trajectory run = ideal_run_of(kind, 0.5);
    EXPECT_TRUE(run.outcome == Outcome::kCompleted || run.outcome == Outcome::kToleranceNotMet) << run.message;
    EXPECT_LT(run.energy.drift, 1e-7 * run.energy.kinetic_peak);
    EXPECT_TRUE(names_singular_positions(run));
    expect_on_branch(kind, 0.5, run, 1e-7);
  }
}

TEST(SingularPositionsSlow, ReactionsOfAFreeParallelogramAreThoseOfTurningCranks) {
  const Trajectory run = ideal_run_of(parallelogram(), 0);
  for (const LoadSummary& joint : run.joints) {
    const double exact = joint.name == "A" || joint.name == "B" ? 0.5 * kSpin * kSpin * 0.2 : 0.5 * kSpin * kSpin * 0.2 + 0.1 * kSpin * kSpin;
    EXPECT_NEAR(joint.peak, exact, 1e-4 * exact) << joint.name;
    EXPECT_NEAR(joint.rms, exact, 1e-6 * exact) << joint.name;
  }
}

// Each passage leaves the joints ringing at frequencies proportional to the root of the stiffness, and the ringing is resolved.
TEST(SingularPositionsSlow, StiffJointsPassAtMostTwentyTimesAsDearlyAsSoftOnes) {
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.name);
    std::uint64_t steps[2];
    for (int i = 0; i < 2; ++i) {
      Model model = parse_model(text(kind, 0, "duration = 6\noutput_step = 0.01\ntolerance = 1e-3"), kind.name);
      const double stiffness = i == 0 ? 1e8 : 1e10;
      reference::set_joints(model, stiffness, 3e-4 * stiffness / std::sqrt(stiffness / 1e8));
      const Trajectory run = simulate(model);
      EXPECT_EQ(run.outcome, Outcome::kCompleted) << run.message;
      steps[i] = run.counters.steps;
    }
    EXPECT_LT(steps[1], 20 * steps[0]);
    std::printf("%s: %d, %d steps\n", kind.name.c_str(), static_cast<int>(steps[0]), static_cast<int>(steps[1]));
  }
}

}  // namespace
}  // namespace pintle
