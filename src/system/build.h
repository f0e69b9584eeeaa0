// From a model to a system: names become indices, law words become laws.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "system/system.h"

namespace pintle {

/// The system of a model. Values that depend on the assembled positions (a rod without a stated length, gear phases, free lengths,
/// the start of a constant-speed drive) are still open: `fix_assembled_values` sets them, as every start does (start/start.h). Throws
/// std::invalid_argument for names that do not exist; models from files have been checked before. `like`: a system of which this one may be a variant.
[[nodiscard]] System build_system(const Model& model, const System* like = nullptr);

/// Whether the gap of joint j is unknown before assembly, as for rods without a length, gears, racks and constant-speed drives.
bool is_open(const Model& model, const System& system, int j);

/// `system` with the values that depend on the assembled positions q. `notes` receives a line for each value that was assumed.
[[nodiscard]] System fix_assembled_values(const Model& model, System system, const Vecs& q, std::vector<std::string>& notes);

/// `system` with welds and sliders shifted by whole turns, so that their angle is within half a turn of zero at q.
[[nodiscard]] System unwind(System system, const Vecs& q);

/// `system` with more joints appended to its own.
[[nodiscard]] System with_joints(const System& system, const std::vector<JointData>& joints);

}  // namespace pintle
