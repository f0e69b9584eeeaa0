// The number of instructions of a few fixed commands, counted by valgrind's callgrind: a measure of work that other programs on
// the machine do not disturb. bench/instructions.json has the counts of every release.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "bench/commands.h"
#include "bench/result_table.h"

namespace pintle::bench {
namespace {

using Json = nlohmann::ordered_json;

struct Counted {
  const char* name;
  const char* arguments;  // {0}: mechanisms/, {1}: a folder for results
};
constexpr Counted kCases[] = {
    {"run four_bar", "run {0}/four_bar.toml --out {1}/four_bar --force"},
    {"run n_four_bar_40, 0.2 s", "run {0}/n_four_bar_40.toml --set simulate.duration=0.2 --out {1}/n_four_bar_40 --force"},
    {"check pendulum", "check {0}/pendulum.toml"},
};

double count_of(const Counted& counted, const std::filesystem::path& folder) {
  const std::string arguments = fmt::format(fmt::runtime(counted.arguments), PINTLE_SOURCE_DIR "/mechanisms", folder.string());
  const std::string command = fmt::format("valgrind --tool=callgrind --callgrind-out-file=/dev/null '{}' {} 2>&1", PINTLE_PROGRAM, arguments);
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) throw std::runtime_error("cannot run valgrind");
  double instructions = 0;
  std::string line;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) {
    line += static_cast<char>(c);
    if (c != '\n') continue;
    const std::size_t at = line.find("Collected : ");
    if (at != std::string::npos) instructions = std::stod(line.substr(at + 12));
    line.clear();
  }
  if (!(instructions > 0)) throw std::runtime_error(fmt::format("callgrind counted nothing; is valgrind installed (tools/setup.sh bench)? {}", command));
  return instructions;
}

Json read_record(const std::string& path) {
  std::ifstream file(path);
  return file ? Json::parse(file) : Json::object();
}

}  // namespace

nlohmann::ordered_json count_instructions(const std::string& record_as) {
  const std::string path = std::string(PINTLE_SOURCE_DIR) + "/bench/instructions.json";
  Json record = read_record(path);
  record.erase(record_as);
  const std::string last = record.empty() ? "-" : std::prev(record.end()).key();
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "pintle-instructions";
  ResultTable table("Millions of instructions", {{"command", "command", true}, {"now", "now"}, {last, "last"}, {"change, %", "change_percent"}});
  Json now;
  for (const Counted& counted : kCases) {
    const double count = count_of(counted, folder), before = last == "-" ? NAN : record[last].value(counted.name, NAN);
    now[counted.name] = static_cast<std::int64_t>(count);
    table.add_row({text(counted.name), number(1e-6 * count, "{:.2f}"), number(1e-6 * before, "{:.2f}"), number(100 * (count / before - 1), "{:+.1f}")});
  }
  table.print();
  std::filesystem::remove_all(folder);
  if (record_as.empty()) return table.json();
  record[record_as] = now;
  std::ofstream file(path);
  file << record.dump(1) << '\n';
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
  fmt::print("recorded as {} in {}\n", record_as, path);
  return table.json();
}

}  // namespace pintle::bench
