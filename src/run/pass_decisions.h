// What decides how many passes a run makes, and when it stops: numbers for run_passes.cpp alone. theory/time section 6.
#pragma once

#include <cstdint>

namespace pintle::pass_decisions {

constexpr int kMaxPasses = 6;              // of a run, at most
constexpr int kMaxShortPasses = 10;        // the same while all of them have made few steps
constexpr std::uint64_t kFewSteps = 50000; // so many, or half a second
constexpr double kLoosest = 1e-4;          // of the second pass: above it steps are bounded by other things, and two passes are alike
constexpr double kLoosestIdeal = 1e-8;     // the same for ideal joints, which are a reference, and cheap
constexpr double kLoosestOfMotion = 1e-3;  // the same where the tolerance is of the motion; no pass is looser, and no energy account
constexpr double kLeastTolerance = 1e-13;  // of any pass: below it all is rounding
constexpr double kLatePart = 0.25;         // of a run, at its end: where passes agree there, they have not separated as chaotic motions do. With half of it nothing changes; with 0.5 a striking train that comes to rest is chaotic
constexpr double kPromised = 0.7;          // of the tolerance: with a smaller stated error the true one keeps to it, which may be a third larger
constexpr double kPromisedByFew = 0.5;     // the same of order 9, whose steps are few and long: two passes say less. With 0.7, 5 more of 817 runs of the battery are over the tolerance
constexpr double kPromisedStuck = 0.2;     // the same where surfaces have come to rest: passes may have locked in the same force, which is another than that of finer ones. With 0.7 and 0.5 a toggle clamp of rubbing pins is up to 5 tolerances off
constexpr double kAlike = 1.25;            // steps of the finer pass over those of the coarser: with fewer the two say little
constexpr double kSurest = 0.05;           // of the tolerance of the steps: no error is stated as smaller
constexpr double kRepeated = 0.1;          // tolerance of a pass that is to show whether what two have shown is so, over that of the finer; of the next where errors or an open account ask for another, at least
constexpr double kShorter = 0.5;           // longest step of a pass whose tolerance would not shorten its steps, over the mean one before
constexpr double kNearRounding = 1e-8;     // tolerance below which stiff joints may feel rounding, and steps multiply
constexpr double kNarrowed = 3e-10;        // tolerance down to which another pass is made finer because of what ramps of held jumps lag behind: with a tenth of it a relay takes 1.3 million steps for half the lag, with double a fifth for twice the lag
constexpr double kNoGain = 0.5;            // of the error that the passes before have shown: one that has not fallen so far below kNearRounding may be made of rounding
constexpr std::uint64_t kCheap = 500;      // steps of a pass after which finer ones of order 5 cost little; of order 9 they would be as few again, and differ by the coarser one's error
constexpr std::uint64_t kLong = 10000;     // after a pass of so many steps the next one goes there by a tenth at a time
constexpr double kFinest = 1e-11;          // tolerance down to which passes are made because errors grow exponentially; one more is compared with it
constexpr double kMostScatter = 0.65;      // of a rate of growth, for chaos to be claimed: that of the double pendulum has 0.56, of a cam whose roller rattles, and whose finer passes agree to the end, 0.75
constexpr double kOptimism = 2;            // standard errors by which a rate may be smaller before no tolerance is said to help
constexpr double kFalls = 0.1;             // of the error of passes that have grown apart alike: those whose errors fall so far converge yet. With 0 three balls of a cradle, whose error falls from 9 to 0.4 of the peak with a tenth of the tolerance, are taken for chaotic
constexpr double kFarBelow = 1e-18;        // tolerance that growing errors would ask for, below which nobody tries whether tolerances that can be had are enough
constexpr double kSudden = 0.1;            // of the error that the ratio of two tolerances would make of the error before: passes that are better may agree by chance
constexpr double kLeap = 1e-4;             // of the tolerance of a pass: the next one is no tighter, unless two pairs have shown the same exponential growth
constexpr double kShift = 0.2;             // of the time in which errors grow by the ratio of two tolerances: by so much later, at least, the tighter passes part. A pendulum that falls from its upper position parts at 0.04 of it later, as errors grow while it falls only
constexpr int kMostOpen = 2;               // passes made finer because the energy account did not close

}  // namespace pintle::pass_decisions
