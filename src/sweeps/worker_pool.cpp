#include "sweeps/worker_pool.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace pintle {

int usable_threads(int wanted) { return wanted > 0 ? wanted : std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

WorkerPool::WorkerPool(const SweepJob& job, int threads, std::function<std::optional<std::uint64_t>()> next) : next_(std::move(next)), working_(threads) {
  try {
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this, computer = job.computer()]() mutable { work(std::move(computer)); });
  } catch (...) {  // because the destructor does not run
    end();
    throw;
  }
}

WorkerPool::~WorkerPool() { end(); }

void WorkerPool::end() {
  stop();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerPool::work(ChunkComputer computer) {
  std::exception_ptr error;
  try {
    while (!stopped_) {
      const auto chunk = next_();
      if (!chunk) break;
      std::vector<SampleResult> results = computer.compute(*chunk, [this] { return !stopped_; });
      if (results.empty()) break;
      const std::lock_guard lock(mutex_);
      finished_.push_back({*chunk, std::move(results)});
      something_.notify_one();
    }
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  if (error) error_ = error;
  --working_;
  something_.notify_one();
}

std::vector<FinishedChunk> WorkerPool::take(double seconds) {
  std::unique_lock lock(mutex_);
  const auto wake = [this] { return !finished_.empty() || working_ == 0 || error_; };
  something_.wait_for(lock, std::chrono::duration<double>(seconds), wake);
  if (finished_.empty() && error_) std::rethrow_exception(error_);
  return std::exchange(finished_, {});
}

bool WorkerPool::idle() {
  const std::lock_guard lock(mutex_);
  return working_ == 0 && finished_.empty() && !error_;
}

}  // namespace pintle
