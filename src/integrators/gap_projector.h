// Moves a state so that stiff joints have the gaps, rates and accelerations asked for, and finds the joint forces that
// go with them, theory/time section 4. "Stiff" is by degree: a mode of frequency w is moved by w^2 / (w^2 + mu^2) each
// time, so that soft joints keep what they have, and directions that no motion can close (redundant joints) stay as the
// geometry has them. One factorisation serves all four questions.
#pragma once

#include "solve/block_lu.h"
#include "simd/lanes.h"
#include "system/system.h"

namespace pintle {

class GapProjector {
 public:
  explicit GapProjector(const System& system);

  /// Factorises mu^2 M + G' (K + mu C) G at the configuration of `m`. False when singular. With `moved` (1 or 0 for every
  /// component of every gap) the components with 0 are left alone, as if they had no law.
  bool prepare(double t, const std::vector<Planar::Motion>& m, double mu, const Vecs& gap_at, const Vecs& rate_at,
               const Vecs* moved = nullptr);

  /// The same where the joints have been read already.
  bool prepare(const std::vector<Reading>& readings, double mu, const Vecs& gap_at, const Vecs& rate_at, const Vecs* moved = nullptr);

  /// Gaps, rates, Jacobians and convective terms of `m`; the factorisation stays.
  void read(double t, const std::vector<Planar::Motion>& m) { system_.readings(t, m, readings_); }

  /// x += the smallest displacement (in the mass norm) whose gap change is `wanted`, one pass.
  void close(const Vecs& wanted, Vecs& x);
  /// Joint forces improved so that M a = Q + G' f in the stiff modes, one pass; `a` has the wanted gap accelerations.
  /// The largest change of a joint's force is returned, over the stiff components.
  double improve_forces(const Vecs& Q, const Vecs& a, Vecs& force);
  /// Joint forces improved so that in the stiff modes the accelerations M^-1 (Q + G' f) give the gaps' own, one pass.
  void balance(const Vecs& Q, const Vecs& gap_accel, Vecs& force);

  const std::vector<Reading>& readings() const { return readings_; }

 private:
  bool factorize(double mu, const Vecs& gap_at, const Vecs& rate_at, const Vecs* moved);
  Planar::Vec weigh(int j, const Planar::Vec& gap) const;

  const System& system_;
  BlockLu<double, Planar::kDof> lu_;
  std::vector<Reading> readings_;
  std::vector<Planar::Mat> weight_;  // K + mu C per joint
  std::vector<char> diagonal_;       // it is
  std::vector<BlockPattern::Slot> slots_;
  Vecs body_, accel_, missing_;
  double mu_ = 0;
};

}  // namespace pintle
