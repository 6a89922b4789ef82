"""How the cost of a run grows with the modes, contacts, magnetic bearings and duration of a scene.

    python3 tests/bench/growth.py build/bin/rotorub [--repeat N] [--short]

Each row of the table is one run of `rotorub run` on a shaft between two stiff bearings that a rotating force drives into
every ring. The cost is the wall time of the integration alone, as `wall_s` of summary.json states it, and the smallest
of N runs in turns counts, because other work on the machine only adds to it. The exponents are the slopes of
least-squares lines through the logarithms of size and cost. The table is Markdown; tests/bench/README.md shows one.
--short runs the two smallest sizes of each kind for a tenth of the time; growth_test.py uses it.
"""

import argparse
import json
import math
import pathlib
import subprocess
import tempfile

# The base scene has the first value of each list; each kind varies one of them.
SIZES = {
    "modes": (8, 16, 32, 64),
    "contacts": (1, 2, 4, 8),
    "magnetic bearings": (0, 1, 2, 4, 8),
    "duration, s": (0.1, 0.2, 0.4, 0.8),
}
STEPS = {"modes": "0.25 us"}  # `verlet` has to resolve the fastest of 64 modes
STEP = "2.5 us"


def scene(modes=8, contacts=1, magnets=0, end=0.1, step=STEP):
    """The text of a scene; end: s."""
    text = f"""
[run]
end = {end}
step = "{step}"
output_step = "1 ms"

[rotor]
speed = "50 Hz"
length = 0.6
E = "210 GPa"
rho = 7850.0
modes = {modes}
damping_ratio = 0.01

[[rotor.section]]
from = 0.0
to = 0.6
diameter = "18 mm"

[[rotor.disc]]
z = 0.3
mass = 2.0
Jt = 1.8e-3
Jp = 3.6e-3
eccentricity = "20 um"

[[rotor.bearing]]
z = 0.03
stiffness = 2e7

[[rotor.bearing]]
z = 0.57
stiffness = 2e7

[drive]
kind = "linear"
gain = 0.5
speed = "50 Hz"
inertia = 2e-3

[[force]]
kind = "rotating"
amplitude = 400.0
frequency = "50 Hz"
station = 0.3
"""
    for k in range(contacts):
        name = f'name = "ring {k + 1}"\n' if contacts > 1 else ""
        text += f"""
[[contact]]
{name}station = {0.24 + 0.015 * k:.3f}
radius = "20 mm"
clearance = "0.5 mm"
friction = 0.1
restitution = 0.3
[contact.stator]
mass = 1.0
damping = 300.0
stiffness = 2e5
"""
    for k in range(magnets):
        text += f"""
[[magnetic_bearing]]
station = {0.1 + 0.05 * k:.2f}
negative_stiffness = "0.02 N/um"
[magnetic_bearing.control]
force_per_current = 20
proportional = "2 A/mm"
derivative = 2
current_limit = 4.0
"""
    return text


def scenes_of(kind, short):
    """Pairs of a size and its scene."""
    key = {"modes": "modes", "contacts": "contacts", "magnetic bearings": "magnets", "duration, s": "end"}[kind]
    sizes = [size for size in SIZES[kind] if size][:2] if short else SIZES[kind]
    for size in sizes:
        values = {"end": 0.1, "step": STEPS.get(kind, STEP), key: size}
        if short:
            values["end"] *= 0.1
        yield size, scene(**values)


def run(rotorub, path, integrator):
    """The summary of one run."""
    out = path.with_suffix("." + integrator)
    done = subprocess.run([rotorub, "run", path, "--integrator", integrator, "-o", out, "--json"], text=True, capture_output=True)
    if done.returncode != 0:
        raise SystemExit(f"{path.read_text()}\n{integrator}: {done.stderr}")
    return json.loads(done.stdout)


def exponent(pairs):
    """Slope of the least-squares line through the logarithms, of the sizes above 0."""
    points = [(math.log(size), math.log(cost)) for size, cost in pairs if size > 0]
    x, y = (sum(values) / len(points) for values in zip(*points))
    return sum((a - x) * (b - y) for a, b in points) / sum((a - x) ** 2 for a, _ in points)


def measure(rotorub, repeat, short=False, kinds=tuple(SIZES), most=None):
    """For each kind a list of (size, summary of `verlet`, summary of `event`), each with its least wall_s. most: how many
    sizes of each kind; None: all."""
    with tempfile.TemporaryDirectory() as folder:
        cases = [(kind, size, text) for kind in kinds for size, text in list(scenes_of(kind, short))[:most]]
        found = {}
        for _ in range(repeat):
            for number, (kind, size, text) in enumerate(cases):
                path = pathlib.Path(folder) / f"{number}.toml"
                path.write_text(text)
                for integrator in ("verlet", "event"):
                    new = run(rotorub, path, integrator)
                    old = found.get((kind, size, integrator), new)
                    found[kind, size, integrator] = min(old, new, key=lambda summary: summary["wall_s"])
    return {kind: [(size, found[kind, size, "verlet"], found[kind, size, "event"])
                   for other, size, _ in cases if other == kind] for kind in kinds}


def table(measured):
    """The Markdown table."""
    lines = ["| | `verlet`, a step | `event`, a step | `event`, steps | `event`, whole run |", "| --- | --- | --- | --- | --- |"]
    for kind, rows in measured.items():
        columns = [[], [], [], []]
        for size, verlet, event in rows:
            costs = (1e6 * verlet["wall_s"] / verlet["steps"], 1e6 * event["wall_s"] / event["steps"], event["steps"],
                     1e3 * event["wall_s"])
            for column, cost in zip(columns, costs):
                column.append((size, cost))
            lines.append(f"| {kind}: {size:g} | {costs[0]:.2f} us | {costs[1]:.1f} us | {costs[2]:,} | {costs[3]:.1f} ms |")
        fitted = " | ".join(f"{exponent(column):.2f}" for column in columns)
        lines.append(f"| *exponent* | {fitted} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rotorub")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--short", action="store_true")
    given = parser.parse_args()
    print(table(measure(given.rotorub, given.repeat, given.short)))


if __name__ == "__main__":
    main()
