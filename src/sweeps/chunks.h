// The samples in fixed chunks: what is computed together does not depend on threads, machines or restarts.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "batch/envelope.h"
#include "io/model_variants.h"
#include "sweeps/plan.h"

namespace pintle {

/// Of which those that are not checked are integrated together. Where every sample is, there is nothing to share: one by one, each is kept as soon as it is finished.
inline std::uint64_t samples_per_chunk(std::uint64_t check_every) { return check_every == 1 ? 1 : 16; }

/// The chunks that remain to be computed; several threads take chunks from it.
class ChunkQueue {
 public:
  /// `done` tells which samples already exist.
  ChunkQueue(std::uint64_t n_samples, std::uint64_t per_chunk, const std::function<bool(std::uint64_t)>& done);
  std::optional<std::uint64_t> next();
  std::uint64_t per_chunk() const { return per_chunk_; }
  void close();  ///< no further chunks are handed out

 private:
  std::mutex mutex_;
  std::uint64_t per_chunk_, next_ = 0;
  std::vector<bool> to_do_;
};

/// Computes chunks; one per thread.
class ChunkComputer {
 public:
  ChunkComputer(const SweepPlan& plan, const EnvelopeEngine& engine, ModelVariants variants, std::uint64_t check_every)
      : plan_(plan), engine_(engine), variants_(std::move(variants)), check_every_(check_every) {}

  /// The results of all samples of a chunk, in order; empty if `keep_going` returned false.
  std::vector<SampleResult> compute(std::uint64_t chunk, const std::function<bool()>& keep_going);

 private:
  const SweepPlan& plan_;
  const EnvelopeEngine& engine_;
  ModelVariants variants_;
  std::uint64_t check_every_;
};

}  // namespace pintle
