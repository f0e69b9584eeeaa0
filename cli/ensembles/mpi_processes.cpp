#include "cli/ensembles/mpi_processes.h"

#include <mpi.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "pintle/complaint.h"
#include "sweeps/sample_bytes.h"

namespace pintle::cli {
namespace {

// A process asks with what it has finished (frames, perhaps none) after the number of batches it can take; the answer is a list of
// batches. An empty list means that nothing is left.
constexpr int kAsk = 1, kAnswer = 2;
constexpr std::uint64_t kBatchesPerThread = 2;
constexpr double kWait = 1e-3;  // [s]

std::string receive(int source, int tag, const MPI_Status& status) {
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  MPI_Recv(bytes.data(), size, MPI_BYTE, source, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return bytes;
}

void send(int to, int tag, const void* bytes, std::size_t size) { MPI_Send(bytes, static_cast<int>(size), MPI_BYTE, to, tag, MPI_COMM_WORLD); }

std::vector<FinishedBatch> batches_of(std::string_view bytes) {
  std::vector<FinishedBatch> out;
  for (std::size_t at = 0; at < bytes.size();) {
    auto frame = read_frame(bytes, at);
    if (!frame) throw std::runtime_error("a message between processes is damaged");
    const std::uint64_t batch = frame->sample / kSamplesPerBatch;
    if (out.empty() || out.back().batch != batch) out.push_back({batch, {}});
    out.back().results.push_back(std::move(frame->result));
  }
  return out;
}

// Computes the listed batches on all threads.
std::string compute(const SweepJob& job, int threads, const std::vector<std::uint64_t>& batches) {
  std::mutex mutex;
  std::size_t given = 0;
  const auto next = [&]() -> std::optional<std::uint64_t> {
    const std::lock_guard lock(mutex);
    return given < batches.size() ? std::optional(batches[given++]) : std::nullopt;
  };
  std::string bytes;
  Crew crew(job, threads, next);
  while (!crew.idle())
    for (const FinishedBatch& batch : crew.take(1))
      for (std::size_t k = 0; k < batch.results.size(); ++k) append_frame(bytes, batch.batch * kSamplesPerBatch + k, batch.results[k]);
  return bytes;
}

}  // namespace

bool started_by_mpi() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

MpiProcesses::MpiProcesses() {
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

MpiProcesses::~MpiProcesses() { MPI_Finalize(); }

void MpiProcesses::share(std::string& text) const {
  std::uint64_t size = text.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  text.resize(size);
  MPI_Bcast(text.data(), static_cast<int>(size), MPI_BYTE, 0, MPI_COMM_WORLD);
}

void MpiProcesses::abort(int exit_code) const {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::abort();
}

std::vector<FinishedBatch> MpiProcesses::serve(BatchQueue& queue) {
  std::vector<FinishedBatch> out;
  while (true) {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, kAsk, MPI_COMM_WORLD, &there, &status);
    if (there == 0) return out;
    const std::string bytes = receive(status.MPI_SOURCE, kAsk, status);
    std::uint64_t wanted = 0;
    std::memcpy(&wanted, bytes.data(), sizeof wanted);
    for (FinishedBatch& batch : batches_of(std::string_view(bytes).substr(sizeof wanted))) out.push_back(std::move(batch));
    std::vector<std::uint64_t> given;
    while (given.size() < wanted) {
      const auto batch = queue.next();
      if (!batch) break;
      given.push_back(*batch);
    }
    if (given.empty()) ++dismissed_;
    send(status.MPI_SOURCE, kAnswer, given.data(), given.size() * sizeof given[0]);
  }
}

void MpiProcesses::dismiss() {
  BatchQueue nothing(0, [](std::uint64_t) { return true; });
  while (busy()) {
    serve(nothing);
    std::this_thread::sleep_for(std::chrono::duration<double>(kWait));
  }
}

void MpiProcesses::work(const SweepRequest& request, int threads) const {
  std::optional<SweepJob> job;
  try {
    job.emplace(request);
  } catch (const InputError&) {  // the first one has found the same, and says so
  }
  std::string message(sizeof(std::uint64_t), '\0');
  while (true) {
    const std::uint64_t wanted = job ? kBatchesPerThread * static_cast<std::uint64_t>(threads) : 0;
    std::memcpy(message.data(), &wanted, sizeof wanted);
    send(0, kAsk, message.data(), message.size());
    MPI_Status status;
    for (int there = 0; there == 0;) {  // MPI's own waiting would keep a core busy
      MPI_Iprobe(0, kAnswer, MPI_COMM_WORLD, &there, &status);
      if (there == 0) std::this_thread::sleep_for(std::chrono::duration<double>(kWait));
    }
    const std::string bytes = receive(0, kAnswer, status);
    std::vector<std::uint64_t> batches(bytes.size() / sizeof(std::uint64_t));
    if (batches.empty()) return;
    std::memcpy(batches.data(), bytes.data(), bytes.size());
    message.assign(sizeof(std::uint64_t), '\0');
    message += compute(*job, threads, batches);
  }
}

}  // namespace pintle::cli
