#!/usr/bin/env python3
"""Changes one sign, comparison, condition or constant at a time, and lists what no test notices.

Every room of src/ gets a sample of its lines, drawn from a seed. All changes are built at once into a copy of the tree (build/mutants), where a number in the
environment switches one of them on: tools/mutation/switch.h. Every test is then run once to see which changes it comes by, and each change is tried with the
tests that do, those of its room first, then the quickest, until one fails. Results are kept in build/mutants/results.json after each change, so that a run may
be stopped at any time: it goes on where it was. What is equivalent to the original, and why, stands in tools/equivalent_mutants.txt.

    tools/mutants.py --sample 12                        # about an hour: 20 minutes for the build, ten to measure the tests, the rest for 260 changes
    tools/mutants.py --rooms laws,joints --sample 40
    tools/mutants.py --again                            # only what nobody has noticed so far, with tests that are new
    tools/mutants.py --write docs/mutants.md            # the table of what has been run
"""
import argparse
import collections
import concurrent.futures
import itertools
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from mutation.sites import draw, sources_of

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "build" / "mutants"
TREE, BUILD, RESULTS, DROPPED = WORK / "tree", WORK / "build", WORK / "results.json", WORK / "dropped.json"
EQUIVALENT = ROOT / "tools" / "equivalent_mutants.txt"

SPARE = 1.5  # sites built in for each one asked for: some do not compile
TIMED = "Live.SurvivesEveryMechanismBeingPulledAbout"  # in real time: it fails if the machine is busy
BATCHES = [1, 4, 16, 64, 256]  # total duration [s] of the tests that are started together
LONGER = 4  # a change counts as noticed if it makes a test take more than this many times its usual time
UNREACHED, NOBODY, OWN, ALL = "no test comes by", "nobody", "the room's tests", "all tests"


def say(text):
    print(text, flush=True)


def rooms_of(tree):
    return sorted(p.name for p in (tree / "src").iterdir() if p.is_dir())


def run(command, seconds, **more):
    """The exit code, or None if the time was up: then the command and everything that it has started are ended."""
    more = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, **more}
    process = subprocess.Popen(command, start_new_session=True, **more)
    try:
        return process.wait(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        return None


def copy_tree(tree, changed=lambda name, content: content):
    """Copies the working tree; unchanged files keep their times. `changed` may replace a file's content."""
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.splitlines()
    for name in listed:
        source, target = ROOT / name, tree / name
        if not source.is_file():
            continue
        content = changed(name, source.read_bytes())
        if target.is_file() and target.read_bytes() == content:
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)
        shutil.copymode(source, target)
    kept = set(listed)
    for path in tree.rglob("*"):
        if path.is_file() and str(path.relative_to(tree)) not in kept:
            path.unlink()


def configure(tree, build, *options):
    cached = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    subprocess.run(["cmake", "-G", "Ninja", "-S", str(tree), "-B", str(build), *cached, *options], check=True, stdout=subprocess.DEVNULL)


def load(path, otherwise):
    return json.loads(path.read_text()) if path.exists() else otherwise


def build_in(sites):
    """Copies the working tree with all these changes built in, numbered as in the list, from 1; None is left out."""
    by_file = collections.defaultdict(list)
    for number, site in enumerate(sites, 1):
        if site is None:
            continue
        by_file[site.file].append((site, site.built_in.format(number)))

    def changed(name, content):
        if name not in by_file:
            return content
        lines = content.decode().split("\n")
        for site, line in by_file[name]:
            if lines[site.number - 1] != site.line:
                sys.exit(f"{name} has changed since its changes were drawn: start again")
            lines[site.number - 1] = line
        switch = f'#include "{TREE / "tools" / "mutation" / "switch.h"}"\n#line 1 "{TREE / name}"\n'
        return (switch + "\n".join(lines)).encode()

    copy_tree(TREE, changed)


def build(sites, jobs):
    """Builds the sites that compile, in rounds: those named in the compiler's messages are left out, as None in the list, so that the others keep their numbers."""
    sites = list(sites)
    dropped = {tuple(key) for key in load(DROPPED, [])}
    while True:
        sites = [site if site and site.key not in dropped else None for site in sites]
        build_in(sites)
        configure(TREE, BUILD, "-DPINTLE_UNITY=ON", "-DCMAKE_CXX_FLAGS=-w -Wno-narrowing")  # constants have become variables
        log = WORK / "build.log"
        with log.open("w") as out:
            if run(["ninja", "-C", str(BUILD), "-k0", f"-j{jobs}"], 3 * 3600, stdout=out, stderr=subprocess.STDOUT) == 0:
                return sites
        named = set(re.findall(re.escape(str(TREE)) + r"/([\w./]+):(\d+)", log.read_text()))
        bad = [site for site in sites if site and (site.file, str(site.number)) in named]
        if not bad:
            sys.exit(f"the tests do not compile, and no change is the cause: {log}")
        say(f"{len(bad)} changes do not compile and are left out")
        dropped |= {site.key for site in bad}
        DROPPED.write_text(json.dumps(sorted(dropped)))


