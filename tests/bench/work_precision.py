"""Work against precision of `event` and of general solvers of differential equations.

    python3 tests/bench/work_precision.py build/bin/rotorub [--short]

Each problem is a scene of mjcf whose rotor touches one ring and slides there. The equations are written here anew, from
the matrices that `rotorub modes --state-space` and `rotorub mjcf` print and from the scene's numbers, so the table also
shows how far `event` is from independent solvers. Needs numpy and scipy. README.md shows the second table.

The work is the number of evaluations of the right-hand side, because times would compare Python with C++. Those of `event`
are counted by valgrind's callgrind at its default tolerance, and taken in proportion to the steps at the others (without
valgrind: 12 a step). The error is the largest distance of the rotor's centre from the reference, relative to the rotor's
largest deflection: for `event` over the rows of its run, for the others at the ends of their steps. The reference is DOP853
at 3e-14; the errors of `event` at given tolerances are `rotorub bench`'s, against `event` at 1e-13.
"""

import argparse
import csv
import functools
import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import tomllib
import xml.etree.ElementTree

import numpy as np
from scipy.integrate import DOP853, LSODA, Radau
from scipy.optimize import brentq

from exponential_gauss import ExponentialGauss

MJCF = pathlib.Path(__file__).resolve().parents[2] / "mjcf"
UNITS = {"mm": 1e-3, "ms": 1e-3, "us": 1e-6, "Hz": 2.0 * np.pi}
# The rig's rotor, 8 modes in each plane from 56 Hz to 2.6 kHz, without torsion and at a constant speed.
RIG = ["initial.steady=false", "drive=none", "rotor.torsion=none", "rotor.disc[0].eccentricity=0",
       "force[0].station=0.24", "force[0].on=0"]
PROBLEMS = {  # name: the scene, and what is set in it
    "rig, flight": ("paper_passive.toml", RIG + ["contact.clearance=5 mm", "run.end=0.05"]),
    "rig, rub": ("paper_passive.toml", RIG + ["run.end=0.02"]),
    "bench_ring": ("bench_ring.toml", ["run.end=0.1"]),
    "compliant_ring": ("compliant_ring.toml", []),
    "compliant_ring, 1000 times as stiff": ("compliant_ring.toml", ["contact.compliance.stiffness=2e12", "run.end=0.03"]),
}
TOLERANCES = (1e-6, 1e-8, 1e-10, 1e-12)
SHORT = {"names": ("rig, rub", "compliant_ring"), "methods": ("DOP853", "exponential"), "tolerances": (1e-6, 1e-9),
         "end": 0.01}
EQUAL_ERROR = 1e-10  # at which the methods are compared
ROUND_OFF = 1e-18  # m, of a gap
LEAST_PER_STEP = 12  # evaluations of `event` for each step, without its dense output and its repeated steps
LEAST_REBOUND = 1e-7  # m/s; a slower impact has no rebound, which ends an accumulation of impacts


