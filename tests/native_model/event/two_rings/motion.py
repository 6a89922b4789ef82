"""A rotor in two auxiliary bearings, from event to event: the integration between events (scipy's
DOP853), where an event is, and what it changes. The mechanics are in system.py, the laws of contact
in laws.py."""
import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq, minimize_scalar

from laws import MINUS, OPEN, PLUS, SIGN, STICK, coulomb, coulomb_case, enumerate_cases, expansion
from laws import solve
from system import System

REST = 1e-3                     # of the speed without a rebound: leaving no faster than this is staying
NO_SLIP = 1e-11                 # m/s: a smaller slip is none
SAME_TIME = 1e-9                # of the time since the last event: closer touches are one impact
COUNTED = 1e-4                  # m/s: a faster approach counts as an impact
NAME = {OPEN: "free", STICK: "stick", PLUS: "slide", MINUS: "slide"}


class Run:
    """The unknowns z are the way since the last event, the velocity, and integrals (work of what
    has no potential, impulses of lasting contacts), over the time tau since that event: a bounce
    of 1e-9 m/s, 1e-19 m high, is then as exact as any other."""

    def __init__(self, scene, tolerance, plastic):
        self.s, self.tolerance, self.plastic = System(scene), tolerance, plastic
        self.t, self.q, self.v = 0.0, self.s.q.copy(), self.s.v.copy()
        self.modes = [OPEN] * self.s.count
        self.gaps = [self.s.gap(k, self.q) for k in range(self.s.count)]
        assert min(self.gaps) > 0, "the run must begin without contact"
        self.impulse = np.zeros(2 * self.s.count)               # N, T, N, T of the contacts, so far
        self.first_energy, self.work = self.s.energy(self.q, self.v), 0.0
        self.impacts, self.events, self.rows = [], [], []
        self.drift = 0.0                                        # m, largest gap of a closed contact
        for time in sorted(scene["run"]["output_times"]):
            while self.t < time:
                self.advance(time)
            self.rows.append(self.figures(time))

    # ------------------------------------------------------------------------ motion between events
    def closed(self):
        return [k for k, mode in enumerate(self.modes) if mode != OPEN]

    def state(self, z):
        n = self.s.size
        return self.q + z[:n], z[n:2 * n]

    def motion(self, tau, z):
        """q'' and the contact forces (N, T, N, T ..) while no mode changes."""
        s, closed, t = self.s, self.closed(), self.t + tau
        q, v = self.state(z)
        acceleration, force = s.free_acceleration(t, q, v), np.zeros(2 * s.count)
        power = v @ s.turning_force(t) - v @ s.D @ v
        if closed:
            W, _, without, A = s.stacked(closed, t, q, v)
            x = solve([coulomb_case(self.modes[k], s.mu[k]) for k in closed], without, A)
            acceleration += s.inverse @ W.T @ x
            force.reshape(-1, 2)[closed] = x.reshape(-1, 2)
            power += x @ W @ v
        return acceleration, force, power

    def derivative(self, tau, z):
        acceleration, force, power = self.motion(tau, z)
        return np.concatenate([self.state(z)[1], acceleration, [power], force])

    def integrator(self, tau, z, end):
        n, rest = self.s.size, 1 + 2 * self.s.count
        size = np.concatenate([np.full(n, 1e-4), np.full(n, 1e-1), np.full(rest, 1e-1)])
        return DOP853(self.derivative, tau, z, end, rtol=self.tolerance, atol=self.tolerance * size)

    def gap(self, k, z):
        """From the way since the last event: no round-off where it began at 0."""
        way, old = self.s.B[k] @ z[:self.s.size], self.s.B[k] @ self.q - self.s.offset[k]
        both = np.hypot(*old) + np.hypot(*(old + way))
        return self.gaps[k] - ((2 * old + way) @ way / both if both > 0 else 0.0)

    def watched(self):
        """(contact, event, f, f'): it comes as f(tau, z) falls below 0; f' where it is at hand."""
        def rows(k, z):
            return self.s.rows(k, *self.state(z))

        def slip_change(k, tau, z):
            W, _, rest = rows(k, z)
            return W[1] @ self.motion(tau, z)[0] + rest[1]

        def force(k, of_n, of_t):
            return lambda tau, z: np.dot([of_n, of_t], self.motion(tau, z)[1][2 * k:2 * k + 2])

        for k, mode in enumerate(self.modes):
            mu, s = self.s.mu[k], SIGN.get(mode)
            if mode == OPEN:
                yield (k, "touch", lambda tau, z, k=k: self.gap(k, z),
                       lambda tau, z, k=k: rows(k, z)[1][0])
            elif mode == STICK:
                yield k, MINUS, force(k, mu, -1.0), None
                yield k, PLUS, force(k, mu, 1.0), None
            else:
                yield k, "leave", force(k, 1.0, 0.0), None
                if mu > 0:
                    yield (k, "halt", lambda tau, z, k=k, s=s: s * rows(k, z)[1][1],
                           lambda tau, z, k=k, s=s: s * slip_change(k, tau, z))

    # ----------------------------------------------------------------------------- up to an event
    def advance(self, time):
        """To the next event, and through it, or to `time`."""
        watched, length = list(self.watched()), time - self.t
        z = np.concatenate([np.zeros(self.s.size), self.v, np.zeros(1 + 2 * self.s.count)])
        run = self.integrator(0.0, z, length)
        while run.status == "running":
            before = run.y.copy()
            run.step()
            assert run.status != "failed", f"the integration fails at {self.t + run.t} s"
            dense = run.dense_output()
            found = [(first_below(f, rate, dense, run.t_old, run.t), i)
                     for i, (_, _, f, rate) in enumerate(watched)]
            found = [event for event in found if event[0] is not None]
            if found:
                tau, i = min(found)
                k, kind, f, rate = watched[i]
                z, tau = self.exactly(run.t_old, before, tau, f, rate)
                self.take(tau, z)
                modes = list(self.modes)
                self.change(k, kind, tau)
                self.events += [(self.t, j) for j, (old, new) in enumerate(zip(modes, self.modes))
                                if old != new]
                return
        self.take(length, run.y)
        self.t = time

    def exactly(self, tau, z, event, f, rate):
        """The state at an event: integrated to it, as the dense output is coarser, and Newton."""
        if event > tau:
            run = self.integrator(tau, z, event)
            while run.status == "running":
                run.step()
            tau, z = event, run.y.copy()
        for _ in range(3 if rate else 0):
            slope = rate(tau, z)
            by = -f(tau, z) / slope if slope < 0 else 0.0
            by = by if abs(by) < 1e-6 * tau else 0.0            # grazing: it is where it is
            z, tau = z + by * self.derivative(tau, z), tau + by
        return z, tau

    def take(self, tau, z):
        n = self.s.size
        self.gaps = [self.gap(k, z) if mode == OPEN else 0.0 for k, mode in enumerate(self.modes)]
        self.q, self.v = self.state(z)
        self.t += tau
        self.work += z[2 * n]
        self.impulse += z[2 * n + 1:]
        self.project()

    def project(self):
        """Of the closed contacts: gap 0, gap rate 0, and no slip where they stick."""
        s, closed = self.s, self.closed()
        if closed:
            W = np.array([s.rows(k, self.q, self.v)[0][0] for k in closed])
            gaps = np.array([s.gap(k, self.q) for k in closed])
            self.drift = max(self.drift, np.abs(gaps).max())
            self.q = self.q - s.inverse @ W.T @ least_norm(W @ s.inverse @ W.T, gaps)
            self.stop([(k, 0) for k in closed] + [(k, 1) for k in closed if self.modes[k] == STICK])

    def stop(self, which):
        """No gap rate (k, 0), no slip (k, 1)."""
        rows = [(self.s.rows(k, self.q, self.v), part) for k, part in which]
        W = np.array([row[0][part] for row, part in rows])
        y = np.array([row[1][part] for row, part in rows])
        self.v = self.v - self.s.inverse @ W.T @ least_norm(W @ self.s.inverse @ W.T, y)

    # --------------------------------------------------------------------------- what an event does
    def change(self, k, kind, tau):
        closed = self.closed()
        if kind == "touch":
            also = [j for j in range(self.s.count) if j != k and self.modes[j] == OPEN and
                    self.gaps[j] <= -SAME_TIME * tau * self.s.rows(j, self.q, self.v)[1][0]]
            self.impact(closed, [k] + also)
        elif kind == "leave":                                   # the forces of the others go on
            self.set_mode(k, OPEN)
        elif kind in SIGN:                                      # sticks no longer: so do they here
            self.set_mode(k, kind)
        else:
            self.rest(closed)

    def set_mode(self, k, mode):
        self.modes[k], self.gaps[k] = mode, 0.0

    def impact(self, resting, hit):
        s, contacts = self.s, sorted(resting + hit)
        W, y, _, A = s.stacked(contacts, self.t, self.q, self.v)
        for i, k in enumerate(contacts):
            y[2 * i] = min(y[2 * i], 0.0) if k in hit else 0.0
            y[2 * i + 1] = 0.0 if abs(y[2 * i + 1]) < NO_SLIP else y[2 * i + 1]
        before = y
        _, total, y = enumerate_cases([coulomb(s.mu[k]) for k in contacts], y, A, 1e-13)
        if before[0::2].min() <= -self.plastic:
            total[np.abs(total) < 1e-13 * np.abs(total).max()] = 0.0
            laws = [expansion(s.mu[k], s.eps[k], s.eps_t[k], total[2 * i:2 * i + 2])
                    for i, k in enumerate(contacts)]
            _, more, y = enumerate_cases(laws, y, A, 1e-13)
            total = total + more
        gain = 0.5 * total @ (before + y)
        assert gain < 1e-12 * np.abs(total).max() * np.abs(before).max(), "an impact gains energy"

        # The work on the coordinates: with the spin held, the motor's is in it.
        self.work += total @ W @ self.v + 0.5 * total @ A @ total
        self.v = self.v + s.inverse @ W.T @ total
        for i, k in enumerate(contacts):
            self.impulse[2 * k:2 * k + 2] += total[2 * i:2 * i + 2]
            self.impacts.append((self.t, k, before[2 * i]))
            self.set_mode(k, OPEN)
        self.rest([k for i, k in enumerate(contacts) if y[2 * i] < REST * self.plastic])

    def rest(self, contacts):
        """By accelerations: who of them stays, and how."""
        if not contacts:
            return
        self.stop([(k, 0) for k in contacts])
        _, y, without, A = self.s.stacked(contacts, self.t, self.q, self.v)
        laws = [coulomb(self.s.mu[k], slip if abs(slip) >= NO_SLIP else 0.0)
                for k, slip in zip(contacts, y[1::2])]
        modes, _, _ = enumerate_cases(laws, without, A, 1e-12 + 1e-9 * np.abs(without).max())
        for k, mode in zip(contacts, modes):
            self.set_mode(k, mode)
        self.project()

    # -------------------------------------------------------------------------------- what is kept
    def figures(self, time):
        """By the names of the product's columns."""
        s, n = self.s, self.s.n
        names = {f"{letter}_{i + 1}": (f"v{letter}_{i + 1}", plane * n + i)
                 for plane, letter in enumerate("xy") for i in range(n)}
        if s.spin is not None:
            names["spin_angle"] = "spin_speed", s.spin
        for k, ring in enumerate(s.ring):
            for axis, letter in enumerate("xy" if ring is not None else ""):
                names[f"{prefix(k)}stator_{letter}"] = f"{prefix(k)}stator_v{letter}", ring + axis
        state = {}
        for name, (rate, index) in names.items():
            state[name], state[rate] = float(self.q[index]), float(self.v[index])
        modes = {f"{prefix(k)}mode": NAME[mode] for k, mode in enumerate(self.modes)}
        return {"t": time, "state": state, "modes": modes}

    def summary(self):
        """Figures of the whole run, a list of numbers a contact."""
        count = range(self.s.count)
        hard = [[-i[2] for i in self.impacts if i[1] == k and i[2] < -COUNTED] for k in count]
        return {"impacts": [len(rates) for rates in hard],
                "normal_impulse": self.impulse[0::2].tolist(),
                "friction_impulse": self.impulse[1::2].tolist(),
                "last_impact": [max((i[0] for i in self.impacts if i[1] == k), default=0.0)
                                for k in count]}

    def own_checks(self):
        """How far the run may be trusted, and how near its questions of yes or no were."""
        times = [event[0] for event in self.events + self.impacts]
        energy = self.s.energy(self.q, self.v)
        return {"energy_residual": float(energy - self.first_energy - self.work),
                "largest_drift": float(self.drift), "all_impacts": len(self.impacts),
                "all_mode_changes": len(self.events),
                "nearest_rate_to_count": min(abs(-i[2] / COUNTED - 1) for i in self.impacts),
                "nearest_event_to_row": min(abs(t - row["t"]) for t in times for row in self.rows)}


