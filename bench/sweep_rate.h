// How many variants of a model one core integrates, as `pintle sweep` does where errors are estimated for one sample only.
#pragma once

namespace pintle::bench {

/// Turns of the four-bar's crank per second of a core's time, at tolerance 1e-4, with the peak of every joint force.
double turns_per_second(int turns);

}  // namespace pintle::bench
