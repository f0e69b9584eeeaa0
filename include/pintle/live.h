// Live motion, advanced in small increments and pulled by the user while it moves; and a linkage at rest, moved by hand. theory/live.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pintle/model.h"

namespace pintle {

using PlanarPose = std::array<double, 3>;  ///< x, y of the centre of mass [m], angle [rad]

/// A soft spring between a point of a body and a point of the world.
struct Pull {
  int body = 0;           ///< index into Model::bodies
  Vec2 point{0, 0};       ///< in body axes, from the centre of mass [m]
  Vec2 target{0, 0};      ///< in the world [m]
  double stiffness = 0;   ///< [N/m]; 0: chosen so that the mechanism follows within about half a second
};

/// Joint force on the second body: force in world axes and couple about the second marker [N, N, N*m].
using JointForce = std::array<double, 3>;

/// The motion of a model from its start, computed as fast as the caller asks for it. Every joint is a force law here,
/// whatever the model's `equations` say.
class LiveMotion {
 public:
  /// Throws AssemblyError when the mechanism cannot be assembled, std::invalid_argument for names that do not exist.
  explicit LiveMotion(const Model& model);
  ~LiveMotion();
  LiveMotion(LiveMotion&&) noexcept;
  LiveMotion& operator=(LiveMotion&&) noexcept;

  /// Sets the pull from now on; nullopt releases it.
  void pull(const std::optional<Pull>& pull);
  /// Advances by dt [s], or as far as possible within `budget` seconds of wall time (0: no limit). Where no step succeeds at the bodies' current speed,
  /// for example when a bent blade snaps through, the bodies continue from rest, and their kinetic energy counts as dissipated. Returns false when no step
  /// succeeds from rest either: the state is unchanged, `failure` says why, and the next call tries again.
  bool advance(double dt, double budget = 0);
  const std::string& failure() const;

  double time() const;
  std::vector<PlanarPose> poses() const;
  /// Their rates [m/s, m/s, rad/s].
  std::vector<PlanarPose> velocities() const;
  /// For the model's joints, in their order.
  std::vector<JointForce> joint_forces() const;
  struct Energies {
    double kinetic = 0, potential = 0, dissipated = 0, supplied = 0;  ///< [J]; the work of the pull is included in `supplied`
  };
  Energies energies() const;
  /// Steps taken so far.
  std::uint64_t steps() const;
  const std::vector<std::string>& notes() const;

 private:
  class Motion;
  std::unique_ptr<Motion> motion_;
};

/// A model without masses, forces and motors: the joints are closed while one body is held at a point and moved with it.
class KinematicDrag {
 public:
  /// Throws std::invalid_argument for names that do not exist. Whether the joints close is reported by `assemble`.
  explicit KinematicDrag(const Model& model);
  ~KinematicDrag();
  KinematicDrag(KinematicDrag&&) noexcept;
  KinematicDrag& operator=(KinematicDrag&&) noexcept;

  struct Hold {
    int body = 0;
    Vec2 point{0, 0};   ///< in body axes, from the centre of mass [m]
    Vec2 target{0, 0};  ///< in the world [m]
  };
  /// Closes every joint with the held point as near to its target as the joints allow, starting from the last poses.
  /// Returns false when a joint stays open: the poses are then the last closed ones, or the best found.
  bool assemble(const std::optional<Hold>& hold = {});
  void set_poses(const std::vector<PlanarPose>& poses);

  std::vector<PlanarPose> poses() const;
  /// How far each joint stays open [m]; an angle is multiplied by the size of the mechanism.
  const std::vector<double>& gaps() const;
  /// Names of the joints that stay open.
  std::vector<std::string> open_joints() const;

 private:
  class Linkage;
  std::unique_ptr<Linkage> linkage_;
};

}  // namespace pintle
