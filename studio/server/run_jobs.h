// Runs in the background, with progress, until their results are requested.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "base/stopwatch.h"
#include "studio/kernel/calls.h"

namespace pintle::studio {

class RunJobs {
 public:
  RunJobs() = default;
  ~RunJobs();  // ends all runs
  RunJobs(const RunJobs&) = delete;
  RunJobs& operator=(const RunJobs&) = delete;

  /// Starts a run; `arguments` are those of the kernel's call "run". Throws Refusal when too many are under way.
  int start(std::string arguments);
  /// {"state": "running", "progress": ...} or {"state": "done"}. Throws Refusal 404.
  std::string state(int id);
  /// The answer, packed. Throws Refusal 409 while it runs.
  std::string result(int id);
  /// Ends a run, which keeps what it has; forgets one that is done.
  void end(int id);

 private:
  struct Job {
    std::atomic<bool> stop{false}, done{false};
    std::mutex writing;
    std::string progress = "null";
    std::string answer;
    Stopwatch since_start;
    std::atomic<double> asked{0};  // when its state was asked for last [s]
    std::thread thread;

    double unasked() const { return since_start.seconds() - asked; }
  };
  Job& find(int id);
  void forget_old();

  std::mutex changing_;  // of the list; held by every call
  std::map<int, std::unique_ptr<Job>> jobs_;
  int next_ = 1;
};

}  // namespace pintle::studio
