#include "laws/gap_at_force.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace pintle {

template <class S>
bool on_same_sides(const BasicLaw<S>& law, const typename S::Vec& a, const typename S::Vec& b, const typename S::Vec& rate) {
  std::vector<double> at_a(static_cast<std::size_t>(law.n_borders())), at_b(at_a.size());
  law.borders({0, a, rate, nullptr}, at_a.data());
  law.borders({0, b, rate, nullptr}, at_b.data());
  return std::equal(at_a.begin(), at_a.end(), at_b.begin(), [](double x, double y) { return (x > 0) == (y > 0); });
}

namespace {

constexpr int kSpringSteps = 20, kGapNewton = 40, kHalvings = 12, kDoublings = 80;  // passes over the components' own springs; Newton iterations for a gap, at most; halvings of one step, at most; doublings of the way out of a play, at most
constexpr double kCarried = 1e-6;                                                // of a force: what may be missing where no step leads nearer to it

// Component by component.
template <class S>
void gap_of_springs(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap) {
  for (int i = 0; i < kSpringSteps; ++i) {
    const BasicResponse<S> now = respond(law, gap, rate);
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

// Newton's step with the whole tangent, over the components that may move and answer to their gaps; `missing` has 0 in the others.
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

// What is missing of the force at this gap, in the components in which `missing` is not 0.
template <class S>
double miss_at(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, const typename S::Vec& missing, const typename S::Vec& gap) {
  const typename S::Vec miss = respond(law, gap, rate).force - force;
  double sum = 0;
  for (int k = 0; k < S::kDof; ++k)
    if (missing[k] != 0) sum += miss[k] * miss[k];
  return std::sqrt(sum);
}

// Whether a force that rises with a power of the gap is so near to its beginning that Newton's step leads far beyond.
template <class S>
bool overshoots(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, const BasicResponse<S>& now, const typename S::Vec& engaged, const typename S::Vec& gap) {
  // Of the stiffness where the law acts: below it the law is at its beginning. Times as much missing as before: less is for the halvings of steps. Without the
  // first, blades that are bent far (test SlowFlexures), whose steps miss up to 985 times as much, start elsewhere.
  constexpr double kBeginning = 0.01, kFar = 100;
  bool begins = false;
  for (int k = 0; k < S::kDof; ++k) begins = begins || (engaged[k] > 0 && now.stiffness(k, k) < kBeginning * engaged[k]);
  if (!begins) return false;
  typename S::Vec missing = now.force - force;
  const typename S::Vec step = newton_step<S>(now, engaged, missing);
  return !(miss_at<S>(law, force, rate, missing, gap + step) <= kFar * missing.norm());
}

// Where the law does not resist at all (in its play, or at the beginning of a force that rises with a power of the gap), or hardly, farther out
// against the force, until there is as much of it.
template <class S>
void begin_where_it_resists(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap) {
  if (law.starts_free()) return;
  const typename S::Vec engaged = law.engaged_stiffness();
  const BasicResponse<S> now = respond(law, gap, rate);
  bool weak = overshoots(law, force, rate, now, engaged, gap);
  for (int k = 0; k < S::kDof; ++k) weak = weak || (engaged[k] > 0 && force[k] != 0 && now.stiffness.row(k).isZero(0));
  if (weak) go_out_against(law, force, rate, gap);
}

// A gap as the law's stiffness lets lengths and angles be compared.
template <class S>
double size_of_gap(const typename S::Vec& gap, const typename S::Vec& engaged) {
  const double stiffest = engaged.template head<S::kDim>().maxCoeff(), turning = engaged.template tail<S::kDof - S::kDim>().maxCoeff();
  const double arm = stiffest > 0 ? std::sqrt(turning / stiffest) : 1;
  return gap.template head<S::kDim>().norm() + arm * gap.template tail<S::kDof - S::kDim>().norm();
}

// Newton's method at one load: plain steps, each at most half of the one before. The gap must stay on the side of the law's borders where `from` is.
template <class S>
bool settle_at(const BasicLaw<S>& law, const typename S::Vec& from, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap) {
  constexpr double kLeastStep = 1e-9;  // of the gap: a step that is shorter is rounding
  const typename S::Vec engaged = law.engaged_stiffness();
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kGapNewton; ++i) {
    const BasicResponse<S> now = respond(law, gap, rate);
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

// A path of gaps through its last points, by the parabola (or line) through them.
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

// A law without states that resists where it is, such as a blade: the load is raised from what it carries there, in steps short enough for Newton's
// method, which no border of the law may lie between. False, and the gap as it was, where that does not lead to it. theory/assembly Eq. (3.6).
template <class S>
bool follow_load(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, typename S::Vec& gap) {
  // The shortest step, as a part of the load and of what has been reached. Thin blades that are bent far are not found with steps above 1e-5, or above 1e-2.
  constexpr double kFirst = 1e-6, kLater = 1e-3;
  if (law.n_states() > 0 || law.starts_free()) return false;
  const BasicResponse<S> start = respond(law, gap, rate);
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
    const BasicResponse<S> there = respond(law, trial, rate);
    if (!there.force.allFinite()) return false;
    if (there.force.dot(wanted) < wanted.squaredNorm()) continue;
    gap = trial;
    return true;
  }
  return false;
}

// Newton on the law's own tangent; nothing in free components.
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
    const BasicResponse<S> now = respond(law, gap, rate);
    typename S::Vec missing = now.force - force;
    typename S::Vec step = newton_step<S>(now, engaged, missing);
    if (!step.allFinite()) return false;
    bool moved = false;
    for (int k = 0; k < S::kDof; ++k) moved = moved || std::abs(step[k]) > 1e-15 * std::abs(gap[k]);
    if (!moved) return true;
    int halvings = 0;
    for (; halvings < kHalvings && !(miss_at<S>(law, force, rate, missing, gap + step) <= missing.norm()); ++halvings) step *= 0.5;
    if (halvings == kHalvings) return law.starts_free() || missing.norm() <= kCarried * force.norm();  // no step leads nearer
    gap += step;
  }
  return true;
}

template <class S>
void newton_step_to_force(const BasicLaw<S>& law, const typename S::Vec& force, const typename S::Vec& rate, const typename S::Vec& moved, typename S::Vec& gap) {
  const BasicResponse<S> now = respond(law, gap, rate);
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
