#include "bench/stored_truths.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace pintle::bench {
namespace {

constexpr double kSameStart = 1e-9;

// Kinetic energy at the start [J], used to detect a changed start, which has another truth.
double energy_of(const Problem& problem) { return problem.system->kinetic(problem.start->v); }

std::filesystem::path file_of(const std::string& name) { return std::filesystem::path(PINTLE_SOURCE_DIR) / "bench" / "truths" / (name + ".json"); }

}  // namespace

std::optional<StoredTruth> read_truth(const std::string& name, const Problem& problem) {
  std::ifstream file(file_of(name));
  if (!file) return std::nullopt;
  const nlohmann::json stored = nlohmann::json::parse(file);
  const auto& rows = stored.at("t, x, y");
  const double energy = energy_of(problem);
  if (rows.size() != problem.outputs.size() || std::abs(stored.at("kinetic energy at the start [J]").get<double>() - energy) > kSameStart * energy) return std::nullopt;
  StoredTruth truth{stored.at("method"), stored.at("difference [m]"), Samples(*problem.system, problem.point)};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (std::abs(rows[i][0].get<double>() - problem.outputs[i]) > 1e-9 * problem.outputs.back()) return std::nullopt;
    truth.places.add_place({rows[i][1].get<double>(), rows[i][2].get<double>()});
  }
  return truth;
}

void write_truth(const std::string& name, const Problem& problem, const StoredTruth& truth) {
  auto rows = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < problem.outputs.size(); ++i) {
    const Planar::Point& p = truth.places.places()[i];
    rows.push_back(nlohmann::ordered_json::array({problem.outputs[i], p.x(), p.y()}));
  }
  std::filesystem::create_directories(file_of(name).parent_path());
  std::ofstream file(file_of(name));
  file << "{\n\"method\": " << nlohmann::json(truth.method) << ",\n\"difference [m]\": " << truth.place_doubt << ",\n\"kinetic energy at the start [J]\": " << nlohmann::json(energy_of(problem)) << ",\n\"t, x, y\": [\n";
  for (std::size_t i = 0; i < rows.size(); ++i) file << rows[i].dump() << (i + 1 < rows.size() ? ",\n" : "\n");
  file << "]\n}\n";
  if (!file.flush()) throw std::runtime_error("cannot write " + file_of(name).string());
}

}  // namespace pintle::bench
