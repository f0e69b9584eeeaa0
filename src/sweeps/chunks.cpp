#include "sweeps/chunks.h"

#include <algorithm>
#include <utility>

#include "pintle/complaint.h"

namespace pintle {

ChunkQueue::ChunkQueue(std::uint64_t n_samples, std::uint64_t per_chunk, const std::function<bool(std::uint64_t)>& done) : per_chunk_(per_chunk), to_do_((n_samples + per_chunk - 1) / per_chunk) {
  for (std::uint64_t i = 0; i < n_samples; ++i)
    if (!done(i)) to_do_[i / per_chunk] = true;
}

std::optional<std::uint64_t> ChunkQueue::next() {
  const std::lock_guard lock(mutex_);
  while (next_ < to_do_.size() && !to_do_[next_]) ++next_;
  return next_ < to_do_.size() ? std::optional(next_++) : std::nullopt;
}

void ChunkQueue::close() {
  const std::lock_guard lock(mutex_);
  next_ = to_do_.size();
}

std::vector<SampleResult> ChunkComputer::compute(std::uint64_t chunk, const std::function<bool()>& keep_going) {
  const std::uint64_t per_chunk = samples_per_chunk(check_every_), first = chunk * per_chunk, last = std::min(first + per_chunk, plan_.size());
  std::vector<SampleResult> out(last - first);
  std::vector<Variant> variants;
  std::vector<std::size_t> place;  // index of each variant among the results
  for (std::uint64_t i = first; i < last; ++i) {
    try {
      variants.push_back({variants_.at(plan_.values(i)), i % check_every_ == 0});
      place.push_back(i - first);
    } catch (const InputError& error) {
      out[i - first].status = SampleStatus::kModelError;
      out[i - first].message = error.what();
    }
  }
  std::vector<SampleResult> results = engine_.run(variants, keep_going);
  if (results.size() < variants.size()) return {};
  for (std::size_t k = 0; k < results.size(); ++k) out[place[k]] = std::move(results[k]);
  return out;
}

}  // namespace pintle
