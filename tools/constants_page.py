"""The page of tools/constants.py: docs/theory/constants.md."""
import collections
import math
import re

# Smallest change that counts as an effect: of the mean of steps or evaluations over the runs; of the error of one run, relative to the tolerance.
COST, ERROR = 0.01, 0.1
LARGEST = 15


def promises(row):
    """Whether the run promises its forces."""
    return row.exit in (0, 9) and "--tolerance-of motion" not in row.run


def by_case(rows):
    cases = collections.defaultdict(dict)
    for row in rows:
        cases[row.constant, row.value, row.factor][row.run] = row
    return cases


class Effect:
    """The effect of one factor on the runs."""

    def __init__(self, rows, usual):
        both = [(row, usual[row.program, run]) for run, row in rows.items() if (row.program, run) in usual]
        self.notes = [row.run for row, was in both if row.exit == was.exit and not row.notes]
        self.same = not self.notes and all(row.same and row.steps == was.steps and row.evaluations == was.evaluations and row.exit == was.exit for row, was in both)
        finished = [(row, was) for row, was in both if row.exit == was.exit]
        self.steps = mean_change([(row.steps, was.steps) for row, was in finished])
        self.evaluations = mean_change([(row.evaluations, was.evaluations) for row, was in finished])
        promised = [(row, was) for row, was in both if promises(row)]
        self.error, self.worst = max(((row.true, row.run) for row, _ in promised), default=(0, ""))
        self.error_change = max((abs(row.true - was.true) for row, was in promised if promises(was)), default=0)
        self.broken = [(row.run, row.true) for row, was in promised if row.true > 1 and was.true <= 1]
        self.ends = [(row.run, was.exit, row.exit) for row, was in both if row.exit != was.exit]

    def cost(self):
        return max(abs(self.steps), abs(self.evaluations))

    def visible(self, cost=COST, error=ERROR):
        return self.cost() >= cost or self.error_change > error or bool(self.ends or self.notes)


def mean_change(pairs):
    """The change as the geometric mean of the ratios, so that each run has the same weight."""
    logs = [math.log(now / was) for now, was in pairs if now > 0 and was > 0]
    return math.exp(sum(logs) / len(logs)) - 1 if logs else 0


def percent(x):
    return "0" if abs(x) < 0.0005 else f"{100 * x:+.1f} %" if abs(x) < 0.1 else f"{100 * x:+.0f} %"


def cells(effect):
    if effect is None:
        return ["not measured"] + [""] * 2
    if effect.same:
        return ["same"] + [""] * 2
    error = f"**{effect.error:.2g}**" if effect.broken else f"{effect.error:.2g}"
    return [percent(effect.steps), percent(effect.evaluations), error]


def short(run):
    """The run in words for a table: the model's name and its options."""
    words = run.split()
    rest = " ".join(words[1:]).replace("--", "")
    return words[0].rsplit("/", 1)[-1].removesuffix(".toml") + (f" ({rest})" if rest else "")


def code_of(exit_code):
    return "no end in 20 s" if exit_code == -1 else f"signal {-exit_code}" if exit_code < 0 else str(exit_code)


def ends_of(effects, notes=True):
    out = []
    for word, effect in zip(("halved", "doubled"), effects):
        runs = [f"{short(run)}: {was} to {code_of(now)}" for run, was, now in effect.ends] if effect else []
        if notes and effect and effect.notes:
            runs.append("other notes in " + ", ".join(short(run) for run in effect.notes[:2]) + (f" and {len(effect.notes) - 2} more" if len(effect.notes) > 2 else ""))
        if runs:
            out.append(f"{word}: " + "; ".join(runs[:3]) + (f" and {len(runs) - 3} more" if len(runs) > 3 else ""))
    return "; ".join(out)


def named(constant):
    return f"`{constant.name}` in [{constant.file.rsplit('/', 1)[-1]}](../../src/{constant.file})"


