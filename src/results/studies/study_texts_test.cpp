// The texts of the studies, from invented results.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "results/studies/check_report.h"
#include "results/studies/compare_report.h"
#include "results/studies/stiffen_report.h"

namespace pintle {
namespace {

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Comparison comparison_with(Cause of_force, Cause of_couple) {
  Comparison c;
  c.against = Equations::kIdeal;
  Difference force, couple;
  force.name = couple.name = "A";
  force.cause = of_force;
  couple.cause = of_couple;
  c.forces = {force};
  c.couples = {couple};
  return c;
}

TEST(CompareText, CausesAreExplainedThatThereAre) {
  const std::string physical = "physical: larger than the error estimates", numerical = "numerical: within the error estimates", undetermined = "not unique: ideal joints";
  const std::string none = compare_text(comparison_with(Cause::kNone, Cause::kNone), "");
  for (const std::string& words : {physical, numerical, undetermined}) EXPECT_FALSE(says(none, words)) << words;
  EXPECT_TRUE(says(compare_text(comparison_with(Cause::kPhysical, Cause::kNone), ""), physical));
  EXPECT_TRUE(says(compare_text(comparison_with(Cause::kNone, Cause::kPhysical), ""), physical));
  EXPECT_TRUE(says(compare_text(comparison_with(Cause::kNumerical, Cause::kNone), ""), numerical));
  EXPECT_TRUE(says(compare_text(comparison_with(Cause::kNotUnique, Cause::kNone), ""), undetermined));
}

TEST(VariantsText, CausesStandBesideLaterRuns) {
  Variants v;
  VariantJoint joint{"A", {}};
  for (const Cause cause : {Cause::kNumerical, Cause::kPhysical}) {
    v.runs.push_back({fmt::format("run {}", v.runs.size()), {}});
    VariantLoad load;
    load.there = true;
    load.cause = cause;
    joint.loads.push_back(load);
  }
  v.joints = {joint};
  const std::string text = variants_text(v);
  EXPECT_TRUE(says(text, "physical: the peaks differ by more")) << text;
  EXPECT_FALSE(says(text, "numerical: the peaks differ")) << text;
  EXPECT_FALSE(says(text, "  numerical\n")) << text;
  EXPECT_TRUE(says(text, "physical\n")) << text;
}

// Changes that decrease fast have a limit, which is stated even if the required digits were not reached.
TEST(StiffenText, LimitsAreStatedWhereTheyAre) {
  Stiffening s;
  for (const double change : {0.3, 0.03, 0.003}) {
    StiffenStep step;
    step.stiffness = 1e6 / change;
    step.change = change;
    s.steps.push_back(step);
  }
  EXPECT_TRUE(says(stiffen_text(s, ""), "Limit of stiff joints"));
  s.steps.back().change = 0.02;
  EXPECT_FALSE(says(stiffen_text(s, ""), "Limit of stiff joints"));
  s.found = true;
  EXPECT_TRUE(says(stiffen_text(s, ""), "Limit of stiff joints"));
}

TEST(CheckText, LongListsAreCutUnlessDetailsAreAsked) {
  CheckReport report;
  CheckLoop loop;
  for (int i = 0; i < 12; ++i) loop.joints.push_back(fmt::format("J{}", i));
  report.topology.loops = {loop};
  EXPECT_FALSE(says(check_text(report, ""), "more"));
  report.topology.loops[0].joints.push_back("J12");
  EXPECT_TRUE(says(check_text(report, ""), "J10 and 2 more\n")) << check_text(report, "");
  EXPECT_FALSE(says(check_text(report, "", true), "more"));
}

}  // namespace
}  // namespace pintle