class Machine:
    """The equations of motion of a scene: y = (q, v, Omega) with the modal coordinates and the ring's in q.

    y' = A y + constant + load(t), and while the rotor touches its ring, with the normal force N and the friction -mu N,
    M v' = ... + B' (-N e_r - mu N e_t) and I Omega' = ... - r mu N. d = B q points from the ring's centre to the rotor's,
    e_r = d/|d|, e_t is e_r turned by a right angle, the gap is clearance - |d|. B M^-1 B' = w 1, so friction and normal
    force do not interact. `mode` is "flight", "rigid" (N keeps the gap at 0) or "compliant" (N = k p^n (1 + a p'))."""

    def __init__(self, rotorub, path, sets, scene):
        plant = json.loads(output([rotorub, "modes", path, *sets, "--state-space"]))
        model = xml.etree.ElementTree.fromstring(output([rotorub, "mjcf", path, *sets]))
        masses = [float(joint.get("armature")) for joint in model.iter("joint") if joint.get("type") == "slide"]
        n = self.n = len(masses)
        self.inverse_mass = 1.0 / np.array(masses)
        self.rotor = np.array(plant["C"])[:2, :n]
        self.B = self.rotor - np.array(plant["C"])[2:, :n]
        self.w = float(self.B[0] ** 2 @ self.inverse_mass)
        assert np.allclose(self.B * self.inverse_mass @ self.B.T, self.w * np.eye(2), rtol=1e-12, atol=1e-12)
        self.A, self.constant = np.zeros((2 * n + 1, 2 * n + 1)), np.zeros(2 * n + 1)
        self.A[:2 * n, :2 * n] = plant["A"]
        drive = scene.get("drive")
        self.inverse_inertia = 1.0 / scene["rotor"]["modal"]["inertia"] if drive else 0.0
        if drive:
            self.A[-1, -1] = -drive["gain"] * self.inverse_inertia
            self.constant[-1] = drive["gain"] * drive["speed"] * self.inverse_inertia
        self.start = np.zeros(2 * n + 1)
        self.start[-1] = scene["rotor"]["speed"]
        self.contact, self.force, self.end = scene["contact"], scene["force"][0], scene["run"]["end"]
        self.force.setdefault("phase", 0.0)
        self.clearance, self.mu = self.contact["clearance"], self.contact["friction"]
        self.compliance = self.contact.get("compliance")
        if self.compliance:
            e = self.contact["restitution"]
            self.rebound = brentq(lambda z: np.log((1 + z) / (1 - e * z)) - z * (1 + e), 1e-3, (1 - 1e-12) / e,
                                  xtol=1e-15)
        self.mode, self.a, self.evaluations = "flight", 0.0, 0

    def geometry(self, y):
        """d/|d|, |d|, and the velocities of d along e_r and e_t. Takes complex y."""
        d, rate = self.B @ y[:self.n], self.B @ y[self.n:2 * self.n]
        delta = np.sqrt(d @ d)
        e_r = d / delta
        return e_r, delta, e_r @ rate, e_r[0] * rate[1] - e_r[1] * rate[0]

    def slope(self, t, y):
        """y'. Takes complex y."""
        angle = self.force["frequency"] * t + self.force["phase"]
        turning = self.force["amplitude"] * np.array([np.cos(angle), np.sin(angle)])
        dy = self.A @ y + self.constant
        dy[self.n:-1] += self.inverse_mass * (turning @ self.rotor)
        if self.mode == "flight":
            return dy
        e_r, delta, out, along = self.geometry(y)
        if self.mode == "rigid":
            normal = (e_r @ (self.B @ dy[self.n:-1]) + along * along / delta) / self.w
        else:
            p = delta - self.clearance
            spring = p * (p * np.sign(p.real)) ** (self.compliance["exponent"] - 1.0)
            normal = self.compliance["stiffness"] * spring * (1.0 + self.a * out)
        self.normal = normal
        return dy + self.push(e_r, normal)

    def push(self, e_r, normal):
        """What a normal force (N) and its friction do to y'; for an impulse: to y."""
        dy = np.zeros(2 * self.n + 1, dtype=np.result_type(e_r, normal))
        on_rotor = np.array([-e_r[0] + self.mu * e_r[1], -e_r[1] - self.mu * e_r[0]]) * normal
        dy[self.n:-1] = self.inverse_mass * (on_rotor @ self.B)
        dy[-1] = -self.contact["radius"] * self.mu * normal * self.inverse_inertia
        return dy

    def derivative(self, t, y):
        self.evaluations += 1
        return self.slope(t, y)

    def jacobian(self, t, y):
        """The exact derivative of y' by y, by complex steps; not counted as evaluations."""
        if self.mode == "flight":
            return self.A
        return np.array([self.slope(t, y + step).imag for step in 1e-30j * np.eye(y.size)]).T / 1e-30

    def margin(self, t, y):
        """Positive while the mode lasts: gap, penetration or normal force."""
        if self.mode == "rigid":
            self.derivative(t, y)
            return self.normal
        gap = self.clearance - self.geometry(y)[1]
        return gap if self.mode == "flight" else -gap

    def change(self, t, y):
        """The state after the event that ends the mode; sets the next mode."""
        e_r, _, speed, along = self.geometry(y)
        if self.mode != "flight":
            self.mode = "flight"
        elif self.compliance:
            self.a, self.mode = self.rebound / max(speed, 1e-4), "compliant"
        else:
            rests = speed < LEAST_REBOUND
            y = y + self.push(e_r, (1.0 if rests else 1.0 + self.contact["restitution"]) * speed / self.w)
            self.mode = "rigid" if rests else "flight"
        assert along + self.contact["radius"] * y[-1] > 0.0, "the contact no longer slides"
        return self.on_ring(y)

    def on_ring(self, y):
        """The nearest state with gap and gap rate 0, if the mode is "rigid"."""
        if self.mode == "rigid":
            for part, excess in ((slice(0, self.n), 1), (slice(self.n, 2 * self.n), 2)):
                found = self.geometry(y)
                y[part] -= self.inverse_mass * (found[0] @ self.B) * (found[excess] - (excess == 1) * self.clearance) / self.w
        return y


