#include "integrators/methods.h"

#include <stdexcept>
#include <utility>

#include "integrators/dense_output.h"
#include "integrators/dopri5.h"
#include "integrators/ideal_stepper.h"

namespace pintle {
namespace {

const State& inside_of(DenseOutput& dense, const RadauStepper& method, double t) {
  return dense.at(t, method.previous(), method.state(), method.nodes());
}
const State& inside_of(DenseOutput& dense, const Dopri5& method, double t) {
  return dense.at(t, method.previous(), method.state());
}

// A method on the equations of free bodies, with dense output.
template <class Method>
class BodyStepper final : public Stepper {
 public:
  BodyStepper(const System& system, Method method) : method_(std::move(method)), dense_(system) {}

  void set_max_step(double h) override { method_.set_max_step(h); }
  void set_load_scale(const LoadScale& scale) override { method_.set_load_scale(scale); }
  const LoadScale& load_scale() const override { return method_.load_scale(); }
  void start(const State& state, double h) override { method_.start(state, h); }
  bool step(double t_end) override { return method_.step(t_end); }
  const State& state() const override { return method_.state(); }
  const State& previous() const override { return method_.previous(); }
  const State& inside(double t) override { return inside_of(dense_, method_, t); }
  const Counters& counters() const override { return method_.counters(); }
  const std::string& failure() const override { return method_.failure(); }

 private:
  Method method_;
  DenseOutput dense_;
};

}  // namespace

std::string usual_method(Equations equations) { return equations == Equations::kIdeal ? "dopri5" : "radau"; }

std::unique_ptr<Stepper> make_stepper(const System& system, const MethodChoice& choice, double tolerance) {
  if (choice.equations == Equations::kNewtonian) {
    if (choice.method == "radau")
      return std::make_unique<BodyStepper<RadauStepper>>(system, RadauStepper(system, tolerance, choice.stages));
    if (choice.method == "dopri5") return std::make_unique<BodyStepper<Dopri5>>(system, Dopri5(system, tolerance));
  }
  if (choice.equations == Equations::kIdeal && choice.method == "dopri5") return std::make_unique<IdealStepper>(system, tolerance);
  throw std::invalid_argument("there is no method " + choice.method + " for these equations");
}

}  // namespace pintle
