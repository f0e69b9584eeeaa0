// A sample's result as bytes, for the journal and for messages between machines.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "batch/envelope.h"

namespace pintle {

struct NumberedResult {
  std::uint64_t sample = 0;
  SampleResult result;
};

/// One frame: its length, a checksum, the result. Native byte order.
void append_frame(std::string& bytes, std::uint64_t sample, const SampleResult& result);

/// Reads the frame at `at` and moves `at` past it; nothing if the frame is truncated or damaged.
std::optional<NumberedResult> read_frame(std::string_view bytes, std::size_t& at);

/// Length of the frame that starts with these bytes; 0 if there are too few. The longest frame is 1 GiB; a greater length means damage.
std::size_t frame_length(std::string_view head);
inline constexpr std::size_t kFrameHead = 8;

std::uint32_t crc32(std::string_view bytes);

}  // namespace pintle
