// Constants that decide how many passes a run makes and when it stops, for run_passes.cpp alone. theory/time section 6.
#pragma once

#include <cstdint>

namespace pintle::pass_decisions {

constexpr int kMaxPasses = 6;              // upper limit on the passes of a run
constexpr int kMaxShortPasses = 10;        // the same while all passes together have taken few steps
constexpr std::uint64_t kFewSteps = 50000; // fewer steps than this are few: about half a second
constexpr double kLoosest = 1e-4;          // upper limit on the tolerance of the second pass: above it other things limit the steps, and two passes take nearly the same ones
constexpr double kLoosestIdeal = 1e-8;     // the same for ideal joints, which serve as a reference and are cheap
constexpr double kLoosestOfMotion = 1e-3;  // the same for a tolerance on the motion; no pass or energy account is looser
constexpr double kLeastTolerance = 1e-13;  // lower limit for any pass: below it all is roundoff
constexpr double kPromised = 0.7;          // accept if the stated error is below this fraction of the tolerance: the true error, which may be a third larger, then meets it
constexpr double kPromisedByFew = 0.5;     // the same for order 9, whose steps are few and long, so that two passes show less. With 0.7, 5 more of 817 runs of the battery exceed the tolerance
constexpr double kPromisedStuck = 0.2;     // the same where surfaces have come to rest: both passes may have locked in the same force, which differs from that of finer ones. With 0.7 and 0.5 a toggle clamp with rubbing pins is wrong by up to 5 tolerances
constexpr double kAlike = 1.25;            // ratio of the steps of the finer pass to those of the coarser: below it, their agreement shows little
constexpr double kSurest = 0.05;           // lower limit on a stated error, as a fraction of the tolerance of the steps
constexpr double kRepeated = 0.1;          // tolerance of a pass that checks what two have shown, as a fraction of the finer one's; upper limit on it where errors or an open account call for another pass
constexpr double kShorter = 0.5;           // longest step of a pass whose tolerance would not shorten its steps, as a fraction of the previous mean step
constexpr double kNearRounding = 1e-8;     // tolerance below which roundoff may disturb stiff joints and multiply the steps
constexpr double kNarrowed = 3e-10;        // lowest tolerance from which a finer pass is made because the ramps of held jumps lag: with a tenth of it a relay takes 1.3 million steps for half the lag, with double a fifth of the steps for twice the lag
constexpr double kNoGain = 0.5;            // fraction of the error of the previous passes: an error that has not fallen below it at tolerances under kNearRounding may consist of roundoff
constexpr std::uint64_t kCheap = 500;      // after a pass with no more steps than this, finer passes of order 5 cost little; with order 9 they would have as few steps again, and differ by the coarser one's error
constexpr std::uint64_t kLong = 10000;     // after a pass with more steps than this, tolerances near kNearRounding are lowered only tenfold at a time
constexpr double kFinest = 1e-11;          // lowest tolerance tried because errors grow exponentially; one further pass is compared with it
constexpr double kMostScatter = 0.65;      // upper limit, as a fraction of the growth rate, on its scatter for chaos to be claimed: the double pendulum has 0.56; a cam whose roller rattles, and whose finer passes agree to the end, has 0.75
constexpr double kOptimism = 2;            // standard errors subtracted from a growth rate before concluding that no tolerance helps
constexpr double kFalls = 0.1;             // fraction of the error of earlier passes that grew apart: passes with less still converge. With 0, three balls of a cradle, whose error falls from 9 to 0.4 of the peak with a tenth of the tolerance, are taken for chaotic
constexpr double kFarBelow = 1e-18;        // if growing errors would require a tolerance below this, the attainable ones are not tried
constexpr double kSudden = 0.1;            // fraction of the previous error times the ratio of the two tolerances: passes with a smaller error may agree by chance
constexpr double kLeap = 1e-4;             // lower limit on the next tolerance, as a fraction of the last, unless two pairs have shown the same exponential growth
constexpr double kShift = 0.2;             // fraction of the time in which errors grow by the ratio of two tolerances: the tighter passes must part at least this much later. Those of a pendulum that falls from its upper position part 0.04 of it later, as errors grow only while it falls
constexpr double kMostFollowed = 1e5;      // upper limit on the steps of a pass that follows a growing vibration: a few seconds
constexpr int kMostOpen = 2;               // upper limit on the passes repeated because the energy account did not close

}  // namespace pintle::pass_decisions
