// A sweep with the help of other processes.
#pragma once

#include <functional>
#include <vector>

#include "pintle/sweep.h"
#include "sweeps/worker_pool.h"

namespace pintle {

/// Processes, perhaps on other machines, that compute for the one that writes.
class Remote {
 public:
  virtual ~Remote() = default;
  /// Gives chunks to those that ask, and returns what they have sent. Never waits.
  virtual std::vector<FinishedChunk> serve(ChunkQueue& queue) = 0;
  /// Some process still computes or has not been told that nothing is left.
  virtual bool busy() const = 0;
};

/// `sweep`, with `remote` if it is not null.
SweepOutcome run_sweep(const SweepRequest& request, const SweepRun& run, const SweepObserver& observer, Remote* remote);

}  // namespace pintle
