// An ensemble from a program: the largest pin force of a bob of 1 kg on arms of three lengths, and the file that holds it.
//
// Let go from the horizontal, the pin carries m g + 2 m g / (1 + I / (m r^2)) at the bottom. The program prints both and
// fails if they differ by more than the distance of two output times and the pin's compliance explain.
#include <pintle/sweep.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

int main() {
  pintle::SweepRequest request;
  request.model_name = "pendulum.toml";
  request.model_text = R"(format = 1
[parameters]
length = "1 m"
[simulate]
duration = "1 s"
[ground.markers]
O = [0, 0]
[body.bob]
mass = "1 kg"
inertia = "1e-3 kg*m^2"
position = ["length", 0]
markers.O = ["-length", 0]
[joint.pin]
type = "revolute"
between = ["ground.O", "bob.O"]
)";
  request.vary = {"parameters.length=0.5..1.5 m:lin:3"};
  pintle::sweep(request, {"pendulum-sweep.h5", 0, true, "sweep"});
  const pintle::SweepTable table = pintle::read_sweep("pendulum-sweep.h5");
  bool good = table.n_samples() == 3;
  for (std::size_t i = 0; i < table.n_samples(); ++i) {
    const double length = table.values[i], truth = 9.80665 * (1 + 2 / (1 + 1e-3 / (length * length)));
    std::printf("%.1f m: peak pin force %.2f N, of a rigid pin %.2f N\n", length, table.force[i], truth);
    good = good && std::abs(table.force[i] - truth) < 1e-3 * truth;
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
