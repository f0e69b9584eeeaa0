// One of the force laws that act in parallel in a joint. A new law is a plain struct that meets the requirements of LawPartOf.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "base/bends.h"
#include "laws/law_numbers.h"
#include "space/space.h"

namespace pintle {

/// A quantity that a law reports in addition to its force, as a column of results.
struct LawColumn {
  std::string name;     // "friction"
  std::string unit;     // "N*m"
  std::string meaning;  // one line
};

/// A coordinate beyond a stop.
struct StopBreach {
  bool upper = false;  // which stop
  int component = 0;   // of the relative pose
  double stop = 0;     // its position [m] or [rad]
  double depth = 0;    // how far the coordinate is beyond it
};

/// What holds a free coordinate of a joint that friction keeps at rest.
struct Stiction {
  int component = 0;     // of the relative pose
  double stiffness = 0;  // [N/m] or [N*m/rad]
};

template <class S>
class BasicLawPart {
 public:
  using Vec = typename S::Vec;
  template <class T>
  using Input = LawInput<T, S::kDof>;
  template <class T>
  using Output = LawOutput<T, S::kDof>;
  virtual ~BasicLawPart() = default;
  virtual std::unique_ptr<BasicLawPart> clone() const = 0;
  virtual std::string_view word() const = 0;

#define PINTLE_EVALUATE(T) virtual void evaluate(const Input<T>& in, Output<T>& out) const = 0;
  PINTLE_LAW_NUMBERS(PINTLE_EVALUATE)
#undef PINTLE_EVALUATE

