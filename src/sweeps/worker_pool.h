// The threads of one process, each computing one chunk after another.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "sweeps/sweep_job.h"

namespace pintle {

struct FinishedChunk {
  std::uint64_t chunk = 0;
  std::vector<SampleResult> results;
};

/// The number of cores that this process may use, unless `wanted` says otherwise.
int usable_threads(int wanted);

class WorkerPool {
 public:
  /// Every thread calls `next` until it returns nothing. Throws what starting a thread or preparing its computer throws.
  WorkerPool(const SweepJob& job, int threads, std::function<std::optional<std::uint64_t>()> next);
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool();

  /// The chunks finished since the last call; waits for one at most this long [s]. Rethrows an exception of a thread after all finished chunks have been taken.
  std::vector<FinishedChunk> take(double seconds);
  /// No thread is computing any more, everything has been taken, and no thread has thrown.
  bool idle();
  /// Batches under way are abandoned.
  void stop() { stopped_ = true; }

 private:
  void work(ChunkComputer computer);
  void end();

  std::function<std::optional<std::uint64_t>()> next_;
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  std::condition_variable something_;
  std::vector<FinishedChunk> finished_;
  std::exception_ptr error_;
  int working_ = 0;
  std::vector<std::thread> threads_;
};

}  // namespace pintle
