// The cost of space: Bricard's six-hinge linkage for ten seconds, and a planar mechanism computed in the plane and in space.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "bench/commands.h"
#include "bench/pintle_methods.h"
#include "bench/result_table.h"
#include "bench/stopwatch.h"
#include "run/integration.h"
#include "run/pass_constants.h"
#include "run/run_system.h"
#include "tests/spatial_models.h"

namespace pintle::bench {
namespace {

constexpr double kTurn = 0.1;  // time for one mechanism in a round [s], unless a single run takes longer

// A mechanism that is run both as a whole run and as a single pass at the same tolerance.
class Competitor {
 public:
  explicit Competitor(std::string name) : name_(std::move(name)) {}
  virtual ~Competitor() = default;
  // Runs both, often enough for a meaningful median.
  void take_turn() {
    const Stopwatch turn;
    do {
      const Stopwatch pass;
      run_pass();
      pass_times_.add(pass.seconds());
      const Stopwatch whole;
      run_whole();
      whole_times_.add(whole.seconds());
    } while (turn.seconds() < kTurn);
  }
  void add_row(ResultTable& table) const {
    const double steps = static_cast<double>(pass_.steps);
    table.add_row({text(name_), count(steps), number(static_cast<double>(pass_.newton_iterations) / steps, "{:.1f}"), number(1e3 * pass(), "{:.2f}"), number(pass_times_.spread(), "{:.2f}"),
                   count(static_cast<double>(run_.counters.passes)), count(static_cast<double>(run_.counters.steps)), number(1e3 * whole(), "{:.2f}"), number(whole_times_.spread(), "{:.2f}"),
                   number(stated(), "{:.1e}")});
  }
  double pass() const { return pass_times_.median(); }    // [s]
  double whole() const { return whole_times_.median(); }  // [s]

 protected:
  virtual void run_pass() = 0;
  virtual void run_whole() = 0;

  std::string name_;
  Counters pass_;   // of the single pass
  Trajectory run_;  // the whole run

 private:
  double stated() const {
    double largest = 0;
    for (const LoadSummary& joint : run_.joints) largest = std::max(largest, joint.relative_error_estimate);
    return largest;
  }

  Times pass_times_, whole_times_;
};

template <class S>
class CompetitorIn final : public Competitor {
 public:
  CompetitorIn(std::string name, const BasicSystem<S>& system, const BasicState<S>& start, double duration, double tolerance)
      : Competitor(std::move(name)), system_(system), start_(start) {
    settings_.duration = duration;
    settings_.tolerance = tolerance;
    plan_.duration = duration;
    plan_.output_step = duration / 500;
    plan_.first_step = 1e-4 * duration;
    make_pilot();
  }

 private:
  // Obtains the loads and the order that the subsequent pass takes from the pilot.
  void make_pilot() {
    plan_.tolerance = kPilot * settings_.tolerance;
    for (plan_.choice.stages = settings_.tolerance < kTight ? 5 : 3;; plan_.choice.stages = 5) {
      const BasicIntegration<S> pilot = integrate_once();
      scale_ = pilot.scale;
      if (plan_.choice.stages == 5 || static_cast<double>(pilot.counters.newton_iterations) >= kEasy * static_cast<double>(pilot.counters.steps)) break;
    }
    plan_.tolerance = settings_.tolerance;
    plan_.scale = &scale_;
  }
  BasicIntegration<S> integrate_once() const {
    BasicForceRecorder<S> recorder(system_, Recorded::kStates);
    BasicIntegration<S> done = integrate(system_, start_, plan_, recorder);
    if (done.ended != Ended::kAtEnd) throw std::runtime_error(name_ + ": " + done.message);
    return done;
  }
  void run_pass() override { pass_ = integrate_once().counters; }
  void run_whole() override {
    run_ = run_system(system_, start_, settings_).result;
    if (run_.outcome != Outcome::kCompleted) throw std::runtime_error(name_ + ": " + run_.message);
  }

  const BasicSystem<S>& system_;
  const BasicState<S>& start_;
  SimulateSettings settings_;
  BasicIntegrationPlan<S> plan_;
  BasicLoadScale<S> scale_;
};

}  // namespace

nlohmann::ordered_json study_space(const SpaceOptions& options) {
  const sample::SpatialSample ring = sample::bricard(1e9);
  const ReadyModel four_bar(collection_model("four_bar"));
  const sample::SpatialSystem in_space = sample::in_space(four_bar.system);
  const sample::SpatialState start = sample::in_space(in_space, four_bar.start);
  const double turn = four_bar.model.simulate.duration;
  std::vector<std::unique_ptr<Competitor>> all;
  all.push_back(std::make_unique<CompetitorIn<Spatial>>("Bricard's six hinges, 10 s", ring.system, ring.start, 10, options.tolerance));
  all.push_back(std::make_unique<CompetitorIn<Planar>>("four-bar, one turn, in the plane", four_bar.system, four_bar.start, turn, options.tolerance));
  all.push_back(std::make_unique<CompetitorIn<Spatial>>("four-bar, one turn, in space", in_space, start, turn, options.tolerance));
  for (int round = 0; round < options.rounds; ++round)
    for (const auto& one : all) one->take_turn();
  ResultTable table(fmt::format("Space: tolerance {:.0e}, 500 rows", options.tolerance),
                    {{"mechanism", "mechanism", true}, {"steps", "steps"}, {"Newton", "newton_iterations_per_step"}, {"one pass, ms", "pass_milliseconds"}, {"spread", "pass_spread"},
                     {"passes", "passes"}, {"steps of all", "all_steps"}, {"whole run, ms", "run_milliseconds"}, {"spread", "run_spread"}, {"stated error", "stated_error"}});
  for (const auto& one : all) one->add_row(table);
  const Competitor &hinges = *all[0], &flat = *all[1], &deep = *all[2];
  ResultTable targets("Targets", {{"what", "what", true}, {"target", "wanted", true}, {"measured", "measured", true}, {"", "verdict", true}});
  const auto judge = [&targets](const std::string& what, double wanted, double found, const char* unit) {
    targets.add_row({text(what), text(fmt::format("<= {:g} {}", wanted, unit)), text(fmt::format("{:.3g} {}", found, unit)), text(found <= wanted ? "pass" : "not met")});
  };
  judge("Bricard's six hinges, 10 s, one pass", 30, 1e3 * hinges.pass(), "ms");
  judge("Bricard's six hinges, 10 s, whole run", 30, 1e3 * hinges.whole(), "ms");
  judge("Four-bar in space over that of the plane, one pass", 4, deep.pass() / flat.pass(), "times");
  judge("Four-bar in space over that of the plane, whole run", 4, deep.whole() / flat.whole(), "times");
  table.print();
  targets.print();
  return {{"space", table.json()}, {"targets", targets.json()}};
}

}  // namespace pintle::bench
