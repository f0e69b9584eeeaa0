#include "bench/simbody/mechanism.h"

#include <Simbody.h>

#include <cmath>
#include <memory>

namespace pintle::bench::simbody {
namespace {

using SimTK::MobilizedBody;
using SimTK::Vec3;
using SimTK::Vec6;

SimTK::Transform transform(const Three& frame) {
  return SimTK::Transform(SimTK::Rotation(frame[2], SimTK::ZAxis), Vec3(frame[0], frame[1], 0));
}

// Forces other than gravity, which is left to Simbody.
class Loads : public SimTK::Force::Custom::Implementation {
 public:
  Loads(const Mechanism& from, const std::vector<MobilizedBody>& bodies) : from_(from), bodies_(bodies) {}

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& on_bodies, SimTK::Vector_<Vec3>&, SimTK::Vector&) const override {
    std::vector<Three> q(bodies_.size()), v(bodies_.size()), Q(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Vec3 p = bodies_[i].getBodyOriginLocation(state), u = bodies_[i].getBodyOriginVelocity(state);
      const SimTK::Rotation& R = bodies_[i].getBodyRotation(state);
      q[i] = {p[0], p[1], std::atan2(R[1][0], R[0][0])};
      v[i] = {u[0], u[1], bodies_[i].getBodyAngularVelocity(state)[2]};
    }
    from_.loads(state.getTime(), q, v, Q);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      on_bodies[bodies_[i].getMobilizedBodyIndex()] += SimTK::SpatialVec(Vec3(0, 0, Q[i][2]), Vec3(Q[i][0], Q[i][1], 0));
  }
  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0; }

 private:
  const Mechanism& from_;
  const std::vector<MobilizedBody>& bodies_;
};

class Model {
 public:
  explicit Model(const Mechanism& from) : from_(from), matter_(system_), forces_(system_), bodies_(from.mass.size()) {
    const Vec3 gravity(from.gravity[0], from.gravity[1], 0);
    if (gravity.norm() > 0) SimTK::Force::UniformGravity(forces_, matter_, gravity);
    for (const Link& link : from.tree) bodies_[link.body] = mobilizer(link);
    for (const int joint : from.loops) close_loop(from.joints[joint]);
    if (from.tree.empty()) {
      for (std::size_t i = 0; i < bodies_.size(); ++i)
        bodies_[i] = MobilizedBody::Planar(matter_.Ground(), SimTK::Transform(), rigid(i), SimTK::Transform());
      for (const Joint& joint : from.joints) add_bushing(joint);
    }
    if (from.loads) SimTK::Force::Custom(forces_, new Loads(from, bodies_));
  }
  const SimTK::MultibodySystem& system() const { return system_; }

  SimTK::State start() {
    SimTK::State state = system_.realizeTopology();
    system_.realizeModel(state);
    for (std::size_t i = 0; from_.tree.empty() && i < bodies_.size(); ++i) {
      const Three &q = from_.q[i], &v = from_.v[i];
      bodies_[i].setQFromVector(state, SimTK::Vector(Vec3(q[2], q[0], q[1])));
      bodies_[i].setUFromVector(state, SimTK::Vector(Vec3(v[2], v[0], v[1])));
    }
    for (const Link& link : from_.tree) {
      bodies_[link.body].setOneQ(state, 0, link.start);
      bodies_[link.body].setOneU(state, 0, link.rate);
    }
    return state;
  }

  void read(const SimTK::State& state, Output& out) const {
    out.t = state.getTime();
    if (!from_.tree.empty()) {
      system_.realize(state, SimTK::Stage::Acceleration);
      read_reactions(state, out.forces);
      const Vec3 p = bodies_[from_.point_body].findStationLocationInGround(state, Vec3(from_.point[0], from_.point[1], 0));
      out.point = {p[0], p[1]};
      return;
    }
    out.q.resize(bodies_.size());
    out.v.resize(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const SimTK::Vector q = bodies_[i].getQAsVector(state), u = bodies_[i].getUAsVector(state);
      out.q[i] = {q[1], q[2], q[0]};
      out.v[i] = {u[1], u[2], u[0]};
    }
  }

