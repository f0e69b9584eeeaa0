#include "studio/kernel/calls.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

#include "studio/kernel/exchange.h"
#include "studio/kernel/sessions.h"

namespace pintle::studio {

struct Kernel::Sessions {
  MotionSessions motions;
};

Kernel::Kernel() : sessions_(std::make_unique<Sessions>()) {}
Kernel::~Kernel() = default;

namespace {

struct PlainCall {
  std::string_view name;
  Json (*make)(Exchange&);
};
constexpr std::array<PlainCall, 9> kPlainCalls{{{"schema", schema}, {"catalog", catalog}, {"read", read}, {"write", write},
                                                {"edit", edit}, {"format", format}, {"check", check}, {"run", run}, {"report", report}}};

struct SessionCall {
  std::string_view name;
  Json (MotionSessions::*make)(Exchange&);
};
constexpr std::array<SessionCall, 6> kSessionCalls{{{"open_drag", &MotionSessions::open_drag}, {"drag", &MotionSessions::drag},
                                                    {"close_drag", &MotionSessions::close_drag}, {"open_live", &MotionSessions::open_live},
                                                    {"advance", &MotionSessions::advance}, {"close_live", &MotionSessions::close_live}}};

Json make_value(std::string_view name, Exchange& call, MotionSessions& sessions) {
  for (const PlainCall& each : kPlainCalls)
    if (each.name == name) return each.make(call);
  for (const SessionCall& each : kSessionCalls)
    if (each.name == name) return (sessions.*each.make)(call);
  throw CallFault("The kernel has no call \"" + std::string(name) + "\".", "The page and the kernel are of different versions: reload the page.");
}

void append_count(std::string& out, std::size_t n) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>((n >> (8 * i)) & 0xFFU);
}

}  // namespace

Answer Kernel::call(std::string_view name, std::string_view arguments, const OnProgress& on_progress) {
  try {
    const Json parsed = Json::parse(arguments);
    if (!parsed.is_object()) throw CallFault("The call is malformed: its arguments are not an object.", "This is a fault of the page: reload it.");
    Exchange exchange{parsed, on_progress, {}};
    const Json value = make_value(name, exchange, sessions_->motions);
    return {dump({{"value", value}}), std::move(exchange.arrays)};
  } catch (...) {
    return {dump({{"fault", current_fault()}}), {}};
  }
}

std::string packed(const Answer& answer) {
  std::string out;
  append_count(out, answer.text.size());
  append_count(out, answer.arrays.size());
  std::size_t numbers = 0;
  for (const auto& array : answer.arrays) {
    append_count(out, array.size());
    numbers += array.size();
  }
  out.resize((out.size() + 7) / 8 * 8, '\0');
  std::size_t at = out.size();
  out.resize(at + 8 * numbers);
  for (const auto& array : answer.arrays) {
    if (!array.empty()) std::memcpy(out.data() + at, array.data(), 8 * array.size());
    at += 8 * array.size();
  }
  return out + answer.text;
}

}  // namespace pintle::studio