def scipy_solver(method):
    """A maker of scipy's solver for solve(). Errors count relative to the largest displacement and speed, as in `event`."""
    def make(machine, t, y, end, tolerance, scale, h):
        extra = {"jac": machine.jacobian} if method is Radau else {}
        if method is not LSODA:
            extra["first_step"] = min(h, end - t)
        return method(machine.derivative, t, y, end, rtol=tolerance, atol=tolerance * scale, **extra)
    return make


METHODS = {"DOP853": scipy_solver(DOP853), "LSODA": scipy_solver(LSODA), "Radau": scipy_solver(Radau),
           "exponential": ExponentialGauss, "exponential, fixed J": functools.partial(ExponentialGauss, fixed=True)}
DENSE = ("DOP853", "LSODA")  # their dense output is good enough for events


def solve(machine, method, tolerance, scale, keep=False):
    """Runs from event to event. Returns steps, the ends of the steps as (t, rotor's centre), and, with keep, pairs of an
    end time and the dense output up to it."""
    machine.mode, machine.evaluations = "flight", 0
    t, y, h, steps, ends, pieces, machine.fastest = 0.0, machine.start, 1e-6, 0, [], [], 0.0
    while t < machine.end:
        solver = METHODS[method](machine, t, y, machine.end, tolerance, scale, h)
        while t < machine.end:
            before = solver.y.copy()
            why = solver.step()
            if solver.status == "failed":
                raise ArithmeticError(f"{method} at {solver.t} s: {why}")
            steps += 1
            h, start, t, y = solver.t - t, t, solver.t, solver.y
            until = t
            if method.startswith("exponential") and machine.mode == "flight":  # a long step may touch and come back
                times = np.linspace(start, t, 65 + int(16 * (t - start) * np.abs(solver.eigenvalues).max()))[1:]
                until = next((time for time, at in zip(times, solver.at(times)) if machine.margin(time, at) < 0.0), t)
            ended = until < t or machine.margin(t, y) < 0.0
            if ended or keep:
                dense = solver.dense_output()
            if ended:
                t, y = locate(machine, method, start, before, until, dense, tolerance, scale)
                y = machine.change(t, y)
            elif machine.mode == "rigid" and method != "LSODA":  # whose past steps cannot be moved
                solver.y = y = machine.on_ring(y)
            ends.append((t, machine.rotor @ y[:machine.n]))
            machine.fastest = max(machine.fastest, np.max(np.abs(y[machine.n:-1])))
            if keep:
                pieces.append((t, dense))
            if ended:
                break
    return steps, ends, pieces


