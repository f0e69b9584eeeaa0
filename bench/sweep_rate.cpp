#include "bench/sweep_rate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "batch/envelope.h"
#include "bench/commands.h"
#include "bench/pintle_methods.h"
#include "bench/result_table.h"
#include "bench/stopwatch.h"

namespace pintle::bench {
namespace {

std::vector<Variant> make_variants(const Model& base, int n) {
  std::vector<Variant> variants(n, Variant{base, false});
  for (int i = 0; i < n; ++i) {
    const double share = n > 1 ? 2.0 * i / (n - 1) - 1 : 0;
    Model& model = variants[i].model;
    Joint& joint = model.joints[std::min<std::size_t>(1, model.joints.size() - 1)];
    for (double& k : joint.law.values["stiffness"]) k *= std::exp2(share);
    model.bodies.back().mass *= 1 + 0.1 * share;
  }
  return variants;
}

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return x[x.size() / 2];
}

double largest_difference(const std::vector<SampleResult>& a, const std::vector<SampleResult>& b) {
  double worst = 0;
  for (std::size_t j = 0; j < a[0].joints.size(); ++j) {
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i].status != SampleStatus::kCompleted || b[i].status != SampleStatus::kCompleted) throw std::runtime_error("a variant was not completed: " + a[i].message + b[i].message);
      largest = std::max(largest, a[i].joints[j].force);
      difference = std::max(difference, std::abs(a[i].joints[j].force - b[i].joints[j].force));
    }
    if (largest > 0) worst = std::max(worst, difference / largest);
  }
  return worst;
}

}  // namespace

SweepRate measure_sweep_rate(const std::string& name, double tolerance, int n, int rounds) {
  Model base = collection_model(name, {"simulate.tolerance=" + std::to_string(tolerance)});
  for (Joint& joint : base.joints)
    if (joint.law.values["stiffness"].empty()) joint.law.values["stiffness"] = {1e8};
  const EnvelopeEngine together(base, {{}, true}), alone(base, {{}, true, false});
  const std::vector<Variant> variants = make_variants(base, n);
  std::vector<double> time, time_alone;
  SweepRate out;
  for (int round = 0; round < rounds; ++round) {
    const Stopwatch watch;
    const auto batches = together.run(variants, [] { return true; });
    time.push_back(watch.seconds());
    const Stopwatch watch_alone;
    const auto runs = alone.run(variants, [] { return true; });
    time_alone.push_back(watch_alone.seconds());
    out.difference = largest_difference(batches, runs);
    out.aboard = static_cast<double>(std::count_if(batches.begin(), batches.end(), [](const SampleResult& r) { return r.in_batch; })) / n;
  }
  out.per_second = n / median(time);
  out.alone_per_second = n / median(time_alone);
  return out;
}

double turns_per_second(int turns) { return measure_sweep_rate("four_bar", 1e-4, turns, 3).per_second; }

nlohmann::ordered_json study_sweeps(const SweepOptions& options) {
  ResultTable table("Variants per second of one core", {{"model", "model", true}, {"tolerance", "tolerance"}, {"per second", "per_second"}, {"alone", "alone_per_second"},
                                                        {"ratio", "ratio"}, {"in batches", "aboard"}, {"difference", "difference"}});
  for (const std::string& model : options.models)
    for (const double tolerance : options.tolerances) {
      const SweepRate rate = measure_sweep_rate(model, tolerance, options.variants, options.rounds);
      table.add_row({text(model), number(tolerance, "{:.0e}"), number(rate.per_second, "{:.0f}"), number(rate.alone_per_second, "{:.0f}"),
                 number(rate.per_second / rate.alone_per_second, "{:.1f}"), number(100 * rate.aboard, "{:.0f} %"), number(rate.difference, "{:.1e}")});
    }
  table.print();
  return table.json();
}

}  // namespace pintle::bench
