#include "integrators/general/sundials_stepper.h"

#ifdef PINTLE_SUNDIALS

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "integrators/dense/dense_output.h"
#include "integrators/general/sundials_code.h"
#include "integrators/general/usual_tolerance.h"
#include "integrators/law_borders.h"

namespace pintle {
namespace {

constexpr int kDenseBodies = 8;          // with more bodies, Newton matrices are factorised by KLU
constexpr double kBehind = 1e-7;         // fraction of a step that ended on the root of a border without crossing it: how far the state is taken beyond it
constexpr double kDoesNotSteer = 1e100;  // absolute tolerance of the energies, so that they do not control the steps [J]

class SundialsStepper final : public Stepper {
 public:
  SundialsStepper(const System& system, std::string name, const SundialsChoice& choice, double tolerance)
      : name_(std::move(name)), choice_(choice), tolerance_(tolerance), equations_(system, FirstOrderOde::Energies::kAppended),
        states_(system), borders_(system), begin_(zero_state(system)), end_(begin_), between_(begin_), dense_(system) {}

  void set_max_step(double h) override { max_step_ = h; }
  void set_load_scale(const LoadScale&) override {}
  const LoadScale& load_scale() const override { return no_scale_; }

  void start(const State& state, double) override {
    begin_ = end_ = state;
    states_.complete(end_);
    borders_.start(end_);
    const UsualTolerance usual(tolerance_);
    std::vector<double> y(equations_.size()), floor(y.size(), usual.absolute);
    for (int i = equations_.state_size(); i < equations_.size(); ++i) floor[i] = kDoesNotSteer;
    equations_.flatten(state, y.data());
    code_.emplace(choice_, equations_, state.t, y, usual.relative, floor);
    if (max_step_ > 0) code_->set_max_step(max_step_);
  }

  bool step(double t_end) override {
    begin_ = end_;
    code_->stop_at(t_end);
    if (!code_->step()) {
      failure_ = fmt::format("{}: {}", name_, code_->failure());
      return false;
    }
    equations_.unflatten(code_->t(), code_->y(), end_);
    states_.complete(end_);
    if (borders_.cross(end_) || (code_->at_root() && cross_just_behind())) {
      std::vector<double> y(equations_.size());
      equations_.flatten(end_, y.data());
      code_->restart(end_.t, y);
      states_.complete(end_);
      borders_.record(end_);
    }
    code_->count(counters_);
    return true;
  }

  const State& state() const override { return end_; }
  const State& previous() const override { return begin_; }
  const State& interpolate(double t) override {
    if (t == end_.t) return end_;
    if (t == begin_.t) return begin_;
    if (borders_.crossed()) return dense_.at(std::min(t, state_before_event().t), begin_, state_before_event());  // the code no longer has the step
    const double* y = code_->interpolate(t);
    if (!y) return end_;
    equations_.unflatten(t, y, between_);
    states_.complete(between_);
    return between_;
  }
  const State& state_before_event() const override { return borders_.before_event(end_); }
  const Counters& counters() const override { return counters_; }
  const std::string& failure() const override { return failure_; }
  const std::vector<LawCrossing>& crossings() const override { return borders_.crossings(); }

 private:
  // The root on which a step has ended may be just before a border, or exactly on it.
  bool cross_just_behind() {
    const double* y = code_->interpolate(end_.t + kBehind * (end_.t - begin_.t));
    if (!y) return false;
    between_ = end_;
    equations_.unflatten(end_.t + kBehind * (end_.t - begin_.t), y, end_);
    states_.complete(end_);
    if (borders_.cross(end_)) return true;
    end_ = between_;
    return false;
  }

  std::string name_;
  SundialsChoice choice_;
  double tolerance_, max_step_ = 0;
  FirstOrderOde equations_;
  ForceEvaluator states_;
  LawBorders borders_;
  std::optional<SundialsCode> code_;
  State begin_, end_, between_;
  DenseOutput dense_;
  LoadScale no_scale_;
  Counters counters_;
  std::string failure_;
};

}  // namespace

bool has_sundials() { return true; }

std::unique_ptr<Stepper> make_sundials_stepper(const System& system, const std::string& method, double tolerance) {
  SundialsChoice choice;
  if (method == "ode45") {
    choice.family = SundialsChoice::Family::kExplicitRungeKutta;
    choice.table = dormand_prince_table();
  } else if (method == "ode113") {
    choice.family = SundialsChoice::Family::kAdams;
  } else if (method != "ode15s") {
    return nullptr;
  }
  if (system.n_bodies() > kDenseBodies) choice.solver = SundialsChoice::LinearSolver::kKlu;
  return std::make_unique<SundialsStepper>(system, method, choice, tolerance);
}

}  // namespace pintle

#else

namespace pintle {

bool has_sundials() { return false; }

std::unique_ptr<Stepper> make_sundials_stepper(const System&, const std::string&, double) { return nullptr; }

}  // namespace pintle

#endif
