#!/usr/bin/env python3
"""Lists the named constants of the numerics, and measures what becomes of runs when each is halved and doubled.

A copy of the tree (build/constants/tree) reads each constant through a factor from the environment, so that one build serves all of them:
PINTLE_SCALE="integrators/radau/step_control.h:kSafety=0.5". A fixed set of runs is made with the program as it is, and again with each factor. What they cost,
how far joint forces are from those of much smaller tolerances, and how the program ends are kept in build/constants/results.csv after each constant, so that a
measurement that is stopped goes on where it was. What is not scaled, and why, stands in tools/unmeasured_constants.txt, and what is run in RUNS.

    tools/constants.py --list               # the constants, and what is not measured
    tools/constants.py --build              # the copy and its program
    tools/constants.py --seconds 500        # measures for so long: again and again, until it says that all are done
    tools/constants.py --write              # docs/theory/constants.md
    tools/constants.py --meanings           # the same page with the meanings of today's comments and its measurements as they are
"""
import argparse
import collections
import concurrent.futures
import csv
import fnmatch
import hashlib
import json
import math
import os
import re
import shlex
import subprocess
import sys
import time

import constants_page
from mutants import ROOT, configure, copy_tree, say, sources_of

WORK = ROOT / "build" / "constants"
TREE, BUILD, RESULTS = WORK / "tree", WORK / "build", WORK / "results.csv"
PROGRAM = BUILD / "bin" / "pintle"
UNMEASURED = ROOT / "tools" / "unmeasured_constants.txt"
PAGE = ROOT / "docs" / "theory" / "constants.md"
ROOMS = ["laws", "linalg", "system", "kinematics", "integrators", "dynamics", "start", "run", "batch", "studies", "live"]
FACTORS = [0.5, 2.0]
# The effect on runs of a change that cannot matter: an effect that is no larger has no meaning.
NOISE = [("integrators/radau/step_control.h:kSafety", "noise", 1 + sign * size) for size in (1e-9, 1e-8) for sign in (1, -1)]
TRUTH, LEAST = 1e-3, 1e-9  # tolerance of the reference run, relative to that of the others; the smallest that a model may ask for

# The arguments of the runs of `pintle run`. Each takes less than half a second.
RUNS = """
mechanisms/four_bar.toml
mechanisms/four_bar.toml --tolerance 1e-7
mechanisms/four_bar.toml --tolerance-of motion
mechanisms/slider_crank.toml --duration 0.02
mechanisms/slider_crank_clearance.toml
mechanisms/double_pendulum.toml
tests/models/battery/redundant-1-127.toml
mechanisms/door_stops.toml
mechanisms/selector_switch.toml
mechanisms/stick_slip.toml --duration 1.5
mechanisms/strut_on_tyre.toml
mechanisms/cam_follower.toml --duration 0.1
mechanisms/gear_train.toml
mechanisms/rope_pendulum.toml
mechanisms/crane_hoist.toml
mechanisms/crane_bushing.toml
mechanisms/oil_film_rotor.toml
mechanisms/parallel_spring_stage.toml --duration 0.02
tests/models/press_at_dead_centre.toml
tests/models/four_bar_at_its_limit.toml
tests/models/cart_and_pole_wrong_sign.toml
mechanisms/robot_arm.toml --equations relative --duration 0.5
mechanisms/four_bar.toml --equations relative
mechanisms/four_bar.toml --equations relative --set joint.O2.ideal=true --set joint.A.ideal=true --set joint.O4.ideal=true
mechanisms/four_bar.toml --equations ideal
mechanisms/n_four_bar_1.toml --equations ideal --duration 2
mechanisms/four_bar.toml --equations augmented_lagrangian
mechanisms/four_bar.toml --equations relative_augmented_lagrangian
mechanisms/four_bar.toml --method dopri5 --duration 0.02
mechanisms/door_stops.toml --method dopri5 --duration 0.2
mechanisms/four_bar.toml --method ode15s --duration 0.05
mechanisms/four_bar.toml --method generalised_alpha --tolerance 1e-3 --duration 0.1
mechanisms/four_bar.toml --method hht --tolerance 1e-3 --duration 0.1
""".strip().splitlines()
# The constants of a method are measured only on its runs: the first line that matches; all others on all runs.
OF_METHODS = [
    ("integrators/ideal/*", r"--equations (?!relative\b(?!_))|--equations relative_"),
    ("start/ideal_rows.cpp", r"--equations (?!relative\b(?!_))|--equations relative_"),
    ("integrators/general/*", r"--method|_lagrangian"),
    ("integrators/methods.cpp", r"--method"),
    ("integrators/relative/*", r"--equations relative"),
    ("start/relative/*", r"--equations relative"),
    ("integrators/radau/*", r"^(?!.*(--method|--equations (ideal|augmented|relative_)))"),
    ("integrators/absolute/*", r"^(?!.*(--method|--equations (ideal|augmented|relative_)))"),
    ("laws/flexures/*", r"spring"),
    ("run/limits/*", r"dead_centre|limit|wrong_sign|robot|slider_crank.toml --duration"),
]

