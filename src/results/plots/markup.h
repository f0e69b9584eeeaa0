// Text that stands in SVG or HTML.
#pragma once

#include <string>
#include <string_view>

namespace pintle {

/// With the characters of markup spelled out; fit for text and for attributes in double quotes. Control characters become blanks.
std::string escaped_markup(std::string_view text);

}  // namespace pintle
