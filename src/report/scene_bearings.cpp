// How the bearing of a pin is drawn: balls, oil, rubber, or the clearance between pin and bush.
#include <cmath>
#include <string_view>

#include "base/constants.h"
#include "report/outline.h"
#include "report/scene_maker.h"

namespace pintle {
namespace {

enum class Ring { kPlain, kBalls, kOil, kRubber, kGap };

Ring ring_of(std::string_view law) {
  if (law == "rolling-bearing") return Ring::kBalls;
  if (law == "journal-bearing") return Ring::kOil;
  if (law == "clearance") return Ring::kGap;
  return law == "rubber-bushing" || law == "bushing" || law == "maxwell" ? Ring::kRubber : Ring::kPlain;
}

}  // namespace

/// The ring around the pin of a revolute joint whose law is more than a spring and a damper.
void SceneMaker::add_bearing_ring(const Joint& joint, const Anchor& bush) {
  constexpr double kOuter = 0.95, kCentres = 0.73, kBall = 0.15;  // [units]; the pin has 0.5
  constexpr int kBalls = 10;
  const double u = scene_.unit;
  const Ring ring = ring_of(joint.law.word);
  if (ring == Ring::kPlain) return;
  const Paint paint = ring == Ring::kOil ? Paint::kOil : ring == Ring::kRubber ? Paint::kRubber : Paint::kPin;
  put(kPins, {Form::kCircle, paint, bush.body, {{bush.point}}, kOuter * u});
  if (ring != Ring::kBalls) return;
  Shape balls{Form::kCircle, Paint::kBall, bush.body, {}, kBall * u};
  for (int i = 0; i < kBalls; ++i) balls.paths.push_back({bush.point + kCentres * u * direction(2 * kPi * i / kBalls)});
  put(kPins, std::move(balls));
}

}  // namespace pintle
