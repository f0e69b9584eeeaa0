#include "bench/sundials_methods.h"

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunmatrix/sunmatrix_sparse.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <memory>
#include <stdexcept>

#include "bench/stopwatch.h"

namespace pintle::bench {
namespace {

constexpr long kMaxSteps = 5'000'000;

template <class T>
using Owned = std::unique_ptr<T, void (*)(T*)>;
using Vector = Owned<_generic_N_Vector>;

void must(int flag, const char* what) {
  if (flag < 0) throw std::runtime_error(std::string("SUNDIALS: ") + what + " failed");
}

int rate(realtype t, N_Vector y, N_Vector dy, void* equations) {
  static_cast<FlatEquations*>(equations)->rate(t, N_VGetArrayPointer(y), N_VGetArrayPointer(dy));
  return 0;
}

void fill_dense(const FlatEquations& e, SUNMatrix J) {
  const int n = e.system().n_bodies(), half = 3 * n;
  SUNMatZero(J);
  for (int k = 0; k < half; ++k) SM_ELEMENT_D(J, k, half + k) = 1;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
          SM_ELEMENT_D(J, half + 3 * i + r, 3 * j + c) = e.by_position(i, j)(r, c);
          SM_ELEMENT_D(J, half + 3 * i + r, half + 3 * j + c) = e.by_velocity(i, j)(r, c);
        }
}

// By columns, the diagonal always present, so that I - gamma J needs no other pattern.
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

void fill_sparse(const FlatEquations& e, SUNMatrix J) {
  const int n = e.system().n_bodies(), half = 3 * n;
  ColumnWriter out(J);
  for (int j = 0; j < n; ++j)
    for (int c = 0; c < 3; ++c) {
      out.begin_column();
      out.put(3 * j + c, 0);
      for (int i = 0; i < n; ++i)
        for (int r = 0; r < 3 && e.coupled(i, j); ++r) out.put(half + 3 * i + r, e.by_position(i, j)(r, c));
    }
  for (int j = 0; j < n; ++j)
    for (int c = 0; c < 3; ++c) {
      out.begin_column();
      out.put(3 * j + c, 1);
      for (int i = 0; i < n; ++i)
        for (int r = 0; r < 3 && e.coupled(i, j); ++r) out.put(half + 3 * i + r, e.by_velocity(i, j)(r, c));
    }
  out.begin_column();
}

int jacobian(realtype t, N_Vector y, N_Vector, SUNMatrix J, void* equations, N_Vector, N_Vector, N_Vector) {
  auto& e = *static_cast<FlatEquations*>(equations);
  e.linearize(t, N_VGetArrayPointer(y));
  SUNMatGetID(J) == SUNMATRIX_DENSE ? fill_dense(e, J) : fill_sparse(e, J);
  return 0;
}

sunindextype entries(const FlatEquations& e) {
  sunindextype blocks = 0;
  for (int i = 0; i < e.system().n_bodies(); ++i)
    for (int j = 0; j < e.system().n_bodies(); ++j) blocks += e.coupled(i, j);
  return 2 * 9 * blocks + e.size();
}

// Everything of SUNDIALS that lives as long as a run.
struct Workspace {
  explicit Workspace(const Problem& problem)
      : equations(*problem.system),
        y(N_VNew_Serial(equations.size(), context), N_VDestroy),
        floor(N_VNew_Serial(equations.size(), context), N_VDestroy) {
    equations.flatten(problem.start->q, problem.start->v, N_VGetArrayPointer(y.get()));
  }
  void make_linear_solver(LinearSolver choice) {
    const sunindextype n = equations.size();
    const bool dense = choice == LinearSolver::kDense;
    matrix.reset(dense ? SUNDenseMatrix(n, n, context) : SUNSparseMatrix(n, n, entries(equations), CSC_MAT, context));
    solver.reset(dense ? SUNLinSol_Dense(y.get(), matrix.get(), context)
                       : SUNLinSol_KLU(y.get(), matrix.get(), context));
  }
  // The relative tolerance; `floor` becomes the absolute one.
  double tolerances(const Problem& problem, Weights weights, double tolerance) {
    const int n = equations.size();
    const bool plain = weights == Weights::kPlain;
    for (int i = 0; i < n; ++i)
      N_VGetArrayPointer(floor.get())[i] =
          plain ? tolerance : tolerance * problem.force / (i < n / 2 ? problem.stiffness : problem.impedance);
    return plain ? tolerance : 1e-15;
  }