def locate(machine, method, start, before, until, dense, tolerance, scale):
    """Time and state of the event in the last step, before `until`: a root of the dense output. Radau's dense
    output is cubic and that of the exponential method has order 5, so both repeat the step up to the event."""
    def share(t):
        """The margin, without the root at the start of a flight or touch."""
        return machine.margin(t, dense(t)) / (t - start)

    first = start + 1e-6 * (until - start)
    if share(first) <= 0.0:
        return start, before
    t = brentq(share, first, until, xtol=1e-300, rtol=4 * np.finfo(float).eps, maxiter=200)
    if method in DENSE or t - start < 1e-9:
        return t, dense(t)
    if machine.mode == "rigid":
        little = 1e-4 * (t - start)
        rate = (machine.margin(t, dense(t)) - machine.margin(t - little, dense(t - little))) / little
    else:
        rate = machine.geometry(dense(t))[2] * (-1.0 if machine.mode == "flight" else 1.0)
    for _ in range(4):
        again = METHODS[method](machine, start, before, t, tolerance, scale, t - start)
        while again.status == "running":
            again.step()
        late = machine.margin(t, again.y) / rate
        if abs(late) < 1e-6 * (t - start) + ROUND_OFF / abs(rate):
            break
        t = max(t - late, 0.5 * (start + t))
    return t - late, again.y - late * machine.derivative(t, again.y)


def output(command):
    """What a command prints."""
    done = subprocess.run([str(word) for word in command], text=True, capture_output=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}: {done.stderr}")
    return done.stdout


def in_si(value):
    """A value of a scene in SI units: tables and lists part by part, "50 Hz" as 314.16."""
    if isinstance(value, dict):
        return {key: in_si(part) for key, part in value.items()}
    if isinstance(value, list):
        return [in_si(part) for part in value]
    number, _, unit = value.partition(" ") if isinstance(value, str) else ("", "", "")
    return float(number) * UNITS[unit] if unit in UNITS else value


