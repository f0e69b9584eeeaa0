#include "bench/force_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analyses/recorder.h"

namespace pintle::bench {
namespace {

constexpr double kNegligible = 1e-4;  // a joint is measured at least by this part of the largest force

}  // namespace

std::vector<double> output_times(double duration, int count) {
  std::vector<double> times;
  for (int i = 1; i <= count; ++i) times.push_back(i == count ? duration : duration * i / count);
  return times;
}

void ForceSamples::add(double t, const Vecs& q, const Vecs& v, const Vecs& force) {
  system_->motions(q, v, motions_);
  for (int j = 0; j < system_->n_joints(); ++j) {
    const JointLoad load = joint_load(*system_, j, t, motions_, force[j]);
    values_.insert(values_.end(), {load.fx, load.fy, load.couple});
  }
  ++rows_;
}

void ForceSamples::add_by_laws(double t, const Vecs& q, const Vecs& v) {
  system_->motions(q, v, motions_);
  force_.resize(system_->joints.size());
  for (int j = 0; j < system_->n_joints(); ++j) {
    const Reading r = system_->reading(j, t, motions_);
    force_[j] = law_force(system_->joints[j].law, r.gap, r.rate);
  }
  add(t, q, v, force_);
}

void ForceSamples::add_loads(const std::vector<double>& loads) {
  values_.insert(values_.end(), loads.begin(), loads.end());
  ++rows_;
}

std::vector<double> ForceSamples::peaks() const {
  std::vector<double> peak(system_->joints.size(), 0.0);
  for (std::size_t i = 0; i < rows_; ++i)
    for (int j = 0; j < system_->n_joints(); ++j) peak[j] = std::max(peak[j], std::hypot(at(i, j)[0], at(i, j)[1]));
  return peak;
}

double ForceSamples::largest_force() const {
  const std::vector<double> peak = peaks();
  return *std::max_element(peak.begin(), peak.end());
}

double ForceSamples::error(const ForceSamples& reference) const {
  if (rows_ != reference.rows_) return std::numeric_limits<double>::infinity();
  const std::vector<double> peak = reference.peaks();
  const double least = kNegligible * *std::max_element(peak.begin(), peak.end());
  double worst = 0;
  for (std::size_t i = 0; i < rows_; ++i)
    for (int j = 0; j < system_->n_joints(); ++j) {
      const double *a = at(i, j), *b = reference.at(i, j);
      const double difference = std::hypot(a[0] - b[0], a[1] - b[1]) / std::max(peak[j], least);
      if (!(difference <= worst)) worst = difference;
    }
  return worst;
}

}  // namespace pintle::bench
