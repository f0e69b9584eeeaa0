// How many variants of a model one core integrates, as in `pintle sweep` if errors are estimated for only one sample.
#pragma once

#include <string>

namespace pintle::bench {

struct SweepRate {
  double per_second = 0;       // variants per second of one core's time
  double alone_per_second = 0;  // the same with a separate run for every variant
  double difference = 0;       // difference of any joint's peak between the two, relative to its largest peak in any variant
  double aboard = 0;           // fraction of the variants that were computed in batches
};

/// Variants of a model of the collection at a tolerance: stiffness of one joint from half to twice its value, mass of one body within a
/// tenth either way. Batches and separate runs alternate; medians of `rounds`.
SweepRate measure_sweep_rate(const std::string& model, double tolerance, int variants, int rounds);

/// Turns of the four-bar's crank per second of a core's time, at tolerance 1e-4, with the peak of every joint force.
double turns_per_second(int turns);

}  // namespace pintle::bench
