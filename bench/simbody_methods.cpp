#include "bench/simbody_methods.h"

#include <dlfcn.h>

#include <stdexcept>
#include <string>

#include "bench/peer_tree.h"
#include "bench/simbody/mechanism.h"
#include "bench/stopwatch.h"

namespace pintle::bench {
namespace {

using simbody::Three;

Three three(const Planar::Vec& x) { return {x[0], x[1], x[2]}; }
Three three(const Planar::Frame& frame) { return {frame.p.x(), frame.p.y(), frame.angle}; }
std::vector<Three> threes(const Vecs& x) {
  std::vector<Three> out;
  for (const Planar::Vec& one : x) out.push_back(three(one));
  return out;
}
Vecs vecs(const std::vector<Three>& x) {
  Vecs out;
  for (const Three& one : x) out.push_back({one[0], one[1], one[2]});
  return out;
}

simbody::Joint plain(const JointData& joint) {
  if (joint.type != "revolute" && joint.type != "prismatic") throw std::logic_error("Simbody's model has no joint " + joint.name);
  const Response law = respond(joint.law, Planar::Vec::Zero(), Planar::Vec::Zero());
  simbody::Joint out;
  out.a = joint.at.a;
  out.b = joint.at.b;
  out.F = three(joint.at.F);
  out.M = three(joint.at.M);
  out.slides = joint.type == "prismatic";
  out.stiffness = three(law.stiffness.diagonal());
  out.damping = three(law.damping.diagonal());
  return out;
}

void add_tree(const Problem& problem, simbody::Mechanism& out) {
  const System& system = *problem.system;
  PeerTree tree = peer_tree(system);
  std::vector<Planar::Motion> motions;
  system.motions(problem.start->q, problem.start->v, motions);
  for (const TreeLink& link : tree.links) {
    const JointData& joint = system.joints[link.joint];
    const RelativePose pose = system.pose(joint.at, motions);
    const int component = joint.type == "revolute" ? 2 : 0;
    const double sign = link.forward ? 1 : -1;
    out.tree.push_back({link.body, link.parent, link.joint, link.forward, sign * pose.z[component], sign * pose.rate[component]});
  }
  for (const int joint : tree.loops)
    if (system.joints[joint].type != "revolute") throw std::logic_error("Simbody's model cannot close a loop at joint " + system.joints[joint].name);
  out.loops = std::move(tree.loops);
}

simbody::Mechanism plain(const Problem& problem, bool bushings) {
  const System& system = *problem.system;
  simbody::Mechanism out;
  for (const BodyData& body : system.bodies) {
    out.mass.push_back(body.mass[0]);
    out.inertia.push_back(body.mass[2]);
  }
  out.q = threes(problem.start->q);
  out.v = threes(problem.start->v);
  const BodyData& first = system.bodies[0];
  out.gravity = {first.gravity[0] / first.mass[0], first.gravity[1] / first.mass[1]};
  for (const JointData& joint : system.joints) out.joints.push_back(plain(joint));
  if (!bushings) add_tree(problem, out);
  out.point_body = problem.point.body;
  out.point = {problem.point.at.x(), problem.point.at.y()};
  if (system.loads.empty() && system.applied.empty()) return out;
  out.loads = [&system](double t, const std::vector<Three>& q, const std::vector<Three>& v, std::vector<Three>& Q) {
    std::vector<Planar::Motion> motions;
    Vecs on_bodies;
    system.motions(vecs(q), vecs(v), motions);
    system.external(t, motions, on_bodies);
    for (std::size_t i = 0; i < Q.size(); ++i) Q[i] = three(Planar::Vec(on_bodies[i] - system.bodies[i].gravity));
  };
  return out;
}

// A function of the module, which stays loaded.
template <class Function>
Function* of_module(const char* name) {
  static void* const module = dlopen(PINTLE_SIMBODY_MODULE, RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
  void* const found = module ? dlsym(module, name) : nullptr;
  if (!found) throw std::runtime_error(std::string("Simbody: ") + dlerror());
  return reinterpret_cast<Function*>(found);
}

}  // namespace

MethodRun run_simbody(const SimbodyMethod& method, const Problem& problem, double accuracy) {
  MethodRun run{false, 0, 0, 0, Samples(*problem.system, problem.point)};
  const bool bushings = method.joints == SimbodyMethod::Joints::kBushings;
  const simbody::Mechanism mechanism = plain(problem, bushings);
  Stopwatch watch;
  simbody::Plan plan;
  plan.bdf = method.integrator == SimbodyMethod::Integrator::kBdf;
  plan.accuracy = accuracy;
  plan.outputs = problem.outputs;
  plan.keep_going = [&] { return watch.seconds() < problem.cap; };
  plan.output = [&](const simbody::Output& at) {
    if (bushings) return run.samples.add_by_laws(at.t, vecs(at.q), vecs(at.v));
    std::vector<double> loads;
    for (const Three& force : at.forces) loads.insert(loads.end(), force.begin(), force.end());
    run.samples.add_loads(loads);
    run.samples.add_place({at.point[0], at.point[1]});
  };
  simbody::Result result;
  of_module<decltype(simbody::pintle_simbody_integrate)>("pintle_simbody_integrate")(mechanism, plan, [&] { watch = Stopwatch(); }, result);
  run.seconds = watch.seconds();
  run.completed = result.completed;
  run.steps = result.steps;
  run.evaluations = result.realizations;
  return run;
}

std::string simbody_version() {
  std::string version;
  of_module<decltype(simbody::pintle_simbody_version)>("pintle_simbody_version")(version);
  return version;
}

}  // namespace pintle::bench
