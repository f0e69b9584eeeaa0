#include "bench/simbody_methods.h"

#include <Simbody.h>
#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "bench/peer_tree.h"
#include "bench/stopwatch.h"
#include "laws/response.h"

namespace pintle::bench {
namespace {

using SimTK::MobilizedBody, SimTK::Vec3, SimTK::Vec6;

Vec3 vec3(const Planar::Point& p) { return {p.x(), p.y(), 0}; }

SimTK::Transform transform(const Planar::Frame& frame) {
  return {SimTK::Rotation(frame.angle, SimTK::ZAxis), vec3(frame.p)};
}

// Springs and motors as Pintle evaluates them, gravity left to Simbody.
class Loads : public SimTK::Force::Custom::Implementation {
 public:
  Loads(const System& system, const std::vector<MobilizedBody>& bodies) : system_(system), bodies_(bodies) {}

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& on_bodies, SimTK::Vector_<Vec3>&, SimTK::Vector&) const override {
    Vecs q(bodies_.size()), v(bodies_.size()), Q;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Vec3 p = bodies_[i].getBodyOriginLocation(state), u = bodies_[i].getBodyOriginVelocity(state);
      const SimTK::Rotation& R = bodies_[i].getBodyRotation(state);
      q[i] = {p[0], p[1], std::atan2(R[1][0], R[0][0])};
      v[i] = {u[0], u[1], bodies_[i].getBodyAngularVelocity(state)[2]};
    }
    std::vector<Planar::Motion> motions;
    system_.motions(q, v, motions);
    system_.external(state.getTime(), motions, Q);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Planar::Vec load = Q[i] - system_.bodies[i].gravity;
      on_bodies[bodies_[i].getMobilizedBodyIndex()] += SimTK::SpatialVec(Vec3(0, 0, load[2]), Vec3(load[0], load[1], 0));
    }
  }
  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0; }

 private:
  const System& system_;
  const std::vector<MobilizedBody>& bodies_;
};

class Mechanism {
 public:
  Mechanism(const System& from, SimbodyMethod::Joints joints) : from_(from), matter_(system_), forces_(system_), bodies_(from.bodies.size()) {
    const BodyData& first = from.bodies[0];
    const Vec3 gravity(first.gravity[0] / first.mass[0], first.gravity[1] / first.mass[1], 0);
    if (gravity.norm() > 0) SimTK::Force::UniformGravity(forces_, matter_, gravity);
    if (joints == SimbodyMethod::Joints::kTree) {
      tree_ = peer_tree(from);
      for (const TreeLink& link : tree_.links) bodies_[link.body] = mobilizer(link);
      for (const int joint : tree_.loops) close_loop(joint);
    } else {
      for (std::size_t i = 0; i < bodies_.size(); ++i)
        bodies_[i] = MobilizedBody::Planar(matter_.Ground(), SimTK::Transform(), rigid(from.bodies[i]), SimTK::Transform());
      for (const JointData& joint : from.joints) add_bushing(joint);
    }
    if (!from.loads.empty() || !from.applied.empty()) SimTK::Force::Custom(forces_, new Loads(from, bodies_));
  }
  const SimTK::MultibodySystem& system() const { return system_; }

  SimTK::State start(const State& at) {
    SimTK::State state = system_.realizeTopology();
    system_.realizeModel(state);
    for (std::size_t i = 0; tree_.links.empty() && i < bodies_.size(); ++i) {
      const Planar::Vec &q = at.q[i], &v = at.v[i];
      bodies_[i].setQFromVector(state, SimTK::Vector(Vec3(q[2], q[0], q[1])));
      bodies_[i].setUFromVector(state, SimTK::Vector(Vec3(v[2], v[0], v[1])));
    }
    std::vector<Planar::Motion> motions;
    from_.motions(at.q, at.v, motions);
    for (const TreeLink& link : tree_.links) {
      const JointData& joint = from_.joints[link.joint];
      const RelativePose pose = from_.pose(joint.at, motions);
      const int component = joint.type == "revolute" ? 2 : 0;
      bodies_[link.body].setOneQ(state, 0, link.forward ? pose.z[component] : -pose.z[component]);
      bodies_[link.body].setOneU(state, 0, link.forward ? pose.rate[component] : -pose.rate[component]);
    }
    return state;
  }

