// Plans: the notation for users, the order of the samples, and the complaints about mistakes.
#include "sweeps/plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "io/reading/overrides.h"
#include "sweeps/sweep_job.h"
#include "sweeps/sweep_models_for_tests.h"

namespace pintle {
namespace {

using sample::contains;
using sample::request;

SweepPlan plan_of(const SweepRequest& r) { return SweepJob(r).plan(); }

std::string complaint_about(const SweepRequest& r) {
  try {
    SweepJob job(r);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(SweepPlan, RangesKeepTheirEndsAndUnits) {
  const SweepPlan log = plan_of(request({"joint.pin.stiffness=1e6..1e9 N/m:log:4"}));
  ASSERT_EQ(log.size(), 4u);
  EXPECT_EQ(log.values(0), std::vector<double>{1e6});
  EXPECT_NEAR(log.values(1)[0], 1e7, 1e-6);
  EXPECT_EQ(log.values(3), std::vector<double>{1e9});
  const SweepPlan lin = plan_of(request({"body.bob.angle=-90..90 deg:lin:3"}));
  EXPECT_DOUBLE_EQ(lin.values(0)[0], -std::acos(0.0));
  EXPECT_EQ(lin.values(1)[0], 0);
  EXPECT_EQ(plan_of(request({"joint.pin.stiffness=1 kN/mm,2,3 N/mm"})).values(1)[0], 2000);
  EXPECT_EQ(plan_of(request({"parameters.length=length/2, length"})).values(0)[0], 0.5);
}

TEST(SweepPlan, ALogarithmicRangeWantsOneSign) {
  const std::string text = complaint_about(request({"body.bob.angle=-1..2:log:4"}));
  EXPECT_TRUE(contains(text, "both ends of a logarithmic range must have the same sign")) << text;
  EXPECT_TRUE(contains(text, "try: body.bob.angle=-1..2:lin:4\n")) << text;
}

// Numbers in [simulate], in joint defaults, parameters, and in named things.
TEST(SweepPlan, PathsLeadToNumbers) {
  EXPECT_EQ(plan_of(request({"defaults.joint.stiffness=1e6,2e6"})).values(1)[0], 2e6);
  EXPECT_EQ(plan_of(request({"simulate.tolerance=1e-4,1e-5"})).values(0)[0], 1e-4);
  for (const char* wrong : {"defaults.joint=1,2", "defaults.pin.stiffness=1,2", "simulate=1,2", "parameters.length.long=1,2", "joint.pin=1,2", "variation.a.b=1,2"})
    EXPECT_TRUE(contains(complaint_about(request({wrong})), "this is not the path of a number")) << wrong << complaint_about(request({wrong}));
}

TEST(SweepPlan, AFrequencyIsNoSpeed) {
  EXPECT_TRUE(contains(complaint_about(request({"body.bob.spin=5,10 Hz"})), "would count radians, not turns"));
  EXPECT_EQ(complaint_about(request({"body.bob.spin=5,10 rad/s"})), "");
}

// Of the last and of the first sample, and of those between.
TEST(SweepPlan, SeriesNeedTheSameTimesInEverySample) {
  for (const char* durations : {"simulate.duration=0.05,0.1 s", "simulate.duration=0.1,0.05,0.1 s"}) {
    SweepRequest r = request({durations});
    r.series = {"joint.pin.on_bob.fx[world]"};
    EXPECT_TRUE(contains(complaint_about(r), "series need the same ones in every sample")) << complaint_about(r);
  }
}

TEST(SweepPlan, TheLastVaryRunsFastest) {
  const SweepPlan plan = plan_of(request({"body.bob.mass=1,2", "joint.pin.damping=10,20,30"}));
  ASSERT_EQ(plan.size(), 6u);
  EXPECT_EQ(plan.values(0), (std::vector<double>{1, 10}));
  EXPECT_EQ(plan.values(1), (std::vector<double>{1, 20}));
  EXPECT_EQ(plan.values(5), (std::vector<double>{2, 30}));
  SweepRequest side = request({"body.bob.mass=1,2", "joint.pin.damping=10,20"});
  side.zip = true;
  EXPECT_EQ(plan_of(side).size(), 2u);
  EXPECT_EQ(plan_of(side).values(1), (std::vector<double>{2, 20}));
}

TEST(SweepPlan, DrawsDependOnSeedPathAndNumberAlone) {
  SweepRequest r = request({});
  r.samples = 50;
  const SweepPlan alone = plan_of(r);
  EXPECT_EQ(alone.paths(), (std::vector<std::string>{"joint.pin.stiffness", "parameters.length"}));
  r.vary = {"body.bob.mass=1,2"};
  const SweepPlan grid = plan_of(r);
  ASSERT_EQ(grid.size(), 100u);
  EXPECT_EQ(grid.values(53)[0], 2);
  EXPECT_EQ(grid.values(53)[1], alone.values(3)[0]);
  r.samples = 70;
  r.vary.clear();
  EXPECT_EQ(plan_of(r).values(3), alone.values(3));
  r.seed = 2;
  EXPECT_NE(plan_of(r).values(3), alone.values(3));
}

TEST(SweepPlan, ALatinHypercubeHasOneDrawInEveryStratum) {
  SweepRequest r = request({});
  r.samples = 200;
  r.latin = true;
  const SweepPlan plan = plan_of(r);
  std::set<int> strata;
  for (std::uint64_t i = 0; i < r.samples; ++i) strata.insert(static_cast<int>((plan.values(i)[1] - 0.5) * 200));  // uniform from 0.5 to 1.5
  EXPECT_EQ(strata.size(), 200u);
}

TEST(SweepPlan, SaysWhatIsWrong) {
  const auto says = [](const std::string& vary, std::string_view part) {
    const std::string text = complaint_about(request({vary}));
    EXPECT_TRUE(contains(text, part)) << vary << "\n" << text;
    EXPECT_TRUE(contains(text, "--vary:1:")) << text;
  };
  says("joint.pin.stiffness", "PATH=FROM..TO");
  says("joint.pin.stifness=1,2", "stiffness");
  says("joint.pn.stiffness=1,2", "pin");
  says("joint.pin.stiffness=1e6..1e9 N:log:3", "stiffness [N/m] is expected");
  says("joint.pin.stiffness=1e6..1e9", "needs a spacing");
  says("joint.pin.stiffness=1e6:1e9:log:16", "two dots between its ends");
  says("joint.pin.stiffness=1e6..1e9:cubic:3", "lin or log");
  says("joint.pin.stiffness=1e6..1e9:log:1", "whole number");
  says("joint.pin.damping=0..1e3:log:3", "the same sign");
  says("body.bob.mass=-1,1", "outside the range");
  says("body.bob.position=1,2", "one number");
  says("parameters.width=1,2", "no parameter");
  says("length=1,2", "path of a number");
  says("variation.x.mean=1,2", "path of a number");
}

TEST(SweepPlan, SaysWhatIsMissing) {
  EXPECT_TRUE(contains(complaint_about(request({})), "--vary or --sample"));
  SweepRequest none = request({});
  none.model_text = sample::pendulum_with("");
  none.samples = 5;
  EXPECT_TRUE(contains(complaint_about(none), "has none"));
  EXPECT_TRUE(contains(complaint_about(request({"body.bob.mass=1,2", "body.bob.mass=3,4"})), "in two ways"));
  SweepRequest uneven = request({"body.bob.mass=1,2", "joint.pin.damping=1,2,3"});
  uneven.zip = true;
  EXPECT_TRUE(contains(complaint_about(uneven), "same number of values"));
  SweepRequest times = request({"simulate.duration=0.1,0.2"});
  EXPECT_EQ(complaint_about(times), "");
  times.series = {"body.bob.x"};
  EXPECT_TRUE(contains(complaint_about(times), "output times"));
  times.series = {"body.bob.z"};
  EXPECT_TRUE(contains(complaint_about(times), "did you mean"));
}

TEST(SweepPlan, VariationsOfTheFileAreChecked) {
  const auto says = [](const std::string& variation, std::string_view part) {
    SweepRequest r = request({});
    r.samples = 3;
    r.model_text = sample::pendulum_with(variation);
    const std::string text = complaint_about(r);
    EXPECT_TRUE(contains(text, part)) << variation << "\n" << text;
    EXPECT_TRUE(contains(text, "pendulum.toml:")) << text;
  };
  const auto pin = [](const std::string& values) { return "[variation.\"joint.pin.stiffness\"]\n" + values; };
  says(pin("distribution = \"normal\"\nmean = 1e8\n"), "deviation");
  says(pin("distribution = \"gauss\"\n"), "normal, lognormal");
  says(pin("distribution = \"uniform\"\nfrom = \"1 N\"\nto = 3\n"), "stiffness [N/m] is expected");
  says(pin("distribution = \"uniform\"\nfrom = 3\nto = 2\n"), "empty");
  says(pin("distribution = \"uniform\"\nfrom = -3\nto = 2\n"), "cannot have this value");
  says(pin("distribution = \"uniform\"\nfrom = 1\nto = 2\nmean = 1\n"), "does not use it");
  says(pin("distribution = \"triangular\"\nfrom = 1\nto = 2\nmode = 3\n"), "between from and to");
  says(pin("distribution = \"normal\"\nmean = -1e8\ndeviation = 1e6\n"), "almost none");
  says("[variation.\"joint.pin.clearance\"]\ndistribution = \"uniform\"\nfrom = 1\nto = 2\n", "clearance");  // of a law that the joint does not have: nothing could be drawn
  says("[variation.\"joint.pn.stiffness\"]\ndistribution = \"uniform\"\nfrom = 1\nto = 2\n", "pin");
}

}  // namespace
}  // namespace pintle
