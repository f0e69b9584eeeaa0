// Complete mechanisms, with loads, joints and a duration: one function per kind.
#pragma once

#include "bench/battery/dice.h"
#include "bench/battery/mechanism_text.h"

namespace pintle::bench {

MechanismText redundant(Dice& dice);
MechanismText pre_stressed(Dice& dice);
MechanismText locked(Dice& dice);
MechanismText dead_centres(Dice& dice);
MechanismText toggle(Dice& dice);

MechanismText soft_joints(Dice& dice);   // bushing, maxwell, rubber-bushing, table
MechanismText bearings(Dice& dice);      // rolling-bearing, journal-bearing, linear-guide
MechanismText clearance(Dice& dice);
MechanismText contact(Dice& dice);
MechanismText friction(Dice& dice);
MechanismText stops(Dice& dice);
MechanismText flexures(Dice& dice);

MechanismText gears(Dice& dice);
MechanismText backlash(Dice& dice);
MechanismText ropes(Dice& dice);
MechanismText rods(Dice& dice);          // massless, of fixed or driven length
MechanismText cams(Dice& dice);
MechanismText surfaces(Dice& dice);      // cams, curved edges and teeth with friction

MechanismText belts(Dice& dice);
MechanismText cylinders(Dice& dice);
MechanismText detents(Dice& dice);
MechanismText controlled(Dice& dice);    // motors and forces that depend on the motion

MechanismText waiting(Dice& dice);       // at rest until something happens
MechanismText relays(Dice& dice);        // bang-bang controllers

}  // namespace pintle::bench