DECLARATION = re.compile(r"^(?P<indent>\s*)(?P<words>(?:(?:inline|static)\s+)*)constexpr\s+(?P<type>double|int|long|std::size_t|std::uint64_t)\s+(?P<rest>k[A-Z]\w*\s*(?:\[[^\]]*\]|=|\{).*)$")
SCALED = "scaled_constant.h"
SCALED_HEADER = """#pragma once
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <type_traits>

template <class T>
T pintle_scaled(std::string_view name, T value) {
  const char* asked = std::getenv("PINTLE_SCALE");
  if (asked == nullptr) return value;
  const std::string_view text(asked);
  const std::size_t equals = text.find('=');
  if (text.substr(0, equals) != name) return value;
  const double scaled = static_cast<double>(value) * std::atof(asked + equals + 1);
  if constexpr (std::is_integral_v<T>) return static_cast<T>(std::floor(scaled));
  else return scaled;
}
"""

Constant = collections.namedtuple("Constant", "file line name type value comment scope")


def parts_at(text, separator):
    """The parts between separators that are outside brackets."""
    out, depth, start = [], 0, 0
    for i, letter in enumerate(text):
        depth += {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}.get(letter, 0)
        if letter == separator and depth == 0:
            out.append(text[start:i].strip())
            start = i + 1
    return out + [text[start:].strip()]


def shared_out(comment, count):
    """The comment of each of several constants of one line: its part if there are as many parts, otherwise the whole comment."""
    parts = [part.strip() for part in comment.split(";")]
    return parts if len(parts) == count else [comment] * count


def comment_above(lines, number):
    """The comment that ends on the previous line, unless it is the file's first."""
    first = number
    while first > 0 and re.match(r"\s*///?(?!/)", lines[first - 1]):
        first -= 1
    return " ".join(re.sub(r"^\s*///?\s*", "", line) for line in lines[first:number])


def constants_of_text(file, text):
    lines, found = text.splitlines(), []
    for number, line in enumerate(lines):
        m = DECLARATION.match(line)
        if m is None or ";" not in m["rest"]:
            continue
        code, _, after = m["rest"].partition(";")
        beside = re.match(r"\s*//[/<]*\s*(.*)", after)
        declared = parts_at(code, ",")
        above = comment_above(lines, number)
        comments = shared_out(beside[1] if beside else above, len(declared))
        scope = "namespace" if not m["indent"] else "class" if "static" in m["words"] else "function"
        for declarator, comment in zip(declared, comments):
            name, _, value = (part.strip() for part in declarator.partition("="))
            found.append(Constant(file, number + 1, name, m["type"], value, comment, scope))
    return found


def constants_of(tree):
    """All constants in the rooms, in their order."""
    paths = [path for room in ROOMS for path in sources_of(tree, room)]
    return [c for path in paths for c in constants_of_text(str(path.relative_to(tree / "src")), path.read_text())]


