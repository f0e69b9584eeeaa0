// Style common to all plots: colours, dashes, fonts.
#pragma once

#include <array>
#include <string_view>

#include "base/text/utf8.h"

namespace pintle {

// Colours that colour-blind readers can distinguish: M. Okabe and K. Ito, Color Universal Design (2008).
inline constexpr std::array<const char*, 7> kPlotColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#222222"};
inline constexpr std::array<const char*, 4> kPlotDashes{"", "7 3", "2 2.5", "9 3 2 3"};  ///< used when the colours run out

inline constexpr const char* kPlotFont = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";
inline constexpr double kTitleSize = 16, kTextSize = 12.5, kTickSize = 12;  ///< [px]
inline constexpr double kColumnWidth = 0.5;  ///< smallest distance that the eye resolves on screen and in print [px]

/// Approximate width of a text [px].
inline double text_width(std::string_view text, double size) { return 0.56 * size * static_cast<double>(count_characters(text)); }

}  // namespace pintle
