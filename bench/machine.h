// The machine on which the numbers were measured.
#pragma once

#include <nlohmann/json.hpp>

namespace pintle::bench {

/// Processor, cores, compiler, flags, versions of Pintle and of the peers, load of the machine: names and descriptions.
nlohmann::ordered_json describe_machine();

}  // namespace pintle::bench
