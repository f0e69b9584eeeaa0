// The force law of a joint: a spring and a damper in each component, plus any number of other parts, evaluated one after the other.
#pragma once

#include <algorithm>
#include <concepts>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "laws/law_part.h"
#include "laws/law_tangents.h"
#include "laws/linear.h"
#include "laws/response.h"

namespace pintle {

/// The arguments of a law, in plain numbers.
template <class S>
struct BasicLawPoint {
  double t;                                       // [s]
  const typename S::Vec& gap;
  const typename S::Vec& rate;
  const double* state = nullptr;                  // n_states() numbers
};
using LawPoint = BasicLawPoint<Planar>;

template <class S>
class BasicLaw {
 public:
  using Vec = typename S::Vec;
  using Linear = BasicLinearLaw<S>;
  using Point = BasicLawPoint<S>;
  using Tangents = BasicLawTangents<S>;
  using Part = BasicLawPart<S>;
  BasicLaw() = default;
  BasicLaw(const Linear& linear) : linear_(linear) {}
  /// A law without springs and dampers of its own.
  template <class P>
    requires(!std::same_as<P, BasicLinearLaw<S>> && !std::same_as<P, BasicLaw> && requires { P::kWord; })
  BasicLaw(const P& part) {
    add(std::make_unique<LawPartOf<P, S>>(part));
  }
  BasicLaw(const BasicLaw& other) : linear_(other.linear_) {
    for (const auto& part : other.parts_) add(part->clone());
  }
  BasicLaw(BasicLaw&&) noexcept = default;
  BasicLaw& operator=(BasicLaw other) noexcept {
    std::swap(linear_, other.linear_);
    std::swap(parts_, other.parts_);
    std::swap(n_states_, other.n_states_);
    return *this;
  }

  void set_linear(const Linear& linear) { linear_ = linear; }
  /// Throws std::invalid_argument if the joint would have too many states.
  void add(std::unique_ptr<Part> part);
  /// Only the parts that hold the joint: without friction, stops, detents and pressure.
  BasicLaw holding_law() const;

  /// The springs and dampers if there is nothing else: constant tangents without coupling between components. Otherwise null.
  const Linear* as_linear() const { return parts_.empty() ? &linear_ : nullptr; }
  int n_states() const { return n_states_; }
  int n_borders() const;
  const std::vector<std::unique_ptr<Part>>& parts() const { return parts_; }

  /// Over any number type of PINTLE_LAW_NUMBERS. Sets all of `out`; in.before need not be set.
  template <class T>
  void evaluate(LawInput<T, S::kDof> in, LawOutput<T, S::kDof>& out) const {
    out.clear(n_states_);
    linear_.evaluate(in, out);
    for (int first = 0; const auto& part : parts_) {
      std::copy(std::begin(out.force), std::end(out.force), in.before);
      LawOutput<T, S::kDof> one;
      one.clear(part->n_states());
      part->evaluate(in, one);
      for (int k = 0; k < S::kDof; ++k) out.force[k] += one.force[k];
      for (int z = 0; z < part->n_states(); ++z) out.state_rate[first + z] = one.state_rate[z];
      out.energy += one.energy;
      out.loss += one.loss;
      in.state += part->n_states();
      first += part->n_states();
    }
  }

  /// Force on the second body; power lost [W].
  Vec force(const Point& at) const;
  double loss(const Point& at) const;
  /// The contribution to the force of the parts that have states.
  Vec force_of_states(const Point& at) const;
  double energy(const Point& at) const;
  void state_rates(const Point& at, double* rate) const;
  /// Everything, with the tangents.
  void linearize(const Point& at, Tangents& out) const;
  /// The signed functions of all borders, n_borders() numbers.
  void borders(const BasicLawPoint<S>& at, double* value) const;
  /// Lets the part set those of its states that change at its border, which has just been crossed; `state` is that of `at`. Any decrease of
  /// the law's stored energy is added to `lost` [J].
  void cross(const Point& at, int part, int border, double* state, double& lost) const;

