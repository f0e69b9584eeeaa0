#include "bench/mujoco_methods.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "bench/peer_tree.h"
#include "bench/stopwatch.h"

namespace pintle::bench {
namespace {

using Point = Planar::Point;

constexpr int kSmall = 150;  // number of bodies for which MuJoCo's own estimate of the memory suffices

// At the start every body's axes are the world axes, so that hinges start at angle zero and positions are plain differences.
class Document {
 public:
  Document(const MujocoMethod& method, const Problem& problem, double step)
      : system_(*problem.system), tree_(peer_tree(system_)) {
    system_.motions(problem.start->q, problem.start->v, motions_);
    const double gx = system_.bodies[0].gravity[0] / system_.bodies[0].mass[0], gy = system_.bodies[0].gravity[1] / system_.bodies[0].mass[1];
    text_ = fmt::format(
        "<mujoco><compiler angle=\"radian\" inertiafromgeom=\"false\"/><option timestep=\"{:.17g}\" integrator=\"{}\" "
        "gravity=\"{:.17g} {:.17g} 0\" solver=\"Newton\" iterations=\"100\" tolerance=\"1e-14\"><flag contact=\"disable\"/></option>{}<worldbody>\n",
        step, method.integrator, gx, gy, system_.n_bodies() > kSmall ? "<size nstack=\"40000000\"/>" : "");
    for (const TreeLink& link : tree_.links)
      if (link.parent == kGround) add_body(link);
    text_ += "</worldbody><equality>\n";
    for (const int joint : tree_.loops) add_loop(joint, method.softness * step);
    text_ += "</equality></mujoco>\n";
  }
  const std::string& text() const { return text_; }
  const PeerTree& tree() const { return tree_; }

 private:
  Point centre(int body) const { return body == kGround ? Point(0, 0) : motions_[body].p; }
  Point place(int body, const Planar::Frame& frame) const {
    return body == kGround ? frame.p : Point(motions_[body].p + motions_[body].turned(frame.p));
  }

  void add_body(const TreeLink& link) {
    const BodyData& body = system_.bodies[link.body];
    const JointData& joint = system_.joints[link.joint];
    const Point p = centre(link.body) - centre(link.parent);
    const Planar::Frame& own = link.forward ? joint.at.M : joint.at.F;
    text_ += fmt::format("<body name=\"b{}\" pos=\"{:.17g} {:.17g} 0\">", link.body, p.x(), p.y());
    if (joint.type == "revolute") {
      const Point at = place(link.body, own) - centre(link.body);
      text_ += fmt::format("<joint name=\"j{}\" type=\"hinge\" axis=\"0 0 1\" pos=\"{:.17g} {:.17g} 0\"/>", link.body, at.x(), at.y());
    } else if (joint.type == "prismatic" && link.parent == kGround && link.forward) {
      const Planar::Frame& way = joint.at.F;
      text_ += fmt::format("<joint name=\"j{}\" type=\"slide\" axis=\"{:.17g} {:.17g} 0\"/>", link.body, way.c, way.s);
    } else {
      throw std::logic_error("MuJoCo's model has no joint " + joint.name);
    }
    const double mass = body.mass[0], inertia = body.mass[2];
    text_ += fmt::format("<inertial pos=\"0 0 0\" mass=\"{0:.17g}\" diaginertia=\"{1:.17g} {1:.17g} {1:.17g}\"/>\n", mass, inertia);
    for (const TreeLink& child : tree_.links)
      if (child.parent == link.body) add_body(child);
    text_ += "</body>\n";
  }

  void add_loop(int j, double time_constant) {
    const JointData& joint = system_.joints[j];
    if (joint.type != "revolute") throw std::logic_error("MuJoCo's model cannot close a loop at joint " + joint.name);
    const bool swapped = joint.at.a == kGround;
    const int first = swapped ? joint.at.b : joint.at.a, second = swapped ? joint.at.a : joint.at.b;
    const Point at = place(first, swapped ? joint.at.M : joint.at.F) - centre(first);
    const std::string other = second == kGround ? "" : fmt::format(" body2=\"b{}\"", second);
    text_ += fmt::format("<connect body1=\"b{}\"{} anchor=\"{:.17g} {:.17g} 0\" solref=\"{:.17g} 1\" solimp=\"0.9999 0.9999 0.001\"/>\n", first, other,
                         at.x(), at.y(), time_constant);
  }

  const System& system_;
  PeerTree tree_;
  std::vector<Planar::Motion> motions_;
  std::string text_;
};

struct FreeModel {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
  void operator()(mjData* d) const { mj_deleteData(d); }
  void operator()(mjVFS* vfs) const {
    mj_deleteVFS(vfs);
    delete vfs;
  }
};

std::unique_ptr<mjModel, FreeModel> load(const std::string& text) {
  std::unique_ptr<mjVFS, FreeModel> files(new mjVFS);
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "model.xml", static_cast<int>(text.size()));
  std::copy(text.begin(), text.end(), static_cast<char*>(files->filedata[0]));
  char error[500] = "";
  mju_user_warning = [](const char*) {};  // by default it would write a log into the working directory
  std::unique_ptr<mjModel, FreeModel> model(mj_loadXML("model.xml", files.get(), error, sizeof error));
  if (!model) throw std::runtime_error(fmt::format("MuJoCo refuses the model: {}", error));
  return model;
}

// Springs and motors evaluated as in Pintle; gravity is left to MuJoCo.
class Loads {
 public:
  Loads(const Problem& problem, const PeerTree& tree, const mjModel* model) : system_(*problem.system), tree_(tree), start_(problem.start->q) {
    for (const TreeLink& link : tree_.links) {
      body_.push_back(mj_name2id(model, mjOBJ_BODY, fmt::format("b{}", link.body).c_str()));
      const int joint = mj_name2id(model, mjOBJ_JOINT, fmt::format("j{}", link.body).c_str());
      position_.push_back(model->jnt_qposadr[joint]);
      rate_.push_back(model->jnt_dofadr[joint]);
    }
    q_ = v_ = start_;
  }