def unmeasured():
    entries = [line for line in UNMEASURED.read_text().splitlines() if line and not line.startswith("#")]
    return [tuple(part.strip() for part in entry.split(" | ", 2)) for entry in entries]


def why_not(constant, entries):
    """Why it is not measured, or an empty string."""
    if "[" in constant.name:
        return "a table"
    return next((why for file, name, why in entries if fnmatch.fnmatchcase(constant.file, file) and fnmatch.fnmatchcase(constant.name, name)), "")


def runs_of(constant):
    pattern = next((pattern for file, pattern in OF_METHODS if fnmatch.fnmatchcase(constant.partition(":")[0], file)), "")
    return [text for text in RUNS if re.search(pattern, text)]


def key_of(constant):
    return f"{constant.file}:{constant.name}"


def scaled_line(line, constants, entries):
    """The line with its constants read through the factor."""
    m = DECLARATION.match(line)
    _, _, after = m["rest"].partition(";")
    kinds = {"namespace": "inline const" if "inline" in m["words"] else "const", "class": "inline static const", "function": "static const"}
    out = []
    for c in constants:
        if why_not(c, entries):
            out.append(f"{m['words']}constexpr {c.type} {c.name}{' = ' if c.value else ''}{c.value};")
        else:
            out.append(f'{kinds[c.scope]} {c.type} {c.name} = pintle_scaled<{c.type}>("{key_of(c)}", {c.value});')
    return m["indent"] + " ".join(out) + after


def scaled_text(file, text, entries):
    """A source that reads its constants through the factor; `file` is its path from src/."""
    lines, by_line = text.split("\n"), collections.defaultdict(list)
    for c in constants_of_text(file, text):
        by_line[c.line].append(c)
    changed = [number for number, constants in by_line.items() if any(not why_not(c, entries) for c in constants)]
    if not changed:
        return text
    for number in changed:
        lines[number - 1] = scaled_line(lines[number - 1], by_line[number], entries)
    place = next(i for i, line in enumerate(lines) if line.startswith("#include") or line.startswith("#pragma once"))
    return "\n".join(lines[: place + 1] + [f'#include "{SCALED}"'] + lines[place + 1 :])


def build():
    entries, files = unmeasured(), {str(path.relative_to(ROOT)) for room in ROOMS for path in sources_of(ROOT, room)}

    def changed(name, content):
        return scaled_text(name.removeprefix("src/"), content.decode(), entries).encode() if name in files else content

    header = WORK / "include" / SCALED
    header.parent.mkdir(parents=True, exist_ok=True)
    copy_tree(TREE, changed)
    if not header.is_file() or header.read_text() != SCALED_HEADER:
        header.write_text(SCALED_HEADER)
    configure(TREE, BUILD, "-DPINTLE_TESTS=OFF", f"-DCMAKE_CXX_FLAGS=-I{header.parent}")
    if subprocess.run(["ninja", "-C", str(BUILD), f"-j{os.cpu_count()}", "-k0", "pintle_cli"]).returncode != 0:
        sys.exit("the copy does not compile: a constant that has to be one for the compiler belongs in tools/unmeasured_constants.txt")


Row = collections.namedtuple("Row", "program constant value factor run exit steps refused evaluations passes stated true same notes seconds")


def forces_of(folder):
    """The times of a run's rows, and each joint's forces in them."""
    with open(folder / "series.csv", newline="") as file:
        rows = csv.reader(file)
        columns = {name: i for i, name in enumerate(next(rows))}
        next(rows)
        table = [[float(x) for x in row] for row in rows]
    joints = [name.removesuffix(".fx[world]") for name in columns if re.fullmatch(r"joint\..*\.on_.*\.fx\[world\]", name)]
    return [row[0] for row in table], {joint: [(row[columns[f"{joint}.fx[world]"]], row[columns[f"{joint}.fy[world]"]]) for row in table] for joint in joints}


