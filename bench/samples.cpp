#include "bench/samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "run/record/force_table.h"

namespace pintle::bench {
namespace {

constexpr double kNegligible = 1e-4;  // a joint is measured by at least this fraction of the largest force

}  // namespace

std::vector<double> output_times(double duration, int count) {
  std::vector<double> times;
  for (int i = 1; i <= count; ++i) times.push_back(i == count ? duration : duration * i / count);
  return times;
}

void Samples::add(const Vecs& q, const Vecs& v, const Vecs& force) {
  system_->motions(q, v, motions_);
  for (int j = 0; j < system_->n_joints(); ++j) {
    const Planar::Vec load = joint_load(*system_, j, motions_, force[j]);
    values_.insert(values_.end(), load.begin(), load.end());
  }
  ++rows_;
  if (point_.body != kGround) add_place(motions_[point_.body].p + motions_[point_.body].turned(point_.at));
}

void Samples::add_by_laws(double t, const Vecs& q, const Vecs& v) {
  system_->motions(q, v, motions_);
  force_.resize(system_->joints.size());
  for (int j = 0; j < system_->n_joints(); ++j) {
    const JointKinematics r = system_->kinematics(j, t, motions_);
    force_[j] = respond(system_->joints[j].law, r.gap, r.rate).force;
  }
  add(q, v, force_);
}

void Samples::add_loads(const std::vector<double>& loads) {
  values_.insert(values_.end(), loads.begin(), loads.end());
  ++rows_;
}

std::vector<double> Samples::peaks() const {
  std::vector<double> peak(system_->joints.size(), 0.0);
  for (std::size_t i = 0; i < rows_; ++i)
    for (int j = 0; j < system_->n_joints(); ++j) peak[j] = std::max(peak[j], std::hypot(at(i, j)[0], at(i, j)[1]));
  return peak;
}

double Samples::largest_force() const {
  const std::vector<double> peak = peaks();
  return *std::max_element(peak.begin(), peak.end());
}

double Samples::error(const Samples& reference) const {
  if (rows_ == 0 || reference.rows_ == 0) return std::numeric_limits<double>::quiet_NaN();
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

double Samples::place_error(const Samples& reference) const {
  if (!has_places() || !reference.has_places()) return std::numeric_limits<double>::quiet_NaN();
  if (places_.size() != reference.places_.size()) return std::numeric_limits<double>::infinity();
  double worst = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const double distance = (places_[i] - reference.places_[i]).norm();
    if (!(distance <= worst)) worst = distance;
  }
  return worst;
}

double Samples::end_error(const Samples& reference) const {
  if (!has_places() || !reference.has_places()) return std::numeric_limits<double>::quiet_NaN();
  if (places_.size() != reference.places_.size()) return std::numeric_limits<double>::infinity();
  return (places_.back() - reference.places_.back()).norm();
}

}  // namespace pintle::bench
