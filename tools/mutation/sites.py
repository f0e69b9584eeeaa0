"""What may be changed in a source, and how a change is built in so that a number in the environment switches it on."""
import hashlib
import re
from dataclasses import dataclass

NUMBER = r"(?<![\w.\[<'])(?:\d+\.?\d*(?:e[+-]?\d+)?|\.\d+)(?![\w.>'])"
OPPOSITE = {"<": ">=", "<=": ">", ">": "<=", ">=": "<", "==": "!=", "!=": "==", "+": "-", "-": "+", "+=": "-=", "-=": "+=", "&&": "||", "||": "&&"}
COMPARISON = {"<": "Less", "<=": "LessEqual", ">": "Greater", ">=": "GreaterEqual", "==": "Equal", "!=": "NotEqual"}
PATTERNS = [
    ("sign", r" (\+|-) "),
    ("sign", r" (\+=|-=) "),
    ("comparison", r" (<=?|>=?) (?!\w+>)"),
    ("comparison", r" (==|!=) "),
    ("condition", r" (&&|\|\|) "),
    ("condition", r"\b(if) \((?!constexpr)"),
    ("constant", f"({NUMBER})"),
]
# No sites: declarations, where a number is a size or a comparison a template's bracket; loops, which would hang or read beyond an end, which every test notices.
NO_SITE = re.compile(r"^\s*(for \(|//|/\*|\*|#|template|using|namespace|case |static_assert|struct|class|enum|friend|\"|EXPECT|ASSERT)|operator|\[\]|std::array<|Matrix<|Lanes<|\.reserve\(|\.resize\(|if constexpr|\\$")
ALWAYS_SET = re.compile(r"^\s*[\w:<>]+ (\w+ = 0|\w+_ = [\d.]+)[,;]")  # variables that are set before they are read
OF_WORDS = re.compile(r'"|\bstring|text|format|\bname|message|path')  # here + joins strings, which have no sign
M = "::pintle_mutants::"


@dataclass(frozen=True)
class Site:
    room: str
    file: str
    number: int  # of the line
    kind: str
    line: str
    changed: str  # the line as a reader would write it with the change
    built_in: str  # the line with the switch, {0} for the number of the change

    @property
    def key(self):
        return self.file, self.line, self.changed


def without_words(line):
    """The line with its strings and its comment blanked out, of the same length."""
    line = re.sub(r'"(\\.|[^"\\])*"', lambda m: '"' + "_" * (len(m.group(0)) - 2) + '"', line)
    line = re.sub(r"'(\\.|[^'\\])'", lambda m: "'" + "_" * (len(m.group(0)) - 2) + "'", line)
    return re.sub(r"//.*$", lambda m: " " * len(m.group(0)), line)


def closing(text, start):
    """Where the bracket that opens at `start` closes; -1 if it does not."""
    depth = 0
    for i in range(start, len(text)):
        depth += {"(": 1, ")": -1}.get(text[i], 0)
        if depth == 0:
            return i
    return -1


def operand_end(bare, start, stops):
    """Where the operand that begins at `start` ends; -1 if that is not on this line."""
    depth = 0
    for i in range(start, len(bare)):
        if bare[i] in "([{":
            depth += 1
        elif bare[i] in ")]}":
            depth -= 1
        if depth < 0 or (depth == 0 and any(bare.startswith(stop, i) for stop in stops)):
            return i
    return -1


def operand_begin(bare, end, stops):
    """Where the operand that ends at `end` begins; -1 if that is not on this line."""
    depth = 0
    for i in range(end - 1, -1, -1):
        if bare[i] in ")]}":
            depth += 1
        elif bare[i] in "([{":
            depth -= 1
        if depth < 0:
            return i + 1
        for stop in stops:
            if depth == 0 and bare.endswith(stop, 0, i + 1):
                return i + 1
    return -1


def escaped(text):
    return text.replace("{", "{{").replace("}", "}}")


def built_in(line, bare, kind, m):
    """(line as changed, line with the switch); None if it cannot be changed here."""
    op, begin, end = m.group(1), m.start(1), m.end(1)
    head, tail = line[:begin], line[end:]
    changed = head + OPPOSITE.get(op, "") + tail
    if kind == "constant":
        if ALWAYS_SET.match(bare):
            return None
        changed = head + ("1" if float(op) == 0 else f"(2 * {op})") + tail
        return changed, escaped(head) + f"{M}number({{0}}, {op})" + escaped(tail)
    if kind == "comparison":
        return changed, escaped(head) + f"{op} {M}{COMPARISON[op]}{{{{{{0}}}}}} {op}" + escaped(tail)
    if op == "+" and OF_WORDS.search(bare):
        return None
    if op in "+-":
        return changed, escaped(head) + f"{op} {M}sign({{0}}) *" + escaped(tail)
    if kind == "sign":
        stop = operand_end(bare, end, ";")
        if stop < 0:
            return None
        return changed, escaped(head) + f"{op} {M}sign({{0}}) * (" + escaped(line[end + 1 : stop]) + ")" + escaped(line[stop:])
    if op == "if":
        stop = closing(bare, end + 1)
        if stop < 0 or " = " in bare[end:stop] or ";" in bare[end:stop]:
            return None
        condition = line[end + 2 : stop]
        return head + f"if (!({condition}))" + line[stop + 1 :], escaped(head) + f"if ({M}is_active({{0}}) != static_cast<bool>({escaped(condition)}))" + escaped(line[stop + 1 :])
    # binds as the operator itself does: && before ||
    looser = [" || ", " ? ", " : ", " = ", ", ", ";", "return ", " {"] + ([" && "] if op == "&&" else [])
    first, last = operand_begin(bare, m.start(), looser), operand_end(bare, m.end(), looser)
    if first < 0 or last < 0:
        return None
    left, right = escaped(line[first : m.start()]), escaped(line[m.end() : last])
    return changed, f"{escaped(line[:first])}({M}is_active({{0}}) ? ({left} {OPPOSITE[op]} {right}) : ({left} {op} {right})){escaped(line[last:])}"


def not_constant(text):
    """Constants known to the compiler become constants that are set when the program starts."""
    text = re.sub(r"\bstatic constexpr ", "static inline const ", text)
    return re.sub(r"\bconstexpr ", "const ", text)


def sources_of(tree, room):
    files = [p for p in (tree / "src" / room).rglob("*") if p.suffix in (".h", ".cpp") and not re.search(r"_test\.cpp$|_for_tests\.", p.name)]
    return sorted(files)


def sites_of(tree, room):
    """Everything that may be changed in a room."""
    sites = []
    for path in sources_of(tree, room):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            bare = without_words(line)
            if NO_SITE.search(bare):
                continue
            for kind, pattern in PATTERNS:
                for m in re.finditer(pattern, bare):
                    both = built_in(line, bare, kind, m)
                    if both:
                        sites.append(Site(room, str(path.relative_to(tree)), number, kind, line, both[0], not_constant(both[1])))
    return sites


def draw(tree, room, seed, wanted, known):
    """`wanted` sites of a room, no two of them on one line: first those whose keys are known, then others, in an order that does not depend on changes elsewhere."""
    order = {site: hashlib.sha256("\n".join((seed, *site.key)).encode()).hexdigest() for site in sites_of(tree, room)}
    drawn, lines = [], set()
    for site in sorted(order, key=lambda site: (site.key not in known, order[site])):
        if len(drawn) < wanted and (site.file, site.number) not in lines:
            lines.add((site.file, site.number))
            drawn.append(site)
    return drawn
