#include "integrators/absolute/stage_newton_iteration.h"

namespace pintle {

PINTLE_IN_SPACE(template std::unique_ptr<BasicStageSolver<Spatial>> make_stage_solver(const BasicSystem<Spatial>& system, const RadauTable& table, double tolerance, Steps steps);)

}  // namespace pintle
