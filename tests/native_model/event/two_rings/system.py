"""A rotor and its rings as matrices.

Coordinates q: x_1.., y_1.. (bending modes in two planes), the spin angle where it is free, then X,
Y of each ring that moves, from where it rests. Omega is rotor.speed, or the speed of a free spin:
    M q'' = f(t) - K q - (D + Omega G) q' + sum_k (W_N,k^T lambda_N,k + W_T,k^T lambda_T,k)
Contact k: d = B_k q - offset, delta = |d|, e_r = d/delta, e_t = e_z x e_r, v_t = e_t.d'
    g_N   = clearance - delta
    g_N'  = W_N q'            = -e_r.d'
    g_T'  = W_T q'            = e_t.d' + r Omega     (held: W_T without the spin, and + r Omega)
    g_N'' = W_N q'' - v_t^2/delta
    g_T'' = W_T q'' + (v_t/delta) g_N'
"""
import numpy as np


class System:
    """Of a scene: a TOML table, numbers in SI without units, drive none, "free" or "linear"."""

    def __init__(self, scene):
        modal, contacts = scene["rotor"]["modal"], scene["contact"]
        rings = [contact.get("stator") for contact in contacts]
        free = "drive" in scene
        self.n = n = len(modal["mass"])
        self.spin = 2 * n if free else None
        self.size = size = 2 * n + free + 2 * sum(ring is not None for ring in rings)
        self.speed = scene["rotor"].get("speed", 0.0)

        # The rotor: both planes alike; gyroscopic force on x: -Omega g vy, on y: +Omega g vx.
        mass, stiffness, damping = np.zeros(size), np.zeros(size), np.zeros(size)
        for values, key in (mass, "mass"), (stiffness, "stiffness"), (damping, "damping"):
            values[:2 * n] = np.tile(modal.get(key, np.zeros(n)), 2)
        self.G = np.zeros((size, size))
        self.G[:n, n:2 * n] = np.diag(modal.get("gyroscopic", np.zeros(n)))
        self.G[n:2 * n, :n] = -self.G[:n, n:2 * n]
        self.q, self.v, self.constant = np.zeros(size), np.zeros(size), np.zeros(size)
        start = scene.get("initial", {})
        for values, keys in (self.q, ("x", "y")), (self.v, ("vx", "vy")):
            for plane, key in enumerate(keys):
                values[plane * n:(plane + 1) * n] = start.get(key, np.zeros(n))
        if free:
            gain = scene["drive"].get("gain", 0.0)              # torque gain (speed - Omega)
            mass[self.spin], damping[self.spin] = modal["inertia"], gain
            self.constant[self.spin] = gain * scene["drive"].get("speed", 0.0)
            self.v[self.spin] = self.speed

        # The contacts, and the rings that move.
        self.B, self.ring, at = [], [], 2 * n + free
        for contact, ring in zip(contacts, rings):
            B = self.at_station(contact)
            self.ring.append(None if ring is None else at)
            if ring is not None:
                two = slice(at, at + 2)
                B[:, two] = -np.eye(2)
                mass[two], stiffness[two] = ring["mass"], ring["stiffness"]
                damping[two] = ring.get("damping", 0.0)
                self.q[two] = ring.get("position", [0.0, 0.0])
                self.v[two] = ring.get("velocity", [0.0, 0.0])
                at += 2
            self.B.append(B)
        self.count = len(contacts)
        self.offset = [np.array(contact.get("offset", [0.0, 0.0])) for contact in contacts]
        self.radius, self.clearance, self.mu, self.eps = (
            [contact[key] for contact in contacts]
            for key in ("radius", "clearance", "friction", "restitution"))
        self.eps_t = [contact.get("tangential_restitution", 0.0) for contact in contacts]
        self.M, self.K, self.D = np.diag(mass), np.diag(stiffness), np.diag(damping)
        self.inverse = np.linalg.inv(self.M)

        # Loads: weight (a ring has its own), and forces that turn.
        if "gravity" in scene:
            acceleration = np.array(scene["gravity"]["acceleration"])
            load = scene["gravity"].get("participation", modal["mass"])
            self.constant[:2 * n] += np.kron(acceleration, load)
            for at in (at for at in self.ring if at is not None):
                self.constant[at:at + 2] += mass[at:at + 2] * acceleration
        self.turning = []
        for force in scene.get("force", []):
            assert force["kind"] == "rotating" and not {"on", "off", "ramp"} & set(force)
            self.turning.append((force["amplitude"] * self.at_station(force), force["frequency"],
                                 force.get("phase", 0.0)))

    def at_station(self, table):
        """2 x size: the rotor's deflection where the modes have the values `shape`."""
        B = np.zeros((2, self.size))
        B[0, :self.n] = B[1, self.n:2 * self.n] = table.get("shape", np.ones(self.n))
        return B

    def turning_force(self, t):
        total = np.zeros(self.size)
        for B, frequency, phase in self.turning:
            angle = frequency * t + phase
            total += np.array([np.cos(angle), np.sin(angle)]) @ B
        return total

    def energy(self, q, v):
        """Kinetic energy and potential, of springs and constant loads."""
        return 0.5 * v @ self.M @ v + 0.5 * q @ self.K @ q - self.constant @ q

    def omega(self, v):
        return self.speed if self.spin is None else v[self.spin]

    def gap(self, k, q):
        return self.clearance[k] - np.hypot(*(self.B[k] @ q - self.offset[k]))

    def rows(self, k, q, v):
        """W (N and T row), (g_N', g_T'), and what (g_N'', g_T'') have without q''."""
        d, rate = self.B[k] @ q - self.offset[k], self.B[k] @ v
        delta = np.hypot(*d)
        if delta == 0.0:                                        # no direction, and no contact
            return np.zeros((2, self.size)), np.zeros(2), np.zeros(2)
        e_r = d / delta
        e_t = np.array([-e_r[1], e_r[0]])
        W = np.array([-e_r @ self.B[k], e_t @ self.B[k]])
        if self.spin is not None:
            W[1, self.spin] = self.radius[k]
        v_t = e_t @ rate
        y = np.array([-e_r @ rate, v_t + self.radius[k] * self.omega(v)])
        return W, y, np.array([-v_t * v_t, v_t * y[0]]) / delta

    def free_acceleration(self, t, q, v):
        force = self.constant + self.turning_force(t) - self.K @ q
        return self.inverse @ (force - (self.D + self.omega(v) * self.G) @ v)

    def stacked(self, contacts, t, q, v):
        """Of contacts: W, g' (N, T, N, T ..), g'' without their forces, Delassus' matrix."""
        W, y, rest = zip(*(self.rows(k, q, v) for k in contacts))
        W = np.vstack(W)
        without = W @ self.free_acceleration(t, q, v) + np.concatenate(rest)
        return W, np.concatenate(y), without, W @ self.inverse @ W.T
