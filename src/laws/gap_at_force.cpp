#include "laws/gap_at_force.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace pintle {
namespace {

// Whether it is a contact whose surfaces stick.
template <class S>
bool may_stick(const std::unique_ptr<BasicLawPart<S>>& part) {
  for (int border = 0; border < part->n_borders() && part->holds(); ++border)
    if (part->border_name(border, false) == "sticks") return true;
  return false;
}

// Of surfaces in contact that slide at this rate, and so do not stick: the damping of stuck ones would carry any force.
template <class S>
BasicResponse<S> respond_sliding(const BasicLaw<S>& law, const typename S::Vec& gap, const typename S::Vec& rate) {
  BasicResponse<S> r = respond(law, gap, rate);
  if (rate.isZero(0) || std::none_of(law.parts().begin(), law.parts().end(), may_stick<S>)) return r;
  double state[kMostLawStates];
  law.rest({0, gap, rate, state}, state);
  BasicLawTangents<S> tangents;
  law.linearize({0, gap, rate, state}, tangents);
  r.force = tangents.force;
  r.stiffness = tangents.stiffness;
  r.damping = tangents.damping;
  return r;
}

}  // namespace

template <class S>
bool on_same_sides(const BasicLaw<S>& law, const typename S::Vec& a, const typename S::Vec& b, const typename S::Vec& rate) {
  std::vector<double> at_a(static_cast<std::size_t>(law.n_borders())), at_b(at_a.size());
  law.borders({0, a, rate, nullptr}, at_a.data());
  law.borders({0, b, rate, nullptr}, at_b.data());
  return std::equal(at_a.begin(), at_a.end(), at_b.begin(), [](double x, double y) { return (x > 0) == (y > 0); });
}

namespace {

constexpr int kSpringSteps = 20, kGapNewton = 40, kHalvings = 12, kDoublings = 80;  // most passes over the components' own springs; most Newton iterations for a gap; most halvings of one step; most doublings of the distance when leaving a play
constexpr double kCarried = 1e-6;                                                // as a fraction of a force: residual accepted if no step reduces it

// Solves component by component.
template <class S>
void gap_of_springs(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap) {
  for (int i = 0; i < kSpringSteps; ++i) {
    const BasicResponse<S> now = respond_sliding(law, gap, rate);
    bool moved = false;
    for (int k = 0; k < S::kDof; ++k) {
      if (!(now.stiffness(k, k) > 0)) continue;
      const double step = (now.force[k] - force[k]) / now.stiffness(k, k);
      gap[k] += step;
      moved = moved || std::abs(step) > 1e-15 * std::abs(gap[k]);
    }
    if (!moved) break;
  }
}

// Newton's step with the whole tangent, over the components that may move and respond to their gaps; sets `missing` to 0 in the others.
template <class S>
typename S::Vec newton_step(const BasicResponse<S>& now, const typename S::Vec& engaged, typename S::Vec& missing, const typename S::Vec& moved = S::Vec::Ones()) {
  typename S::Mat K = now.stiffness;
  for (int k = 0; k < S::kDof; ++k) {
    if (moved[k] != 0 && ((engaged[k] > 0 && !now.stiffness.row(k).isZero(0)) || now.stiffness(k, k) > 0)) continue;
    K.row(k).setZero();
    K.col(k).setZero();
    K(k, k) = 1;
    missing[k] = 0;
  }
  return K.partialPivLu().solve(missing);
}

// The residual force at this gap, over the components in which `missing` is not 0.
template <class S>
double miss_at(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, const typename S::Vec& missing, const typename S::Vec& gap) {
  const typename S::Vec miss = respond_sliding(law, gap, rate).force - force;
  double sum = 0;
  for (int k = 0; k < S::kDof; ++k)
    if (missing[k] != 0) sum += miss[k] * miss[k];
  return std::sqrt(sum);
}

// Whether a force that rises with a power of the gap is so close to its origin that Newton's step goes far beyond the solution.
template <class S>
bool overshoots(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, const BasicResponse<S>& now, const typename S::Vec& engaged, const typename S::Vec& gap) {
  // kBeginning: the law is near its origin if its stiffness is below this fraction of the engaged stiffness. kFar: a step is too long if it multiplies the residual by more than this:
  // smaller growth is left to the halving of steps. Without kBeginning, strongly bent blades (test SlowFlexures), whose steps multiply the residual by up to 985, start elsewhere.
  constexpr double kBeginning = 0.01, kFar = 100;
  bool begins = false;
  for (int k = 0; k < S::kDof; ++k) begins = begins || (engaged[k] > 0 && now.stiffness(k, k) < kBeginning * engaged[k]);
  if (!begins) return false;
  typename S::Vec missing = now.force - force;
  const typename S::Vec step = newton_step<S>(now, engaged, missing);
  return !(miss_at<S>(law, force, rate, missing, gap + step) <= kFar * missing.norm());
}

// Where the law does not resist at all (within its play, or at the origin of a force that rises with a power of the gap), or hardly does, moves
// the gap outwards against the force until the law gives as much of it.
template <class S>
void begin_where_it_resists(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap) {
  if (law.starts_free()) return;
  const typename S::Vec engaged = law.engaged_stiffness();
  const BasicResponse<S> now = respond_sliding(law, gap, rate);
  bool weak = overshoots(law, force, rate, now, engaged, gap);
  for (int k = 0; k < S::kDof; ++k) weak = weak || (engaged[k] > 0 && force[k] != 0 && now.stiffness.row(k).isZero(0));
  if (weak) go_out_against(law, force, rate, gap);
}

// The size of a gap; the ratio of the law's stiffnesses makes lengths and angles comparable.
template <class S>
double size_of_gap(const typename S::Vec& gap, const typename S::Vec& engaged) {
  const double stiffest = engaged.template head<S::kDim>().maxCoeff(), turning = engaged.template tail<S::kDof - S::kDim>().maxCoeff();
  const double arm = stiffest > 0 ? std::sqrt(turning / stiffest) : 1;
  return gap.template head<S::kDim>().norm() + arm * gap.template tail<S::kDof - S::kDim>().norm();
}

// Newton's method at one load: plain steps, each at most half of the previous one. The gap must stay on the same side of the law's borders as `from`.
template <class S>
bool settle_at(const BasicLaw<S>& law, const typename S::Vec& from, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap) {
  constexpr double kLeastStep = 1e-9;  // as a fraction of the gap: a shorter step is rounding
  const typename S::Vec engaged = law.engaged_stiffness();
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kGapNewton; ++i) {
    const BasicResponse<S> now = respond_sliding(law, gap, rate);
    typename S::Vec missing = now.force - force;
    const typename S::Vec step = newton_step<S>(now, engaged, missing);
    if (!step.allFinite()) return false;
    const double moved = size_of_gap<S>(step, engaged), size = size_of_gap<S>(gap + step, engaged);
    const bool rounding = moved <= kLeastStep * size;
    if (!(moved <= 0.5 * last)) return rounding && on_same_sides(law, from, gap, rate);
    gap += step;
    if (moved <= 1e-15 * size) return on_same_sides(law, from, gap, rate);
    last = moved;
  }
  return false;
}

