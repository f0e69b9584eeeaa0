#include "integrators/methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

#include "integrators/absolute/radau_stepper.h"
#include "integrators/dense/dense_output.h"
#include "integrators/general/alpha_stepper.h"
#include "integrators/general/dopri5.h"
#include "integrators/general/sundials_stepper.h"
#include "integrators/ideal/augmented_lagrangian.h"
#include "integrators/ideal/ideal_stepper.h"
#include "integrators/ideal/penalty_forces.h"
#include "integrators/ideal/tree_augmented.h"
#include "integrators/relative/tree_dopri5.h"
#include "integrators/relative/tree_radau.h"

namespace pintle {
namespace {

template <class S>
const BasicState<S>& interpolate_with(BasicDenseOutput<S>& dense, BasicRadauStepper<S>& method, double t) {
  if (const BasicState<S>* before = method.in_crossing(t)) return *before;
  return t == method.state().t ? method.state() : dense.at(t, method.previous(), method.state_before_event(), method.nodes());
}
const State& interpolate_with(DenseOutput& dense, const Dopri5& method, double t) {
  return t == method.state().t ? method.state() : dense.at(t, method.previous(), method.state_before_event());
}

// A method on the equations of free bodies, with dense output.
template <class S, class Method>
class BodyStepper final : public BasicStepper<S> {
 public:
  BodyStepper(const BasicSystem<S>& system, Method method) : method_(std::move(method)), dense_(system) {}

  void set_max_step(double h) override { method_.set_max_step(h); }
  void set_load_scale(const BasicLoadScale<S>& scale) override { method_.set_load_scale(scale); }
  const BasicLoadScale<S>& load_scale() const override { return method_.load_scale(); }
  void start(const BasicState<S>& state, double h) override { method_.start(state, h); }
  bool step(double t_end) override { return method_.step(t_end); }
  const BasicState<S>& state() const override { return method_.state(); }
  const BasicState<S>& previous() const override { return method_.previous(); }
  const BasicState<S>& interpolate(double t) override { return interpolate_with(dense_, method_, t); }
  const BasicState<S>& state_before_event() const override {
    if constexpr (requires { method_.state_before_event(); }) return method_.state_before_event();
    else return method_.state();
  }
  const BasicStepNodes<S>* nodes() const override {
    if constexpr (requires { method_.nodes(); }) return &method_.nodes();
    else return nullptr;
  }
  int sliding_load() const override {
    if constexpr (requires { method_.sliding_load(); }) return method_.sliding_load();
    else return -1;
  }
  double largest_step_error() const override {
    if constexpr (requires { method_.largest_step_error(); }) return method_.largest_step_error();
    else return 1;
  }
  bool watches_bends() const override { return std::is_same_v<Method, BasicRadauStepper<S>>; }
  const Counters& counters() const override { return method_.counters(); }
  const std::string& failure() const override { return method_.failure(); }
  const std::vector<LawCrossing>& crossings() const override { return method_.crossings(); }
  std::string last_event(double since) const override {
    if constexpr (requires { method_.last_event(since); }) return method_.last_event(since);
    else return {};
  }

