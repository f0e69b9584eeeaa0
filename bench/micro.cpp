// The components of a step, with Google Benchmark.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <memory>

#include "bench/commands.h"
#include "bench/pintle_methods.h"
#include "integrators/absolute/radau_stepper.h"
#include "joints/joint_displacement.h"
#include "laws/law.h"
#include "linalg/block_lu.h"
#include "linalg/spectrum.h"
#include "tests/large_models.h"

namespace pintle::bench {
namespace {

using S = Planar;

void count_bodies(benchmark::State& state, int bodies) {
  state.counters["per_body"] = benchmark::Counter(static_cast<double>(state.iterations()) * bodies,
                                                  benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void law_response(benchmark::State& state) {
  const Law law = LinearLaw::typical();
  S::Vec gap(1e-6, -2e-6, 1e-6), rate(1e-3, 2e-3, 0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(gap);
    benchmark::DoNotOptimize(respond(law, gap, rate));
  }
}

void joint_kinematics(benchmark::State& state, const std::string& name) {
  const ReadyModel ready(collection_model(name));
  std::vector<S::Motion> m;
  ready.system.motions(ready.start.q, ready.start.v, m);
  for (auto _ : state) {
    benchmark::DoNotOptimize(m.data());
    benchmark::DoNotOptimize(ready.system.kinematics(ready.system.n_joints() - 1, 0, m));
  }
}

void accelerations(benchmark::State& state, const std::string& name) {
  const ReadyModel ready(collection_model(name));
  Vecs a(ready.system.bodies.size());
  for (auto _ : state) {
    ready.system.accelerations(0, ready.start.q, ready.start.v, a);
    benchmark::DoNotOptimize(a.data());
  }
  count_bodies(state, ready.system.n_bodies());
}

// Fills a matrix that has the system's pattern and a dominant diagonal.
template <class T>
void fill(const System& system, BlockLu<T, 3>& lu) {
  lu.set_diagonal([](int, int) { return T(10.0); });
  for (int i = 0; i < system.n_bodies(); ++i)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        if (c != r) lu.diagonal(i)(r, c) = T(0.1 * (r + c));
  for (const JointData& joint : system.joints) {
    if (joint.at.a == kGround || joint.at.b == kGround) continue;
    for (const auto& [i, j] : {std::pair{joint.at.a, joint.at.b}, std::pair{joint.at.b, joint.at.a}})
      for (int r = 0; r < 3; ++r) lu.off_diagonal(system.pattern().slot(i, j))(r, r) = T(-1.0);
  }
}

template <class T>
void factorise(benchmark::State& state, const std::string& name) {
  const ReadyModel ready(collection_model(name));
  BlockLu<T, 3> lu(ready.system.pattern());
  for (auto _ : state) {
    fill(ready.system, lu);
    benchmark::DoNotOptimize(lu.factorize());
  }
  count_bodies(state, ready.system.n_bodies());
}

template <class T>
void solve(benchmark::State& state, const std::string& name) {
  const ReadyModel ready(collection_model(name));
  BlockLu<T, 3> lu(ready.system.pattern());
  fill(ready.system, lu);
  lu.factorize();
  std::vector<BlockVec<T, 3>> x(ready.system.bodies.size());
  for (auto _ : state) {
    for (auto& block : x) block[0] = block[1] = block[2] = T(1.0);
    lu.solve(x);
    benchmark::DoNotOptimize(x.data());
  }
  count_bodies(state, ready.system.n_bodies());
}

// Steps with error control at tolerance 1e-5, repeatedly from start to end.
void step(benchmark::State& state, const Model& model, int stages) {
  const ReadyModel ready(model);
  const double end = ready.model.simulate.duration;
  RadauStepper stepper(ready.system, 1e-5, stages);
  stepper.start(ready.start, 1e-4 * end);
  for (auto _ : state) {
    if (stepper.state().t < end * (1 - 1e-12) && stepper.step(end)) continue;
    state.PauseTiming();
    stepper.start(ready.start, 1e-4 * end);
    state.ResumeTiming();
  }
  const Counters& c = stepper.counters();
  state.counters["newton"] = static_cast<double>(c.newton_iterations) / static_cast<double>(c.steps + c.rejected);
  count_bodies(state, ready.system.n_bodies());
}

void whole_run_start(benchmark::State& state, const std::string& name) {
  const Model model = collection_model(name);
  for (auto _ : state) {
    const ReadyModel ready(model);
    benchmark::DoNotOptimize(ready.start.q.data());
  }
}

void register_all() {
  using benchmark::RegisterBenchmark;
  RegisterBenchmark("law/linear", law_response);
  RegisterBenchmark("joint/revolute", joint_kinematics, "four_bar");
  RegisterBenchmark("joint/slider", joint_kinematics, "trammel");
  RegisterBenchmark("joint/gear", joint_kinematics, "gear_train");
  for (const char* name : {"four_bar", "n_four_bar_40"}) {
    RegisterBenchmark(fmt::format("accelerations/{}", name).c_str(), accelerations, name);
    RegisterBenchmark(fmt::format("factorise/real/{}", name).c_str(), factorise<double>, name);
    RegisterBenchmark(fmt::format("factorise/order_5/{}", name).c_str(), factorise<Spectrum<3>>, name);
    RegisterBenchmark(fmt::format("linalg/real/{}", name).c_str(), solve<double>, name);
    RegisterBenchmark(fmt::format("linalg/order_5/{}", name).c_str(), solve<Spectrum<3>>, name);
    RegisterBenchmark(fmt::format("start/{}", name).c_str(), whole_run_start, name);
  }
  for (const int stages : {3, 5}) {
    for (const char* name : {"four_bar", "n_four_bar_10", "n_four_bar_40"})
      RegisterBenchmark(fmt::format("step/{}/order_{}", name, 2 * stages - 1).c_str(), step, collection_model(name),
                        stages);
    for (const int links : {10, 100, 1000})
      RegisterBenchmark(fmt::format("step/chain_{}/order_{}", links, 2 * stages - 1).c_str(), step, sample::chain_model(links),
                        stages);
  }
}

}  // namespace

void run_micro(const std::string& filter, double min_time, const std::string& json_file) {
  std::vector<std::string> words{"pintle-bench", "--benchmark_filter=" + filter,
                                 fmt::format("--benchmark_min_time={}", min_time), "--benchmark_counters_tabular=true"};
  if (!json_file.empty()) words.insert(words.end(), {"--benchmark_out=" + json_file, "--benchmark_out_format=json"});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  register_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}

}  // namespace pintle::bench
