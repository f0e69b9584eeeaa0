#include "bench/machine.h"

#include <fmt/format.h>
#include <sundials/sundials_version.h>

#include <ctime>
#include <fstream>
#include <string>
#include <thread>

#ifdef PINTLE_HAS_SIMBODY
#include "bench/simbody_methods.h"
#endif
#ifdef PINTLE_HAS_MUJOCO
#include "bench/mujoco_methods.h"
#endif

namespace pintle::bench {
namespace {

std::string value_in(const char* path, const std::string& key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key)) {
      std::string value = line.substr(line.find_first_of(":=") + 1);
      std::erase(value, '"');
      return value.substr(std::min(value.find_first_not_of(" \t"), value.size()));
    }
  return "unknown";
}

std::string first_words(const char* path, int count) {
  std::ifstream file(path);
  std::string all, word;
  for (int i = 0; i < count && file >> word; ++i) all += (i == 0 ? "" : " ") + word;
  return all;
}

std::string sundials_version() {
  char text[64] = "";
  SUNDIALSGetVersion(text, sizeof text);
  return text;
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  char text[16] = "";
  std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
  return text;
}

}  // namespace

nlohmann::ordered_json describe_machine() {
  nlohmann::ordered_json out;
  out["date"] = today();
  out["processor"] = value_in("/proc/cpuinfo", "model name");
  out["cores"] = std::thread::hardware_concurrency();
  out["system"] = value_in("/etc/os-release", "PRETTY_NAME");
#ifdef __clang__
  out["compiler"] = "clang " __VERSION__;
#else
  out["compiler"] = "g++ " __VERSION__;
#endif
  out["flags"] = PINTLE_BENCH_FLAGS;
  out["Pintle"] = PINTLE_VERSION;
  out["SUNDIALS"] = sundials_version();
#ifdef PINTLE_HAS_SIMBODY
  out["Simbody"] = simbody_version();
#else
  out["Simbody"] = "not in this build";
#endif
#ifdef PINTLE_HAS_MUJOCO
  out["MuJoCo"] = mujoco_version();
#else
  out["MuJoCo"] = "not in this build";
#endif
  out["load of the last 1, 5, 15 minutes"] = first_words("/proc/loadavg", 3);
  return out;
}

}  // namespace pintle::bench
