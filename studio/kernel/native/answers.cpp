// The kernel's calls as a native program: what its answers are is what the WebAssembly module's must be.
//   pintle-answers < CALLS > ANSWERS
// A line of CALLS is {"call": "run", "arguments": {...}}; an answer is packed, with its length (8 bytes, little-endian) before it.
#include <cstdint>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "studio/kernel/calls.h"

int main() {
  pintle::studio::Kernel kernel;
  std::string line;
  while (std::getline(std::cin, line)) {
    const auto call = nlohmann::ordered_json::parse(line);
    const std::string answer = packed(kernel.call(call.at("call").get<std::string>(), call.at("arguments").dump()));
    const std::uint64_t size = answer.size();
    for (int i = 0; i < 8; ++i) std::cout.put(static_cast<char>((size >> (8 * i)) & 0xFFU));
    std::cout << answer;
  }
  return std::cout.flush() ? 0 : 1;
}
