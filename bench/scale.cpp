// How cost and memory grow with the number of bodies, from the text of the model file to the integrator's steps.
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "bench/commands.h"
#include "bench/result_table.h"
#include "bench/stopwatch.h"
#include "integrators/methods.h"
#include "pintle/read_model.h"
#include "start/start.h"
#include "system/build.h"
#include "tests/large_models.h"

namespace pintle::bench {
namespace {

const std::map<std::string, std::function<Model(int)>> kShapes{
    {"chain", sample::chain_model}, {"tree", sample::tree_model}, {"ladder", sample::ladder_model}, {"grid", sample::grid_model}};

// Peak memory of this process, above its memory when this object was made. Linux only; 0 elsewhere.
class PeakMemory {
 public:
  PeakMemory() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";
    before_ = kilobytes("VmRSS:");
  }
  double bytes() const { return 1024 * (kilobytes("VmHWM:") - before_); }

 private:
  static double kilobytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
      if (double value = 0; word == key && status >> value) return value;
    return 0;
  }
  double before_ = 0;
};

// The model as a file with one line per body and joint.
std::string text_of(const Model& model) {
  const auto marker = [](const Marker& m) { return fmt::format("{} = [{}, {}]", m.name, m.position[0], m.position[1]); };
  std::string text = fmt::format("format = 1\nname = \"{}\"\ngravity = [{}, {}]\n[simulate]\nduration = {}\noutput_step = {}\ntolerance = {}\n[ground.markers]\n",
                                 model.name, model.gravity[0], model.gravity[1], model.simulate.duration,
                                 model.simulate.output_step, model.simulate.tolerance);
  for (const Marker& m : model.ground) text += marker(m) + "\n";
  text += "[body]\n";
  for (const Body& b : model.bodies) {
    text += fmt::format("{} = {{ mass = {}, inertia = {}, position = [{}, {}], angle = {}, ", b.name, b.mass, b.inertia,
                        (*b.position)[0], (*b.position)[1], *b.angle);
    if (b.velocity) text += fmt::format("velocity = [{}, {}], spin = {}, ", (*b.velocity)[0], (*b.velocity)[1], *b.spin);
    text += fmt::format("markers = {{ {}, {} }} }}\n", marker(b.markers[0]), marker(b.markers[1]));
  }
  text += "[joint]\n";
  for (const Joint& j : model.joints)
    text += fmt::format("{} = {{ type = \"{}\", between = [\"{}.{}\", \"{}.{}\"], stiffness = \"{} N/m\", damping = \"{} N*s/m\" }}\n", j.name, j.type,
                        j.first.body, j.first.marker, j.second.body, j.second.marker, j.law.values.at("stiffness")[0], j.law.values.at("damping")[0]);
  return text;
}

struct Costs {
  int size = 0, bodies = 0, joints = 0, fill = 0;
  double read = 0, build = 0, assemble = 0, start = 0, step = 0;  // [s]; start is without assembly; step is one step
  double newton = 0;  // iterations per step
  double bytes = 0;   // at the peak
};

Costs measure(const Model& model, int size, int steps) {
  Costs c;
  c.size = size;
  const std::string text = text_of(model);
  const PeakMemory memory;
  const Stopwatch kinematics;
  const Model read = parse_model(text, "large.toml");
  c.read = kinematics.seconds();
  const Stopwatch building;
  System system = build_system(read);
  c.build = building.seconds();
  c.bodies = system.n_bodies();
  c.joints = system.n_joints();
  c.fill = system.pattern().n_off_diagonal();
  const Stopwatch assembling;
  static_cast<void>(assemble_system(read, std::move(system)));
  c.assemble = assembling.seconds();
  const Stopwatch starting;
  const Assembly start = start_of_run(read);
  c.start = starting.seconds() - c.assemble - c.build;
  const auto stepper = make_stepper(start.system, {Equations::kNewtonian, "radau", 3}, 1e-3);
  stepper->start(start.state, 1e-4 * read.simulate.duration);
  stepper->step(read.simulate.duration);  // the first step fills buffers
  const Stopwatch stepping;
  for (int i = 0; i < steps; ++i)
    if (!stepper->step(read.simulate.duration)) break;
  const double made = static_cast<double>(stepper->counters().steps) - 1;
  c.step = stepping.seconds() / made;
  c.newton = static_cast<double>(stepper->counters().newton_iterations) / (made + 1);
  c.bytes = memory.bytes();
  return c;
}

// The exponent p in time = c * bodies^p, by least squares of the logarithms.
double exponent(const std::vector<Costs>& rows, double Costs::*time) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const Costs& row : rows) {
    const double a = std::log(row.bodies), b = std::log(std::max(row.*time, 1e-9));
    ++n, x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

void add_row(ResultTable& table, const std::string& shape, const Costs& c) {
  const double n = c.bodies;
  table.add_row({text(shape), count(c.size), count(n), count(c.joints), number(c.fill / n, "{:.2f}"), number(c.read, "{:.3g}"),
                 number(c.build, "{:.3g}"), number(c.assemble, "{:.3g}"), number(c.start, "{:.3g}"), number(c.newton, "{:.1f}"),
                 number(1e6 * c.step / n, "{:.2f}"), number(c.bytes / n / 1024, "{:.2f}")});
}

}  // namespace

nlohmann::ordered_json study_scale(const ScaleOptions& options) {
  ResultTable table(fmt::format("Cost against size: order 5, tolerance 1e-3, the first {} steps", options.steps),
                    {{"shape", "shape", true}, {"N", "size"}, {"bodies", "bodies"}, {"joints", "joints"}, {"blocks/body", "blocks_per_body"},
                     {"read [s]", "read"}, {"build [s]", "build"}, {"assemble [s]", "assemble"}, {"start [s]", "start"},
                     {"Newton/step", "newton_per_step"}, {"us/step/body", "microseconds_per_step_and_body"}, {"KiB/body", "kibibytes_per_body"}});
  nlohmann::ordered_json out;
  std::vector<std::string> lines;
  for (const std::string& shape : options.shapes) {
    std::vector<Costs> rows;
    for (const int size : shape == "grid" ? options.grid_sizes : options.sizes) {
      rows.push_back(measure(kShapes.at(shape)(size), size, options.steps));
      add_row(table, shape, rows.back());
      const Costs& c = rows.back();
      if (options.verbose)
        fmt::print(stderr, "{} {}: read {:.3g} s, start {:.3g} s, step {:.3g} s\n", shape, size, c.read, c.build + c.assemble + c.start, c.step);
    }
    if (rows.size() < 2) continue;
    const double read = exponent(rows, &Costs::read), assembly = exponent(rows, &Costs::assemble),
                 start = exponent(rows, &Costs::start), step = exponent(rows, &Costs::step);
    lines.push_back(fmt::format("  {}: time goes as bodies^p, with p = {:.3f} reading, {:.3f} assembling, {:.3f} starting, {:.3f} stepping", shape, read,
                                assembly, start, step));
    out["exponents"][shape] = {{"read", read}, {"assemble", assembly}, {"start", start}, {"step", step}};
  }
  table.print();
  for (const std::string& line : lines) fmt::print("{}\n", line);
  out["table"] = table.json();
  return out;
}

}  // namespace pintle::bench
