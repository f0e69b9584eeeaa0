// A system as the plain first-order equations y' = f(t, y), y = (q, v), that general integrators ask for, with the
// exact Jacobian.
#pragma once

#include "system/state.h"

namespace pintle::bench {

class FlatEquations {
 public:
  explicit FlatEquations(const System& system);

  const System& system() const { return system_; }
  /// Length of y.
  int size() const { return 6 * system_.n_bodies(); }
  void flatten(const Vecs& q, const Vecs& v, double* y) const;
  void unflatten(const double* y, Vecs& q, Vecs& v) const;

  void rate(double t, const double* y, double* dy);
  /// Finds the blocks of d(a)/dq and d(a)/dv at y.
  void linearize(double t, const double* y);
  /// True where some joint or load couples the accelerations of body i to body j.
  bool coupled(int i, int j) const { return coupled_[place(i, j)]; }
  const Planar::Mat& by_position(int i, int j) const { return by_q_[place(i, j)]; }
  const Planar::Mat& by_velocity(int i, int j) const { return by_v_[place(i, j)]; }

 private:
  std::size_t place(int i, int j) const { return static_cast<std::size_t>(i) * system_.bodies.size() + j; }
  void add_joint(int j, double t);

  const System& system_;
  Vecs q_, v_, a_;
  std::vector<Planar::Motion> motions_;
  std::vector<char> coupled_;
  std::vector<Planar::Mat> by_q_, by_v_;
};

}  // namespace pintle::bench
