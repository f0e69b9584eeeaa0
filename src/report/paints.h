// Colours and lines of a drawing, for light and dark backgrounds. The page of a report gets the same table.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "report/scene.h"

namespace pintle {

/// [0] on a light background, [1] on a dark one.
using Shades = std::array<const char*, 2>;

struct PaintStyle {
  Paint paint;
  const char* name;   ///< in the page's data
  Shades fill;        ///< "": not filled; "tint": the body's own colour; "paper": the background's
  Shades line;        ///< "": no line
  double line_width;  ///< [px]
  const char* dash;   ///< of the line [px]; "" for a solid line
};

const PaintStyle& style_of(Paint paint);
const std::vector<PaintStyle>& all_paints();

inline constexpr std::array<Shades, 8> kTints{{{"#c7dcf2", "#34557a"},
                                               {"#f8d8b6", "#7d5630"},
                                               {"#cbe7cd", "#356a49"},
                                               {"#e4d0ed", "#684777"},
                                               {"#f5e5a3", "#746730"},
                                               {"#c3e8e5", "#2c6a65"},
                                               {"#f5cdd3", "#7d404b"},
                                               {"#dadbd5", "#555955"}}};
inline constexpr Shades kPaperShades{"#ffffff", "#14181d"};
inline constexpr Shades kInkShades{"#1f2933", "#dce3ea"};
inline constexpr Shades kForceShades{"#c8102e", "#ff6b6b"};
inline constexpr Shades kLoadShades{"#b35900", "#ffab4a"};  ///< applied forces
inline constexpr Shades kTraceShades{"#2563a8", "#7db4f0"};
inline constexpr Shades kNoteShades{"#5b6570", "#9aa5b1"};

/// The colour for a paint's entry: "tint" is that of `body`.
std::string colour_of(const char* entry, int body, bool dark);

}  // namespace pintle