  void apply(mjData* d) {
    for (std::size_t i = 0; i < tree_.links.size(); ++i) {
      const TreeLink& link = tree_.links[i];
      const bool turns = system_.joints[link.joint].type == "revolute";
      const double parent = link.parent == kGround ? 0 : q_[link.parent][2] - start_[link.parent][2];
      const double parent_spin = link.parent == kGround ? 0 : v_[link.parent][2];
      const mjtNum* at = d->xpos + 3 * body_[i];
      mjtNum velocity[6];
      mju_copy(velocity, d->cvel + 6 * body_[i], 6);  // spin, then the velocity of the tree's centre of mass
      const mjtNum* centre = d->subtree_com + 3 * root_of(i);
      const double spin = parent_spin + (turns ? d->qvel[rate_[i]] : 0);
      q_[link.body] = {at[0], at[1], start_[link.body][2] + parent + (turns ? d->qpos[position_[i]] : 0)};
      v_[link.body] = {velocity[3] - spin * (at[1] - centre[1]), velocity[4] + spin * (at[0] - centre[0]), spin};
    }
    system_.motions(q_, v_, motions_);
    system_.external(d->time, motions_, Q_);
    for (std::size_t i = 0; i < tree_.links.size(); ++i) {
      const int body = tree_.links[i].body;
      const Planar::Vec load = Q_[body] - system_.bodies[body].gravity;
      mjtNum* out = d->xfrc_applied + 6 * body_[i];
      out[0] = load[0];
      out[1] = load[1];
      out[5] = load[2];
    }
  }

 private:
  int root_of(std::size_t i) const {
    while (tree_.links[i].parent != kGround)
      for (std::size_t k = 0; k < i; ++k)
        if (tree_.links[k].body == tree_.links[i].parent) {
          i = k;
          break;
        }
    return body_[i];
  }

  const System& system_;
  const PeerTree& tree_;
  Vecs start_, q_, v_, Q_;
  std::vector<int> body_, position_, rate_;
  std::vector<Planar::Motion> motions_;
};

thread_local Loads* active_loads = nullptr;
void apply_loads(const mjModel*, mjData* d) { active_loads->apply(d); }

void set_rates(const Problem& problem, const PeerTree& tree, const mjModel* model, mjData* d) {
  const Vecs& v = problem.start->v;
  for (const TreeLink& link : tree.links) {
    const JointData& joint = problem.system->joints[link.joint];
    const int at = model->jnt_dofadr[mj_name2id(model, mjOBJ_JOINT, fmt::format("j{}", link.body).c_str())];
    const double parent = link.parent == kGround ? 0 : v[link.parent][2];
    d->qvel[at] = joint.type == "revolute" ? v[link.body][2] - parent : joint.at.F.c * v[link.body][0] + joint.at.F.s * v[link.body][1];
  }
}

}  // namespace

MethodRun run_mujoco(const MujocoMethod& method, const Problem& problem, double step) {
  MethodRun run{false, 0, 0, 0, Samples(*problem.system, problem.point)};
  const double interval = problem.outputs.front() - problem.start->t;
  const int per_output = std::max(1, static_cast<int>(std::ceil(interval / step - 1e-9)));
  const Document document(method, problem, interval / per_output);
  const auto model = load(document.text());
  const std::unique_ptr<mjData, FreeModel> data(mj_makeData(model.get()));
  set_rates(problem, document.tree(), model.get(), data.get());
  Loads loads(problem, document.tree(), model.get());
  active_loads = &loads;
  mjcb_control = problem.system->loads.empty() && problem.system->applied.empty() ? nullptr : apply_loads;
  const int body = mj_name2id(model.get(), mjOBJ_BODY, fmt::format("b{}", problem.point.body).c_str());
  const Planar::Vec& start = problem.start->q[problem.point.body];
  const Point r = Planar::Motion::of(start, Planar::Vec::Zero()).turned(problem.point.at);
  const Stopwatch watch;
  run.completed = true;
  for (std::size_t row = 0; row < problem.outputs.size() && run.completed; ++row) {
    for (int i = 0; i < per_output && run.completed; ++i) {
      mj_step(model.get(), data.get());
      if (i % 16 == 0) run.completed = watch.seconds() < problem.cap;
    }
    mj_kinematics(model.get(), data.get());
    const mjtNum *p = data->xpos + 3 * body, *R = data->xmat + 9 * body;
    run.samples.add_place({p[0] + R[0] * r.x() + R[1] * r.y(), p[1] + R[3] * r.x() + R[4] * r.y()});
    run.steps += per_output;
  }
  run.seconds = watch.seconds();
  mjcb_control = nullptr;
  run.evaluations = run.steps * (method.integrator == "RK4" ? 4 : 1);
  return run;
}

std::string mujoco_version() {
  return mj_versionString();
}

}  // namespace pintle::bench