def true_error(run, truth, until):
    """The largest difference of a joint's force in rows that both have, relative to the joint's peak, or to 1e-4 of the largest peak if that is more."""
    row_of = {t: i for i, t in enumerate(truth[0])}
    common = [(i, row_of[t]) for i, t in enumerate(run[0]) if t <= until and t in row_of]
    peak = {name: max((math.hypot(*truth[1][name][k]) for _, k in common), default=0) for name in run[1]}
    least, worst = 1e-4 * max(peak.values(), default=0), 0
    for name, force in run[1].items():
        off = max((math.dist(force[i], truth[1][name][k]) for i, k in common), default=0)
        worst = max(worst, off / max(peak[name], least, 1e-300))
    return worst


def folder_of(kind, text):
    return WORK / "runs" / kind / re.sub(r"[^\w.]+", "-", text)


def run_once(arguments, folder, seconds, scale=""):
    """The exit code (-1: the time was up), and the seconds that it took."""
    start = time.time()
    try:
        code = subprocess.run([PROGRAM, "run", *arguments, "--out", folder, "--force", "--quiet", "--progress", "none"], cwd=TREE, env={**os.environ, "PINTLE_SCALE": scale},
                              timeout=seconds, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
    except subprocess.TimeoutExpired:
        code = -1
    return code, time.time() - start


def with_tolerance(arguments, tolerance):
    place = arguments.index("--tolerance") if "--tolerance" in arguments else len(arguments)
    return [*arguments[:place], *arguments[place + 2 :], "--tolerance", f"{tolerance:g}"]


class MeasuredRun:
    """One of RUNS with the constants as they are, and its reference."""

    def __init__(self, text, program):
        self.text, self.program, self.arguments = text, program, shlex.split(text)
        usual, truth = folder_of(f"usual-{program}", text), folder_of("truth", text)
        if not (usual / "summary.json").exists():
            run_once(self.arguments, usual, 60)
        self.tolerance = json.loads((usual / "summary.json").read_text())["tolerance"]
        if not (truth / "series.csv").exists():
            finer = LEAST if "--equations ideal" in text else max(LEAST, TRUTH * self.tolerance)  # with ideal joints 1e-8 is the loosest
            code, took = run_once(with_tolerance(self.arguments, finer), truth, 60)
            say(f"truth in {took:.1f} s, exit code {code}: {text}")
        self.truth, self.content, self.changed = forces_of(truth), (usual / "series.csv").read_bytes(), folder_of("changed", text)
        self.notes = notes_of(usual)
        self.usual_error = true_error(forces_of(usual), self.truth, horizon_of(usual)) / self.tolerance

    def row(self, constant, value, factor):
        for name in ("series.csv", "summary.json"):
            (self.changed / name).unlink(missing_ok=True)
        code, took = run_once(self.arguments, self.changed, 20, f"{constant}={factor:.17g}" if constant else "")
        if not (self.changed / "summary.json").exists():
            return Row(self.program, constant, value, factor, self.text, code, 0, 0, 0, 0, 0, 0, 0, 0, round(took, 3))
        summary = json.loads((self.changed / "summary.json").read_text())
        counters, same = summary["counters"], (self.changed / "series.csv").read_bytes() == self.content
        error = self.usual_error if same else true_error(forces_of(self.changed), self.truth, horizon_of(self.changed)) / self.tolerance
        stated = max(j["relative_error_estimate"] for j in summary["joints"]) / self.tolerance
        return Row(self.program, constant, value, factor, self.text, code, counters["steps"], counters["rejected"], counters["evaluations"], counters["passes"], float(f"{stated:.4g}"),
                   float(f"{error:.4g}"), int(same), int(notes_of(self.changed) == self.notes), round(took, 3))


def notes_of(folder):
    """The messages and notes of the run. Numbers in them have few digits."""
    summary = json.loads((folder / "summary.json").read_text())
    return [summary["message"], *summary["notes"]]


def horizon_of(folder):
    """The time up to which the run promises its forces."""
    summary = json.loads((folder / "summary.json").read_text())
    return min((j["horizon"] for j in summary["joints"]), default=math.inf) if summary["outcome"] == "horizon" else math.inf


def load_rows():
    if not RESULTS.exists():
        return []
    with RESULTS.open(newline="") as file:
        return [Row(r["program"], r["constant"], r["value"], float(r["factor"]), r["run"], int(r["exit"]), int(r["steps"]), int(r["refused"]), int(r["evaluations"]), int(r["passes"]),
                    float(r["stated"]), float(r["true"]), int(r["same"]), int(r["notes"]), float(r["seconds"])) for r in csv.DictReader(file)]


def built():
    """Key and value of each constant that the copy reads through the factor."""
    found = [m for room in ROOMS for path in sources_of(TREE, room) for m in re.finditer(r'pintle_scaled<[\w:]+>\("([^"]+)", (.*?)\);', path.read_text())]
    return [(m[1], m[2]) for m in found]


def measure(seconds, jobs):
    """Returns whether all constants are done."""
    end, program = time.time() + seconds, hashlib.sha256(PROGRAM.read_bytes()).hexdigest()[:8]
    runs = {text: MeasuredRun(text, program) for text in RUNS}
    rows = load_rows()
    done = {(r.constant, r.value, r.factor) for r in rows if r.constant or r.program == program}
    wanted = [("", "", 1.0)] + NOISE + [(key, value, factor) for key, value in built() for factor in FACTORS]
    missing = [case for case in wanted if case not in done]
    for count, case in enumerate(missing):
        if time.time() > end:
            say(f"{len(missing) - count} of {len(wanted)} cases are left")
            return False
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            rows = list(pool.map(lambda text, case=case: runs[text].row(*case), runs_of(case[0])))
        new = not RESULTS.exists()
        with RESULTS.open("a", newline="") as file:
            writer = csv.writer(file)
            if new:
                writer.writerow(Row._fields)
            writer.writerows(rows)
    say(f"all {len(wanted)} cases are done")
    return True


def list_all():
    entries = unmeasured()
    for c in constants_of(ROOT):
        why = why_not(c, entries)
        say(f"src/{c.file}:{c.line}: {c.name} = {c.value}" + (f"  (not measured: {why})" if why else f"  // {c.comment}"))


def check():
    """Prints the faults of the constants and of the list of those that are not measured; returns whether there are none."""
    entries, all_of_them = unmeasured(), constants_of(ROOT)
    wrong = [f"src/{c.file}:{c.line}: {c.name} does not say what it decides" for c in all_of_them if not why_not(c, entries) and not c.comment]
    for file, name, _ in entries:
        if not any(fnmatch.fnmatchcase(c.file, file) and fnmatch.fnmatchcase(c.name, name) for c in all_of_them):
            wrong.append(f"{UNMEASURED.relative_to(ROOT)}: no constant is {file} {name}")
    for line in wrong:
        say(line)
    return not wrong


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--list", action="store_true", help="the constants, and what is not measured")
    options.add_argument("--check", action="store_true", help="exits with 1 if a constant does not say what it decides")
    options.add_argument("--build", action="store_true", help="the copy and its program")
    options.add_argument("--seconds", type=float, help="measure for so long")
    options.add_argument("--jobs", type=int, default=1, help="runs at a time")
    options.add_argument("--meanings", action="store_true", help="update the meanings in docs/theory/constants.md from the comments")
    options.add_argument("--write", action="store_true", help="write docs/theory/constants.md")
    options = options.parse_args()
    if options.list:
        list_all()
    if options.check and not check():
        sys.exit(1)
    if options.build:
        build()
    if options.seconds is not None and not measure(options.seconds, options.jobs):
        sys.exit(2)
    if options.meanings:
        entries = unmeasured()
        PAGE.write_text(constants_page.with_meanings(PAGE.read_text(), [c for c in constants_of(ROOT) if not why_not(c, entries)]))
    if options.write:
        entries, everything = unmeasured(), constants_of(ROOT)
        measured = [c for c in everything if not why_not(c, entries)]
        skipped = [(c, why_not(c, entries)) for c in everything if why_not(c, entries)]
        PAGE.write_text(constants_page.page(measured, skipped, load_rows(), RUNS, NOISE))


if __name__ == "__main__":
    main()
