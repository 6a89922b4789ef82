"""How a frozen value is held, and its text in the tables: what `record` writes and the test reads."""

import csv
import math
import re

# The range of n samples, widened on both sides by this multiple of itself, leaves out a further sample of the same
# normal distribution in 3 of 10,000 cases.
WIDEN = {2: 50.0, 3: 33.0, 4: 9.1, 5: 4.8, 6: 3.2, 7: 2.4}
TIGHT = 1e-7  # of the scale: at least this much is allowed
REGULAR = 1e-4  # of the scale: a value that is held this closely is held tightly
CHAOTIC = 0.02  # of the scale: a final state that scatters by more is not held
BOUND = 3.0  # a residual may grow by this factor
ROUND_OFF = 1e-10  # and by this much
CHAOTIC_BOUND, CHAOTIC_ROUND_OFF = 10.0, 1e-6  # the same in a chaotic run
EXTREME = 0.5  # of its value: the least that the largest or least value of a chaotic run may be off
SHARE = 0.02  # the least that a share of a chaotic run's rows may be off
ZERO = 1e-12  # what this does not exceed counts as zero


class Held:
    """What a value may be. kind: "near" (value, width), "below" (value), "is" (a word or a count), "free"."""

    def __init__(self, kind, value=None, width=0.0):
        self.kind, self.value, self.width = kind, value, width

    def __str__(self):
        if self.kind == "near":
            plain = abs(self.width - TIGHT * abs(self.value)) <= 1e-3 * self.width  # its own scale: the width need not be said
            return f"={number(self.value, self.width)}~{'' if plain and self.width else rounded_up(self.width)}"
        if self.kind == "below":
            return f"<={rounded_up(self.value)}"
        return f"={self.value}"

    @staticmethod
    def read(text):
        """{name: Held} of one cell, "name=value~width"."""
        name, sign, rest = re.fullmatch(r"(.+?)(<=|=)(.*)", text).groups()
        if sign == "<=":
            return name, Held("below", float(rest))
        if "~" in rest:
            value, width = rest.split("~")
            return name, Held("near", float(value), float(width) if width else 1.001 * TIGHT * abs(float(value)))
        return name, Held("is", rest)

    def fault(self, value):
        """What is wrong with the value, in words; None: nothing."""
        if self.kind == "free":
            return None
        if self.kind == "is":
            same = str(value) == self.value
            return None if same else f"{value} is not {self.value}"
        if not isinstance(value, (int, float)) or math.isnan(value):
            return f"{value} is not a number"
        if self.kind == "below":
            return None if value <= self.value else f"{value!r} is above {self.value!r}"
        low, high = self.value - self.width, self.value + self.width
        if low <= value <= high:
            return None
        return f"{value!r} is not in [{low!r}, {high!r}], by {abs(value - self.value) / (self.width or 1e-300):.3g} of the half width"


def short(text):
    """1.50e-04 as 1.5e-4."""
    mantissa, _, exponent = text.partition("e")
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    return mantissa + (f"e{int(exponent)}" if exponent and int(exponent) else "")


def number(value, width):
    """The value with the digits that its width leaves meaningful."""
    if value == 0.0 or abs(value) < 0.05 * width:
        return "0"
    if width == 0.0:
        return short(repr(value))
    digits = math.floor(math.log10(abs(value))) - math.floor(math.log10(width)) + 2
    text = short(f"{value:.{min(max(digits, 1), 16)}e}")
    plain = short(f"{float(text):.15g}")
    return min(text, plain, key=len) if float(plain) == float(text) else text


def rounded_up(width):
    """Two digits, never less than the number."""
    if width == 0.0:
        return "0"
    exponent = math.floor(math.log10(width)) - 1
    return short(f"{math.ceil(width / 10.0**exponent * (1.0 - 1e-12)) * 10.0**exponent:.1e}")


def widened(samples):
    """The interval of a value that scatters."""
    low, high = min(samples), max(samples)
    return Held("near", 0.5 * (low + high), (high - low) * (0.5 + WIDEN[len(samples)]))


def held_number(samples, scale, floor=0.0):
    """samples[0] is the run as it is, the others are its twins."""
    if any(not isinstance(x, (int, float)) or not math.isfinite(x) for x in samples):
        return held_word(samples)
    spread = max(samples) - min(samples)
    if 3.0 * spread <= REGULAR * scale or 3.0 * spread <= floor:
        return Held("near", float(samples[0]), max(TIGHT * scale, floor, 3.0 * spread))
    return widened(samples)


def held_state(samples, scale):
    """A column of the last row."""
    held = held_number(samples, scale)
    numbers = all(isinstance(x, (int, float)) for x in samples)
    return Held("free") if numbers and max(samples) - min(samples) > CHAOTIC * scale else held


def held_count(samples, regular):
    """Exact in a regular run whose twins agree; else at least two either way."""
    if any(not isinstance(x, (int, float)) for x in samples):
        return held_word(samples)
    if regular and len(set(samples)) == 1:
        return Held("is", str(samples[0]))
    held = widened(samples)
    return Held("near", held.value, max(2.0 + 0.5 * (max(samples) - min(samples)), held.width))


def held_bound(samples, regular):
    if any(not isinstance(x, (int, float)) or not math.isfinite(x) for x in samples):
        return held_word(samples)
    factor, floor = (BOUND, ROUND_OFF) if regular else (CHAOTIC_BOUND, CHAOTIC_ROUND_OFF)
    return Held("below", factor * max(samples) + floor)


def at_least(held, width):
    """With at least this width."""
    return Held("near", held.value, max(held.width, width)) if held.kind == "near" else held


def held_word(samples):
    return Held("is", str(samples[0])) if len(set(map(str, samples))) == 1 else Held("free")


# A cell that lists the names of values that are held alike.
LISTS = {
    "none": Held("is", "None"),  # null in the summary
    "zero": Held("near", 0.0, ZERO),
    "roundoff": Held("below", 1.5 * ROUND_OFF),  # a residual that vanishes
    "free": Held("free"),  # chaotic, not held
}


def cells_of(entries):
    """The cells of {name: Held}."""
    cells, lists = [], {name: [] for name in LISTS}
    for name, entry in entries.items():
        if entry.kind == "is" and entry.value == "None":
            lists["none"].append(name)
        elif str(entry) == "=0" or (str(entry).startswith("=0~") and (entry.width == 0.0 or 0.1 * ZERO <= entry.width <= ZERO)):
            lists["zero"].append(name)
        elif entry.kind == "below" and entry.value <= LISTS["roundoff"].value:
            lists["roundoff"].append(name)
        elif entry.kind == "free":
            lists["free"].append(name)
        else:
            cells.append(f"{name}{entry}")
    return cells + [f"{name}:{' '.join(names)}" for name, names in lists.items() if names]


def entries_of(cells):
    """The same back."""
    entries = {}
    for cell in cells:
        name, colon, names = cell.partition(":")
        entries.update(dict.fromkeys(names.split(), LISTS[name]) if colon else [Held.read(cell)])
    return entries


def read_cells(file):
    """{(scene, engine): {name: Held}} of a table."""
    with open(file) as lines:
        rows = list(csv.reader(lines))[1:]
    return {(row[0], row[1]): entries_of(row[2:]) for row in rows}