  /// The states of a joint that has long been at this gap and moves at this rate.
  void rest(const Point& at, double* state) const;
  /// The stiction of the part that sticks in this state, if one does: LawPart::stiction.
  std::optional<Stiction> stiction(const double* state) const;
  /// Sets the states of the part that can stick, among those of `at`, so that it sticks and carries `force`; false if it would slip.
  bool set_stuck(const Point& at, double force, double* state) const;
  /// The part that could stick starts in slip: LawPart::start_slipping.
  void start_slipping(double force);
  /// The response of the parts that hold the joint, with their states at rest: force, static stiffness, damping.
  BasicResponse<S> holding(const Vec& gap, const Vec& rate) const;
  /// Whether any part acts that does not hold, such as friction or a stop in a free direction.
  bool rubs() const;
  /// Whether a part that holds also causes friction in the free directions, as touching surfaces do.
  bool rubs_where_it_holds() const;
  /// Whether such a part acts whatever the joint carries, as stops and detents do and friction of pins does not.
  bool acts_without_reaction() const;
  /// Whether a part is the stops of the free coordinate; whether a part is its dry friction.
  bool has_stops() const;
  bool has_friction() const;
  /// Whether the force of a part depends only on the forces of those before it; and the sum of these forces if the joint has this
  /// reaction. They have no potential: their power is supplied from outside.
  bool depends_on_reaction_alone() const;
  Vec force_on_reaction(const Vec& reaction) const;
  /// Whether a part supplies power, as the pressure in a cylinder does.
  bool feeds() const;
  /// The power supplied if the joint has this force [W]. It does not depend on states.
  double supply(const Point& at, const Vec& force) const;
  /// The stop that this gap exceeds.
  std::optional<StopBreach> breach(const Vec& gap) const;
  /// Whether its limit is an ideal joint: springs and dampers hold the joint, and nothing else does.
  bool ideal_limit() const;
  /// Whether a start leaves the joint where assembly has put it: LawPart::starts_free.
  bool starts_free() const;
  /// Stiffness of the parts that hold, with one-sided laws treated as acting.
  Vec engaged_stiffness() const;
  /// LawPart::gap_under, if a single part holds the joint.
  std::optional<Vec> gap_under(const Vec& force) const;
  /// LawPart::closed_stiffness of the parts that are open here: those with borders and no force.
  Vec open_contact_stiffness(const Point& at) const;
  /// The largest lever of its parts [m]; 0: its own force causes no couple.
  double lever() const;
  /// The largest value of its parts: LawPart::penetration.
  double penetration(const Vec& gap) const;
  /// LawPart::misfit.
  Vec misfit(Vec gap) const {
    for (const auto& part : parts_) gap = part->misfit(gap);
    return gap;
  }

  /// The columns of all parts; their values, appended, if the joint has this force.
  std::vector<LawColumn> columns() const;
  void observe(const Point& at, const Vec& force, std::vector<double>& values) const;

 private:
  template <class Dual>
  void linearize_by(const Point& at, Tangents& out) const;
  template <class Visit>
  void visit_parts(const Point& at, const Visit& visit) const;
  BasicResponse<S> holding_of_parts(const Vec& gap, const Vec& rate) const;

  Linear linear_;
  std::vector<std::unique_ptr<Part>> parts_;
  int n_states_ = 0;
};
using Law = BasicLaw<Planar>;

/// The response at rest of what keeps a joint together: for use where states are not available (assembly, starts, checks).
template <class S>
BasicResponse<S> respond(const BasicLaw<S>& law, const typename S::Vec& gap, const typename S::Vec& rate) {
  if (const auto* linear = law.as_linear()) return linear->respond(gap, rate);
  return law.holding(gap, rate);
}

/// Whether a law with this response resists in all components in which it would hold its joint.
template <class S>
bool resists(const BasicLaw<S>& law, const BasicResponse<S>& now) {
  const typename S::Vec engaged = law.engaged_stiffness();
  for (int k = 0; k < S::kDof; ++k)
    if (engaged[k] > 0 && !(now.stiffness(k, k) > 0)) return false;
  return true;
}

}  // namespace pintle