// A path of gaps, extrapolated from its last points by the parabola (or line) through them.
template <class S>
class GapPath {
 public:
  GapPath(double at, const typename S::Vec& gap) { add(at, gap); }
  void add(double at, const typename S::Vec& gap) {
    if (n_ == kPoints) std::rotate(points_.begin(), points_.begin() + 1, points_.end());
    else ++n_;
    points_[n_ - 1] = {at, gap};
  }
  const typename S::Vec& last() const { return points_[n_ - 1].gap; }
  typename S::Vec extrapolated(double at) const {
    typename S::Vec sum = S::Vec::Zero();
    for (std::size_t i = 0; i < n_; ++i) {
      double weight = 1;
      for (std::size_t j = 0; j < n_; ++j)
        if (j != i) weight *= (at - points_[j].at) / (points_[i].at - points_[j].at);
      sum += weight * points_[i].gap;
    }
    return sum;
  }

 private:
  static constexpr std::size_t kPoints = 3;
  struct Point {
    double at = 0;
    typename S::Vec gap;
  };
  std::array<Point, kPoints> points_;
  std::size_t n_ = 0;
};

// For a law without states that resists where it is, such as a blade: the load is raised from the force at the initial gap, in steps short enough for
// Newton's method, between which no border of the law may lie. If that fails, returns false and leaves the gap unchanged. theory/assembly Eq. (3.6).
template <class S>
bool follow_load(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap) {
  // The shortest step, as a fraction of the load and of the part already reached. Strongly bent thin blades are not found with steps above 1e-5, or above 1e-2.
  constexpr double kFirst = 1e-6, kLater = 1e-3;
  if (law.n_states() > 0 || law.starts_free()) return false;
  const BasicResponse<S> start = respond_sliding(law, gap, rate);
  if (!resists(law, start)) return false;
  GapPath<S> path(0, gap);
  double done = 0;
  for (double part = 1; done < 1;) {
    const double next = std::min(1.0, done + part);
    typename S::Vec trial = path.extrapolated(next);
    if (settle_at(law, path.last(), typename S::Vec(start.force + next * (force - start.force)), rate, trial)) {
      path.add(next, trial);
      done = next;
      part *= 2;
    } else if ((part *= 0.5) < std::max(kFirst, kLater * done)) {
      return false;
    }
  }
  gap = path.last();
  return true;
}

}  // namespace

