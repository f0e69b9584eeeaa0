// What the numbers were measured on.
#pragma once

#include <nlohmann/json.hpp>

namespace pintle::bench {

/// Processor, cores, compiler, flags, versions of Pintle and of the peers, load of the machine: names and words.
nlohmann::ordered_json describe_machine();

}  // namespace pintle::bench
