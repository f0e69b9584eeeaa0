#!/usr/bin/env python3
"""Changes one sign, comparison, condition or constant at a time, and lists what no test notices.

Every room of src/ gets a sample of its lines, drawn from a seed, without those of headers that most of the library would be compiled again for. A mutant is
built in a copy of the tree (build/mutants) and has to survive the suites of its room first, then all. The rooms take turns and results are kept in
build/mutants/results.json after each mutant, so that a run may be stopped at any time: it goes on where it was. What is equivalent to the original, and why,
stands in tools/equivalent_mutants.txt.

    tools/mutants.py --rooms laws,joints --sample 6     # a few minutes a mutant; all rooms take a night
    tools/mutants.py --write docs/mutants.md            # the table of what has been run
"""
import argparse
import collections
import concurrent.futures
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "build" / "mutants"
TREE, BUILD, RESULTS = WORK / "tree", WORK / "build", WORK / "results.json"
EQUIVALENT = ROOT / "tools" / "equivalent_mutants.txt"

MOST_COMPILED = 12
TIMED_SUITE = "Live"  # real time: it fails where the machine is busy
ROOM_ONLY = "not by the room's tests"

NUMBER = r"(?<![\w.])(?:\d+\.?\d*(?:e[+-]?\d+)?|\.\d+)(?![\w.])"
# What is looked for, and what each of its finds is replaced by.
CHANGES = [
    ("sign", r" \+ ", lambda m: " - "),
    ("sign", r" - ", lambda m: " + "),
    ("sign", r" \+= ", lambda m: " -= "),
    ("sign", r" -= ", lambda m: " += "),
    ("comparison", r" (<=?|>=?) (?!\w+>)", lambda m: " " + {"<": ">=", "<=": ">", ">": "<=", ">=": "<"}[m.group(1)] + " "),
    ("comparison", r" (==|!=) ", lambda m: " " + {"==": "!=", "!=": "=="}[m.group(1)] + " "),
    ("condition", r" (&&|\|\|) ", lambda m: " " + {"&&": "||", "||": "&&"}[m.group(1)] + " "),
    ("condition", r"\bif \((?!constexpr)", lambda m: "if (!("),
    ("constant", NUMBER, lambda m: "1" if float(m.group(0)) == 0 else f"(2 * {m.group(0)})"),
]
# Declarations, where a number is a size or a comparison a template's bracket; loops, which then hang or read beyond an end, as everybody notices.
NO_SITE = re.compile(r"^\s*(for \(|//|/\*|\*|#|template|using|namespace|case |static_assert|struct|class|enum|friend|\"|EXPECT|ASSERT)|operator|\[\]|std::array<|Matrix<|Lanes<|\.reserve\(|\.resize\(")


def say(text):
    print(text, flush=True)


def rooms_of(tree):
    return sorted(p.name for p in (tree / "src").iterdir() if p.is_dir())


def sources_of(tree, room):
    files = [p for p in (tree / "src" / room).rglob("*") if p.suffix in (".h", ".cpp") and not re.search(r"_test\.cpp$|_for_tests\.", p.name)]
    return sorted(files)


def without_words(line):
    """The line with its strings and its comment blanked out, of the same length."""
    line = re.sub(r'"(\\.|[^"\\])*"', lambda m: '"' + "_" * (len(m.group(0)) - 2) + '"', line)
    return re.sub(r"//.*$", lambda m: " " * len(m.group(0)), line)


def closing(text, start):
    depth = 0
    for i in range(start, len(text)):
        depth += {"(": 1, ")": -1}.get(text[i], 0)
        if depth == 0:
            return i
    return -1


def sites_of(tree, room):
    """(file, line number, kind, line, changed line) of everything that may be changed in a room."""
    sites = []
    for path in sources_of(tree, room):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            bare = without_words(line)
            if NO_SITE.search(bare):
                continue
            for kind, pattern, change in CHANGES:
                for m in re.finditer(pattern, bare):
                    new = change(m)
                    changed = line[: m.start()] + new + line[m.end() :]
                    if new == "if (!(":
                        end = closing(bare, m.end() - 1)
                        if end < 0 or " = " in bare[m.end() : end]:
                            continue
                        changed = line[: m.start()] + "if (!(" + line[m.end() : end] + "))" + line[end + 1 :]
                    sites.append((str(path.relative_to(tree)), number, kind, line, changed))
    return sites


