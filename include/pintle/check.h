// Analysis of a model without running it: mobility, redundancy, loops, frequencies, and whether every formula that a
// run uses agrees with finite differences and the energy account. theory/checks.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "pintle/model.h"

namespace pintle {

/// A closed loop: the joints around it.
struct CheckLoop {
  std::vector<std::string> joints;
};

/// The joint graph. Servos of motors and springs are not edges of it.
struct CheckTopology {
  int n_loops = 0;                                 ///< independent loops
  std::vector<CheckLoop> loops;                    ///< loops that a spanning tree from the ground leaves open; the first 1000
  std::vector<std::vector<std::string>> floating;  ///< groups of bodies that no joint ties to the ground
};

/// The number of independent motions. Ranks are of the scaled constraint Jacobian: angles times `length`, rows of unit norm.
struct CheckMobility {
  int freedoms = 0;            ///< 3 per body
  int constraints = 0;         ///< gap components that a joint's law resists; slack ropes and servos are not among them
  int gruebler = 0;            ///< freedoms - constraints
  int rank = -1;               ///< at the assembled position; -1: not determined, `remark` says why
  int rank_nearby = -1;        ///< the highest rank at assembled positions close by; -1: not determined
  int mobility = -1;           ///< freedoms - the higher of the two ranks
  int redundant = -1;          ///< constraints - the higher of the two ranks
  int servos = 0;              ///< motors by speed or position
  int mobility_driven = -1;    ///< with the servos' coordinates held, at the assembled position
  double length = 0;           ///< [m]
  double rank_tolerance = 0;   ///< singular values below this, relative to the largest, count as zero [-]
  double smallest_kept = 0;    ///< smallest relative singular value that counts [-]; 0: not determined
  double largest_dropped = 0;  ///< largest relative singular value that does not count [-]
  std::string method;          ///< "singular values" or "sparse factors"
  std::string remark;
  bool singular_position() const { return rank >= 0 && rank_nearby > rank; }
};

/// Constraint components that carry load against each other without any motion to resist.
struct CheckRedundancy {
  int degree = 1;  ///< number of superfluous constraints in this group
  struct Member {
    std::string joint;
    std::string component;
    double share = 0;  ///< of the degree; the shares of a group add up to it [-]; 0 when ranks come from sparse factors
  };
  std::vector<Member> members;  ///< largest share first
};

/// A gear pair or a rack: motion of the second body per unit rotation of the first, with the line of centres held.
struct CheckGear {
  std::string joint, type, first_body, second_body;
  double ratio = 0;  ///< [-] or, a rack along its axis, [m/rad]
  std::string unit;  ///< "-" or "m/rad"
};

/// In a train of mobility 1: the rate of a joint's free coordinate per unit rate of the reference coordinate, at the assembled position.
struct CheckTransmission {
  std::string joint, coordinate;
  double ratio = 0;
  std::string unit;
};

/// One gap component on its own spring, with the two bodies otherwise free.
struct CheckComponent {
  std::string joint, type, component;
  double stiffness = 0;       ///< [N/m] or [N*m/rad]
  double damping = 0;         ///< [N*s/m] or [N*m*s/rad]
  double effective_mass = 0;  ///< 1 / (G M^-1 G') [kg] or [kg*m^2]
  double frequency = 0;       ///< undamped [rad/s]
  double damping_ratio = 0;   ///< of critical [-]
};

/// A vibration of the whole mechanism on its joints, at the assembled position.
struct CheckMode {
  double frequency = 0;          ///< undamped [rad/s]
  double damping_ratio = 0;      ///< from the mode's own damping [-]
  std::string joint, component;  ///< the one that stores most of its energy
  double share = 0;              ///< of that joint component in the mode's energy [-]
};

struct CheckFrequencies {
  std::vector<CheckComponent> components;
  std::vector<CheckMode> modes;  ///< slowest first; empty or only the fastest when the model is large
  bool complete = false;         ///< every mode is in `modes`
  double explicit_step = 0;      ///< longest stable step of Dormand-Prince 5(4) [s]; 0: no limit
  std::string remark;
};

/// A small motion about the position of rest, exp(lambda t), with all forces: joints, springs, motors, loads and the turning of forces with the bodies.
struct CheckSmallMotion {
  double real = 0, imaginary = 0;  ///< lambda [1/s] and [rad/s], imaginary >= 0: of two conjugate ones
  double frequency = 0;            ///< |lambda| [rad/s]
  double damping_ratio = 0;        ///< -real / |lambda| [-]; negative: it grows
  std::string body, direction;     ///< the coordinate with most of its kinetic energy: x, y or angle
  double share = 0;                ///< of that coordinate in the kinetic energy [-]
};

struct CheckSmallMotions {
  bool known = false;                   ///< the linear analysis was possible; otherwise `remark` says why not
  std::vector<CheckSmallMotion> modes;  ///< slowest first
  double resolved = 0;                  ///< motions slower than this are not told from free ones [rad/s]
  int n_free = 0;                       ///< such motions: nothing drives them back, or away
  std::string remark;
};

/// One comparison, made at the assembled state and a few others, for every joint, law and load it applies to.
struct CheckItem {
  std::string what;
  double worst = 0;      ///< relative mismatch [-]
  double tolerance = 0;  ///< [-]
  std::string place;     ///< where the worst mismatch is
  long comparisons = 0;
  long at_kinks = 0;                                  ///< left out because a law or expression has no slope there
  bool passed() const { return worst <= tolerance; }  // a NaN does not pass
};

struct CheckBattery {
  std::vector<CheckItem> items;
  bool passed() const;
};

struct CheckReport {
  int n_bodies = 0, n_joints = 0, n_springs = 0, n_forces = 0, n_motors = 0;
  double total_mass = 0;                    ///< of the moving bodies [kg]
  std::array<double, 2> mass_centre{0, 0};  ///< as assembled [m]
  CheckTopology topology;
  CheckMobility mobility;
  std::vector<CheckRedundancy> redundancies;
  std::vector<CheckGear> gears;
  std::string transmission_of;  ///< "joint.coordinate" that the ratios refer to
  std::vector<CheckTransmission> transmission;
  CheckFrequencies frequencies;
  CheckSmallMotions small_motions;
  CheckBattery jacobians, energy;
  std::vector<std::string> notes;  ///< what assembly assumed, and what the user should know
  bool passed() const { return jacobians.passed() && energy.passed(); }
};

/// Checks `model` at its assembled position. Throws AssemblyError when a loop cannot close.
CheckReport check_model(const Model& model);

}  // namespace pintle
