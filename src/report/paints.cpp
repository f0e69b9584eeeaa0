#include "report/paints.h"

#include <algorithm>
#include <string_view>

namespace pintle {

const std::vector<PaintStyle>& all_paints() {
  constexpr Shades kNone{"", ""}, kTint{"tint", "tint"}, kBackground{"paper", "paper"};
  static const std::vector<PaintStyle> paints{
      {Paint::kEarth, "ground", {"#e4e4de", "#343a41"}, kInkShades, 1.3, ""},
      {Paint::kHatch, "hatch", kNone, kNoteShades, 1, ""},
      {Paint::kGuide, "guide", {"#e4e4de", "#4a525b"}, kInkShades, 1.2, ""},
      {Paint::kLink, "link", kTint, kInkShades, 1.3, ""},
      {Paint::kGear, "gear", kTint, kInkShades, 1.3, ""},
      {Paint::kPitch, "pitch", kNone, kInkShades, 0.9, "9 3 2 3"},
      {Paint::kHole, "hole", kBackground, kInkShades, 1.1, ""},
      {Paint::kBlock, "block", kTint, kInkShades, 1.4, ""},
      {Paint::kWeld, "weld", kInkShades, kNone, 0, ""},
      {Paint::kPin, "pin", kBackground, kInkShades, 1.4, ""},
      {Paint::kBall, "ball", kInkShades, kNone, 0, ""},
      {Paint::kOil, "oil", {"#f0cf7f", "#8a6a1f"}, kInkShades, 1.1, ""},
      {Paint::kRubber, "rubber", {"#77776f", "#8b9199"}, kInkShades, 1.1, ""},
      {Paint::kMass, "mass", kInkShades, kNone, 0, ""},
      {Paint::kMassLight, "mass_light", kBackground, kInkShades, 1, ""},
      {Paint::kSpring, "spring", kNone, {"#14784f", "#57c795"}, 1.6, ""},
      {Paint::kRod, "rod", kNone, kInkShades, 2.4, ""},
      {Paint::kRope, "rope", kNone, {"#7a5a2e", "#d1a867"}, 1.8, ""},
      {Paint::kBarrel, "barrel", {"#e4e4de", "#343a41"}, kInkShades, 1.3, ""},
      {Paint::kBlade, "blade", kNone, {"#14784f", "#57c795"}, 2.6, ""},
      {Paint::kStop, "stop", kNone, {"#a05a00", "#ffb74d"}, 2.2, ""},
      {Paint::kMotor, "motor", {"#8a3ffc", "#b692ff"}, {"#8a3ffc", "#b692ff"}, 1.8, ""},
  };
  return paints;
}

const PaintStyle& style_of(Paint paint) {
  return *std::find_if(all_paints().begin(), all_paints().end(), [paint](const PaintStyle& style) { return style.paint == paint; });
}

std::string colour_of(const char* entry, int body, bool dark) {
  const std::string_view name = entry;
  if (name == "paper") return kPaperShades[dark];
  if (name == "tint") return kTints[static_cast<std::size_t>(std::max(body, 0)) % kTints.size()][dark];
  return std::string(name);
}

}  // namespace pintle
