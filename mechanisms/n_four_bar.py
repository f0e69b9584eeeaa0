#!/usr/bin/env python3
"""Prints the N-four-bar model: n_four_bar.py 40 > n_four_bar_40.toml

N + 1 upright cranks with ground pins A0..AN at (i, 0) and upper pins B0..BN at (i, 1), joined by N level couplers. All
bars are uniform and slender, 1 m and 1 kg. Where two couplers meet a crank, each has a pin of its own on the same axis.
"""

import argparse

HEADER = """\
# {title}: {cranks} upright cranks joined by {n} level coupler{s}. Made by n_four_bar.py {n}.
#
# Look at: the top of crank0 keeps to its circle and all cranks stay parallel, although every pass through the
# horizontal (all bars in line) is singular: there the ideal equations lose rank, with 1 degree of freedom becoming
# {cranks}. The crank's angle follows J*theta'' = -9.81*S*cos(theta) with J = (N + 1)/3 + N and S = (N + 1)/2 + N; the
# energy about y = 0 stays at J/2 + 9.81*S = {energy:.6f} J.
#
# Numbers: problem A02 of the IFToMM library of computational benchmark problems (M. Gonzalez et al., Multibody System
# Dynamics 16, 2006, 179-190), for N = {n}. Positions and velocities are exact. The library's joints are ideal; these
# have the stiffness and damping of rolling-element bearings.
format = 1
name = "N-four-bar, N = {n}"
gravity = [0, "-9.81 m/s^2"]

[parameters]
length = "1 m"
half = "length/2"
mass = "1 kg"
inertia = "mass*length^2/12"
spin = "-1 rad/s"

[simulate]
duration = "10 s"
output_step = "0.05 s"
tolerance = 1e-3                      # each pass through the horizontal multiplies the difference of two runs

[defaults.joint]
stiffness = "1e8 N/m"
damping = "3000 N*s/m"
"""

BAR = 'mass = "mass", inertia = "inertia"'


def ground(n):
    yield "\n[ground.markers]"
    for i in range(n + 1):
        yield f"A{i} = [{i}, 0]"


def bodies(n):
    yield "\n[body]"
    for i in range(n + 1):
        yield (f'crank{i} = {{ {BAR}, position = [{i}, 0.5], angle = "90 deg", '
               'velocity = [0.5, 0], spin = "spin", markers = { A = ["-half", 0], B = ["half", 0] } }')
    for i in range(n):
        yield (f"coupler{i} = {{ {BAR}, position = [{i}.5, 1], angle = 0, velocity = [1, 0], spin = 0, "
               'markers = { left = ["-half", 0], right = ["half", 0] } }')


def joints(n):
    yield "\n[joint]"
    for i in range(n + 1):
        yield f'A{i} = {{ type = "revolute", between = ["ground.A{i}", "crank{i}.A"] }}'
    for i in range(n):
        yield f'B{i}right = {{ type = "revolute", between = ["crank{i}.B", "coupler{i}.left"] }}'
        yield f'B{i + 1}left = {{ type = "revolute", between = ["crank{i + 1}.B", "coupler{i}.right"] }}'


def energy(n):
    return 0.5 * ((n + 1) / 3 + n) + 9.81 * ((n + 1) / 2 + n)


def model(n):
    title = "One four-bar loop" if n == 1 else f"{n} four-bar loops side by side"
    header = HEADER.format(n=n, title=title, s="" if n == 1 else "s", cranks=n + 1, energy=energy(n))
    return header + "\n".join([*ground(n), *bodies(n), *joints(n)]) + "\n"


def main():
    parser = argparse.ArgumentParser(description="Print the N-four-bar model.")
    parser.add_argument("n", type=int, help="number of loops, 1 or more")
    n = parser.parse_args().n
    if n < 1:
        parser.error("at least one loop is needed")
    print(model(n), end="")


if __name__ == "__main__":
    main()
