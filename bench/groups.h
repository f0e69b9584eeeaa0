// The groups of methods compared in the tables and pictures: at every error, each is judged by the best of its methods.
#pragma once

#include <array>
#include <string>

namespace pintle::bench {

inline const std::string kCompliant = "compliant", kIdeal = "ideal";  // the equations that a method solves

namespace group {
inline const std::string kPintle = "Pintle", kWholeRun = "Pintle, whole run", kExplicit = "Pintle, dopri5", kSundials = "SUNDIALS",
                         kSimbodyBushings = "Simbody, bushings", kPintleIdeal = "Pintle, ideal joints", kSimbodyIdeal = "Simbody, ideal joints",
                         kMujoco = "MuJoCo, ideal joints", kPenalty = "Penalty", kAugmented = "Augmented Lagrangian";
inline const std::array<std::string, 10> kAll{kPintle, kWholeRun, kExplicit, kSundials, kSimbodyBushings, kPintleIdeal, kPenalty, kAugmented, kSimbodyIdeal, kMujoco};
/// Style of the line in the picture: a colour for each program, dashed for ideal joints.
inline const std::array<int, 10> kStyle{0, 1, 2, 3, 4, 7, 13, 9, 11, 12};
}  // namespace group

}  // namespace pintle::bench
