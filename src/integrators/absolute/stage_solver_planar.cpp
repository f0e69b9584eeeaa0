#include "integrators/absolute/stage_newton_iteration.h"

namespace pintle {

template std::unique_ptr<BasicStageSolver<Planar>> make_stage_solver(const BasicSystem<Planar>& system, const RadauTable& table, double tolerance, Steps steps);

}  // namespace pintle
