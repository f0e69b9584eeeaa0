// Section 8: the Lagrangian form in three angles, one joint opened.
#include <fmt/format.h>

#include <stdexcept>

#include "paper/four_bar_runs.h"
#include "paper/items.h"

namespace pintle::paper {

Item make_opened() {
  Item item{"relative", "Section 8: three angles and one opened joint", {}, {}, {}, {}, {}};
  item.text = {"The pins O2, A and O4 are ideal and eliminated by the three angles; only the pin at B is a force law. Its reaction follows from the "
               "law, those of the ideal pins from inverse dynamics."};
  Table table{"Each pin's force over a turn minus that with ideal joints, relative to its peak", {"k [N/m]", "O2", "A", "B", "O4", "angles [rad]"}, {}};
  try {
    double opened = 0, all = 0;
    for (const double k : {1e6, 1e8, 1e10}) {
      Model model = four_bar({k, 3000}, 60);
      model.simulate.equations = Equations::kRelative;
      for (Joint& joint : model.joints) joint.ideal = joint.name != "B";
      const FromIdeal d = from_ideal(run(model, true), 60);
      std::vector<std::string> row{short_number(k)};
      for (const double e : d.by_pin) row.push_back(fmt::format("{:.1e}", e));
      row.push_back(fmt::format("{:.1e}", d.angle));
      table.rows.push_back(row);
      if (k == 1e8) {
        opened = d.force;
        all = from_ideal(run(four_bar({k, 3000}, 60), true), 60).force;
      }
    }
    item.claims = {{"8", "three second-order equations in the link angles, no closure constraints, give the four-bar",
                    fmt::format("forces {:.1e} of the peak from ideal at k = 1e8 (all four pins compliant: {:.1e})", opened, all),
                    verdict(opened < 5e-4)}};
    item.tables = {table};
  } catch (const std::invalid_argument&) {
    item.waiting = {"the form in three angles (`equations = \"relative\"`, joints marked `ideal`)"};
  }
  return item;
}

}  // namespace pintle::paper