class Tests:
    """The tests, with the changes that each of them reaches and the time that it takes."""

    def __init__(self, jobs):
        self.jobs, self.program = jobs, str(BUILD / "pintle_tests")
        self.reached, self.seconds = {}, {}

    def run(self, names, mutant, seconds, reached=None):
        """Returns whether the tests pass."""
        with tempfile.TemporaryDirectory(prefix="pintle-mutants-") as folder:
            flags = Path(folder) / "flags"
            flags.write_text("--gtest_fail_fast\n--gtest_filter=" + ":".join(names) + "\n")
            more = {"PINTLE_MUTANT": str(mutant), "TMPDIR": folder}
            if reached:
                more["PINTLE_MUTANTS_REACHED"] = reached
            return run([self.program, f"--gtest_flagfile={flags}"], seconds, cwd=folder, env={**os.environ, **more}) == 0

    def measure(self):
        """Runs every test once without a change."""
        names, suite = [], ""
        for line in subprocess.run([self.program, "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout.splitlines():
            if line.startswith("  "):
                names.append(suite + line.split("#")[0].strip())
            elif re.match(r"[\w/]+\.", line):
                suite = line.split("#")[0].strip()
        names = [name for name in names if name != TIMED and "DISABLED_" not in name]
        broken, done = [], itertools.count(1)

        def measure_one(name):
            with tempfile.TemporaryDirectory(prefix="pintle-mutants-") as folder:
                path, start = Path(folder) / "reached", time.monotonic()
                if not self.run([name], 0, 600, str(path)):
                    broken.append(name)
                    return
                self.seconds[name] = time.monotonic() - start
                self.reached[name] = {int(word) for word in path.read_text().split()} if path.exists() else set()
            if (n := next(done)) % 200 == 0:
                say(f"{n} of {len(names)} tests measured")

        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            list(pool.map(measure_one, names))
        say(f"{len(self.seconds)} tests pass, in {sum(self.seconds.values()):.0f} s" + (f"; left out, as they fail without a change: {', '.join(broken)}" if broken else ""))

    def noticed(self, names, mutant, stopped):
        """Returns whether one of the tests fails; the quickest are run first, many at a time."""
        left = sorted(names, key=self.seconds.get)
        for most in BATCHES:
            batch = []
            while left and (not batch or sum(map(self.seconds.get, batch)) + self.seconds[left[0]] <= most):
                batch.append(left.pop(0))
            if batch and not stopped.is_set() and not self.run(batch, mutant, 10 + LONGER * sum(map(self.seconds.get, batch))):
                return True
        return False if not left else self.noticed(left, mutant, stopped)

    def verdict(self, mutant, own_suites, most_seconds, stopped):
        """(who notices it, number of tests that reach it, number of tests run)"""
        come_by = sorted((name for name in self.reached if mutant in self.reached[name]), key=self.seconds.get)
        own = [name for name in come_by if name.split(".")[0].split("/")[-1] in own_suites or name.split("/")[0] in own_suites]
        others, taken = [], 0
        for name in come_by:
            taken += self.seconds[name]
            if name not in own and taken <= most_seconds:
                others.append(name)
        if not come_by:
            return UNREACHED, 0, 0
        if self.noticed(own, mutant, stopped):
            return OWN, len(come_by), len(own)
        return (ALL if self.noticed(others, mutant, stopped) else NOBODY), len(come_by), len(own) + len(others)


def suites_of(room):
    """The suites of the tests in the room."""
    return {suite for path in (TREE / "src" / room).rglob("*_test.cpp") for suite in re.findall(r"^TEST(?:_F|_P)?\((\w+),", path.read_text(), re.M)}


def test_rooms(options):
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell makes its background commands ignore it, and tests send it
    WORK.mkdir(parents=True, exist_ok=True)
    rooms = options.rooms or rooms_of(ROOT)
    results = {(r["file"], r["line"], r["changed"]): r for r in load(RESULTS, [])}
    drawn = [site for room in rooms for site in draw(ROOT, room, options.seed, round(SPARE * options.sample), results)]
    drawn = build(drawn, options.jobs)
    numbers, counted = {}, collections.Counter()
    for number, site in enumerate(drawn, 1):
        if site and counted[site.room] < options.sample:
            counted[site.room] += 1
            numbers[site] = number
    tests = Tests(options.jobs)
    say(f"{len(numbers)} changes in {len(counted)} rooms are built in")
    tests.measure()
    unseen = (NOBODY, UNREACHED)
    todo = [site for site in numbers if site.key not in results or (options.again and results[site.key]["noticed_by"] in unseen)]
    todo.sort(key=lambda site: [s for s in numbers if s.room == site.room].index(site))  # one of each room, then the next of each
    lock, stopped = threading.Lock(), threading.Event()

    def try_one(site):
        if stopped.is_set():
            return
        noticed, come_by, tried = tests.verdict(numbers[site], suites_of(site.room), options.most_seconds, stopped)
        with lock:
            if stopped.is_set():
                return
            results[site.key] = {"room": site.room, "file": site.file, "number": site.number, "kind": site.kind, "line": site.line, "changed": site.changed,
                                 "noticed_by": noticed, "tests": come_by, "run": tried}
            RESULTS.write_text(json.dumps(list(results.values()), indent=1))
            say(f"{site.room:12} {noticed:18} {site.file}:{site.number}: {site.changed.strip()}")

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        try:
            list(pool.map(try_one, todo))
        except KeyboardInterrupt:
            stopped.set()


def equivalents():
    """(file, changed line) -> why no test can notice it."""
    known = {}
    if EQUIVALENT.exists():
        for entry in EQUIVALENT.read_text().splitlines():
            if entry and not entry.startswith("#"):
                file, changed, why = (part.strip() for part in entry.split(" @@ ", 2))
                known[file, changed] = why
    return known


def page(results):
    known = equivalents()
    there = {(str(path.relative_to(ROOT)), line) for room in rooms_of(ROOT) for path in sources_of(ROOT, room) for line in path.read_text().splitlines()}
    rooms = collections.defaultdict(collections.Counter)
    survivors = []
    for r in results:
        if (r["file"], r["line"]) not in there:
            continue
        unseen = r["noticed_by"] in (NOBODY, UNREACHED)
        why = known.get((r["file"], r["changed"].strip()))
        rooms[r["room"]]["equivalent" if unseen and why else r["noticed_by"]] += 1
        if unseen:
            survivors.append((r, why))
    out = ["# Tests that notice", "",
           "`make mutants` changes one sign, comparison, condition or constant of the sources at a time, in a sample of lines drawn from a seed, and runs the tests that come by the changed line: those of its room, then all",
           "others, the quickest first, as far as two minutes of them go. A change that nobody notices is either given a test or explained as equivalent. The table is of what has been run so far; one room, or a larger",
           "sample, is `make mutants ROOMS=laws SAMPLE=40`.", "",
           "| room | changed | noticed by its tests | by all tests | equivalent | unnoticed | noticed |", "| --- | ---: | ---: | ---: | ---: | ---: | ---: |"]
    total = collections.Counter()
    for room in sorted(rooms) + ["all"]:
        c = rooms[room] if room != "all" else total
        own, whole, same, nobody = c[OWN], c[ALL], c["equivalent"], c[NOBODY] + c[UNREACHED]
        real = own + whole + nobody
        out.append(f"| {room} | {real + same} | {own} | {whole} | {same} | {nobody} | {100 * (own + whole) // max(1, real)} % |")
        if room != "all":
            total.update(c)
    out += ["", "## Nobody noticed", ""]
    for r, why in sorted(survivors, key=lambda s: (s[0]["file"], s[0]["number"])):
        more = f". Equivalent: {why}" if why else f"; of {r['tests']} tests that come by, {r['run']} were run" if r["tests"] > r["run"] else "" if r["tests"] else "; no test comes by"
        out += [f"- `{r['file']}`: `{r['line'].strip()}` as `{r['changed'].strip()}`{more}"]
    return "\n".join(out) + "\n"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--rooms", type=lambda words: [w for w in words.split(",") if w], default=[], help="rooms of src/, with commas between (default: all)")
    options.add_argument("--sample", type=int, default=12, help="changes of a room that compile")
    options.add_argument("--seed", default="1")
    options.add_argument("--jobs", type=int, default=os.cpu_count())
    options.add_argument("--most-seconds", type=float, default=120, help="of tests that are run to notice a change, beside those of its room")
    options.add_argument("--again", action="store_true", help="try again what nobody has noticed so far")
    options.add_argument("--write", type=Path, help="only write the page of the results")
    options = options.parse_args()
    if options.write is None:
        test_rooms(options)
    text = page(load(RESULTS, []))
    if options.write:
        options.write.write_text(text)
    else:
        say("\n" + text)


if __name__ == "__main__":
    main()
