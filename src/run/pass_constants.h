// How a run chooses the tolerances and the order of its integrations. theory/time section 6.
#pragma once

namespace pintle {

constexpr double kFirstStep = 1e-4;        // of the duration: the first step of a pass
constexpr double kAlmostAll = 1 - 1e-12;   // of the duration: what is missing is the rounding of times
constexpr double kPilot = 10;    // tolerance of the first pass over that of the second
constexpr double kTight = 3e-7;  // a tolerance below it is met by order 9
constexpr double kEasy = 3;      // Newton iterations per step: fewer say that steps are short, and order 9 makes them longer

}  // namespace pintle
