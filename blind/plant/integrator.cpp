#include "blind/plant/integrator.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <utility>

#include "core/check.h"

namespace tera::blind {
namespace {

constexpr double kRelative = 1e-6, kAbsolute = 1e-8;
constexpr long kMostSteps = 200000;

}  // namespace

struct Integrator::Solver {
  Derivative derivative;
  Edges edges;
  std::size_t size = 0, edge_count = 0;
  double t_s = 0;
  SUNContext context = nullptr;
  N_Vector x = nullptr;
  SUNMatrix jacobian = nullptr;
  SUNLinearSolver linear = nullptr;
  void* memory = nullptr;

  ~Solver() {
    CVodeFree(&memory);
    SUNLinSolFree(linear);
    SUNMatDestroy(jacobian);
    N_VDestroy(x);
    SUNContext_Free(&context);
  }

  static int Derive(realtype t, N_Vector x, N_Vector dx, void* self) {
    const auto& solver = *static_cast<Solver*>(self);
    solver.derivative(t, {N_VGetArrayPointer(x), solver.size},
                      {N_VGetArrayPointer(dx), solver.size});
    return 0;
  }
  static int FindEdges(realtype t, N_Vector x, realtype* edges, void* self) {
    const auto& solver = *static_cast<Solver*>(self);
    solver.edges(t, {N_VGetArrayPointer(x), solver.size}, {edges, solver.edge_count});
    return 0;
  }
};

Integrator::Integrator(std::vector<double> x, Derivative derivative, std::size_t edge_count,
                       Edges edges)
    : solver_(std::make_unique<Solver>()) {
  Solver& s = *solver_;
  s.derivative = std::move(derivative);
  s.edges = std::move(edges);
  s.size = x.size();
  s.edge_count = edge_count;
  TERA_CHECK(SUNContext_Create(nullptr, &s.context) == 0, "no solver");
  const auto n = static_cast<sunindextype>(x.size());
  s.x = N_VNew_Serial(n, s.context);
  std::copy(x.begin(), x.end(), N_VGetArrayPointer(s.x));
  s.jacobian = SUNDenseMatrix(n, n, s.context);
  s.linear = SUNLinSol_Dense(s.x, s.jacobian, s.context);
  s.memory = CVodeCreate(CV_BDF, s.context);
  bool good = CVodeInit(s.memory, Solver::Derive, 0, s.x) == CV_SUCCESS;
  good = good && CVodeSetUserData(s.memory, &s) == CV_SUCCESS;
  good = good && CVodeSStolerances(s.memory, kRelative, kAbsolute) == CV_SUCCESS;
  good = good && CVodeSetLinearSolver(s.memory, s.linear, s.jacobian) == CV_SUCCESS;
  good = good && CVodeSetMaxNumSteps(s.memory, kMostSteps) == CV_SUCCESS;
  good = good && CVodeSetNoInactiveRootWarn(s.memory) == CV_SUCCESS;
  if (edge_count > 0) {
    good = good &&
           CVodeRootInit(s.memory, static_cast<int>(edge_count), Solver::FindEdges) == CV_SUCCESS;
  }
  TERA_CHECK(good, "solver refuses its settings");
}

Integrator::~Integrator() = default;

std::span<const double> Integrator::To(double t_s) {
  Solver& s = *solver_;
  CVodeSetStopTime(s.memory, t_s);
  while (s.t_s < t_s) {
    const int outcome = CVode(s.memory, t_s, s.x, &s.t_s, CV_NORMAL);
    TERA_CHECK(outcome >= 0, "the integration failed");
    if (outcome == CV_ROOT_RETURN) Restart();
    if (outcome == CV_TSTOP_RETURN) break;
  }
  s.t_s = t_s;
  return {N_VGetArrayPointer(s.x), s.size};
}

void Integrator::Restart() {
  Solver& s = *solver_;
  TERA_CHECK(CVodeReInit(s.memory, s.t_s, s.x) == CV_SUCCESS, "the solver cannot restart");
}

}  // namespace tera::blind
