// The threads of one process, each computing one chunk after the other.
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

/// As many as there are cores that this process may use.
int usable_threads(int wanted);

class WorkerPool {
 public:
  /// Every thread calls `next` until it gives nothing. Throws what starting a thread or preparing its computer throws.
  WorkerPool(const SweepJob& job, int threads, std::function<std::optional<std::uint64_t>()> next);
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool();

  /// What is finished since the last call; waits for it at most so long [s]. Rethrows what a thread threw, after everything that is finished has been taken.
  std::vector<FinishedChunk> take(double seconds);
  /// No thread computes any more, and everything has been taken, nothing thrown among it.
  bool idle();
  /// Batches under way are given up.
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
