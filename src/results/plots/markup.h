// Text for SVG or HTML.
#pragma once

#include <string>
#include <string_view>

namespace pintle {

/// Escapes the characters of markup; suitable for text and for attributes in double quotes. Control characters become spaces.
std::string escaped_markup(std::string_view text);

}  // namespace pintle
