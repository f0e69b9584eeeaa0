// The items of the page, each by its name.
#pragma once

#include <vector>

#include "paper/page.h"

namespace pintle::paper {

Item make_figure_6();
Item make_figure_7();
Item make_dashpot();
Item make_solvers();
Item make_figure_9();
Item make_bearings();
Item make_procedure();
Item make_start();
Item make_opened();
Item make_slider();
Item make_sweep();
Item make_slips();

struct ItemEntry {
  const char* name;
  const char* about;
  Item (*make)();
};
/// In the paper's order.
const std::vector<ItemEntry>& all_items();

}  // namespace pintle::paper
