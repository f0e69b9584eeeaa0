#include "laws/law.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace pintle {
namespace {

template <class S>
LawInput<double, S::kDof> input_at(const BasicLawPoint<S>& at) {
  LawInput<double, S::kDof> in{};
  in.t = at.t;
  std::copy_n(at.gap.data(), S::kDof, in.gap);
  std::copy_n(at.rate.data(), S::kDof, in.rate);
  in.state = at.state;
  return in;
}

template <class S>
LawOutput<double, S::kDof> answer(const BasicLaw<S>& law, const BasicLawPoint<S>& at) {
  LawOutput<double, S::kDof> out;
  law.evaluate(input_at(at), out);
  return out;
}

template <class S>
typename S::Vec force_of(const BasicLawPart<S>& part, const LawInput<double, S::kDof>& in) {
  LawOutput<double, S::kDof> out;
  out.clear();
  part.evaluate(in, out);
  return Eigen::Map<const typename S::Vec>(out.force);
}

}  // namespace

template <class S>
void BasicLaw<S>::add(std::unique_ptr<BasicLawPart<S>> part) {
  const int states = n_states_ + part->n_states();
  if (states > kMostLawStates) throw std::invalid_argument(fmt::format("the laws of a joint may have {} states together", kMostLawStates));
  parts_.push_back(std::move(part));
  n_states_ = states;
}

template <class S>
int BasicLaw<S>::n_borders() const {
  int n = 0;
  for (const auto& part : parts_) n += part->n_borders();
  return n;
}

template <class S>
typename S::Vec BasicLaw<S>::force(const BasicLawPoint<S>& at) const {
  if (parts_.empty()) return linear_.force(at.gap, at.rate);
  const auto out = answer(*this, at);
  return Eigen::Map<const typename S::Vec>(out.force);
}

template <class S>
double BasicLaw<S>::loss(const BasicLawPoint<S>& at) const { return parts_.empty() ? linear_.loss(at.rate) : answer(*this, at).loss; }

template <class S>
double BasicLaw<S>::energy(const BasicLawPoint<S>& at) const {
  return parts_.empty() ? linear_.respond(at.gap, at.rate).energy : answer(*this, at).energy;
}

template <class S>
void BasicLaw<S>::state_rates(const BasicLawPoint<S>& at, double* rate) const {
  if (n_states_ == 0) return;
  const auto out = answer(*this, at);
  std::copy_n(out.state_rate, n_states_, rate);
}

template <class S>
template <class Dual>
void BasicLaw<S>::linearize_by(const BasicLawPoint<S>& at, BasicLawTangents<S>& out) const {
  LawInput<Dual, S::kDof> in;
  Dual state[kMostLawStates];
  in.t = Dual(at.t);
  for (int k = 0; k < S::kDof; ++k) {
    in.gap[k] = Dual::variable(at.gap[k], k);
    in.rate[k] = Dual::variable(at.rate[k], S::kDof + k);
  }
  for (int z = 0; z < n_states_; ++z) state[z] = Dual::variable(at.state[z], 2 * S::kDof + z);
  in.state = state;
  LawOutput<Dual, S::kDof> answer;
  evaluate(in, answer);
  out.n = n_states_;
  out.energy = answer.energy.v;
  out.loss = answer.loss.v;
  for (int k = 0; k < S::kDof; ++k) {
    out.force[k] = answer.force[k].v;
    for (int c = 0; c < S::kDof; ++c) {
      out.stiffness(k, c) = -answer.force[k].d[c];
      out.damping(k, c) = -answer.force[k].d[S::kDof + c];
    }
    for (int z = 0; z < n_states_; ++z) out.force_by_state[k][z] = answer.force[k].d[2 * S::kDof + z];
  }
  for (int z = 0; z < n_states_; ++z) {
    out.state_rate[z] = answer.state_rate[z].v;
    for (int c = 0; c < S::kDof; ++c) {
      out.by_gap[z][c] = answer.state_rate[z].d[c];
      out.by_rate[z][c] = answer.state_rate[z].d[S::kDof + c];
    }
    for (int y = 0; y < n_states_; ++y) out.by_state[z][y] = answer.state_rate[z].d[2 * S::kDof + y];
  }
}

template <class S>
void BasicLaw<S>::linearize(const BasicLawPoint<S>& at, BasicLawTangents<S>& out) const {
  if (n_states_ <= 2) linearize_by<FewDual<S::kDof>>(at, out);
  else linearize_by<ManyDual<S::kDof>>(at, out);
}

// Calls visit(part, in) for every part with its input: its states, and the forces of the parts before it.
template <class S>
template <class Visit>
void BasicLaw<S>::visit_parts(const BasicLawPoint<S>& at, const Visit& visit) const {
  LawInput<double, S::kDof> in = input_at(at);
  LawOutput<double, S::kDof> so_far, one;
  so_far.clear();
  linear_.evaluate(in, so_far);
  for (const auto& part : parts_) {
    std::copy(std::begin(so_far.force), std::end(so_far.force), in.before);
    visit(*part, in);
    if (&part == &parts_.back()) return;
    one.clear();
    part->evaluate(in, one);
    for (int k = 0; k < S::kDof; ++k) so_far.force[k] += one.force[k];
    in.state += part->n_states();
  }
}

