// Computes the missing samples and adds them to the journal; when it has all of them, the file is made from it.
#include "pintle/sweep.h"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <thread>
#include <utility>

#include "base/stopwatch.h"
#include "sweeps/run_sweep.h"

namespace pintle {
namespace {

namespace fs = std::filesystem;

constexpr double kBetweenReports = 0.1;  // [s]
constexpr double kBetweenSyncs = 1;      // of work [s] that a power cut may cost
constexpr double kShortWait = 1e-3, kLongWait = 5e-2;  // [s] with other processes to serve, and without

class Collection {
 public:
  Collection(const SweepJob& job, Journal& journal, const SweepObserver& observer, Remote* remote)
      : job_(job), journal_(journal), observer_(observer), remote_(remote), resumed_(journal.n_done()),
        queue_(job.plan().size(), job.samples_per_chunk(), [&journal](std::uint64_t i) { return journal.has(i); }) {}

  /// True if the journal has every sample at the end.
  bool run(int threads) {
    WorkerPool pool(job_, threads, [this] { return queue_.next(); });
    while (true) {
      if (remote_ != nullptr) keep(remote_->serve(queue_));
      keep(pool.take(remote_ != nullptr ? kShortWait : kLongWait));
      sync_now_and_then();
      if (!go_on()) {
        queue_.close();
        pool.stop();
      }
      if (!pool.idle()) continue;
      if (remote_ == nullptr || !remote_->busy()) break;
      std::this_thread::sleep_for(std::chrono::duration<double>(kShortWait));  // lets the other processes compute
    }
    journal_.flush(true);
    report();
    return journal_.n_done() == journal_.n_samples();
  }

  SweepProgress progress() const { return {journal_.n_done(), journal_.n_samples(), resumed_, journal_.n_troubled(), watch_.seconds()}; }

 private:
  // A chunk is computed as a whole; if a kill had split it, only the missing samples are added.
  void keep(const std::vector<FinishedChunk>& finished) {
    for (const FinishedChunk& chunk : finished)
      for (std::size_t k = 0; k < chunk.results.size(); ++k) {
        const std::uint64_t sample = chunk.chunk * queue_.per_chunk() + k;
        if (!journal_.has(sample)) journal_.add(sample, chunk.results[k]);
      }
    if (!finished.empty()) journal_.flush(false);  // a kill costs no finished work
  }

  void sync_now_and_then() {
    if (watch_.seconds() - synced_ < kBetweenSyncs) return;
    synced_ = watch_.seconds();
    journal_.flush(true);
  }

  bool report() { return !observer_ || observer_(progress()); }

  bool go_on() {
    if (stopped_ || watch_.seconds() - reported_ < kBetweenReports) return !stopped_;
    reported_ = watch_.seconds();
    stopped_ = !report();
    return !stopped_;
  }

  const SweepJob& job_;
  Journal& journal_;
  const SweepObserver& observer_;
  Remote* remote_;
  std::uint64_t resumed_;
  ChunkQueue queue_;
  Stopwatch watch_;
  double reported_ = 0, synced_ = 0;
  bool stopped_ = false;
};

// Whether `file` already contains the requested result. Throws if it is something else.
bool finished_before(const fs::path& file, const std::string& plan, bool force) {
  if (force || !fs::exists(file)) return false;
  if (fs::is_directory(file)) throw file_error(file, "write", EISDIR);
  const std::string found = plan_of_sweep_file(file);
  if (found == plan) return true;
  throw FileError(fmt::format("{}: {}.\n    try: another --out, or --force to replace it", file.string(),
                              found.empty() ? "this is not the file of a sweep, or it is damaged"
                                            : "this is the file of another sweep, with other values, another model or other options"));
}

}  // namespace

SweepOutcome run_sweep(const SweepRequest& request, const SweepRun& run, const SweepObserver& observer, Remote* remote) {
  if (!has_hdf5()) throw FileError(run.out.string() + ": " + kNoHdf5);
  const SweepJob job(request);
  const fs::path journal_path = run.out.string() + ".part";
  const std::uint64_t n = job.plan().size();
  if (finished_before(run.out, job.hash(), run.force)) {
    std::error_code ignored;
    fs::remove(journal_path, ignored);  // killed between writing the file and removing the journal
    return {SweepEnd::kFinishedBefore, {n, n, n, 0, 0}};
  }
  Journal journal(journal_path, job.hash(), n, run.force);
  Collection collection(job, journal, observer, remote);
  const bool all = collection.run(usable_threads(run.threads));
  if (!all) return {SweepEnd::kInterrupted, collection.progress()};
  write_sweep_file(run.out, job.origin(run.command), job.plan(), journal);
  journal.remove();
  return {SweepEnd::kFinished, collection.progress()};
}

SweepOutcome sweep(const SweepRequest& request, const SweepRun& run, const SweepObserver& observer) { return run_sweep(request, run, observer, nullptr); }

}  // namespace pintle
