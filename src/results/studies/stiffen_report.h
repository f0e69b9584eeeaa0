// What the stiffness procedure found, for people, for programs and as a picture.
#pragma once

#include <string>

#include "pintle/stiffen.h"
#include "results/plots/svg_plot.h"

namespace pintle {

std::string stiffen_text(const Stiffening& stiffening, const std::string& title, bool colour = false);
std::string stiffen_json(const Stiffening& stiffening, const std::string& model_name, const std::string& model_path);
/// Peaks of the chosen quantities over their limits, and the changes, against the stiffness.
Plot stiffen_plot(const Stiffening& stiffening, const std::string& title);

}  // namespace pintle
