// Random mechanisms keep their promises, and so do those that once broke one. theory/time section 6, docs/battery.md.
#include "bench/battery/battery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <vector>

#include "pintle/read_model.h"

namespace pintle::bench {
namespace {

namespace fs = std::filesystem;

TEST(RandomMechanisms, AreAFunctionOfSeedAndNumberAndNothingIsWrongWithThem) {
  const int kinds = static_cast<int>(mechanism_kinds().size());
  std::set<std::string> texts;
  for (int number = 0; number < 4 * kinds; ++number) {
    const RandomMechanism m = random_mechanism(5, number);
    EXPECT_EQ(m.text, random_mechanism(5, number, {m.kind->word}).text);
    EXPECT_NO_THROW(parse_model(m.text, m.name + ".toml")) << m.text;
    texts.insert(m.text.substr(m.text.find("[simulate]")));
  }
  EXPECT_EQ(texts.size(), static_cast<std::size_t>(4 * kinds));
  EXPECT_NE(random_mechanism(6, 0).text, random_mechanism(5, 0).text);
  EXPECT_THROW(random_mechanism(5, 0, {"perpetuum-mobile"}), std::invalid_argument);
}

// The crank of this mechanism ends 0.02 m from where the rocker would turn: no dyad joins them.
TEST(RandomMechanisms, BeginAgainWhereTheNumbersLeaveNoPlace) {
  EXPECT_NE(random_mechanism(2, 48, {"clearance"}).text, "");
}

// Dice are the same on every machine: 2^53 equally likely numbers from a counter.
TEST(RandomMechanisms, DrawTheirNumbersInOrder) {
  Dice dice(7, 3);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(dice.uniform(0, 1), uniform_number(7, 3, static_cast<std::uint64_t>(i)));
  EXPECT_NEAR(Dice(7, 3).log_uniform(1, 100), std::pow(100, uniform_number(7, 3, 0)), 1e-12);
  std::vector<int> seen(3);
  for (int i = 0; i < 300; ++i) ++seen[static_cast<std::size_t>(dice.integer(0, 2))];
  for (const int n : seen) EXPECT_GT(n, 60);
}

BatteryLimits quick() {
  BatteryLimits limits;
  limits.truth_tolerance = 1e-6;
  return limits;
}

std::string description(const MeasuredRun& run) {
  std::ostringstream out;
  out << run.name << " at " << run.tolerance << ": " << fault_of(run).what << ", joint " << run.worst.joint << ", error " << run.worst.error << ", stated " << run.worst.estimate << "; " << run.message;
  return out.str();
}

// One of each kind without contacts, and without blades, whose forces take long to compute. The findings of the whole battery are in docs/battery.md.
TEST(BatterySlow, KeepsItsPromises) {
  std::vector<std::string> kinds;
  for (const MechanismKind& kind : mechanism_kinds())
    if (!kind.touches && kind.word != "flexures") kinds.push_back(kind.word);
  BatteryTally tally;
  for (int number = 0; number < static_cast<int>(kinds.size()); ++number) {
    const RandomMechanism mechanism = random_mechanism(4, number, kinds);
    const TrueMotion truth = true_motion(mechanism, quick());
    for (const double tolerance : {1e-3, 1e-4}) {
      const MeasuredRun run = measured_run(mechanism, truth, tolerance, quick());
      EXPECT_FALSE(run.broke_its_promise()) << description(run);
      tally.add(run);
    }
  }
  EXPECT_EQ(tally.runs, 2 * static_cast<int>(kinds.size()));
  EXPECT_EQ(tally.over + tally.missed + tally.failed + tally.hung + tally.refused + tally.other, 0);
  EXPECT_GE(tally.judged, 9 * tally.runs / 10);
  EXPECT_LE(tally.too_little, tally.runs / 10);
}

std::vector<RandomMechanism> once_broken() {
  std::vector<RandomMechanism> models;
  for (const auto& entry : fs::directory_iterator(fs::path(PINTLE_SOURCE_DIR) / "tests" / "models" / "battery")) {
    std::ifstream file(entry.path());
    std::ostringstream text;
    text << file.rdbuf();
    models.push_back({entry.path().stem().string(), &mechanism_kinds().front(), text.str()});
  }
  std::sort(models.begin(), models.end(), [](const RandomMechanism& a, const RandomMechanism& b) { return a.name < b.name; });
  return models;
}

// Starts of redundant joints that diverged, passes that were equal where it mattered, steps that no tolerance shortened.
TEST(BatterySlow, ModelsThatOnceBrokeAPromiseKeepIt) {
  const std::vector<RandomMechanism> models = once_broken();
  EXPECT_GE(models.size(), 10u);
  for (const RandomMechanism& mechanism : models) {
    const TrueMotion truth = true_motion(mechanism, quick());
    EXPECT_TRUE(truth.usable) << mechanism.name << truth.refused << truth.dense.message;
    for (const double tolerance : {1e-3, 1e-4}) {
      const MeasuredRun run = measured_run(mechanism, truth, tolerance, quick());
      EXPECT_EQ(run.ended, MeasuredRun::Ended::kFinished) << description(run);
      EXPECT_EQ(run.outcome, Outcome::kCompleted) << description(run);
      EXPECT_FALSE(run.over()) << description(run);
    }
  }
}

}  // namespace
}  // namespace pintle::bench