  virtual int n_states() const = 0;
  /// The steady states at this gap and rate: state_rate = 0.
  virtual void rest(const Input<double>& in, double* state) const = 0;
  /// Signed functions that change sign where the law changes its formula; integrators end a step there.
  virtual int n_borders() const = 0;
  virtual void borders(const Input<double>& in, double* value) const = 0;
  /// The direction in which border i matters: +1 if its function turns positive, -1 if it turns negative, 0 for both.
  virtual int border_direction(int i) const = 0;
  /// Name of the event of crossing border i in that direction: "touch".
  /// "": not an event of interest to users.
  virtual std::string border_name(int i, bool rising) const = 0;
  /// Whether the borders of a law without states are events too.
  virtual bool reports_crossings() const = 0;
  /// Called just after border i has been crossed in that direction: sets those of its states that are constant in between, such as a mode or a
  /// value kept from the instant when two bodies touched. `in` is the instant after the crossing.
  virtual void cross(int i, const Input<double>& in, double* state) const = 0;
  /// Whether it keeps the joint together. Parts that do not (friction) are left out in the search for gaps that carry loads.
  virtual bool holds() const = 0;
  /// Whether it is the stops of the free coordinate.
  virtual bool stops() const = 0;
  /// Whether it is dry friction in the free directions.
  virtual bool rubs() const = 0;
  /// Whether a part that holds also causes friction in the free directions, as touching surfaces do.
  virtual bool rubs_where_it_holds() const = 0;
  /// What it holds in this state, as dry friction that sticks does; none if it holds nothing.
  virtual std::optional<Stiction> stiction(const double* state) const = 0;
  /// Sets its states so that it sticks and carries `force`; false if it would slip.
  virtual bool set_stuck(const Input<double>& in, double force, double* state) const = 0;
  /// From now on, rest() at zero speed returns a slip that begins under `force`, which is too large to be held, instead of sticking.
  virtual void start_slipping(double force) = 0;
  /// Whether its force is a function of the force of the parts before it and of nothing else: if the joint is ideal, it has this force too.
  virtual bool depends_on_reaction_alone() const = 0;
  /// Whether it supplies power from outside, as the pressure in a cylinder does; and that power, a function of time, gap and rate [W].
  virtual bool feeds() const = 0;
  virtual double supply(const Input<double>& in) const = 0;
  /// Whether a start leaves its joint where assembly has put it, loaded or not: a rope may be slack there, a pin with clearance apart from its bush.
  virtual bool starts_free() const = 0;
  /// Stiffness in each component where the law acts; a slack rope is treated as if it were taut.
  virtual Vec engaged_stiffness() const = 0;
  /// Stiffness in each component once a gap that may be open has closed; engaged_stiffness unless the law specifies otherwise.
  virtual Vec closed_stiffness() const = 0;
  /// The gap at which it carries `force` at rest, for laws that can give it; none: it has to be searched for. Components that it does not hold are 0.
  virtual std::optional<Vec> gap_under(const Vec& force) const = 0;
  /// The bends of the force as a function of the component that is returned with them: steps must not skip them. None: the force is smooth.
  virtual std::pair<int, Bends> bends() const = 0;
  /// Factor by which the joint's own force is multiplied to scale couples that the law derives from it [m]: the radius of a pin with friction.
  virtual double lever() const = 0;
  /// The part of a gap that assembly must close: nothing for a slack rope, the distance from its rest position for a bushing.
  virtual Vec misfit(const Vec& gap) const = 0;
  /// Depth by which the bodies overlap at this gap [m], negative while apart; minus infinity for laws without contact.
  virtual double penetration(const Vec& gap) const = 0;
  /// The stop that this gap exceeds; none: it is between the stops.
  virtual std::optional<StopBreach> breach(const Vec& gap) const = 0;
  virtual std::span<const LawColumn> columns() const = 0;
  /// One value per column, if the whole joint has this force on its second body; the contributions of other parts that do not hold are already subtracted.
  virtual void observe(const Input<double>& in, const Vec& force, double* value) const = 0;
};
using LawPart = BasicLawPart<Planar>;

/// A law from a plain struct P. It has `kWord`, `typical()` (parameters for tests), and a template member evaluate(in, out) that fills out, which is all zero on entry; where they apply also n_states() with rest(),
/// n_borders() with borders(), border_directions() (one +1, -1 or 0 each, or border_direction(i)), cross() and border_name(), kHolds = false, kStops = true, kRubs = false (for parts that neither hold nor stop),
/// kOnReactionAlone = true, kStartsFree = true, kReportsCrossings = true, supply(in), columns() with observe(), engaged_stiffness(), closed_stiffness(), gap_under(), bends(), misfit(), lever(), penetration(), breach(),
/// stiction() with set_stuck() and start_slipping().
template <class P, class S = Planar>
class LawPartOf final : public BasicLawPart<S> {
 public:
  using Vec = typename S::Vec;
  template <class T>
  using Input = LawInput<T, S::kDof>;
  template <class T>
  using Output = LawOutput<T, S::kDof>;
  explicit LawPartOf(P law) : law_(std::move(law)) {}
  std::unique_ptr<BasicLawPart<S>> clone() const override { return std::make_unique<LawPartOf>(*this); }
  std::string_view word() const override { return P::kWord; }

#define PINTLE_EVALUATE(T) \
  void evaluate(const Input<T>& in, Output<T>& out) const override { law_.evaluate(in, out); }
  PINTLE_LAW_NUMBERS(PINTLE_EVALUATE)
#undef PINTLE_EVALUATE

