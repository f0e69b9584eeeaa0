#include "bench/curve_problems.h"

#include <fmt/format.h>

#include "bench/generated_models.h"
#include "bench/pintle_methods.h"
#include "tests/large_models.h"

namespace pintle::bench {

std::vector<CurveProblem> curve_problems() {
  const auto of_collection = [](std::string name, std::vector<std::string> overrides = {}) {
    return [name, overrides] { return collection_model(name, overrides); };
  };
  std::vector<CurveProblem> list;
  list.push_back({"pendulum", "Pendulum, 10 s", of_collection("pendulum", {"simulate.duration=10"}), {"rod", "tip"}});
  list.push_back({"four_bar", "Four-bar, one turn of the crank", of_collection("four_bar"), {"coupler", "B"}});
  list.back().all_peers = true;
  list.push_back({"slider_crank", "Slider-crank compressor, 0.2 s", of_collection("slider_crank", {"simulate.duration=0.2"}), {"piston", "pin"},
                  "From rest, the first 0.2 s."});
  for (const int n : {1, 2, 10, 40, 400}) {
    CurveProblem p{fmt::format("a02_{}", n), fmt::format("A02, N-four-bar with N = {}, 10 s", n), [n] { return sample::ladder_model(n); }, {"crank0", "B"}};
    p.loops = n;
    p.small = n <= 2;
    list.push_back(p);
  }
  list.push_back({"andrews", "Andrews' squeezer, 0.03 s", of_collection("andrews"), {"K1", "F"}});
  list.push_back({"scissor_20", "Scissor chain of 20 bars, 0.7 s", [] { return scissor_chain(10); }, {"a9", "B"}});
  CurveProblem five{"five_bar", "Five-bar parallelogram, one redundant bar, 1 s", [] {
                      Model model = collection_model("five_bar_parallelogram");
                      model.motors.clear();
                      return model;
                    },
                    {"coupler", "A2"},
                    "Without its motor: it coasts at constant speed."};
  five.ideal = false;
  list.push_back(five);
  return list;
}

}  // namespace pintle::bench
