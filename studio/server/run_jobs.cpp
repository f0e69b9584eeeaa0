#include "studio/server/run_jobs.h"

#include <new>
#include <utility>

#include "studio/server/exchange.h"

namespace pintle::studio {
namespace {

constexpr int kMostUnderWay = 2;
constexpr int kMostRunning = 4;  // with those that have been told to stop and have not yet, as in their assembly
constexpr std::size_t kMostKept = 4;
constexpr double kAbandoned = 10;   // [s] without a question: another run may have the place
constexpr double kForgotten = 180;  // [s] without a question: it ends; browsers let pages in the background ask once a minute

}  // namespace

RunJobs::~RunJobs() {
  for (auto& [id, job] : jobs_) job->stop = true;
  for (auto& [id, job] : jobs_)
    if (job->thread.joinable()) job->thread.join();
}

int RunJobs::start(std::string arguments) {
  const std::lock_guard lock(changing_);
  int under_way = 0, running = 0;  // not told to stop; not ended
  for (const auto& [id, job] : jobs_) {
    under_way += job->done || job->stop ? 0 : 1;
    running += job->done ? 0 : 1;
  }
  for (const auto& [id, job] : jobs_)
    if (under_way >= kMostUnderWay && !job->done && !job->stop && job->unasked() > kAbandoned) {
      job->stop = true;
      --under_way;
    }
  if (under_way >= kMostUnderWay || running >= kMostRunning) throw Refusal(429, "Other runs are still in progress.", "Wait for them, or cancel one.");
  forget_old();
  auto job = std::make_unique<Job>();
  job->thread = std::thread([job_now = job.get(), text = std::move(arguments)] {
    Job& now = *job_now;
    std::string answer;
    try {
      answer = packed(Kernel().call("run", text, [&now](std::string_view progress) {
        const std::lock_guard writing(now.writing);
        now.progress = progress;
        return !now.stop && now.unasked() < kForgotten;
      }));
    } catch (const std::bad_alloc&) {
      answer = packed({R"({"fault": {"message": "There is not enough memory for the results of this run.", "hint": "A larger output_step gives fewer rows."}})", {}});
    }
    const std::lock_guard writing(now.writing);
    now.answer = std::move(answer);
    now.done = true;
  });
  jobs_[next_] = std::move(job);
  return next_++;
}

// Only such as are done; their threads end at once.
void RunJobs::forget_old() {
  for (auto it = jobs_.begin(); it != jobs_.end() && jobs_.size() >= kMostKept;) {
    if (!it->second->done) {
      ++it;
      continue;
    }
    it->second->thread.join();
    it = jobs_.erase(it);
  }
}

RunJobs::Job& RunJobs::find(int id) {
  const auto it = jobs_.find(id);
  if (it == jobs_.end()) throw Refusal(404, "There is no such run.", "It was discarded for newer ones: run it again.");
  return *it->second;
}

std::string RunJobs::state(int id) {
  const std::lock_guard lock(changing_);
  Job& job = find(id);
  job.asked = job.since_start.seconds();
  const std::lock_guard writing(job.writing);
  return job.done ? R"({"state": "done"})" : R"({"state": "running", "progress": )" + job.progress + "}";
}

std::string RunJobs::result(int id) {
  const std::lock_guard lock(changing_);
  Job& job = find(id);
  if (!job.done) throw Refusal(409, "The run is still in progress.");
  return job.answer;
}

void RunJobs::end(int id) {
  const std::lock_guard lock(changing_);
  Job& job = find(id);
  job.stop = true;
  if (!job.done) return;
  job.thread.join();
  jobs_.erase(id);
}

}  // namespace pintle::studio
