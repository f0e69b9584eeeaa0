// How many variants of a model one core integrates, as `pintle sweep` does where errors are estimated for one sample only.
#pragma once

#include <string>

namespace pintle::bench {

struct SweepRate {
  double per_second = 0;       // variants, of one core's time
  double alone_per_second = 0;  // the same with every variant in a run of its own
  double difference = 0;       // of any joint's peak between the two, over the largest it has in any variant
  double aboard = 0;           // share of the variants that went in batches
};

/// Variants of a model of the collection at a tolerance: stiffness of one joint from half to twice, mass of one body by a tenth either
/// way. Both ways in turns; medians of `rounds`.
SweepRate measure_sweep_rate(const std::string& model, double tolerance, int variants, int rounds);

/// Turns of the four-bar's crank per second of a core's time, at tolerance 1e-4, with the peak of every joint force.
double turns_per_second(int turns);

}  // namespace pintle::bench