def sentence(text):
    """The text of the comment; its first sentence if it has several."""
    text = re.sub(r"^(theory/\S+ Eq\. \([\d.]+\)\.)\s*(.*)$", r"\2 \1", text.strip())
    first = re.match(r"(.{25,}?[^.]\.)\s+[A-Z]", text)
    return (first[1] if first else text).rstrip(".").replace("|", "\\|")


def place_of(constant):
    return constant.file.rsplit("/", 1)[0]


def page(measured, skipped, rows, runs, noise):
    cases = by_case(rows)
    usual = {(row.program, row.run): row for row in rows if not row.constant}
    effects = {}
    for c in measured:
        effects[c] = [Effect(found, usual) if (found := cases.get((f"{c.file}:{c.name}", c.value, factor))) else None for factor in (0.5, 2.0)]
    out = ["# Constants of the numerics", "",
           f"What the {len(measured)} named numbers of the numerics decide, and what becomes of {len(runs)} runs when each of them is halved and doubled. `make constants` measures and writes this page: it reads names, values",
           "and meanings from the sources (the comment at each constant), builds a copy that reads each constant through a factor, and makes the runs below with `pintle run`.", ""]
    last = next((row.program for row in reversed(rows) if not row.constant), "")
    effects_of_noise = [Effect(cases[case], usual) for case in noise if case in cases]
    out += how_to_read(runs, {run: row for (program, run), row in usual.items() if program == last}, effects_of_noise)
    out += largest(effects)
    out += without_effect(effects, effects_of_noise)
    for place in dict.fromkeys(place_of(c) for c in measured):
        out += table(place, {c: e for c, e in effects.items() if place_of(c) == place})
    out += ["## Not measured", "", "Tables of coefficients are not listed.", "", "| where | constants | why |", "| --- | --- | --- |"]
    groups = collections.defaultdict(list)
    for c, why in skipped:
        if "[" not in c.name:
            groups[c.file, why].append(c.name)
    out += [f"| [{file}](../../src/{file}) | {', '.join(f'`{n}`' for n in names)} | {why} |" for (file, why), names in groups.items()]
    return "\n".join(out) + "\n"


def with_meanings(text, measured):
    """The page with the meanings of the constants as the sources have them now; its measurements stay."""
    meanings = {named(c): sentence(c.comment) for c in measured}
    lines = []
    for line in text.split("\n"):
        cells = line.split(" | ")
        if len(cells) == 10 and cells[0].removeprefix("| ") in meanings:
            cells[2] = meanings[cells[0].removeprefix("| ")]
        lines.append(" | ".join(cells))
    return "\n".join(lines)


def how_to_read(runs, usual, noise):
    worst = max((row for row in usual.values() if promises(row)), key=lambda row: row.true, default=None)
    out = ["- *Steps* and *evaluations* are of all passes of a run together; a column has the change of their geometric mean over the runs, so that each run counts alike.",
           "- *Error* is the largest true error of a joint force over the tolerance, in the worst run that promises its forces: against rows of a run whose tolerance is a thousandth (not below 1e-9), as a part",
           f"  of each joint's peak. With the constants as they are it is {worst.true:.2g}, in {short(worst.run)}. **Bold**: a run that kept to its tolerance has lost it." if worst else "",
           "- *Same*: every number of every run is the same to the last bit, and what the runs say in notes.",
           "- A constant of the start decides from which state a run starts. Where no start without ringing is found, as the notes of rope_pendulum and redundant-1-127 say, another constant means another motion,",
           "  and the error has the distance of the two.",
           "- A constant of one method is measured on the runs of that method. Counts are halved to the next whole number below.",
           "- Measurements go on where they were stopped, also after the program has changed: each row is compared with the runs of its own program.", "",
           "| run | steps | evaluations | error | exit code |", "| --- | ---: | ---: | ---: | ---: |"]
    if noise:
        cost, error = level(noise)
        out.insert(-3, f"- Noise: a change of `kSafety` by a billionth or a hundred-millionth, which cannot matter, makes up to {percent(cost)[1:]} of steps or evaluations and {error:.2g} of an error. Contacts")
        out.insert(-3, "  make another sequence of steps of any change.")
    for run in runs:
        row = usual.get(run)
        out.append(f"| `{run}` | {row.steps} | {row.evaluations} | {row.true:.2g} | {row.exit} |" if row and promises(row) else f"| `{run}` | {row.steps} | {row.evaluations} | | {row.exit} |" if row else f"| `{run}` | | | | |")
    return out + [""]