  sundials::Context context;
  FlatEquations equations;
  Vector y, floor;
  Owned<_generic_SUNMatrix> matrix{nullptr, [](SUNMatrix m) { SUNMatDestroy(m); }};
  Owned<_generic_SUNLinearSolver> solver{nullptr, [](SUNLinearSolver s) { SUNLinSolFree(s); }};
  Owned<_generic_SUNNonlinearSolver> iteration{nullptr, [](SUNNonlinearSolver s) { SUNNonlinSolFree(s); }};
  Vecs q, v;
};

// CVODE, ERKStep and ARKStep have the same calls under different names.
class Stepper {
 public:
  virtual ~Stepper() = default;
  virtual void stop_at(double t) = 0;
  virtual int advance(double t, N_Vector y) = 0;
  virtual void counters(PeerRun& run) = 0;
};

class Cvode : public Stepper {
 public:
  Cvode(const PeerMethod& method, const Problem& problem, double tolerance, Workspace& w)
      : memory_(CVodeCreate(method.family == Family::kBdf ? CV_BDF : CV_ADAMS, w.context)) {
    must(CVodeInit(memory_, rate, problem.start->t, w.y.get()), "CVodeInit");
    const double relative = w.tolerances(problem, method.weights, tolerance);
    must(CVodeSVtolerances(memory_, relative, w.floor.get()), "CVodeSVtolerances");
    CVodeSetUserData(memory_, &w.equations);
    CVodeSetMaxNumSteps(memory_, kMaxSteps);
    CVodeSetErrFile(memory_, nullptr);
    if (method.family == Family::kAdams) {
      w.iteration.reset(SUNNonlinSol_FixedPoint(w.y.get(), 0, w.context));
      must(CVodeSetNonlinearSolver(memory_, w.iteration.get()), "CVodeSetNonlinearSolver");
      return;
    }
    CVodeSetMaxOrd(memory_, method.max_order);
    CVodeSetStabLimDet(memory_, method.limit_unstable);
    w.make_linear_solver(method.solver);
    must(CVodeSetLinearSolver(memory_, w.solver.get(), w.matrix.get()), "CVodeSetLinearSolver");
    must(CVodeSetJacFn(memory_, jacobian), "CVodeSetJacFn");
  }
  ~Cvode() override { CVodeFree(&memory_); }
  void stop_at(double t) override { CVodeSetStopTime(memory_, t); }
  int advance(double t, N_Vector y) override { return CVode(memory_, t, y, &reached_, CV_NORMAL); }
  void counters(PeerRun& run) override {
    CVodeGetNumSteps(memory_, &run.steps);
    CVodeGetNumRhsEvals(memory_, &run.evaluations);
  }

