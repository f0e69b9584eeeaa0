// A sweep with the help of other processes.
#pragma once

#include <functional>
#include <vector>

#include "pintle/sweep.h"
#include "sweeps/worker_pool.h"

namespace pintle {

/// Processes, possibly on other machines, that compute for the process that writes.
class Remote {
 public:
  virtual ~Remote() = default;
  /// Gives chunks to the processes that ask, and returns the results they have sent. Never waits.
  virtual std::vector<FinishedChunk> serve(ChunkQueue& queue) = 0;
  /// Whether some process is still computing or has not yet been told that nothing is left.
  virtual bool busy() const = 0;
};

/// Like `sweep`, but with the help of `remote` if it is not null.
SweepOutcome run_sweep(const SweepRequest& request, const SweepRun& run, const SweepObserver& observer, Remote* remote);

}  // namespace pintle
