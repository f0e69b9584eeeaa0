// Linkages without loads, and what goes onto them: springs and dampers in the joints, loads, motors.
#pragma once

#include <stdexcept>

#include "bench/battery/dice.h"
#include "bench/battery/mechanism_text.h"

namespace pintle::bench {

/// The numbers drawn so far leave no place for a linkage: it is begun again with the next ones.
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
/// One of the four-bar and the slider-crank.
MechanismText one_loop(Dice& dice);

/// A bar of a random mass between two points; its centre is about the middle.
BodyText& add_bar(MechanismText& m, Dice& dice, const std::string& name, Point from, Point to);
/// Turns the crank at a random speed [rad/s].
void spin_crank(MechanismText& m, Dice& dice, double fastest = 12);

/// A joint's spring 1e6 to 1e10 N/m and damper, 0 or up to 1e5 N*s/m.
void add_spring_and_damper(Dice& dice, JointText& joint, double softest = 1e6, double stiffest = 1e10);
/// Every joint that has no law yet.
void fill_joints(MechanismText& m, Dice& dice, double softest = 1e6, double stiffest = 1e10);
/// Gravity, springs, torques, forces, and a motor on the crank where there is none.
void add_loads(MechanismText& m, Dice& dice);
/// A motor on joint A that holds the crank's speed.
void drive_crank(MechanismText& m, Dice& dice);
/// A time long enough for something to happen.
void choose_duration(MechanismText& m, Dice& dice, double shortest = 0.2, double longest = 2);

}  // namespace pintle::bench