 private:
  void* memory_;
  double reached_ = 0;
};

class Erk : public Stepper {
 public:
  Erk(const PeerMethod& method, const Problem& problem, double tolerance, Workspace& w)
      : memory_(ERKStepCreate(rate, problem.start->t, w.y.get(), w.context)) {
    const double relative = w.tolerances(problem, method.weights, tolerance);
    must(ERKStepSVtolerances(memory_, relative, w.floor.get()), "ERKStepSVtolerances");
    must(ERKStepSetTableNum(memory_, static_cast<ARKODE_ERKTableID>(method.table)), "ERKStepSetTableNum");
    ERKStepSetUserData(memory_, &w.equations);
    ERKStepSetMaxNumSteps(memory_, kMaxSteps);
    ERKStepSetErrFile(memory_, nullptr);
  }
  ~Erk() override { ERKStepFree(&memory_); }
  void stop_at(double t) override { ERKStepSetStopTime(memory_, t); }
  int advance(double t, N_Vector y) override { return ERKStepEvolve(memory_, t, y, &reached_, ARK_NORMAL); }
  void counters(PeerRun& run) override {
    ERKStepGetNumSteps(memory_, &run.steps);
    ERKStepGetNumRhsEvals(memory_, &run.evaluations);
  }

 private:
  void* memory_;
  double reached_ = 0;
};

class Dirk : public Stepper {
 public:
  Dirk(const PeerMethod& method, const Problem& problem, double tolerance, Workspace& w)
      : memory_(ARKStepCreate(nullptr, rate, problem.start->t, w.y.get(), w.context)) {
    const double relative = w.tolerances(problem, method.weights, tolerance);
    must(ARKStepSVtolerances(memory_, relative, w.floor.get()), "ARKStepSVtolerances");
    must(ARKStepSetTableNum(memory_, static_cast<ARKODE_DIRKTableID>(method.table), ARKODE_ERK_NONE),
         "ARKStepSetTableNum");
    ARKStepSetUserData(memory_, &w.equations);
    ARKStepSetMaxNumSteps(memory_, kMaxSteps);
    ARKStepSetErrFile(memory_, nullptr);
    ARKStepSetDeduceImplicitRhs(memory_, SUNTRUE);
    w.make_linear_solver(method.solver);
    must(ARKStepSetLinearSolver(memory_, w.solver.get(), w.matrix.get()), "ARKStepSetLinearSolver");
    must(ARKStepSetJacFn(memory_, jacobian), "ARKStepSetJacFn");
  }
  ~Dirk() override { ARKStepFree(&memory_); }
  void stop_at(double t) override { ARKStepSetStopTime(memory_, t); }
  int advance(double t, N_Vector y) override { return ARKStepEvolve(memory_, t, y, &reached_, ARK_NORMAL); }
  void counters(PeerRun& run) override {
    long of_explicit_part = 0;
    ARKStepGetNumSteps(memory_, &run.steps);
    ARKStepGetNumRhsEvals(memory_, &of_explicit_part, &run.evaluations);
  }

 private:
  void* memory_;
  double reached_ = 0;
};

std::unique_ptr<Stepper> make_stepper(const PeerMethod& method, const Problem& problem, double tolerance,
                                      Workspace& w) {
  switch (method.family) {
    case Family::kExplicitRungeKutta:
      return std::make_unique<Erk>(method, problem, tolerance, w);
    case Family::kImplicitRungeKutta:
      return std::make_unique<Dirk>(method, problem, tolerance, w);
    default:
      return std::make_unique<Cvode>(method, problem, tolerance, w);
  }
}

}  // namespace

PeerRun run_sundials(const PeerMethod& method, const Problem& problem, double tolerance) {
  PeerRun run{false, 0, 0, 0, ForceSamples(*problem.system)};
  const Stopwatch watch;
  Workspace w(problem);
  const std::unique_ptr<Stepper> stepper = make_stepper(method, problem, tolerance, w);
  stepper->stop_at(problem.outputs.back());
  run.completed = true;
  for (const double t : problem.outputs) {
    if (method.stop_at_outputs) stepper->stop_at(t);
    if (stepper->advance(t, w.y.get()) < 0) {
      run.completed = false;
      break;
    }
    w.equations.unflatten(N_VGetArrayPointer(w.y.get()), w.q, w.v);
    run.samples.add_by_laws(t, w.q, w.v);
  }
  run.seconds = watch.seconds();
  stepper->counters(run);
  return run;
}

}  // namespace pintle::bench
