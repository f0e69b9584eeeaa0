// The force law of a joint: a spring and a damper in each component, and whatever else acts beside them, one part after the other.
#pragma once

#include <algorithm>
#include <concepts>
#include <memory>
#include <utility>
#include <vector>

#include "laws/law_part.h"
#include "laws/law_tangents.h"
#include "laws/linear.h"
#include "laws/response.h"

namespace pintle {

/// Where a law is asked, in plain numbers.
struct LawPoint {
  double t;                                       // [s]
  const Planar::Vec& gap;
  const Planar::Vec& rate;
  const double* state = nullptr;                  // n_states() numbers
};

class Law {
 public:
  Law() = default;
  Law(const LinearLaw& linear) : linear_(linear) {}
  /// A law without springs and dampers of its own.
  template <class P>
    requires(!std::same_as<P, LinearLaw> && !std::same_as<P, Law> && requires { P::kWord; })
  Law(const P& part) {
    add(std::make_unique<LawPartOf<P>>(part));
  }
  Law(const Law& other) : linear_(other.linear_) {
    for (const auto& part : other.parts_) add(part->clone());
  }
  Law(Law&&) noexcept = default;
  Law& operator=(Law other) noexcept {
    std::swap(linear_, other.linear_);
    std::swap(parts_, other.parts_);
    std::swap(n_states_, other.n_states_);
    return *this;
  }

  void set_linear(const LinearLaw& linear) { linear_ = linear; }
  /// Throws std::invalid_argument when the joint would have too many states.
  void add(std::unique_ptr<LawPart> part);

  /// The springs and dampers, where there is nothing else: constant tangents, one component apart from the other. Otherwise null.
  const LinearLaw* constant_diagonal() const { return parts_.empty() ? &linear_ : nullptr; }
  int n_states() const { return n_states_; }
  int n_borders() const;
  const std::vector<std::unique_ptr<LawPart>>& parts() const { return parts_; }

  /// Over any number type of PINTLE_LAW_NUMBERS. Fills `out` whole; in.before need not be set.
  template <class T>
  void evaluate(LawInput<T> in, LawOutput<T>& out) const {
    out.clear();
    linear_.evaluate(in, out);
    for (int first = 0; const auto& part : parts_) {
      std::copy(std::begin(out.force), std::end(out.force), in.before);
      LawOutput<T> one;
      one.clear();
      part->evaluate(in, one);
      for (int k = 0; k < 3; ++k) out.force[k] += one.force[k];
      for (int z = 0; z < part->n_states(); ++z) out.state_rate[first + z] = one.state_rate[z];
      out.energy += one.energy;
      out.loss += one.loss;
      in.state += part->n_states();
      first += part->n_states();
    }
  }

  /// Force on the second body; power lost [W].
  Planar::Vec force(const LawPoint& at) const;
  double loss(const LawPoint& at) const;
  double energy(const LawPoint& at) const;
  void state_rates(const LawPoint& at, double* rate) const;
  /// Everything, with the tangents.
  void linearize(const LawPoint& at, LawTangents& out) const;
  /// The signed functions of all borders, n_borders() numbers.
  void borders(const LawPoint& at, double* value) const;

  /// The states of a joint that has long been at this gap and moves at this rate.
  void rest(const LawPoint& at, double* state) const;
  /// What keeps the joint together, with its states at rest: force, static stiffness, damping.
  Response holding(const Planar::Vec& gap, const Planar::Vec& rate) const;
  /// Whether anything acts beside what holds, such as friction in a free direction.
  bool rubs() const;
  /// Whether ideal joints are its limit: springs and dampers hold it, and nothing else does.
  bool ideal_limit() const;
  /// Stiffness of what holds, one-sided laws as if they acted.
  Planar::Vec engaged_stiffness() const;
  /// The largest lever of its parts [m]; 0: it makes no couple of its own force.
  double lever() const;
  /// Moves a gap into the range in which the law holds.
  void engage(Planar::Vec& gap) const {
    for (const auto& part : parts_) part->engage(gap);
  }

  /// Columns of all parts, and their values, appended, where the joint has this force.
  std::vector<LawColumn> columns() const;
  void observe(const LawPoint& at, const Planar::Vec& force, std::vector<double>& values) const;

 private:
  template <class Dual>
  void linearize_by(const LawPoint& at, LawTangents& out) const;
  Response holding_of_parts(const Planar::Vec& gap, const Planar::Vec& rate) const;

  LinearLaw linear_;
  std::vector<std::unique_ptr<LawPart>> parts_;
  int n_states_ = 0;
};

/// What keeps a joint together, at rest: where no states are at hand (assembly, starts, checks).
inline Response respond(const Law& law, const Planar::Vec& gap, const Planar::Vec& rate) {
  if (const LinearLaw* linear = law.constant_diagonal()) return linear->respond(gap, rate);
  return law.holding(gap, rate);
}

}  // namespace pintle
