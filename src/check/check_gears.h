// Speed ratios of gear pairs and racks, and of whole trains.
#pragma once

#include <string>
#include <vector>

#include "pintle/check.h"
#include "system/system.h"

namespace pintle {

std::vector<CheckGear> check_gears(const System& system);

struct TrainCheck {
  std::string reference;  // "joint.coordinate"; empty: nothing to report
  std::vector<CheckTransmission> ratios;
};

/// Rates of all joints per unit rate of a driven (else of the first) coordinate at positions q, for a mechanism with
/// gears and a single degree of freedom.
TrainCheck check_train(const Model& model, const System& system, const Vecs& q, const CheckMobility& mobility);

}  // namespace pintle
