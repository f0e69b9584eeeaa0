// The battery: mechanisms of many kinds with random dimensions, joints and loads. A model is a function of seed and number.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/battery/dice.h"
#include "bench/battery/mechanism_text.h"

namespace pintle::bench {

struct MechanismKind {
  std::string word;   // "four-bar"
  std::string about;  // for the table
  MechanismText (*make)(Dice&);
  bool touches = false;  // bodies touch, stick or strike: tolerances down to 1e-4
};

const std::vector<MechanismKind>& mechanism_kinds();

struct RandomMechanism {
  std::string name;  // "four-bar-1-17": kind, seed, number
  const MechanismKind* kind = nullptr;
  std::string text;  // of the model file
};

/// The kinds are used in turn; `kinds` selects some, empty for all.
RandomMechanism random_mechanism(std::uint64_t seed, int number, const std::vector<std::string>& kinds = {});

}  // namespace pintle::bench
