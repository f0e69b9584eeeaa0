// A pendulum with variable pin and length, and requests to sweep it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pintle/sweep.h"

namespace pintle::sample {

inline std::string pendulum_with(const std::string& variations) {
  return R"(format = 1
[parameters]
length = "1 m"
[simulate]
duration = "0.1 s"
output_step = "10 ms"
tolerance = 1e-4
[ground.markers]
O = [0, 0]
[body.bob]
mass = "1 kg"
inertia = "0.1 kg*m^2"
position = ["length", 0]
angle = 0
markers.O = ["-length", 0]
[joint.pin]
type = "revolute"
between = ["ground.O", "bob.O"]
stiffness = "1e8 N/m"
damping = "1e3 N*s/m"
)" + variations;
}

inline SweepRequest request(const std::vector<std::string>& vary) {
  SweepRequest r;
  r.model_text = pendulum_with(R"([variation."joint.pin.stiffness"]
distribution = "lognormal"
mean = "1e8 N/m"
deviation = "2e7 N/m"
[variation."parameters.length"]
distribution = "uniform"
from = "length/2"
to = "1500 mm"
)");
  r.model_name = "pendulum.toml";
  r.vary = vary;
  return r;
}

inline bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

}  // namespace pintle::sample
