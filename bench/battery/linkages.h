// Linkages without loads, and what is added to them: springs and dampers in the joints, loads, motors.
#pragma once

#include <stdexcept>

#include "bench/battery/dice.h"
#include "bench/battery/mechanism_text.h"

namespace pintle::bench {

/// The numbers drawn so far do not allow a linkage; construction restarts with the next numbers.
struct NoSuchLinkage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

MechanismText open_chain(Dice& dice, int most_bars = 4);
MechanismText four_bar(Dice& dice);
MechanismText five_bar(Dice& dice);
MechanismText six_bar(Dice& dice);
MechanismText two_loops(Dice& dice);
MechanismText slider_crank(Dice& dice);
MechanismText inverted_slider_crank(Dice& dice);
/// One of the above; the first joint is the pin A of a crank on the ground.
MechanismText any_linkage(Dice& dice);
/// A four-bar or a slider-crank.
MechanismText one_loop(Dice& dice);

/// A bar of random mass between two points; its centre is near the middle.
BodyText& add_bar(MechanismText& m, Dice& dice, const std::string& name, Point from, Point to);
/// Gives the crank a random initial speed [rad/s].
void spin_crank(MechanismText& m, Dice& dice, double fastest = 12);

/// A joint's spring of 1e6 to 1e10 N/m and damper, either 0 or up to 1e5 N*s/m.
void add_spring_and_damper(Dice& dice, JointText& joint, double softest = 1e6, double stiffest = 1e10);
/// The same for every joint without a law.
void fill_joints(MechanismText& m, Dice& dice, double softest = 1e6, double stiffest = 1e10);
/// Gravity, springs, torques, forces, and a motor on the crank if it has none.
void add_loads(MechanismText& m, Dice& dice);
/// A motor on joint A that holds the crank's speed constant.
void drive_crank(MechanismText& m, Dice& dice);
/// A time long enough for something to happen.
void choose_duration(MechanismText& m, Dice& dice, double shortest = 0.2, double longest = 2);

}  // namespace pintle::bench