  void sample(const SimTK::State& state, const Problem& problem, Samples& samples) const {
    if (tree_.links.empty()) {
      Vecs q(bodies_.size()), v(bodies_.size());
      for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const SimTK::Vector y = bodies_[i].getQAsVector(state), u = bodies_[i].getUAsVector(state);
        q[i] = {y[1], y[2], y[0]};
        v[i] = {u[1], u[2], u[0]};
      }
      samples.add_by_laws(state.getTime(), q, v);
      return;
    }
    system_.realize(state, SimTK::Stage::Acceleration);
    samples.add_loads(reactions(state));
    const Vec3 p = bodies_[problem.point.body].findStationLocationInGround(state, vec3(problem.point.at));
    samples.add_place({p[0], p[1]});
  }

 private:
  static SimTK::Body::Rigid rigid(const BodyData& body) {
    const double inertia = body.mass[2];
    return SimTK::Body::Rigid(SimTK::MassProperties(body.mass[0], Vec3(0), SimTK::Inertia(inertia, inertia, inertia)));
  }
  MobilizedBody& body(int i) { return i == kGround ? static_cast<MobilizedBody&>(matter_.updGround()) : bodies_[i]; }

  MobilizedBody mobilizer(const TreeLink& link) {
    const JointData& joint = from_.joints[link.joint];
    const SimTK::Transform inner = transform(link.forward ? joint.at.F : joint.at.M), outer = transform(link.forward ? joint.at.M : joint.at.F);
    const SimTK::Body::Rigid own = rigid(from_.bodies[link.body]);
    if (joint.type == "revolute") return MobilizedBody::Pin(body(link.parent), inner, own, outer);
    if (joint.type == "prismatic") return MobilizedBody::Slider(body(link.parent), inner, own, outer);
    throw std::logic_error("Simbody's model has no joint " + joint.name);
  }

  void close_loop(int j) {
    const JointData& joint = from_.joints[j];
    if (joint.type != "revolute") throw std::logic_error("Simbody's model cannot close a loop at joint " + joint.name);
    for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0, 1, 0)})
      planes_.push_back(SimTK::Constraint::PointInPlane(body(joint.at.a), SimTK::UnitVec3(normal), dot(normal, vec3(joint.at.F.p)), body(joint.at.b),
                                                        vec3(joint.at.M.p)));
  }

  void add_bushing(const JointData& joint) {
    const Response law = respond(joint.law, Planar::Vec::Zero(), Planar::Vec::Zero());
    const auto axes = [](const Planar::Mat& m) { return Vec6(0, 0, m(2, 2), m(0, 0), m(1, 1), 0); };
    SimTK::Force::LinearBushing(forces_, body(joint.at.a), transform(joint.at.F), body(joint.at.b), transform(joint.at.M), axes(law.stiffness),
                                axes(law.damping));
  }

  std::vector<double> reactions(const SimTK::State& state) const {
    std::vector<double> loads(3 * from_.joints.size(), 0.0);
    const auto put = [&](int joint, const Vec3& force) {
      loads[3 * joint] = force[0];
      loads[3 * joint + 1] = force[1];
    };
    SimTK::Vector_<SimTK::SpatialVec> at_mobilizers;
    matter_.calcMobilizerReactionForces(state, at_mobilizers);
    for (const TreeLink& link : tree_.links) {
      const Vec3 force = at_mobilizers[bodies_[link.body].getMobilizedBodyIndex()][1];
      put(link.joint, link.forward ? force : -force);
    }
    for (std::size_t i = 0; i < tree_.loops.size(); ++i) {
      const int a = from_.joints[tree_.loops[i]].at.a;
      const Vec3 in_a(-planes_[2 * i].getMultipliersAsVector(state)[0], -planes_[2 * i + 1].getMultipliersAsVector(state)[0], 0);
      put(tree_.loops[i], a == kGround ? in_a : Vec3(bodies_[a].getBodyRotation(state) * in_a));
    }
    return loads;
  }

  const System& from_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  std::vector<MobilizedBody> bodies_;
  std::vector<SimTK::Constraint> planes_;  // two for each loop
  PeerTree tree_;
};

std::unique_ptr<SimTK::Integrator> make_integrator(SimbodyMethod::Integrator kind, const SimTK::MultibodySystem& system) {
  if (kind == SimbodyMethod::Integrator::kBdf) return std::make_unique<SimTK::CPodesIntegrator>(system, SimTK::CPodes::BDF, SimTK::CPodes::Newton);
  return std::make_unique<SimTK::RungeKuttaMersonIntegrator>(system);
}

}  // namespace

MethodRun run_simbody(const SimbodyMethod& method, const Problem& problem, double accuracy) {
  MethodRun run{false, 0, 0, 0, Samples(*problem.system, problem.point)};
  Mechanism mechanism(*problem.system, method.joints);
  const SimTK::State start = mechanism.start(*problem.start);
  const Stopwatch watch;
  const auto integrator = make_integrator(method.integrator, mechanism.system());
  integrator->setAccuracy(accuracy);
  integrator->setFinalTime(problem.outputs.back());
  integrator->setInternalStepLimit(1000);
  try {
    integrator->initialize(start);
    std::size_t row = 0;
    while (row < problem.outputs.size() && watch.seconds() < problem.cap) {
      const auto status = integrator->stepTo(problem.outputs[row]);
      if (status == SimTK::Integrator::EndOfSimulation && integrator->getTime() < problem.outputs.back()) break;
      if (integrator->getTime() < problem.outputs[row]) continue;
      mechanism.sample(integrator->getState(), problem, run.samples);
      ++row;
    }
    run.completed = row == problem.outputs.size();
  } catch (const std::exception&) {
    run.completed = false;  // its step became too small
  }
  run.seconds = watch.seconds();
  run.steps = integrator->getNumStepsTaken();
  run.evaluations = integrator->getNumRealizations();
  return run;
}

std::string simbody_version() {
  int major = 0, minor = 0, build = 0;
  SimTK_version_simbody(&major, &minor, &build);
  return fmt::format("{}.{}.{}", major, minor, build);
}

}  // namespace pintle::bench
