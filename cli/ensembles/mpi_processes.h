// The processes started by mpirun or srun: the first writes and computes, the others compute.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "pintle/sweep.h"
#include "sweeps/run_sweep.h"

namespace pintle::cli {

/// Whether this process is one of several, judged by environment variables set by the launcher.
bool started_by_mpi();

class MpiProcesses : public Remote {
 public:
  MpiProcesses();
  MpiProcesses(const MpiProcesses&) = delete;
  MpiProcesses& operator=(const MpiProcesses&) = delete;
  ~MpiProcesses() override;

  bool is_first() const { return rank_ == 0; }
  /// Copies the first process's model text to all. Everything else on the command line is the same for all of them anyway.
  void share(std::string& text) const;
  void share(std::map<std::string, std::string>& texts) const;
  /// Ends all processes at once, after an error.
  [[noreturn]] void abort(int exit_code) const;

  std::vector<FinishedChunk> serve(ChunkQueue& queue) override;
  bool busy() const override { return dismissed_ < size_ - 1; }
  /// Tells all processes that do not know it yet that nothing is left, and waits until they do.
  void dismiss();

  /// The work of all processes but the first: computes what the first hands out, until nothing is left.
  void work(const SweepRequest& request, int threads) const;

 private:
  int rank_ = 0, size_ = 1, dismissed_ = 0;
};

}  // namespace pintle::cli