template <class S>
bool go_out_against(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap) {
  const typename S::Vec engaged = law.engaged_stiffness();
  typename S::Vec out = S::Vec::Zero(), wanted = S::Vec::Zero();
  for (int k = 0; k < S::kDof; ++k) {
    if (!(engaged[k] > 0)) continue;
    wanted[k] = force[k];
    out[k] = -force[k] / engaged[k];
  }
  for (int i = 0; i < kDoublings; ++i, out *= 2) {
    typename S::Vec trial = gap;
    for (int k = 0; k < S::kDof; ++k)
      if (engaged[k] > 0) trial[k] = out[k];
    const BasicResponse<S> there = respond_sliding(law, trial, rate);
    if (!there.force.allFinite()) return false;
    if (there.force.dot(wanted) < wanted.squaredNorm()) continue;
    gap = trial;
    return true;
  }
  return false;
}

// Newton's method with the law's own tangent; free components do not change.
template <class S>
bool gap_at_force(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap) {
  if (law.ideal_limit()) {
    gap_of_springs(law, force, rate, gap);
    return true;
  }
  if (const auto known = law.gap_under(force); known && rate.isZero(0)) {
    for (int k = 0; k < S::kDof; ++k)
      if (law.engaged_stiffness()[k] > 0) gap[k] = (*known)[k];
    return true;
  }
  if (follow_load(law, force, rate, gap)) return true;
  begin_where_it_resists(law, force, rate, gap);
  const typename S::Vec engaged = law.engaged_stiffness();
  for (int i = 0; i < kGapNewton; ++i) {
    const BasicResponse<S> now = respond_sliding(law, gap, rate);
    typename S::Vec missing = now.force - force;
    typename S::Vec step = newton_step<S>(now, engaged, missing);
    if (!step.allFinite()) return false;
    bool moved = false;
    for (int k = 0; k < S::kDof; ++k) moved = moved || std::abs(step[k]) > 1e-15 * std::abs(gap[k]);
    if (!moved) return true;
    int halvings = 0;
    for (; halvings < kHalvings && !(miss_at<S>(law, force, rate, missing, gap + step) <= missing.norm()); ++halvings) step *= 0.5;
    if (halvings == kHalvings) return law.starts_free() || missing.norm() <= kCarried * force.norm();  // no step reduces the residual
    gap += step;
  }
  return true;
}

template <class S>
void newton_step_to_force(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, const typename S::Vec& moved, typename S::Vec& gap) {
  const BasicResponse<S> now = respond_sliding(law, gap, rate);
  typename S::Vec missing = now.force - force;
  const typename S::Vec engaged = law.engaged_stiffness();
  if (overshoots(law, force, rate, now, engaged, gap)) return void(gap_at_force(law, force, rate, gap));
  const typename S::Vec step = newton_step<S>(now, engaged, missing, moved);
  if (step.allFinite()) gap += step;
}

template bool gap_at_force(const BasicLaw<Planar>& law, const Planar::Vec& force, const Planar::Vec& rate, Planar::Vec& gap);
PINTLE_IN_SPACE(template bool gap_at_force(const BasicLaw<Spatial>& law, const Spatial::Vec& force, const Spatial::Vec& rate, Spatial::Vec& gap);)
template bool on_same_sides(const BasicLaw<Planar>& law, const Planar::Vec& a, const Planar::Vec& b, const Planar::Vec& rate);
PINTLE_IN_SPACE(template bool on_same_sides(const BasicLaw<Spatial>& law, const Spatial::Vec& a, const Spatial::Vec& b, const Spatial::Vec& rate);)
template void newton_step_to_force(const BasicLaw<Planar>& law, const Planar::Vec& force, const Planar::Vec& rate, const Planar::Vec& moved, Planar::Vec& gap);
PINTLE_IN_SPACE(template void newton_step_to_force(const BasicLaw<Spatial>& law, const Spatial::Vec& force, const Spatial::Vec& rate, const Spatial::Vec& moved, Spatial::Vec& gap);)

template bool go_out_against(const BasicLaw<Planar>& law, const Planar::Vec& force, const Planar::Vec& rate, Planar::Vec& gap);
PINTLE_IN_SPACE(template bool go_out_against(const BasicLaw<Spatial>& law, const Spatial::Vec& force, const Spatial::Vec& rate, Spatial::Vec& gap);)

}  // namespace pintle
