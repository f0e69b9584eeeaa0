// The processes that mpirun or srun have started: the first writes and computes, the others compute.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "pintle/sweep.h"
#include "sweeps/run_sweep.h"

namespace pintle::cli {

/// Whether this process is one of several, by what their starter has put into the environment.
bool started_by_mpi();

class MpiProcesses : public Remote {
 public:
  MpiProcesses();
  MpiProcesses(const MpiProcesses&) = delete;
  MpiProcesses& operator=(const MpiProcesses&) = delete;
  ~MpiProcesses() override;

  bool is_first() const { return rank_ == 0; }
  /// The first one's model text for all. Whatever else they have from the command line is the same by nature.
  void share(std::string& text) const;
  void share(std::map<std::string, std::string>& texts) const;
  /// Ends all of them at once, after an error.
  [[noreturn]] void abort(int exit_code) const;

  std::vector<FinishedChunk> serve(ChunkQueue& queue) override;
  bool busy() const override { return dismissed_ < size_ - 1; }
  /// Tells all who do not know it yet that nothing is left, and waits until they do.
  void dismiss();

  /// What all but the first do: computes what the first gives out, until nothing is left.
  void work(const SweepRequest& request, int threads) const;

 private:
  int rank_ = 0, size_ = 1, dismissed_ = 0;
};

}  // namespace pintle::cli
