// The results of the stiffness procedure as text, as JSON and as a picture.
#pragma once

#include <string>

#include "pintle/stiffen.h"
#include "results/plots/svg_plot.h"

namespace pintle {

std::string stiffen_text(const Stiffening& stiffening, const std::string& title, bool colour = false);
std::string stiffen_json(const Stiffening& stiffening, const std::string& model_name, const std::string& model_path);
/// Peaks of the chosen quantities relative to their limits, and the changes, against stiffness.
Plot stiffen_plot(const Stiffening& stiffening, const std::string& title);

}  // namespace pintle
