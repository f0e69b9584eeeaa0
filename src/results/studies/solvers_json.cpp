// The comparison of the integration methods as JSON.
#include <cmath>
#include <nlohmann/json.hpp>

#include "results/studies/solvers_report.h"

namespace pintle {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSolversFormat = 1;

Json known(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json run_json(const SolverRun& r) {
  return {{"method", r.method},
          {"tolerance", r.tolerance},
          {"outcome", to_text(r.end)},
          {"message", r.message},
          {"t_end", r.t_end},
          {"steps", r.steps},
          {"rejected", r.rejected},
          {"evaluations", r.evaluations},
          {"newton_iterations", r.newton_iterations},
          {"factorizations", r.factorizations},
          {"wall_seconds", r.seconds},
          {"force_error", known(r.force_error)},
          {"worst_joint", r.worst_joint},
          {"position_error", known(r.position_error)},
          {"angle_error", known(r.angle_error)},
          {"vibration", known(r.vibration)},
          {"vibration_of_peak", known(r.vibration_of_peak)},
          {"vibrating_joint", r.vibrating_joint},
          {"energy_drift", known(r.energy_drift)}};
}

}  // namespace

std::string solvers_json(const SolverStudy& study, const std::string& model_name, const std::string& model_path) {
  Json runs = Json::array(), orders = Json::array();
  for (const SolverRun& run : study.runs) runs.push_back(run_json(run));
  for (const SolverOrder& order : study.orders)
    orders.push_back({{"method", order.method}, {"order", known(order.order)}, {"runs", order.runs}});
  const SolverTruth& t = study.truth;
  const Json out{{"pintle_solvers", kSolversFormat},
                 {"model_name", model_name},
                 {"model_path", model_path},
                 {"duration", study.duration},
                 {"output_step", study.output_step},
                 {"window", study.window},
                 {"slowest_vibration", study.slowest_vibration},
                 {"truth",
                  {{"method", t.method},
                   {"tolerance", t.tolerance},
                   {"error_estimate", known(t.error_estimate)},
                   {"complete", t.complete},
                   {"message", t.message},
                   {"wall_seconds", t.seconds}}},
                 {"runs", runs},
                 {"orders", orders},
                 {"notes", study.notes},
                 {"interrupted", study.interrupted}};
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pintle
