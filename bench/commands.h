// The sub-commands: each prints its tables and returns them as JSON.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace pintle::bench {

struct PeerOptions {
  int repetitions = 9;
  bool all_methods = true;  // otherwise only the best few
};
nlohmann::ordered_json compare_peers(const PeerOptions& options);

struct CurveOptions {
  std::vector<std::string> problems;  // empty: all
  bool quick = false;    // fewer problems and rounds, a smaller cap: about a minute
  bool details = false;  // print every run
  int rounds = 3;
  double cap = 10;       // seconds for any run
  std::string folder;    // for pictures and the page; empty: none are written
};
nlohmann::ordered_json measure_curves(const CurveOptions& options);

/// Recomputes bench/truths.
void store_truths(const std::vector<std::string>& problems, double tolerance);

/// Compared with the last release recorded; if `record_as` names a version, it is added to the record.
nlohmann::ordered_json count_instructions(const std::string& record_as);

struct StiffnessOptions {
  std::vector<double> stiffness{1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12};
  std::vector<double> damping{0, 3e3, 1e5};
  double tolerance = 1e-5;
  int repetitions = 5;
};
nlohmann::ordered_json study_stiffness(const StiffnessOptions& options);

struct ForceOptions {
  std::vector<std::string> models;  // empty: the whole collection
  std::vector<double> tolerances{1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
  double cap = 60;           // seconds for each run
  double negligible = 1e-4;  // fraction of the largest force: a joint with less is measured by this
  bool every_joint = false;
};
nlohmann::ordered_json study_forces(const ForceOptions& options);

struct ScaleOptions {
  std::vector<std::string> shapes{"ladder"};  // chain, tree, ladder, grid
  std::vector<int> sizes{40, 400, 4000, 40000};
  std::vector<int> grid_sizes{10, 20, 50};
  int steps = 20;
  bool verbose = false;  // a line on standard error after each model
};
nlohmann::ordered_json study_scale(const ScaleOptions& options);

struct SweepOptions {
  std::vector<std::string> models{"four_bar", "trammel", "pendulum", "weld_beam", "andrews"};
  std::vector<double> tolerances{1e-3, 1e-4, 1e-5};
  int variants = 240, rounds = 3;
};
nlohmann::ordered_json study_sweeps(const SweepOptions& options);

struct SpaceOptions {
  double tolerance = 1e-5;
  int rounds = 15;
};
/// Mechanisms in space, and the four-bar in the plane and in space, run alternately.
nlohmann::ordered_json study_space(const SpaceOptions& options);

struct RealJointOptions {
  std::vector<double> tolerances{1e-3, 1e-5};
  int rounds = 5;
  double cap = 20;  // seconds for a run of the peer
};
/// Clearance and friction compared with the same mechanisms without them, and with a general stiff solver.
nlohmann::ordered_json study_real_joints(const RealJointOptions& options);

/// Ways to enforce constraints on the four-bar: joint forces by penalties and by the augmented Lagrangian, compared with Pintle's own.
nlohmann::ordered_json study_constraints();

/// Spectral radius of a step for motions across taut joints, plotted to `file`.
nlohmann::ordered_json study_stability(const std::string& file);

struct BatteryOptions {
  int count = 240, first = 0;      // number of models, and the number of the first
  std::uint64_t seed = 1;
  std::vector<std::string> kinds;  // empty: all
  double time = 0;                 // no model is started after this many seconds; 0: no limit
  double truth = 1e-7;             // tolerance of the runs that serve as reference
  double cap = 20;                 // processor time of a run [s]; three times that for its truth
  std::string folder;              // for the tables and the models that broke a promise; empty: none are written
  bool verbose = false;            // names each model on standard error
};
/// Random mechanisms: true error compared with stated error, joint by joint.
nlohmann::ordered_json run_battery(const BatteryOptions& options);

/// Google Benchmark; `filter` is a regular expression. An empty `json_file` writes none.
void run_micro(const std::string& filter, double min_time, const std::string& json_file);

}  // namespace pintle::bench
