#include "bench/sweep_rate.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "analyses/envelope.h"
#include "bench/pintle_methods.h"
#include "bench/stopwatch.h"

namespace pintle::bench {

// The stiffness of one pin goes from half to twice what it is.
double turns_per_second(int turns) {
  const Model base = collection_model("four_bar", {"simulate.tolerance=1e-4"});
  const EnvelopeEngine engine(base, {{}, true});
  std::vector<Variant> variants(turns, Variant{base, false});
  for (int i = 0; i < turns; ++i) variants[i].model.joints[1].law.values["stiffness"] = {1e8 * std::exp2(2.0 * i / turns - 1)};
  const Stopwatch watch;
  for (const SampleResult& result : engine.run(variants, [] { return true; }))
    if (result.status != SampleStatus::kCompleted) throw std::runtime_error("a turn of the four-bar was not completed: " + result.message);
  return turns / watch.seconds();
}

}  // namespace pintle::bench