def run(command, seconds, **more):
    """The exit code, and None where the time was up: then the command is ended with all that it has started."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True, **more)
    try:
        return process.wait(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        return None


def copy_tree(tree, changed=lambda name, content: content):
    """What the working tree has, so that files that have not changed keep their times; `changed` may put something else in a file's place."""
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


class Suites:
    """Builds the program with all tests, and runs the suites of one room or all."""

    def __init__(self, jobs, room_tests_only):
        self.jobs, self.room_tests_only = jobs, room_tests_only
        self.program, self.suites = str(BUILD / "pintle_tests"), []

    def build(self):
        return run(["ninja", "-C", str(BUILD), f"-j{self.jobs}", "pintle_tests", "bin/pintle"], 7200) == 0

    def is_quick_to_build(self, file):
        """Whether no more than MOST_COMPILED sources are compiled again when the file has changed."""
        before = (TREE / file).stat()
        os.utime(TREE / file)
        planned = subprocess.run(["ninja", "-C", str(BUILD), "-n", "pintle_tests", "bin/pintle"], capture_output=True, text=True, check=True).stdout
        os.utime(TREE / file, ns=(before.st_atime_ns, before.st_mtime_ns))
        return planned.count("Building CXX object") <= MOST_COMPILED

    def run_room(self, room):
        """Whether the suites pass whose tests stand in the room; None where it has none."""
        tests = (TREE / "src" / room).rglob("*_test.cpp")
        suites = sorted({suite for path in tests for suite in re.findall(r"^TEST(?:_F|_P)?\((\w+),", path.read_text(), re.M)})
        if not suites:
            return None
        command = [self.program, "--gtest_fail_fast", "--gtest_filter=" + ":".join(f"{s}.*:*/{s}.*" for s in suites)]
        return run(command, 1800, cwd=TREE) == 0

    def measure(self):
        """Runs every suite before anything is changed, and sorts them by the time that they take."""
        listed = subprocess.run([self.program, "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout
        suites = sorted(set(re.findall(r"^([\w/]+)\.", listed, re.M)) - {TIMED_SUITE})
        taken = {}

        def time_suite(suite):
            start = time.monotonic()
            if not self.passes(suite):
                sys.exit(f"{suite} fails before anything is changed: {self.program} --gtest_filter={suite}.*")
            taken[suite] = time.monotonic() - start

        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            list(pool.map(time_suite, suites))
        self.suites = sorted(suites, key=taken.get)
        say(f"{len(suites)} suites pass, in {sum(taken.values()):.0f} s")

    def passes(self, suite):
        return run([self.program, "--gtest_brief=1", "--gtest_fail_fast", f"--gtest_filter={suite}.*"], 600, cwd=BUILD) == 0

    def run_all(self):
        """Whether all suites pass; the quickest ones first, none after one that fails."""
        failed = threading.Event()

        def run_unless_failed(suite):
            if not failed.is_set() and not self.passes(suite):
                failed.set()

        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            list(pool.map(run_unless_failed, self.suites))
        return not failed.is_set()

    def verdict(self, room):
        if not self.build():
            return "does not compile"
        if self.run_room(room) is False:
            return "the room's tests"
        if self.room_tests_only:
            return ROOM_ONLY
        return "nobody" if self.run_all() else "all tests"


def load_results():
    return json.loads(RESULTS.read_text()) if RESULTS.exists() else []


def take_turns(rooms, options, suites, done):
    """(room, site) in the order in which they are tried: one of each room, then the next of each. What is done already is counted and left out."""
    left = {}
    for room in rooms:
        left[room] = sites_of(TREE, room)
        random.Random(f"{options.seed} {room}").shuffle(left[room])
    quick, counted = {}, collections.Counter()
    while any(left.values()):
        for room in rooms:
            while left[room]:
                site = left[room].pop(0)
                known = done.get((site[0], site[3], site[4]))
                if known is None and site[0] not in quick:
                    quick[site[0]] = suites.is_quick_to_build(site[0])
                if known is None and not quick[site[0]]:
                    continue
                if known is None:
                    yield room, site
                    known = done[site[0], site[3], site[4]]
                if known != "does not compile":
                    counted[room] += 1
                    break
            if counted[room] >= options.sample:
                left[room] = []


def test_rooms(options):
    WORK.mkdir(parents=True, exist_ok=True)
    copy_tree(TREE)
    configure(TREE, BUILD, "-DPINTLE_UNITY=ON")
    suites, results = Suites(options.jobs, options.room_tests_only), load_results()
    if not options.room_tests_only:  # what only the room's tests have seen goes on to all tests
        results = [r for r in results if r["noticed_by"] != ROOM_ONLY]
    done = {(r["file"], r["line"], r["changed"]): r["noticed_by"] for r in results}
    if not suites.build():
        sys.exit(f"the tests do not compile before anything is changed: ninja -C {BUILD} pintle_tests bin/pintle")
    suites.measure()
    for room, (file, number, kind, line, changed) in take_turns(options.rooms or rooms_of(TREE), options, suites, done):
        path = TREE / file
        original = path.read_text()
        lines = original.split("\n")
        lines[number - 1] = changed
        path.write_text("\n".join(lines))
        try:
            noticed = suites.verdict(room)
        finally:
            path.write_text(original)
        done[file, line, changed] = noticed
        results.append({"room": room, "file": file, "number": number, "kind": kind, "line": line, "changed": changed, "noticed_by": noticed})
        RESULTS.write_text(json.dumps(results, indent=1))
        say(f"{room:12} {noticed:24} {file}:{number}: {changed.strip()}")


def equivalents():
    """(file, changed line) -> why no test can notice it."""
    known = {}
    if EQUIVALENT.exists():
        for entry in EQUIVALENT.read_text().splitlines():
            if entry and not entry.startswith("#"):
                file, changed, why = (part.strip() for part in entry.split(" | ", 2))
                known[file, changed] = why
    return known


def page(results):
    known = equivalents()
    there = {(str(path.relative_to(ROOT)), line) for room in rooms_of(ROOT) for path in sources_of(ROOT, room) for line in path.read_text().splitlines()}
    results = [r for r in results if (r["file"], r["line"]) in there]
    rooms = collections.defaultdict(collections.Counter)
    survivors = []
    for r in results:
        if r["noticed_by"] in ("does not compile", ROOM_ONLY):
            continue
        why = known.get((r["file"], r["changed"].strip()))
        kind = "equivalent" if r["noticed_by"] == "nobody" and why else r["noticed_by"]
        rooms[r["room"]][kind] += 1
        if r["noticed_by"] == "nobody":
            survivors.append((r, why))
    out = ["# Tests that notice", "",
           "`make mutants` changes one sign, comparison, condition or constant of the sources at a time, in a sample of lines drawn from a seed, and runs the tests of the room, then all tests. A change that nobody notices",
           "is either given a test or explained as equivalent. The table is of what has been run so far; one room, or a larger sample, is `make mutants ROOMS=laws SAMPLE=20`.", "",
           "| room | changed | noticed by its tests | by all tests | equivalent | unnoticed | noticed |", "| --- | ---: | ---: | ---: | ---: | ---: | ---: |"]
    total = collections.Counter()
    for room in sorted(rooms) + ["all"]:
        c = rooms[room] if room != "all" else total
        own, whole, same, nobody = c["the room's tests"], c["all tests"], c["equivalent"], c["nobody"]
        real = own + whole + nobody
        out.append(f"| {room} | {real + same} | {own} | {whole} | {same} | {nobody} | {100 * (own + whole) // max(1, real)} % |")
        if room != "all":
            total.update(c)
    out += ["", "## Nobody noticed", ""]
    for r, why in survivors:
        out += [f"- `{r['file']}`: `{r['line'].strip()}` as `{r['changed'].strip()}`" + (f". Equivalent: {why}" if why else "")]
    return "\n".join(out) + "\n"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--rooms", type=lambda words: [w for w in words.split(",") if w], default=[], help="rooms of src/, with commas between (default: all)")
    options.add_argument("--sample", type=int, default=8, help="mutants of a room that compile")
    options.add_argument("--seed", default="1")
    options.add_argument("--jobs", type=int, default=os.cpu_count())
    options.add_argument("--room-tests-only", action="store_true", help="quickly: what the room's own tests do not notice is left at that")
    options.add_argument("--write", type=Path, help="only write the page of the results")
    options = options.parse_args()
    if options.write is None:
        test_rooms(options)
    text = page(load_results())
    if options.write:
        options.write.write_text(text)
    else:
        say("\n" + text)


if __name__ == "__main__":
    main()