class Event:
    """The product's integrator on one problem: its motion, its steps, and its evaluations of the right-hand side."""

    def __init__(self, rotorub, path, sets, folder):
        self.bench = [rotorub, "bench", path, *sets, "--engines", "event", "--repeats", "1", "--json", "--tolerances"]
        run = [rotorub, "run", path, *sets, "--integrator", "event", "--json", "-o", folder]
        self.steps = json.loads(output(run))["steps"]
        self.scene = in_si(tomllib.loads((folder / "scene.toml").read_text()))
        with open(folder / "series.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.motion = [(float(row["t"]), np.array([float(row["rotor_x"]), float(row["rotor_y"])])) for row in rows]
        self.evaluations = LEAST_PER_STEP * self.steps
        if shutil.which("valgrind"):
            # Without rows, as the other solvers have no output either; statistics of contact still need dense output.
            counts, rare = folder / "callgrind.out", f"run.output_step={self.scene['run']['end']}"
            output(["valgrind", "--tool=callgrind", f"--callgrind-out-file={counts}", *run, "--set", rare])
            self.evaluations = calls(counts.read_text(), "rotorub::SmoothSystem::derivative")

    def points(self, tolerances):
        """For each tolerance the steps and the largest error in m, against `event` at 1e-13."""
        [scene] = json.loads(output([*self.bench, ",".join(map(str, tolerances))]))["scenes"]
        return [(point["steps"], point["position_error"]) for point in scene["points"]]


def calls(text, function):
    """How often a function is called in a callgrind file, which names each function once and then has its number."""
    numbers = re.findall(r"^c?fn=\((\d+)\) " + re.escape(function), text, re.MULTILINE)
    all_calls = re.findall(r"^cfn=\((\d+)\).*\ncalls=(\d+)", text, re.MULTILINE)
    return sum(int(count) for number, count in all_calls if number in numbers)


def measure(rotorub, names=tuple(PROBLEMS), methods=tuple(METHODS), tolerances=TOLERANCES, end=None):
    """For each problem and method a list of (tolerance, steps, evaluations, error). end: s, in the place of the problem's."""
    found = {}
    for name in names:
        file, settings = PROBLEMS[name]
        sets = [word for value in settings + ([f"run.end={end}"] if end else []) for word in ("--set", value)]
        with tempfile.TemporaryDirectory() as folder:
            event = Event(rotorub, MJCF / file, sets, pathlib.Path(folder))
            machine = Machine(rotorub, MJCF / file, sets, event.scene)
            # The scale of the errors from a first run, and the reference from a second one.
            _, ends, _ = solve(machine, "DOP853", 1e-6, np.maximum(1e-6, machine.start))
            size = max(np.hypot(*place) for _, place in ends)
            scale = np.concatenate([np.full(machine.n, size), np.full(machine.n, machine.fastest), [machine.start[-1]]])
            _, _, pieces = solve(machine, "DOP853", 3e-14, scale, keep=True)
            times = np.array([end for end, _ in pieces])

            def error(ends):
                """Largest distance from the reference, relative to the largest deflection."""
                at = [pieces[min(np.searchsorted(times, t), len(pieces) - 1)][1](t) for t, _ in ends]
                return max(np.hypot(*(place - machine.rotor @ y[:machine.n])) for (_, place), y in zip(ends, at)) / size

            per_step = event.evaluations / event.steps
            found[name, "`event`"] = [(tolerance, steps, round(per_step * steps), off / size)
                                      for tolerance, (steps, off) in zip(tolerances, event.points(tolerances))]
            found[name, "difference"] = error(event.motion)
            for method in methods:
                rows = found[name, method] = []
                for tolerance in tolerances:
                    if method != "Radau" or tolerance > 1e-9:  # of order 5: below, it takes too many steps
                        steps, ends, _ = solve(machine, method, tolerance, scale)
                        rows.append((tolerance, steps, machine.evaluations, error(ends)))
    return found


def work_for(rows, error):
    """Evaluations for an error, between the rows by their logarithms; None beyond them."""
    points = sorted((np.log(off), np.log(work)) for _, _, work, off in rows)
    errors, works = zip(*points)
    inside = errors[0] <= np.log(error) <= errors[-1]
    return float(np.exp(np.interp(np.log(error), errors, works))) if inside else None


def markdown(header, rows):
    """The lines of a table."""
    return ["| " + " | ".join(cells) + " |" for cells in (header, ["---"] * len(header), *rows)]


def table(measured, tolerances=TOLERANCES, error=EQUAL_ERROR):
    """Both tables as Markdown: everything, and the evaluations for one error as multiples of those of `event`."""
    methods = list(dict.fromkeys(method for _, method in measured if method != "difference"))
    header, full, equal = [f"{tolerance:.0e}".replace("e-0", "e-") for tolerance in tolerances], [], []
    for name in dict.fromkeys(name for name, _ in measured):
        for method in methods:
            rows = measured[name, method]
            cells = [f"{steps:,} steps, {work:,}, {off:.1e}".replace("e-0", "e-") for _, steps, work, off in rows]
            full.append([name, method, *cells, *[""] * (len(tolerances) - len(cells))])
        works = [work_for(measured[name, method], error) for method in methods]
        ratios = [f"{work / works[0]:.2f}" if work and works[0] else "" for work in works[1:]]
        equal.append([name, *ratios, f"{measured[name, 'difference']:.1e}"])
    first = markdown(["", "", *header], full)
    second = markdown([f"for an error of {error:.0e}", *methods[1:], "`event` off the reference"], equal)
    return "\n".join([*first, "", *second])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rotorub")
    parser.add_argument("--short", action="store_true", help="two problems over 10 ms, by two methods at two tolerances")
    given = parser.parse_args()
    if given.short:
        print(table(measure(given.rotorub, **SHORT), SHORT["tolerances"]))
    else:
        print(table(measure(given.rotorub)))


if __name__ == "__main__":
    main()