def level(noise):
    """The level of noise, below which an effect has no meaning: of cost, of an error."""
    return max((e.cost() for e in noise), default=0), max((e.error_change for e in noise), default=0)


def size(effects):
    """The largest change of the runs' cost, as a logarithm."""
    return max((max(abs(math.log1p(e.steps)), abs(math.log1p(e.evaluations))) for e in effects if e), default=0)


def largest(effects):
    out = ["## The largest effects", "", "On cost:", "", "| constant | value | halved: evaluations | doubled: evaluations |", "| --- | ---: | ---: | ---: |"]
    for c in sorted(effects, key=lambda c: -size(effects[c]))[:LARGEST]:
        out.append(f"| {named(c)} | {shown(c.value)} | " + " | ".join("" if e is None else "same" if e.same else percent(e.evaluations) for e in effects[c]) + " |")
    out += ["", "On the promise, where a run that still promises its forces has lost its tolerance:", "", "| constant | value | error over the tolerance |", "| --- | ---: | --- |"]
    for c, pair in effects.items():
        broken = [(word, run, true) for word, e in zip(("halved", "doubled"), pair) if e for run, true in e.broken]
        if broken:
            out.append(f"| {named(c)} | {shown(c.value)} | " + "; ".join(f"{word}: {true:.2g} in {short(run)}" for word, run, true in broken) + " |")
    out += ["", "On how runs end:", "", "| constant | value | exit codes |", "| --- | ---: | --- |"]
    out += [f"| {named(c)} | {shown(c.value)} | {ends_of(pair, False)} |" for c, pair in effects.items() if ends_of(pair, False)]
    return out + [""]


def without_effect(effects, noise):
    known = {c: pair for c, pair in effects.items() if all(pair)}
    same = [c for c, pair in known.items() if all(e.same for e in pair)]
    little = [c for c, pair in known.items() if c not in same and not any(e.visible() for e in pair)]
    cost, error = level(noise)
    drowned = [c for c, pair in known.items() if c not in same and c not in little and not any(e.visible(max(COST, 1.001 * cost), max(ERROR, 1.001 * error)) for e in pair)]
    out = ["## Without visible effect", "",
           f"{len(same) + len(little)} of {len(known)} change neither steps nor evaluations by a hundredth, no error by a tenth of the tolerance, no exit code and no note. They are either for what these runs do not meet, or they could",
           "go.", "", f"{len(little)} of them change something:", ""]
    out += listed(little) + ["", f"With {len(same)} every number of every run is the same to the last bit:", ""]
    out += listed(same)
    if drowned:
        out += ["", f"The effect of {len(drowned)} more is not larger than the noise:", "", *listed(drowned)]
    return out + [""]


def listed(constants):
    """The constants by file, one line each."""
    files = collections.defaultdict(list)
    for c in constants:
        files[c.file].append(c.name)
    return [f"- [{file}](../../src/{file}): " + ", ".join(f"`{name}`" for name in names) for file, names in files.items()]


def shown(value):
    return value.replace("std::numeric_limits<double>::epsilon()", "eps").replace("*", "\\*").replace("'", "")


def table(place, effects):
    out = [f"## {place}", "", "| constant | value | what it decides | halved: steps | evaluations | error | doubled: steps | evaluations | error | exit codes, notes |",
           "| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |"]
    for c, pair in effects.items():
        out.append(f"| {named(c)} | {shown(c.value)} | {sentence(c.comment)} | " + " | ".join(cells(pair[0]) + cells(pair[1])) + f" | {ends_of(pair)} |")
    return out + [""]
