#ifdef PINTLE_SUNDIALS
#include "integrators/general/sundials_code.h"

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunmatrix/sunmatrix_sparse.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace pintle {
namespace {

using Family = SundialsChoice::Family;

constexpr long kMaxSteps = 20'000'000;  // upper limit on the steps of one call

template <class T>
using Owned = std::unique_ptr<T, void (*)(T*)>;
using Vector = Owned<_generic_N_Vector>;

void must(int flag, const char* what) {
  if (flag < 0) throw std::runtime_error(fmt::format("SUNDIALS: {} failed", what));
}

int rate(realtype t, N_Vector y, N_Vector dy, void* equations) {
  const bool finite = static_cast<FirstOrderOde*>(equations)->rate(t, N_VGetArrayPointer(y), N_VGetArrayPointer(dy));
  return finite ? 0 : 1;  // 1: to be tried with a smaller step
}

void fill_dense(const FirstOrderOde& e, SUNMatrix J) {
  const int half = e.motion_size() / 2;
  SUNMatZero(J);
  for (int k = 0; k < half; ++k) SM_ELEMENT_D(J, k, half + k) = 1;
  e.for_each_block([J](int row, int column, const auto& block) {
    for (Eigen::Index r = 0; r < block.rows(); ++r)
      for (Eigen::Index c = 0; c < block.cols(); ++c) SM_ELEMENT_D(J, row + r, column + c) = block(r, c);
  });
}

// Writes by columns, always with the diagonal, so that I - gamma J needs no other pattern.
class ColumnWriter {
 public:
  explicit ColumnWriter(SUNMatrix J) : J_(J) {}
  void begin_column() { SM_INDEXPTRS_S(J_)[column_++] = count_; }
  void put(int row, double value) {
    SM_INDEXVALS_S(J_)[count_] = row;
    SM_DATA_S(J_)[count_++] = value;
  }

 private:
  SUNMatrix J_;
  sunindextype column_ = 0, count_ = 0;
};

void fill_sparse(const FirstOrderOde& e, SUNMatrix J) {
  const int n = e.system().n_bodies(), half = 3 * n;
  ColumnWriter out(J);
  for (const bool velocities : {false, true})
    for (int j = 0; j < n; ++j)
      for (int c = 0; c < 3; ++c) {
        out.begin_column();
        out.put(3 * j + c, velocities ? 1 : 0);
        for (const FirstOrderOde::Coupling& at : e.couplings(j)) {
          const Planar::Mat block = velocities ? e.by_velocity(at) : e.by_position(at);
          for (int r = 0; r < 3; ++r) out.put(half + 3 * at.row + r, block(r, c));
        }
        for (const ForceTangents::StateTangents& of : e.states())
          for (int side = 0; side < 2; ++side) {
            const JointData& joint = e.system().joints[of.joint];
            if ((side == 0 ? joint.at.a : joint.at.b) != j) continue;
            const Eigen::MatrixXd block = FirstOrderOde::rates_by_motion(of, side, velocities);
            for (int r = 0; r < of.law.n; ++r) out.put(2 * half + joint.first_state + r, block(r, c));
          }
      }
  for (const ForceTangents::StateTangents& of : e.states()) {  // in the order of the states
    const JointData& joint = e.system().joints[of.joint];
    for (int c = 0; c < of.law.n; ++c) {
      out.begin_column();
      for (int side = 0; side < 2; ++side) {
        const int body = side == 0 ? joint.at.a : joint.at.b;
        if (body == kGround) continue;
        const Eigen::MatrixXd block = e.accelerations_by_state(of, side);
        for (int r = 0; r < 3; ++r) out.put(half + 3 * body + r, block(r, c));
      }
      for (int r = 0; r < of.law.n; ++r) out.put(2 * half + joint.first_state + r, of.law.by_state[r][c]);
    }
  }
  for (int k = e.state_size(); k < e.size(); ++k) {
    out.begin_column();
    out.put(k, 0);
  }
  out.begin_column();
}

sunindextype entries(const FirstOrderOde& e) {
  sunindextype blocks = 0;
  for (int j = 0; j < e.system().n_bodies(); ++j) blocks += static_cast<sunindextype>(e.couplings(j).size());
  sunindextype of_states = 0;
  for (const JointData& joint : e.system().joints) {
    const sunindextype n = joint.law.n_states();
    of_states += n * (2 * (2 * 3 + 3) + n);  // of two bodies by the states, of the states by two bodies and by themselves
  }
  return 2 * 9 * blocks + of_states + e.size();
}

int jacobian(realtype t, N_Vector y, N_Vector, SUNMatrix J, void* equations, N_Vector, N_Vector, N_Vector) {
  auto& e = *static_cast<FirstOrderOde*>(equations);
  e.linearize(t, N_VGetArrayPointer(y));
  SUNMatGetID(J) == SUNMATRIX_DENSE ? fill_dense(e, J) : fill_sparse(e, J);
  return 0;
}

int roots(realtype t, N_Vector y, realtype* value, void* equations) {
  static_cast<FirstOrderOde*>(equations)->find_roots(t, N_VGetArrayPointer(y), value);
  return 0;
}

using JacobianFunction = int (*)(realtype, N_Vector, N_Vector, SUNMatrix, void*, N_Vector, N_Vector, N_Vector);
using Count = int (*)(void*, long*);

// The calls of one family. Those for the linear solver are null if there is none, counts if nothing is counted.
struct Calls {
  int (*set_tolerances)(void*, realtype, N_Vector);
  int (*set_user_data)(void*, void*);
  int (*set_max_steps)(void*, long);
  int (*set_error_file)(void*, FILE*);
  int (*set_max_step)(void*, realtype);
  int (*set_stop)(void*, realtype);
  int (*advance)(void*, realtype, N_Vector, realtype*, int);
  int (*interpolate)(void*, realtype, int, N_Vector);
  int (*set_linear_solver)(void*, SUNLinearSolver, SUNMatrix);
  int (*set_jacobian)(void*, JacobianFunction);
  int (*set_roots)(void*, int, int (*)(realtype, N_Vector, realtype*, void*));
  int (*restart)(void*, realtype, N_Vector);
  Count steps, evaluations, rejected, iterations, iteration_failures, factorizations;
  char* (*flag_name)(long);
  void (*release)(void**);
};
static_assert(CV_NORMAL == ARK_NORMAL && CV_ONE_STEP == ARK_ONE_STEP);

const Calls kCvode{CVodeSVtolerances, CVodeSetUserData, CVodeSetMaxNumSteps, CVodeSetErrFile, CVodeSetMaxStep, CVodeSetStopTime, CVode,
                   CVodeGetDky, CVodeSetLinearSolver, CVodeSetJacFn, CVodeRootInit, CVodeReInit, CVodeGetNumSteps, CVodeGetNumRhsEvals, CVodeGetNumErrTestFails,
                   CVodeGetNumNonlinSolvIters, CVodeGetNumNonlinSolvConvFails, CVodeGetNumLinSolvSetups, CVodeGetReturnFlagName, CVodeFree};
const Calls kErk{ERKStepSVtolerances, ERKStepSetUserData, ERKStepSetMaxNumSteps, ERKStepSetErrFile, ERKStepSetMaxStep, ERKStepSetStopTime,
                 ERKStepEvolve, ERKStepGetDky, nullptr, nullptr, ERKStepRootInit, [](void* memory, realtype t, N_Vector y) { return ERKStepReInit(memory, rate, t, y); }, ERKStepGetNumSteps, ERKStepGetNumRhsEvals, ERKStepGetNumErrTestFails,
                 nullptr, nullptr, nullptr, ERKStepGetReturnFlagName, ERKStepFree};

int implicit_evaluations(void* memory, long* n) {
  long of_explicit_part = 0;
  return ARKStepGetNumRhsEvals(memory, &of_explicit_part, n);
}
const Calls kDirk{ARKStepSVtolerances, ARKStepSetUserData, ARKStepSetMaxNumSteps, ARKStepSetErrFile, ARKStepSetMaxStep, ARKStepSetStopTime,
                  ARKStepEvolve, ARKStepGetDky, ARKStepSetLinearSolver, ARKStepSetJacFn, ARKStepRootInit, [](void* memory, realtype t, N_Vector y) { return ARKStepReInit(memory, nullptr, rate, t, y); }, ARKStepGetNumSteps, implicit_evaluations,
                  ARKStepGetNumErrTestFails, ARKStepGetNumNonlinSolvIters, ARKStepGetNumNonlinSolvConvFails, ARKStepGetNumLinSolvSetups,
                  ARKStepGetReturnFlagName, ARKStepFree};

}  // namespace

int dormand_prince_table() { return ARKODE_DORMAND_PRINCE_7_4_5; }

// Everything of SUNDIALS that lives as long as a run.
struct SundialsCode::Workspace {
  Workspace(const SundialsChoice& choice, FirstOrderOde& e, double start, const std::vector<double>& y0, double relative,
            const std::vector<double>& absolute)
      : equations(e), y(N_VNew_Serial(e.size(), context), N_VDestroy), floor(N_VNew_Serial(e.size(), context), N_VDestroy),
        between(N_VNew_Serial(e.size(), context), N_VDestroy), t(start) {
    std::copy(y0.begin(), y0.end(), N_VGetArrayPointer(y.get()));
    std::copy(absolute.begin(), absolute.end(), N_VGetArrayPointer(floor.get()));
    make_memory(choice);
    must(calls->set_tolerances(memory, relative, floor.get()), "setting tolerances");
    calls->set_user_data(memory, &equations);
    calls->set_max_steps(memory, kMaxSteps);
    calls->set_error_file(memory, nullptr);
    choose_method(choice);
    if (equations.n_roots() > 0) must(calls->set_roots(memory, equations.n_roots(), roots), "setting roots");
  }
  ~Workspace() { calls->release(&memory); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  void make_memory(const SundialsChoice& choice) {
    if (choice.family == Family::kExplicitRungeKutta) {
      calls = &kErk;
      memory = ERKStepCreate(rate, t, y.get(), context);
    } else if (choice.family == Family::kImplicitRungeKutta) {
      calls = &kDirk;
      memory = ARKStepCreate(nullptr, rate, t, y.get(), context);
    } else {
      calls = &kCvode;
      memory = CVodeCreate(choice.family == Family::kBdf ? CV_BDF : CV_ADAMS, context);
      must(CVodeInit(memory, rate, t, y.get()), "CVodeInit");
    }
    if (!memory) throw std::runtime_error("SUNDIALS: no memory");
  }
  void choose_method(const SundialsChoice& choice) {
    switch (choice.family) {
      case Family::kExplicitRungeKutta:
        must(ERKStepSetTableNum(memory, static_cast<ARKODE_ERKTableID>(choice.table)), "ERKStepSetTableNum");
        break;
      case Family::kImplicitRungeKutta:
        must(ARKStepSetTableNum(memory, static_cast<ARKODE_DIRKTableID>(choice.table), ARKODE_ERK_NONE), "ARKStepSetTableNum");
        ARKStepSetDeduceImplicitRhs(memory, SUNTRUE);
        make_linear_solver(choice.solver);
        break;
      case Family::kAdams:
        iteration.reset(SUNNonlinSol_FixedPoint(y.get(), 0, context));
        must(CVodeSetNonlinearSolver(memory, iteration.get()), "CVodeSetNonlinearSolver");
        break;
      case Family::kBdf:
        CVodeSetMaxOrd(memory, choice.max_order);
        CVodeSetStabLimDet(memory, choice.limit_unstable);
        make_linear_solver(choice.solver);
        break;
    }
  }
  void make_linear_solver(SundialsChoice::LinearSolver choice) {
    const sunindextype n = equations.size();
    const bool dense = choice == SundialsChoice::LinearSolver::kDense;
    matrix.reset(dense ? SUNDenseMatrix(n, n, context) : SUNSparseMatrix(n, n, entries(equations), CSC_MAT, context));
    solver.reset(dense ? SUNLinSol_Dense(y.get(), matrix.get(), context) : SUNLinSol_KLU(y.get(), matrix.get(), context));
    must(calls->set_linear_solver(memory, solver.get(), matrix.get()), "setting the linear solver");
    must(calls->set_jacobian(memory, jacobian), "setting the Jacobian");
  }
  bool advance(double to, int task) {
    const int flag = calls->advance(memory, to, y.get(), &t, task);
    at_root = flag == CV_ROOT_RETURN;
    if (flag >= 0) return true;
    char* name = calls->flag_name(flag);
    failure = fmt::format("SUNDIALS gave up at t = {:.9g} s: {}", t, name);
    std::free(name);
    return false;
  }
  std::uint64_t number(Count count) const {
    long n = 0;
    if (count) count(memory, &n);
    return static_cast<std::uint64_t>(n);
  }
  // Adds the counts since the last restart.
  void add_counts(Counters& counters) const {
    counters.steps += number(calls->steps);
    counters.evaluations += number(calls->evaluations);
    counters.rejected += number(calls->rejected);
    counters.newton_iterations += number(calls->iterations);
    counters.newton_failures += number(calls->iteration_failures);
    counters.factorizations += solver ? number(calls->factorizations) : 0;
  }

  sundials::Context context;
  FirstOrderOde& equations;
  Vector y, floor, between;
  Owned<_generic_SUNMatrix> matrix{nullptr, [](SUNMatrix m) { SUNMatDestroy(m); }};
  Owned<_generic_SUNLinearSolver> solver{nullptr, [](SUNLinearSolver s) { SUNLinSolFree(s); }};
  Owned<_generic_SUNNonlinearSolver> iteration{nullptr, [](SUNNonlinearSolver s) { SUNNonlinSolFree(s); }};
  const Calls* calls = nullptr;
  void* memory = nullptr;
  double t, stop = 0;
  bool at_root = false;
  Counters before_restart;
  std::string failure;
};

SundialsCode::SundialsCode(const SundialsChoice& choice, FirstOrderOde& equations, double t, const std::vector<double>& y, double relative,
                           const std::vector<double>& absolute)
    : w_(std::make_unique<Workspace>(choice, equations, t, y, relative, absolute)) {}

SundialsCode::~SundialsCode() = default;

void SundialsCode::set_max_step(double h) { w_->calls->set_max_step(w_->memory, h); }
void SundialsCode::stop_at(double t) {
  w_->calls->set_stop(w_->memory, t);
  w_->stop = t;
}
bool SundialsCode::step() { return w_->advance(w_->stop, CV_ONE_STEP); }
bool SundialsCode::advance_to(double t) { return w_->advance(t, CV_NORMAL); }
bool SundialsCode::at_root() const { return w_->at_root; }
double SundialsCode::t() const { return w_->t; }
const double* SundialsCode::y() const { return N_VGetArrayPointer(w_->y.get()); }

const double* SundialsCode::interpolate(double t) {
  return w_->calls->interpolate(w_->memory, t, 0, w_->between.get()) < 0 ? nullptr : N_VGetArrayPointer(w_->between.get());
}

void SundialsCode::restart(double t, const std::vector<double>& y) {
  w_->t = t;
  w_->add_counts(w_->before_restart);
  std::copy(y.begin(), y.end(), N_VGetArrayPointer(w_->y.get()));
  must(w_->calls->restart(w_->memory, w_->t, w_->y.get()), "restarting");
}

void SundialsCode::count(Counters& counters) const {
  counters = w_->before_restart;
  w_->add_counts(counters);
}

const std::string& SundialsCode::failure() const { return w_->failure; }

}  // namespace pintle
#endif