def prefix(k):
    return f"contact{k + 1}_" if k else ""


def least_norm(A, y):
    return np.linalg.lstsq(A, y, rcond=1e-11)[0]


def first_below(f, rate, dense, a, b, pieces=8):
    """First time in (a, b] at which f falls below 0 (it may begin at 0 and rise), or None."""
    def value(tau):
        return f(tau, dense(tau))

    def slope(tau):
        return rate(tau, dense(tau))

    def root(function, left, right):
        return brentq(function, left, right, xtol=1e-28, rtol=1e-15, maxiter=1000, disp=False)

    times = a + (b - a) * np.arange(pieces + 1) / pieces
    values = [value(tau) for tau in times]
    for i in range(pieces):
        left, right, low, high = times[i], times[i + 1], values[i], values[i + 1]
        if high < 0 and low > 0:
            return root(value, left, right)
        if high < 0:                                            # from 0: a bounce within the piece?
            if rate and slope(left) > 0 > slope(right):
                top = root(slope, left, right)
                return root(value, top, right) if value(top) > 0 else left
            return left
        if low > 0 and rate and slope(left) < 0 < slope(right):  # a dip between two samples
            bottom = root(slope, left, right)
            if value(bottom) < 0:
                return root(value, left, bottom)
        if not rate and i and values[i - 1] >= low <= high and 2 * low < high + values[i - 1]:
            bottom = minimize_scalar(value, bounds=(times[i - 1], right), method="bounded").x
            if low > 0 > value(bottom):
                return root(value, times[i - 1], bottom)
    return None
