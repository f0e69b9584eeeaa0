#include "sweeps/storage/sample_bytes.h"

#include <array>
#include <cstring>

namespace pintle {
namespace {

constexpr std::size_t kLongest = std::size_t{1} << 30;

constexpr std::array<std::uint32_t, 256> make_crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t c = i;
    for (int k = 0; k < 8; ++k) c = (c & 1U) != 0 ? 0xEDB88320U ^ (c >> 1U) : c >> 1U;
    table[i] = c;
  }
  return table;
}

template <class T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put_numbers(std::string& bytes, const std::vector<double>& numbers) {
  put(bytes, static_cast<std::uint64_t>(numbers.size()));
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double));
}

// Reads sequentially; missing bytes read as 0 and clear `good`.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  T get() {
    T value{};
    if (!take(&value, sizeof value)) value = T{};
    return value;
  }
  std::uint64_t count(std::size_t size) {
    const auto n = get<std::uint64_t>();
    if (n > bytes_.size() / size) good = false;
    return good ? n : 0;
  }
  bool take(void* to, std::size_t size) {
    if (size > bytes_.size()) good = false;
    if (good && size > 0) std::memcpy(to, bytes_.data(), size);
    if (good) bytes_.remove_prefix(size);
    return good;
  }
  bool all_read() const { return good && bytes_.empty(); }

 private:
  bool good = true;
  std::string_view bytes_;
};

}  // namespace

std::uint32_t crc32(std::string_view bytes) {
  static constexpr std::array<std::uint32_t, 256> kTable = make_crc_table();
  std::uint32_t c = 0xFFFFFFFFU;
  for (const char byte : bytes) c = kTable[(c ^ static_cast<unsigned char>(byte)) & 0xFFU] ^ (c >> 8U);
  return c ^ 0xFFFFFFFFU;
}

void append_frame(std::string& bytes, std::uint64_t sample, const SampleResult& result) {
  const std::size_t start = bytes.size();
  bytes.append(kFrameHead, '\0');
  put(bytes, sample);
  put(bytes, static_cast<std::uint8_t>(result.status));
  put(bytes, result.steps);
  put(bytes, result.passes);
  put(bytes, static_cast<std::uint64_t>(result.joints.size()));
  for (const JointPeak& joint : result.joints)
    for (const double x : {joint.force, joint.time, joint.moment, joint.error}) put(bytes, x);
  put_numbers(bytes, result.series);
  put(bytes, static_cast<std::uint64_t>(result.message.size()));
  bytes += result.message;
  const auto length = static_cast<std::uint32_t>(bytes.size() - start);
  std::memcpy(bytes.data() + start, &length, sizeof length);
  const std::uint32_t sum = crc32(std::string_view(bytes).substr(start));  // with 0 in the place of the sum itself
  std::memcpy(bytes.data() + start + 4, &sum, sizeof sum);
}

std::size_t frame_length(std::string_view head) {
  std::uint32_t length = 0;
  if (head.size() < kFrameHead) return 0;
  std::memcpy(&length, head.data(), sizeof length);
  return length < kFrameHead || length > kLongest ? 0 : length;
}

std::optional<NumberedResult> read_frame(std::string_view bytes, std::size_t& at) {
  const std::string_view rest = bytes.substr(at);
  const std::size_t length = frame_length(rest);
  if (length == 0 || length > rest.size()) return std::nullopt;
  std::string frame(rest.substr(0, length));
  std::uint32_t sum = 0;
  std::memcpy(&sum, frame.data() + 4, sizeof sum);
  std::memset(frame.data() + 4, 0, sizeof sum);
  if (crc32(frame) != sum) return std::nullopt;
  Bytes in(std::string_view(frame).substr(kFrameHead));
  NumberedResult out;
  out.sample = in.get<std::uint64_t>();
  out.result.status = static_cast<SampleStatus>(in.get<std::uint8_t>());
  out.result.steps = in.get<std::uint64_t>();
  out.result.passes = in.get<std::uint64_t>();
  out.result.joints.resize(in.count(4 * sizeof(double)));
  for (JointPeak& joint : out.result.joints)
    for (double* x : {&joint.force, &joint.time, &joint.moment, &joint.error}) *x = in.get<double>();
  out.result.series.resize(in.count(sizeof(double)));
  in.take(out.result.series.data(), out.result.series.size() * sizeof(double));
  out.result.message.resize(in.count(1));
  in.take(out.result.message.data(), out.result.message.size());
  if (!in.all_read()) return std::nullopt;
  at += length;
  return out;
}

}  // namespace pintle
