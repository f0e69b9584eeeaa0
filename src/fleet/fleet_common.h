// What code for registers of any width is made of and shares.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "analyses/curve_nodes.h"
#include "analyses/slow_start.h"
#include "fleet/fleet_work.h"
#include "integrators/force_samples.h"
#include "integrators/newton_contraction.h"
#include "integrators/pose_blocks.h"
#include "integrators/step_error.h"
#include "solve/complex_lanes.h"
#include "simd/wide.h"
