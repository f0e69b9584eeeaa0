// Models that the tests of this folder read.
#pragma once

namespace pintle {

/// The four-bar of section 8 of the paper, with one example of everything else.
inline constexpr const char* kFullModel = R"toml(format = 1
name = "Four-bar"  # with extras
description = """
Two
lines"""
space = "planar"
gravity = [0, "-1.5 m/s^2"]

[parameters]
half = "crank/2"
crank = "1 m"
count = 3

[simulate]
duration = "0.5 s"
output_step = "2 ms"
tolerance = 1e-6
method = "radau"
start = "unloaded"
max_step = "1 s"

[defaults.joint]
stiffness = "2e8 N/m"
angular_damping = 7

[ground.markers]
O2 = [0, 0]
O4 = { r = "6 m", xi = "0 deg", axis = "90 deg" }
P = { x = "1 m", y = "count * 1 m" }

[body.crank]
mass = "1 kg"
inertia = "1e5 kg*m^2"
position = [0.25, "(sqrt(3)/4) m"]
angle = "60 deg"
velocity = [0, "2 m/s"]
spin = "10 rad/s"
hold = ["y", "angle"]
markers.O2 = { r = "half", xi = "180 deg" }
markers.A = ["half", 0, "45 deg"]

[body.coupler]
mass = 2
inertia = 3
markers.A = [-2, 0]
markers.B = [2, 0]

[body.rocker]
mass = 4
inertia = 5
markers.O4 = [-1.5, 0]
markers.B = [1.5, 0]

[joint.O2]
type = "revolute"
between = ["ground.O2", "crank.O2"]

[joint.A]
type = "revolute"
law = "linear"
between = ["crank.A", "coupler.A"]
stiffness = ["1e6 N/m", "2e6 N/m"]
damping = "3500 N*s/m"

[joint.B]
type = "prismatic"
between = ["coupler.B", "rocker.B"]
angular_stiffness = "5e5 N*m/rad"

[joint.O4]
type = "gear"
between = ["ground.O4", "rocker.O4"]
radii = ["20 mm", "40 mm"]
mesh = "internal"

[joint.R]
type = "rod"
between = ["ground.P", "coupler.A"]
length = "1 m"

[joint.K]
type = "rack"
between = ["crank.A", "rocker.B"]
radius = "30 mm"

[spring.S]
between = ["ground.P", "crank.A"]
stiffness = "10 N/m"
damping = "1 N*s/m"
free_length = "0.5 m"

[torsion_spring.T]
between = ["ground.O2", "crank.O2"]
stiffness = "1 N*m/rad"
preload = "2 N*m"

[force.F]
on = "crank.A"
force = ["10 N*sin(2*t)", 0]
axes = "body"
torque = "3 N*m"

[motor.M]
joint = "O2"
torque = "5 N*m - 0.1*rate + B.slide*2 N"

[motor.V]
joint = "B"
speed = "0.1 m/s"
stiffness = "1e5 N/m"
damping = "1e2 N*s/m"

[motor.W]
joint = "A"
position = "0.2*sin(3*t)"
)toml";

}  // namespace pintle