 private:
  Method method_;
  BasicDenseOutput<S> dense_;
};

template <class S>
std::unique_ptr<BasicStepper<S>> make_radau(const BasicSystem<S>& system, const MethodChoice& choice, double tolerance) {
  return std::make_unique<BodyStepper<S, BasicRadauStepper<S>>>(system, BasicRadauStepper<S>(system, tolerance, choice.stages, choice.tolerance_of));
}

constexpr double kHhtAlpha = -0.05;     // alpha of Hilber, Hughes and Taylor: damping of fast vibration
constexpr double kKeptVibration = 0.9;  // generalised-alpha's factor per step at very high frequencies

constexpr std::array<std::string_view, 3> kFromSundials{"ode45", "ode15s", "ode113"};
constexpr std::array<std::string_view, 3> kAlphaFamily{"ode23t", "hht", "generalised_alpha"};

template <class List>
bool is_in(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

bool is_augmented(Equations equations) { return equations == Equations::kAugmentedLagrangian || equations == Equations::kRelativeAugmented; }

AlphaWeights alpha_weights(std::string_view method) {
  return method == "hht"                 ? AlphaWeights::hht(kHhtAlpha)
         : method == "generalised_alpha" ? AlphaWeights::generalised(kKeptVibration)
                                         : AlphaWeights::trapezoidal();
}

std::string usual_method(Equations equations) {
  if (is_augmented(equations)) return "ode23t";
  return has_constraints(equations) ? "dopri5" : "radau";
}

}  // namespace

MethodChoice resolve_method(const SimulateSettings& settings) {
  MethodChoice choice;
  choice.equations = settings.equations;
  choice.method = settings.method == "auto" ? usual_method(settings.equations) : settings.method;
  choice.tolerance_of = settings.tolerance_of;
  choice.penalty = settings.penalty;
  return choice;
}

std::string why_not(const MethodChoice& choice) {
  const bool sundials = is_in(kFromSundials, choice.method), alpha = is_in(kAlphaFamily, choice.method);
  const bool augmented = is_augmented(choice.equations), penalty = choice.equations == Equations::kPenalty, tree = choice.equations == Equations::kRelativeAugmented;
  const bool has_radau = !has_constraints(choice.equations);
  if (penalty && alpha) return "";
  if (augmented ? alpha && !(tree && choice.method == "generalised_alpha") : choice.method == "dopri5" || (choice.method == "radau" && has_radau)) return "";
  if (choice.equations != Equations::kNewtonian)
    return (sundials || alpha) && !augmented
               ? fmt::format("method {} needs joints that are force laws (equations = \"newtonian\")", choice.method)
               : fmt::format("there is no method {} for these equations", choice.method);
  if (sundials && !has_sundials())
    return fmt::format("method {}: this build has no SUNDIALS; install libsundials-dev and libsuitesparse-dev and build again, or choose "
                       "another method (radau, dopri5, ode23t, hht, generalised_alpha)",
                       choice.method);
  if (sundials || alpha) return "";
  return fmt::format("there is no method {} for these equations", choice.method);
}

std::unique_ptr<Stepper> make_stepper(const System& system, const MethodChoice& choice, double tolerance) {
  if (const std::string reason = why_not(choice); !reason.empty()) throw std::invalid_argument(reason);
  if (choice.equations == Equations::kPenalty && choice.method != "dopri5")
    return std::make_unique<AlphaStepper>(system, alpha_weights(choice.method), tolerance, std::make_unique<PenaltyForces>(system, choice.penalty));
  if (choice.equations == Equations::kIdeal || choice.equations == Equations::kPenalty)
    return std::make_unique<IdealStepper>(system, tolerance, choice.equations, choice.penalty);
  if (choice.equations == Equations::kAugmentedLagrangian)
    return std::make_unique<AlphaStepper>(system, alpha_weights(choice.method), tolerance, std::make_unique<AugmentedLagrangian>(system));
  if (choice.equations == Equations::kRelativeAugmented) return std::make_unique<TreeAugmented>(system, alpha_weights(choice.method), tolerance);
  if (choice.equations == Equations::kRelative) {
    if (choice.method == "radau") return std::make_unique<TreeRadau>(system, tolerance, choice.stages);
    return std::make_unique<TreeDopri5>(system, tolerance);
  }
  if (choice.method == "radau") return make_radau(system, choice, tolerance);
  if (choice.method == "dopri5") return std::make_unique<BodyStepper<Planar, Dopri5>>(system, Dopri5(system, tolerance));
  if (is_in(kAlphaFamily, choice.method)) return std::make_unique<AlphaStepper>(system, alpha_weights(choice.method), tolerance);
  return make_sundials_stepper(system, choice.method, tolerance);
}

#ifndef PINTLE_PLANAR_ONLY
std::unique_ptr<BasicStepper<Spatial>> make_stepper(const BasicSystem<Spatial>& system, const MethodChoice& choice, double tolerance) {
  if (choice.equations != Equations::kNewtonian)
    throw std::invalid_argument("mechanisms in space have the equations of free bodies only: set equations = \"newtonian\", in which every joint is a force law");
  if (choice.method != "radau") throw std::invalid_argument(fmt::format("method {} is for mechanisms of the plane: in space set method = \"radau\", or \"auto\"", choice.method));
  return make_radau(system, choice, tolerance);
}
#endif

}  // namespace pintle