template <class S>
typename S::Vec BasicLaw<S>::force_of_states(const BasicLawPoint<S>& at) const {
  typename S::Vec force = S::Vec::Zero();
  visit_parts(at, [&force](const Part& part, const LawInput<double, S::kDof>& in) {
    if (part.n_states() == 0) return;
    force += force_of<S>(part, in);
  });
  return force;
}

template <class S>
void BasicLaw<S>::borders(const BasicLawPoint<S>& at, double* value) const {
  if (n_borders() == 0) return;
  visit_parts(at, [&value](const Part& part, const LawInput<double, S::kDof>& in) {
    if (part.n_borders() > 0) part.borders(in, value);
    value += part.n_borders();
  });
}

template <class S>
void BasicLaw<S>::cross(const BasicLawPoint<S>& at, int part, int border, double* state, double& lost) const {
  const double stored = energy(at);
  visit_parts(at, [&, crossed = parts_[static_cast<std::size_t>(part)].get()](const Part& visited, const LawInput<double, S::kDof>& in) {
    if (&visited == crossed) visited.cross(border, in, state);
    state += visited.n_states();
  });
  lost += stored - energy(at);
}

template <class S>
void BasicLaw<S>::rest(const BasicLawPoint<S>& at, double* state) const {
  visit_parts({at.t, at.gap, at.rate, state}, [&state](const Part& part, const LawInput<double, S::kDof>& in) {
    part.rest(in, state);
    state += part.n_states();
  });
}

template <class S>
std::optional<Stiction> BasicLaw<S>::stiction(const double* state) const {
  for (const auto& part : parts_) {
    if (const auto held = part->stiction(state)) return held;
    state += part->n_states();
  }
  return {};
}

template <class S>
bool BasicLaw<S>::set_stuck(const BasicLawPoint<S>& at, double force, double* state) const {
  bool sticks = false;
  visit_parts({at.t, at.gap, at.rate, state}, [&](const Part& part, const LawInput<double, S::kDof>& in) {
    sticks = part.set_stuck(in, force, state) || sticks;
    state += part.n_states();
  });
  return sticks;
}

template <class S>
void BasicLaw<S>::start_slipping(double force) {
  for (const auto& part : parts_) part->start_slipping(force);
}

template <class S>
bool BasicLaw<S>::rubs() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const auto& part) { return !part->holds(); });
}

template <class S>
bool BasicLaw<S>::rubs_where_it_holds() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const auto& part) { return part->rubs_where_it_holds(); });
}

template <class S>
bool BasicLaw<S>::acts_without_reaction() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const auto& part) { return !part->holds() && part->lever() == 0; });
}

template <class S>
bool BasicLaw<S>::has_stops() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const auto& part) { return part->stops(); });
}

template <class S>
bool BasicLaw<S>::has_friction() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const auto& part) { return part->rubs(); });
}

template <class S>
bool BasicLaw<S>::depends_on_reaction_alone() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const auto& part) { return part->depends_on_reaction_alone(); });
}

template <class S>
typename S::Vec BasicLaw<S>::force_on_reaction(const Vec& reaction) const {
  LawInput<double, S::kDof> in{};
  std::copy_n(reaction.data(), S::kDof, in.before);
  Vec force = Vec::Zero();
  for (const auto& part : parts_) {
    if (!part->depends_on_reaction_alone()) continue;
    LawOutput<double, S::kDof> out;
    out.clear();
    part->evaluate(in, out);
    force += Eigen::Map<const Vec>(out.force);
  }
  return force;
}

template <class S>
bool BasicLaw<S>::feeds() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const auto& part) { return part->feeds(); });
}

template <class S>
double BasicLaw<S>::supply(const BasicLawPoint<S>& at, const Vec& force) const {
  double power = depends_on_reaction_alone() ? force_on_reaction(force).dot(at.rate) : 0;
  for (const auto& part : parts_)
    if (part->feeds()) power += part->supply(input_at(at));
  return power;
}

template <class S>
std::optional<StopBreach> BasicLaw<S>::breach(const typename S::Vec& gap) const {
  for (const auto& part : parts_)
    if (std::optional<StopBreach> beyond = part->stops() ? part->breach(gap) : std::nullopt) return beyond;
  return {};
}

template <class S>
bool BasicLaw<S>::starts_free() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const auto& part) { return part->starts_free(); });
}

template <class S>
bool BasicLaw<S>::ideal_limit() const {
  return std::none_of(parts_.begin(), parts_.end(), [](const auto& part) { return part->holds(); });
}

