// How a run chooses the tolerances and the order of its integrations. theory/time section 6.
#pragma once

namespace pintle {

constexpr double kFirstStep = 1e-4;        // first step of a pass, as a fraction of the duration
constexpr double kAlmostAll = 1 - 1e-12;   // fraction of the duration that counts as all of it: the rest is the rounding of times
constexpr double kPilot = 10;    // ratio of the tolerance of the first pass to that of the second
constexpr double kTight = 3e-7;  // tolerances below this use order 9
constexpr double kEasy = 3;      // Newton iterations per step: fewer indicate short steps, which order 9 makes longer

}  // namespace pintle