 private:
  SimTK::Body::Rigid rigid(std::size_t i) const {
    const double inertia = from_.inertia[i];
    return SimTK::Body::Rigid(SimTK::MassProperties(from_.mass[i], Vec3(0), SimTK::Inertia(inertia, inertia, inertia)));
  }
  MobilizedBody& body(int i) { return i < 0 ? matter_.updGround() : bodies_[i]; }

  MobilizedBody mobilizer(const Link& link) {
    const Joint& joint = from_.joints[link.joint];
    const SimTK::Transform inner = transform(link.forward ? joint.F : joint.M), outer = transform(link.forward ? joint.M : joint.F);
    if (joint.slides) return MobilizedBody::Slider(body(link.parent), inner, rigid(link.body), outer);
    return MobilizedBody::Pin(body(link.parent), inner, rigid(link.body), outer);
  }

  void close_loop(const Joint& joint) {
    const Vec3 on_a(joint.F[0], joint.F[1], 0), on_b(joint.M[0], joint.M[1], 0);
    for (int axis = 0; axis < 2; ++axis) {
      Vec3 normal(0);
      normal[axis] = 1;
      planes_.push_back(SimTK::Constraint::PointInPlane(body(joint.a), SimTK::UnitVec3(normal), on_a[axis], body(joint.b), on_b));
    }
  }

  void add_bushing(const Joint& joint) {
    const auto axes = [](const Three& x) { return Vec6(0, 0, x[2], x[0], x[1], 0); };
    SimTK::Force::LinearBushing(forces_, body(joint.a), transform(joint.F), body(joint.b), transform(joint.M), axes(joint.stiffness), axes(joint.damping));
  }

  void read_reactions(const SimTK::State& state, std::vector<Three>& forces) const {
    forces.assign(from_.joints.size(), Three{});
    SimTK::Vector_<SimTK::SpatialVec> at_mobilizers;
    matter_.calcMobilizerReactionForces(state, at_mobilizers);
    for (const Link& link : from_.tree) {
      const Vec3& f = at_mobilizers[bodies_[link.body].getMobilizedBodyIndex()][1];
      const double sign = link.forward ? 1 : -1;
      forces[link.joint] = {sign * f[0], sign * f[1], 0};
    }
    for (std::size_t i = 0; i < from_.loops.size(); ++i) {
      const int a = from_.joints[from_.loops[i]].a;
      Vec3 f(-planes_[2 * i].getMultipliersAsVector(state)[0], -planes_[2 * i + 1].getMultipliersAsVector(state)[0], 0);
      if (a >= 0) f = bodies_[a].getBodyRotation(state) * f;
      forces[from_.loops[i]] = {f[0], f[1], 0};
    }
  }

  const Mechanism& from_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  std::vector<MobilizedBody> bodies_;
  std::vector<SimTK::Constraint> planes_;  // two per loop
};

std::unique_ptr<SimTK::Integrator> make_integrator(bool bdf, const SimTK::MultibodySystem& system) {
  if (bdf) return std::make_unique<SimTK::CPodesIntegrator>(system, SimTK::CPodes::BDF, SimTK::CPodes::Newton);
  return std::make_unique<SimTK::RungeKuttaMersonIntegrator>(system);
}

constexpr int kLook = 5000;  // steps between two readings of the clock

}  // namespace

void pintle_simbody_integrate(const Mechanism& mechanism, const Plan& plan, const std::function<void()>& begin, Result& result) {
  Model model(mechanism);
  const SimTK::State start = model.start();
  const auto integrator = make_integrator(plan.bdf, model.system());
  integrator->setAccuracy(plan.accuracy);
  integrator->setInternalStepLimit(kLook);
  begin();
  try {
    integrator->initialize(start);
    Output out;
    std::size_t row = 0;
    while (row < plan.outputs.size() && plan.keep_going()) {
      integrator->stepTo(plan.outputs[row]);
      if (integrator->getTime() < plan.outputs[row]) continue;
      model.read(integrator->getState(), out);
      plan.output(out);
      ++row;
    }
    result.completed = row == plan.outputs.size();
  } catch (const std::exception&) {
    result.completed = false;  // its step became too small, or the loops did not close
  }
  result.steps = integrator->getNumStepsTaken();
  result.realizations = integrator->getNumRealizations();
}

void pintle_simbody_version(std::string& out) {
  int major = 0, minor = 0, build = 0;
  SimTK_version_simbody(&major, &minor, &build);
  out = std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(build);
}

}  // namespace pintle::bench::simbody
