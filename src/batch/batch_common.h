// Shared includes of the code for registers of any width.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "batch/batch_work.h"
#include "dynamics/inverse_dynamics.h"
#include "integrators/absolute/pose_blocks.h"
#include "integrators/dense/force_samples.h"
#include "integrators/radau/newton_convergence.h"
#include "integrators/radau/step_error.h"
#include "linalg/chebyshev_nodes.h"
#include "linalg/complex_lanes.h"
#include "simd/processor_registers.h"
