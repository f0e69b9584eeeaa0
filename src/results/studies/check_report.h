// The report of a check, for people and for programs.
#pragma once

#include <string>

#include "pintle/check.h"

namespace pintle {

/// Tables for the console; `colour` adds terminal escapes. `details`: every mode, gap component and comparison.
std::string check_text(const CheckReport& report, const std::string& title, bool details = false, bool colour = false);

/// Everything as JSON, one object.
std::string check_json(const CheckReport& report, const std::string& model_name, const std::string& model_path);

}  // namespace pintle
