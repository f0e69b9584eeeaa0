#include "bench/battery/random_mechanisms.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "bench/battery/kinds.h"
#include "bench/battery/linkages.h"

namespace pintle::bench {
namespace {

template <MechanismText (*linkage)(Dice&)>
MechanismText loaded(Dice& dice) {
  MechanismText m = linkage(dice);
  choose_duration(m, dice);
  fill_joints(m, dice);
  add_loads(m, dice);
  return m;
}

MechanismText chain(Dice& dice) { return open_chain(dice); }

}  // namespace

const std::vector<MechanismKind>& mechanism_kinds() {
  static const std::vector<MechanismKind> kinds{
      {"chain", "open chains of one to four bars", loaded<chain>},
      {"four-bar", "four-bars", loaded<four_bar>},
      {"five-bar", "five-bars", loaded<five_bar>},
      {"six-bar", "six-bars: a dyad on coupler or rocker", loaded<six_bar>},
      {"two-loops", "two four-bars that share a rocker", loaded<two_loops>},
      {"slider-crank", "slider-cranks", loaded<slider_crank>},
      {"inverted", "inverted slider-cranks, with a block or a slot", loaded<inverted_slider_crank>},
      {"redundant", "more cranks or guides than needed", redundant},
      {"pre-stressed", "wrong lengths, taut chains, braces", pre_stressed},
      {"locked", "four-bars driven to their limit", locked},
      {"dead-centres", "driven through positions in line", dead_centres},
      {"toggle", "toggles under load", toggle},
      {"soft-joints", "bushing, maxwell, rubber-bushing, table", soft_joints},
      {"bearings", "rolling and journal bearings, linear guides", bearings},
      {"clearance", "a pin with clearance", clearance, true},
      {"contact", "a bar or block on an edge", contact, true},
      {"friction", "dry friction of each kind", friction, true},
      {"stops", "hard and cushioned stops", stops, true},
      {"flexures", "blades, cross-springs, necks", flexures},
      {"gears", "gears and racks", gears},
      {"backlash", "gears with play", backlash, true},
      {"ropes", "ropes, taut and slack", ropes, true},
      {"rods", "massless rods and actuators", rods},
      {"cams", "grooved cams and contacts", cams, true},
      {"surfaces", "cams, curved edges and teeth that rub", surfaces, true},
      {"belts", "belt drives and drums", belts},
      {"cylinders", "booms on cylinders", cylinders, true},
      {"detents", "knobs with notches", detents, true},
      {"controlled", "motors and forces that read the motion", controlled},
      {"waiting", "at rest until a cord is taut or a force has grown", waiting, true},
      {"relays", "bang-bang controllers", relays, true}};
  return kinds;
}

RandomMechanism random_mechanism(std::uint64_t seed, int number, const std::vector<std::string>& kinds) {
  const std::vector<MechanismKind>& all = mechanism_kinds();
  const auto n = static_cast<std::size_t>(number);
  const std::string word = kinds.empty() ? all[n % all.size()].word : kinds[n % kinds.size()];
  const auto kind = std::find_if(all.begin(), all.end(), [&word](const MechanismKind& k) { return k.word == word; });
  if (kind == all.end()) throw std::invalid_argument("no kind of mechanism is called " + word);
  Dice dice(seed, n);
  const std::string name = fmt::format("{}-{}-{}", word, seed, number);
  for (;;) {
    try {
      return {name, &*kind, kind->make(dice).text(name)};
    } catch (const NoSuchLinkage&) {  // the next numbers are tried
    }
  }
}

}  // namespace pintle::bench
