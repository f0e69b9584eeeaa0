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
#include "sweeps/storage/sample_bytes.h"

namespace pintle::cli {
namespace {

// A process sends the number of chunks it can take, followed by its finished results (frames, possibly none); the answer is a list of
// chunks. An empty list means that nothing is left.
constexpr int kAsk = 1, kAnswer = 2;
constexpr std::uint64_t kChunksPerThread = 2;
constexpr double kWait = 1e-3;  // [s]

std::string receive(int source, int tag, const MPI_Status& status) {
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  MPI_Recv(bytes.data(), size, MPI_BYTE, source, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return bytes;
}

void send(int to, int tag, const void* bytes, std::size_t size) { MPI_Send(bytes, static_cast<int>(size), MPI_BYTE, to, tag, MPI_COMM_WORLD); }

std::vector<FinishedChunk> chunks_of(std::string_view bytes, std::uint64_t per_chunk) {
  std::vector<FinishedChunk> out;
  for (std::size_t at = 0; at < bytes.size();) {
    auto frame = read_frame(bytes, at);
    if (!frame) throw std::runtime_error("a message between processes is damaged");
    const std::uint64_t chunk = frame->sample / per_chunk;
    if (out.empty() || out.back().chunk != chunk) out.push_back({chunk, {}});
    out.back().results.push_back(std::move(frame->result));
  }
  return out;
}

// Computes the listed chunks on all threads.
std::string compute(const SweepJob& job, int threads, const std::vector<std::uint64_t>& chunks) {
  std::mutex mutex;
  std::size_t given = 0;
  const auto next = [&]() -> std::optional<std::uint64_t> {
    const std::lock_guard lock(mutex);
    return given < chunks.size() ? std::optional(chunks[given++]) : std::nullopt;
  };
  std::string bytes;
  WorkerPool pool(job, threads, next);
  while (!pool.idle())
    for (const FinishedChunk& chunk : pool.take(1))
      for (std::size_t k = 0; k < chunk.results.size(); ++k) append_frame(bytes, chunk.chunk * job.samples_per_chunk() + k, chunk.results[k]);
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

void MpiProcesses::share(std::map<std::string, std::string>& texts) const {
  std::uint64_t count = texts.size();
  MPI_Bcast(&count, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  std::vector<std::pair<std::string, std::string>> list(texts.begin(), texts.end());
  list.resize(count);
  for (auto& [name, text] : list) {
    share(name);
    share(text);
  }
  texts = {list.begin(), list.end()};
}

void MpiProcesses::abort(int exit_code) const {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::abort();
}

std::vector<FinishedChunk> MpiProcesses::serve(ChunkQueue& queue) {
  std::vector<FinishedChunk> out;
  while (true) {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, kAsk, MPI_COMM_WORLD, &there, &status);
    if (there == 0) return out;
    const std::string bytes = receive(status.MPI_SOURCE, kAsk, status);
    std::uint64_t wanted = 0;
    std::memcpy(&wanted, bytes.data(), sizeof wanted);
    for (FinishedChunk& chunk : chunks_of(std::string_view(bytes).substr(sizeof wanted), queue.per_chunk())) out.push_back(std::move(chunk));
    std::vector<std::uint64_t> given;
    while (given.size() < wanted) {
      const auto chunk = queue.next();
      if (!chunk) break;
      given.push_back(*chunk);
    }
    if (given.empty()) ++dismissed_;
    send(status.MPI_SOURCE, kAnswer, given.data(), given.size() * sizeof given[0]);
  }
}

void MpiProcesses::dismiss() {
  ChunkQueue nothing(0, 1, [](std::uint64_t) { return true; });
  while (busy()) {
    serve(nothing);
    std::this_thread::sleep_for(std::chrono::duration<double>(kWait));
  }
}

void MpiProcesses::work(const SweepRequest& request, int threads) const {
  std::optional<SweepJob> job;
  try {
    job.emplace(request);
  } catch (const InputError&) {  // the first process has found the same and reports it
  }
  std::string message(sizeof(std::uint64_t), '\0');
  while (true) {
    const std::uint64_t wanted = job ? kChunksPerThread * static_cast<std::uint64_t>(threads) : 0;
    std::memcpy(message.data(), &wanted, sizeof wanted);
    send(0, kAsk, message.data(), message.size());
    MPI_Status status;
    for (int there = 0; there == 0;) {  // MPI's own waiting would keep a core busy
      MPI_Iprobe(0, kAnswer, MPI_COMM_WORLD, &there, &status);
      if (there == 0) std::this_thread::sleep_for(std::chrono::duration<double>(kWait));
    }
    const std::string bytes = receive(0, kAnswer, status);
    std::vector<std::uint64_t> chunks(bytes.size() / sizeof(std::uint64_t));
    if (chunks.empty()) return;
    std::memcpy(chunks.data(), bytes.data(), bytes.size());
    message.assign(sizeof(std::uint64_t), '\0');
    message += compute(*job, threads, chunks);
  }
}

}  // namespace pintle::cli
