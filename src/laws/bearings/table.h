// A measured force: a table of force against displacement, by cubic pieces that rise as the points do (base/tables/monotone_table.h).
//
//   f = -F(e)  for a joint that holds one length;  f = -F(|e|) e/|e|  for a pin        theory/bearings Eq. (4.1)
//   V = integral of F from 0 to e                                                      Eq. (4.2)
//
// At e = 0 a pin's tangent is the table's slope there, in every direction. The table loses no power; the damper in parallel does.
#pragma once

#include <algorithm>
#include <limits>
#include <string_view>

#include "base/tables/monotone_table.h"
#include "laws/law_math.h"
#include "laws/law_numbers.h"
#include "space/planar.h"

namespace pintle {

struct TableLaw {
  static constexpr std::string_view kWord = "table";
  MonotoneTable table;  // [m] -> [N], force not falling
  bool radial = false;  // for a pin: the table begins at (0, 0)
  int along = 0;        // otherwise the component in which it acts

  static TableLaw typical() {
    return {MonotoneTable({0, 1e-6, 1e-5, 1e-4, 1e-3}, {0, 2, 70, 900, 1e3}, MonotoneTable::Symmetry::kOdd), true, 0};
  }

  template <class T>
  void evaluate(const LawInput<T>& in, LawOutput<T>& out) const {
    using namespace law_math;
    if (!radial) {
      out.force[along] = -force_of(in.gap[along]);                                   // (4.1)
      out.energy = energy_of(in.gap[along]);                                         // (4.2)
      return;
    }
    const T r = sqrt(in.gap[0] * in.gap[0] + in.gap[1] * in.gap[1]);
    const T secant = where_positive(r, divide(force_of(r), r), T(table.slope(0)));
    for (int k = 0; k < 2; ++k) out.force[k] = -(secant * in.gap[k]);                // (4.1)
    out.energy = energy_of(r);                                                       // (4.2)
  }
  // An interval without force is the way to a pad, or between two; a pin's is its play, in which it starts seated.
  bool starts_free() const { return !radial && table.zero_interval().first < table.zero_interval().second; }
  // How far a pad is pressed; minus infinity for a table that resists everywhere.
  double penetration(const Planar::Vec& gap) const {
    const auto [from, to] = table.zero_interval();
    return starts_free() ? std::max(from - gap[along], gap[along] - to) : -std::numeric_limits<double>::infinity();
  }
  Planar::Vec misfit(Planar::Vec gap) const {
    const auto [from, to] = table.zero_interval();
    if (starts_free()) gap[along] -= std::clamp(gap[along], from, to);
    return gap;
  }
  Planar::Vec engaged_stiffness() const {
    Planar::Vec k = Planar::Vec::Zero();
    if (radial) k.head<2>().setConstant(steepest());
    else k[along] = steepest();
    return k;
  }

 private:
  template <class T>
  T force_of(const T& e) const {
    return law_math::through(e, [this](double x) { return table.value(x); }, [this](double x) { return table.slope(x); });
  }
  template <class T>
  T energy_of(const T& e) const {
    return law_math::through(e, [this](double x) { return table.integral(x); }, [this](double x) { return table.value(x); });
  }
  // A table may begin flat; the joint is held where the table rises.
  double steepest() const { return table.steepest_secant(); }
};

}  // namespace pintle
