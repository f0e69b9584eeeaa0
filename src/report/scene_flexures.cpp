// How flexures are drawn: blades between their clamps, necks between two cut-outs.
#include <utility>

#include "laws/catalog.h"
#include "report/outline.h"
#include "report/scene_maker.h"

namespace pintle {

bool SceneMaker::add_flexure(const Joint& joint, const Anchor& first, const Anchor& second) {
  const LawInfo* law = find_law(joint.law.word);
  if (law == nullptr) return false;
  LawSetting at;
  at.values = &joint.law.values;
  at.keys = law->keys;
  if (law->word == "leaf-spring") {
    add_blade(joint.name, first, second, at.number("length"));
  } else if (law->word == "cross-spring") {
    const double length = at.number("length"), half = 0.5 * at.number("crossing_angle"), crossing = at.number("crossing");
    const auto end = [](const Anchor& marker, double angle, double along) { return Anchor{marker.body, marker.point + along * direction(marker.axis + angle), marker.axis + angle}; };
    for (const double angle : {half, -half}) add_blade(joint.name, end(first, angle, -crossing * length), end(second, angle, (1 - crossing) * length), length);
    for (const auto& [marker, along] : {std::pair(first, -crossing * length), std::pair(second, (1 - crossing) * length)})  // the parts that carry the clamps
      if (marker.body != kWorld) put(kBars, {Form::kBar, Paint::kLink, marker.body, {{end(marker, half, along).point, end(marker, -half, along).point}}, 0.8 * scene_.unit});
  } else if (law->word == "notch-hinge") {
    add_neck(second.body == kWorld ? first : second);
  } else {
    return false;
  }
  return true;
}

// A blade clamped at both ends: small squares on bodies, a wall on the ground.
void SceneMaker::add_blade(const std::string& name, const Anchor& first, const Anchor& second, double length) {
  scene_.connectors.push_back({name, Paint::kBlade, first, second, 0, length});
  for (const auto& [end, out] : {std::pair(first, 1.0), std::pair(second, -1.0)}) {
    if (end.body == kWorld) add_wall(end.point, out * direction(end.axis));
    else add_weld(end);
    show(end.body, end.point, 0);
  }
}

void SceneMaker::add_neck(const Anchor& at) {
  const double u = scene_.unit;
  const Vec2 across = normal(direction(at.axis));
  put(kPins, {Form::kCircle, Paint::kHole, at.body, {{at.point + 0.85 * u * across}, {at.point - 0.85 * u * across}}, 0.65 * u});
}

}  // namespace pintle
