// Variants similar to their base, in batches of eight in register lanes: start, steps of the base's lengths, peaks of
// the joint forces. A variant that does not qualify, or would need shorter steps, reports it and is left to `lean_run`.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "analyses/lean_run.h"
#include "fleet/fleet_mechanism.h"
#include "integrators/load_scale.h"

namespace pintle {

/// How the base is integrated, and with it the variants.
struct FleetPlan {
  System base;
  double duration = 0, output_step = 0, max_step = 0;  // [s]
  double wanted = 0;                                   // tolerance of the forces
  double tolerance = 0, of_newton = 0;                 // of the steps, of the iterations in them
  double most_error = 0;                               // of a variant's steps, over their tolerance
  double span = 0;                                     // over which the joints are smooth at the start, of the duration
  int sweeps = 2;                                      // of their motion there
  double slack = 1;                                    // the base's joints may be so much slower without being soft
  LoadScale scale;
  std::vector<FleetStep> steps;
};

/// None where `base` is of a kind, or has a start, that a fleet does not take, or where its fleet's peaks are not those of `run`, the
/// checked run that the lesson is from.
std::optional<FleetPlan> plan_fleet(const Model& base, const RunLesson& lesson, const Trajectory& run);

struct FleetResult {
  bool good = false;  // otherwise the rest says nothing
  double unsettled = 0;  // what another sweep would change at the start, relative
  double error = 0;   // the largest of a step, over the tolerance of steps
  int iterations = 0;  // of the step that took most, in this lane or another
  struct Peak {
    double force = 0, time = 0, couple = 0;  // [N], [s], [N*m]
  };
  std::vector<Peak> joints;
};

class FleetWork;

class Fleet {
 public:
  explicit Fleet(const FleetPlan& plan);
  ~Fleet();

  /// Whether the plan can serve this variant at all.
  bool takes(const Model& variant) const;
  /// Assembles a variant into a lane. False where that is not one for a fleet. Throws AssemblyError.
  bool put(int lane, const Model& variant);
  /// All lanes that something was put into since the last time.
  std::array<FleetResult, kFleet> run();

 private:
  bool is_like_base(const System& variant) const;

  const FleetPlan& plan_;
  std::array<System, kFleet> variant_;
  std::unique_ptr<FleetWork> work_;
  std::array<bool, kFleet> filled_{};
};

/// Fleets of one plan for as many threads as ask: to make one takes as long as to run it.
class FleetPool {
 public:
  explicit FleetPool(FleetPlan plan) : plan_(std::move(plan)) {}
  const FleetPlan& plan() const { return plan_; }
  std::unique_ptr<Fleet> borrow();
  void give_back(std::unique_ptr<Fleet> fleet);

 private:
  const FleetPlan plan_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Fleet>> idle_;
};

}  // namespace pintle