  int n_states() const override {
    if constexpr (requires { law_.n_states(); }) return law_.n_states();
    else return 0;
  }
  void rest(const Input<double>& in, double* state) const override {
    if constexpr (requires { law_.rest(in, state); }) law_.rest(in, state);
  }
  int n_borders() const override {
    if constexpr (requires { law_.n_borders(); }) return law_.n_borders();
    else return 0;
  }
  void borders(const Input<double>& in, double* value) const override {
    if constexpr (requires { law_.borders(in, value); }) law_.borders(in, value);
  }
  int border_direction(int i) const override {
    if constexpr (requires { law_.border_direction(i); }) return law_.border_direction(i);
    else if constexpr (requires { law_.border_directions()[i]; }) return law_.border_directions()[i];
    else return 0;
  }
  std::string border_name(int i, bool rising) const override {
    if constexpr (requires { law_.border_name(i, rising); }) return std::string(law_.border_name(i, rising));
    else return "border " + std::to_string(i + 1) + (rising ? " rises" : " falls");
  }
  bool reports_crossings() const override {
    if constexpr (requires { P::kReportsCrossings; }) return P::kReportsCrossings;
    else return false;
  }
  void cross(int i, const Input<double>& in, double* state) const override {
    if constexpr (requires { law_.cross(i, in, state); }) law_.cross(i, in, state);
  }
  bool holds() const override {
    if constexpr (requires { P::kHolds; }) return P::kHolds;
    else return true;
  }
  bool stops() const override {
    if constexpr (requires { P::kStops; }) return P::kStops;
    else return false;
  }
  bool rubs() const override {
    if constexpr (requires { P::kRubs; }) return P::kRubs;
    else return !holds() && !stops();
  }
  bool rubs_where_it_holds() const override {
    if constexpr (requires { law_.rubs(); }) return law_.rubs();
    else return false;
  }
  std::optional<Stiction> stiction(const double* state) const override {
    if constexpr (requires { law_.stiction(state); }) return law_.stiction(state);
    else return {};
  }
  bool set_stuck(const Input<double>& in, double force, double* state) const override {
    if constexpr (requires { law_.set_stuck(in, force, state); }) return law_.set_stuck(in, force, state);
    else return false;
  }
  void start_slipping(double force) override {
    if constexpr (requires { law_.start_slipping(force); }) law_.start_slipping(force);
  }
  bool depends_on_reaction_alone() const override {
    if constexpr (requires { P::kOnReactionAlone; }) return P::kOnReactionAlone;
    else return false;
  }
  bool feeds() const override {
    return requires(const Input<double>& in) { law_.supply(in); };
  }
  double supply(const Input<double>& in) const override {
    if constexpr (requires { law_.supply(in); }) return law_.supply(in);
    else return 0;
  }
  bool starts_free() const override {
    if constexpr (requires { law_.starts_free(); }) return law_.starts_free();
    else if constexpr (requires { P::kStartsFree; }) return P::kStartsFree;
    else return false;
  }
  Vec engaged_stiffness() const override {
    if constexpr (requires { law_.engaged_stiffness(); }) return law_.engaged_stiffness();
    else return Vec::Zero();
  }
  std::optional<Vec> gap_under(const Vec& force) const override {
    if constexpr (requires { law_.gap_under(force); }) return law_.gap_under(force);
    else return std::nullopt;
  }
  Vec closed_stiffness() const override {
    if constexpr (requires { law_.closed_stiffness(); }) return law_.closed_stiffness();
    else return engaged_stiffness();
  }
  std::pair<int, Bends> bends() const override {
    if constexpr (requires { law_.bends(); }) return {law_.free, law_.bends()};
    else return {};
  }
  double lever() const override {
    if constexpr (requires { law_.lever(); }) return law_.lever();
    else return 0;
  }
  Vec misfit(const Vec& gap) const override {
    if constexpr (requires { law_.misfit(gap); }) return law_.misfit(gap);
    else return gap;
  }
  double penetration(const Vec& gap) const override {
    if constexpr (requires { law_.penetration(gap); }) return law_.penetration(gap);
    else return -std::numeric_limits<double>::infinity();
  }
  std::optional<StopBreach> breach(const Vec& gap) const override {
    if constexpr (requires { law_.breach(gap); }) return law_.breach(gap);
    else return {};
  }
  std::span<const LawColumn> columns() const override {
    if constexpr (requires { law_.columns(); }) return law_.columns();
    else return {};
  }
  void observe(const Input<double>& in, const Vec& force, double* value) const override {
    if constexpr (requires { law_.observe(in, force, value); }) law_.observe(in, force, value);
  }

 private:
  P law_;
};

}  // namespace pintle