template <class S>
BasicResponse<S> BasicLaw<S>::holding(const typename S::Vec& gap, const typename S::Vec& rate) const {
  return rubs() ? respond(holding_law(), gap, rate) : holding_of_parts(gap, rate);
}

// Static stiffness: that of Eq. (3.9) at mu = 0.
template <class S>
BasicResponse<S> BasicLaw<S>::holding_of_parts(const typename S::Vec& gap, const typename S::Vec& rate) const {
  double state[kMostLawStates];
  const typename S::Vec still = S::Vec::Zero();
  rest({0, gap, still, state}, state);
  BasicLawTangents<S> tangents;
  linearize({0, gap, rate, state}, tangents);
  // States that do not change at rest, such as friction within rubber, stay as they are.
  for (int z = 0; z < n_states_; ++z) {
    const auto is_zero = [](double x) { return x == 0; };
    if (std::all_of(tangents.by_state[z], tangents.by_state[z] + n_states_, is_zero) && std::all_of(tangents.by_gap[z], tangents.by_gap[z] + S::kDof, is_zero)) tangents.by_state[z][z] = -1;
  }
  LawImpedance<double, S> statics;
  statics.reserve(n_states_);
  statics.find(tangents, 0);
  BasicResponse<S> r;
  r.force = tangents.force;
  for (int k = 0; k < S::kDof * S::kDof; ++k) r.stiffness(k / S::kDof, k % S::kDof) = statics.weight[k];
  if (!r.stiffness.allFinite()) r.stiffness = tangents.stiffness;
  r.damping = tangents.damping;
  r.energy = tangents.energy;
  r.loss = tangents.loss;
  return r;
}

template <class S>
typename S::Vec BasicLaw<S>::engaged_stiffness() const {
  typename S::Vec k = linear_.k;
  for (const auto& part : parts_)
    if (part->holds()) k += part->engaged_stiffness();
  return k;
}

template <class S>
std::optional<typename S::Vec> BasicLaw<S>::gap_under(const Vec& force) const {
  const Part* holder = nullptr;
  for (const auto& part : parts_) {
    if (!part->holds()) continue;
    if (holder != nullptr) return std::nullopt;
    holder = part.get();
  }
  return holder != nullptr && linear_.k.isZero(0) ? holder->gap_under(force) : std::nullopt;
}

template <class S>
typename S::Vec BasicLaw<S>::open_contact_stiffness(const Point& at) const {
  typename S::Vec k = S::Vec::Zero();
  visit_parts(at, [&k](const Part& part, const LawInput<double, S::kDof>& in) {
    if (part.n_borders() == 0) return;
    if (force_of<S>(part, in).isZero(0)) k += part.closed_stiffness();
  });
  return k;
}

template <class S>
BasicLaw<S> BasicLaw<S>::holding_law() const {
  BasicLaw out(linear_);
  for (const auto& part : parts_)
    if (part->holds()) out.add(part->clone());
  return out;
}

template <class S>
double BasicLaw<S>::lever() const {
  double lever = 0;
  for (const auto& part : parts_) lever = std::max(lever, part->lever());
  return lever;
}

template <class S>
double BasicLaw<S>::penetration(const typename S::Vec& gap) const {
  double deepest = -std::numeric_limits<double>::infinity();
  for (const auto& part : parts_) deepest = std::max(deepest, part->penetration(gap));
  return deepest;
}

template <class S>
std::vector<LawColumn> BasicLaw<S>::columns() const {
  std::vector<LawColumn> all;
  for (const auto& part : parts_) all.insert(all.end(), part->columns().begin(), part->columns().end());
  return all;
}

template <class S>
void BasicLaw<S>::observe(const BasicLawPoint<S>& at, const typename S::Vec& force, std::vector<double>& values) const {
  // The given force is more accurate than the laws' value at the gap, but it is the sum over all parts. What holds has the held directions to itself.
  const typename S::Vec free = (engaged_stiffness().array() > 0).select(S::Vec::Zero(), S::Vec::Ones());
  const auto own_force = [&free](const Part& part, const LawInput<double, S::kDof>& in) -> typename S::Vec {
    const typename S::Vec own = force_of<S>(part, in);
    return part.holds() ? typename S::Vec(own.cwiseProduct(free)) : own;
  };
  typename S::Vec sum = linear_.force(at.gap, at.rate).cwiseProduct(free);
  visit_parts(at, [&](const Part& part, const LawInput<double, S::kDof>& in) { sum += own_force(part, in); });
  visit_parts(at, [&](const Part& part, const LawInput<double, S::kDof>& in) {
    const std::size_t n = part.columns().size(), first = values.size();
    values.resize(first + n);
    if (n == 0) return;
    const typename S::Vec others = sum - own_force(part, in);
    part.observe(in, force - others, values.data() + first);
  });
}

template class BasicLaw<Planar>;
PINTLE_IN_SPACE(template class BasicLaw<Spatial>;)

}  // namespace pintle
