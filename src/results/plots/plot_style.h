// What all plots share: colours, dashes, letters.
#pragma once

#include <array>
#include <string_view>

#include "base/text/utf8.h"

namespace pintle {

// Colours that stay apart for colour-blind readers: M. Okabe and K. Ito, Color Universal Design (2008).
inline constexpr std::array<const char*, 7> kPlotColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#222222"};
inline constexpr std::array<const char*, 4> kPlotDashes{"", "7 3", "2 2.5", "9 3 2 3"};  ///< once the colours are used up

inline constexpr const char* kPlotFont = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";
inline constexpr double kTitleSize = 16, kTextSize = 12.5, kTickSize = 12;  ///< [px]
inline constexpr double kColumnWidth = 0.5;  ///< what the eye can tell apart on screen and in print [px]

/// How wide a text is, about [px].
inline double text_width(std::string_view text, double size) { return 0.56 * size * static_cast<double>(count_characters(text)); }

}  // namespace pintle
