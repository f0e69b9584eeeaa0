#include "laws/law.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace pintle {
namespace {

using S = Planar;

LawInput<double> input_at(const LawPoint& at) {
  return {at.t, {at.gap[0], at.gap[1], at.gap[2]}, {at.rate[0], at.rate[1], at.rate[2]}, {}, at.state};
}

LawOutput<double> answer(const Law& law, const LawPoint& at) {
  LawOutput<double> out;
  law.evaluate(input_at(at), out);
  return out;
}

}  // namespace

void Law::add(std::unique_ptr<LawPart> part) {
  n_states_ += part->n_states();
  if (n_states_ > kMostLawStates) throw std::invalid_argument(fmt::format("the laws of a joint may have {} states together", kMostLawStates));
  parts_.push_back(std::move(part));
}

int Law::n_borders() const {
  int n = 0;
  for (const auto& part : parts_) n += part->n_borders();
  return n;
}

S::Vec Law::force(const LawPoint& at) const {
  if (parts_.empty()) return linear_.force(at.gap, at.rate);
  const auto out = answer(*this, at);
  return {out.force[0], out.force[1], out.force[2]};
}

double Law::loss(const LawPoint& at) const { return parts_.empty() ? linear_.loss(at.rate) : answer(*this, at).loss; }

double Law::energy(const LawPoint& at) const {
  return parts_.empty() ? linear_.respond(at.gap, at.rate).energy : answer(*this, at).energy;
}

void Law::state_rates(const LawPoint& at, double* rate) const {
  if (n_states_ == 0) return;
  const auto out = answer(*this, at);
  std::copy_n(out.state_rate, n_states_, rate);
}

template <class Dual>
void Law::linearize_by(const LawPoint& at, LawTangents& out) const {
  LawInput<Dual> in;
  Dual state[kMostLawStates];
  in.t = Dual(at.t);
  for (int k = 0; k < 3; ++k) {
    in.gap[k] = Dual::variable(at.gap[k], k);
    in.rate[k] = Dual::variable(at.rate[k], 3 + k);
  }
  for (int z = 0; z < n_states_; ++z) state[z] = Dual::variable(at.state[z], 6 + z);
  in.state = state;
  LawOutput<Dual> answer;
  evaluate(in, answer);
  out.n = n_states_;
  out.energy = answer.energy.v;
  out.loss = answer.loss.v;
  for (int k = 0; k < 3; ++k) {
    out.force[k] = answer.force[k].v;
    for (int c = 0; c < 3; ++c) {
      out.stiffness(k, c) = -answer.force[k].d[c];
      out.damping(k, c) = -answer.force[k].d[3 + c];
    }
    for (int z = 0; z < n_states_; ++z) out.force_by_state[k][z] = answer.force[k].d[6 + z];
  }
  for (int z = 0; z < n_states_; ++z) {
    out.state_rate[z] = answer.state_rate[z].v;
    for (int c = 0; c < 3; ++c) {
      out.by_gap[z][c] = answer.state_rate[z].d[c];
      out.by_rate[z][c] = answer.state_rate[z].d[3 + c];
    }
    for (int y = 0; y < n_states_; ++y) out.by_state[z][y] = answer.state_rate[z].d[6 + y];
  }
}

void Law::linearize(const LawPoint& at, LawTangents& out) const {
  if (n_states_ <= 2) linearize_by<FewDual>(at, out);
  else linearize_by<ManyDual>(at, out);
}

void Law::borders(const LawPoint& at, double* value) const {
  LawInput<double> in = input_at(at);
  for (const auto& part : parts_) {
    if (part->n_borders() > 0) part->borders(in, value);
    value += part->n_borders();
    in.state += part->n_states();
  }
}

void Law::rest(const LawPoint& at, double* state) const {
  LawInput<double> in = input_at(at);
  LawOutput<double> so_far;
  so_far.clear();
  linear_.evaluate(in, so_far);
  for (const auto& part : parts_) {
    std::copy(std::begin(so_far.force), std::end(so_far.force), in.before);
    part->rest(in, state);
    in.state = state;
    LawOutput<double> one;
    one.clear();
    part->evaluate(in, one);
    for (int k = 0; k < 3; ++k) so_far.force[k] += one.force[k];
    state += part->n_states();
  }
}

bool Law::rubs() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const auto& part) { return !part->holds(); });
}

bool Law::ideal_limit() const {
  return std::none_of(parts_.begin(), parts_.end(), [](const auto& part) { return part->holds(); });
}

Response Law::holding(const S::Vec& gap, const S::Vec& rate) const {
  if (!rubs()) return holding_of_parts(gap, rate);
  Law held(linear_);
  for (const auto& part : parts_)
    if (part->holds()) held.add(part->clone());
  return respond(held, gap, rate);
}

// Static stiffness: that of Eq. (3.9) at mu = 0.
Response Law::holding_of_parts(const S::Vec& gap, const S::Vec& rate) const {
  double state[kMostLawStates];
  const S::Vec still = S::Vec::Zero();
  rest({0, gap, still, state}, state);
  LawTangents tangents;
  linearize({0, gap, rate, state}, tangents);
  LawImpedance<double> statics;
  statics.reserve(n_states_);
  statics.find(tangents, 0);
  Response r;
  r.force = tangents.force;
  for (int k = 0; k < 9; ++k) r.stiffness(k / 3, k % 3) = statics.weight[k];
  if (!r.stiffness.allFinite()) r.stiffness = tangents.stiffness;
  r.damping = tangents.damping;
  r.energy = tangents.energy;
  r.loss = tangents.loss;
  return r;
}

S::Vec Law::engaged_stiffness() const {
  S::Vec k = linear_.k;
  for (const auto& part : parts_)
    if (part->holds()) k += part->engaged_stiffness();
  return k;
}

double Law::lever() const {
  double lever = 0;
  for (const auto& part : parts_) lever = std::max(lever, part->lever());
  return lever;
}

std::vector<LawColumn> Law::columns() const {
  std::vector<LawColumn> all;
  for (const auto& part : parts_) all.insert(all.end(), part->columns().begin(), part->columns().end());
  return all;
}

void Law::observe(const LawPoint& at, const S::Vec& force, std::vector<double>& values) const {
  LawInput<double> in = input_at(at);
  for (const auto& part : parts_) {
    const std::size_t n = part->columns().size(), first = values.size();
    values.resize(first + n);
    if (n > 0) part->observe(in, force, values.data() + first);
    in.state += part->n_states();
  }
}

}  // namespace pintle
