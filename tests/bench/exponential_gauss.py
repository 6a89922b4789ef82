"""An exponential integrator with the interface of scipy's solvers, for work_precision.py.

Exponential Runge-Kutta method of collocation type (M. Hochbruck, A. Ostermann, Exponential integrators, Acta Numerica 19,
2010, section 2; and Appl. Numer. Math. 53, 2005), linearised anew in each step as the exponential Rosenbrock methods
there: with the Jacobian J at the start of the step, f(t, y) - J y is interpolated at 5 Gauss nodes, and y' = J y + that
polynomial is solved exactly. Sweeps over the nodes are repeated until the end of the step no longer changes; in flight,
where f - J y depends on time alone, one sweep is exact. The order is 10 in steps that resolve the motion, and at least
the number of nodes if fast modes are not resolved.
"""

import numpy as np


class ExponentialGauss:
    """Integrates machine.derivative from (t, y) to `end`, with h as the first step. The errors count relative to `scale`.
    fixed: J is always that of flight, so the matrix functions need one decomposition in the whole run."""

    NODES = 5
    X, _ = np.polynomial.legendre.leggauss(NODES)
    X = 0.5 * (1.0 + X)

    def __init__(self, machine, t, y, end, tolerance, scale, h, fixed=False):
        self.fixed = fixed
        self.machine, self.t, self.y, self.end, self.h_next = machine, t, y, end, h
        self.tolerance, self.scale, self.last, self.status = tolerance, scale, None, "running"
        rates = np.sqrt(np.abs(np.diag(machine.A[machine.n:-1, :machine.n])))  # balances the eigenvectors
        self.balance = np.concatenate([rates, np.ones(machine.n + 1)])

    def weights(self, c, h):
        """e^(c h J), and the integrals of e^((c - s) h J) l_j(s) over s from 0 to c, in the basis of J's eigenvectors."""
        points, weights = np.polynomial.legendre.leggauss(24 + int(np.abs(h * self.eigenvalues).max()))
        s = 0.5 * c[:, None] * (1.0 + points)
        decay = np.exp((c[:, None] - s)[:, :, None] * (h * self.eigenvalues))
        moments = np.einsum("kqj,kqm,kq->kjm", lagrange(self.X, s), decay, 0.5 * c[:, None] * weights)
        return np.exp(np.outer(c, h * self.eigenvalues)), h * moments

    def states(self, weights, rest):
        """The solution at the shares of the step that the weights belong to; rest: f - J y at the nodes."""
        decay, moments = weights
        modal = decay * (self.inverse @ self.y_old) + np.einsum("kjm,jm->km", moments, rest @ self.inverse.T)
        return (modal @ self.vectors.T).real

    def step(self):
        """Takes a step as long as the tolerance allows."""
        machine, self.y_old, self.t_old = self.machine, self.y, self.t
        self.J = machine.A if self.fixed else machine.jacobian(self.t, self.y)
        self.eigenvalues, vectors = np.linalg.eig(self.balance[:, None] * self.J / self.balance)
        self.vectors, self.inverse = vectors / self.balance[:, None], np.linalg.inv(vectors) * self.balance
        first = None if self.last else machine.derivative(self.t, self.y)
        while self.status == "running":
            h = min(self.h_next, self.end - self.t)
            if self.last:  # its polynomials, continued
                slopes, at, h_old = self.last
                ahead = lagrange(self.X, 1.0 + self.X * h / h_old)
                rest = ahead @ slopes - (ahead @ at) @ self.J.T
            else:
                rest = np.tile(first - self.J @ self.y, (self.NODES, 1))
            weights, change = self.weights(np.append(self.X, 1.0), h), None
            new = self.states(weights, rest)
            for _ in range(10):
                at = new[:-1]
                slopes = np.array([machine.derivative(self.t + c * h, y) for c, y in zip(self.X, at)])
                rest, old = slopes - at @ self.J.T, new
                new, last_change = self.states(weights, rest), change
                change = np.max(np.abs(new[-1] - old[-1]) / self.scale)
                rate = change / last_change if last_change else 1.0
                done = machine.mode == "flight" or change * rate < 0.1 * self.tolerance  # f - J y knows no y in flight
                if done or (last_change and rate > 0.7):
                    break
            if not done:
                self.h_next = 0.5 * h
                continue
            # The error is estimated with four nodes, without the middle one; the error of all five is smaller.
            others = np.delete(np.arange(self.NODES), self.NODES // 2)
            coarse = lagrange(self.X[others], self.X) @ rest[others]
            error = np.max(np.abs(self.states(weights, coarse)[-1] - new[-1]) / self.scale) / self.tolerance
            self.h_next = h * np.clip(0.9 * (error + 1e-30) ** (-1.0 / self.NODES), 0.2, 4.0)
            if error <= 1.0:
                self.last, self.rest = (slopes, at, h), rest
                self.t, self.y = (self.end if h >= self.end - self.t else self.t + h), new[-1]
                self.status = "running" if self.t < self.end else "finished"
                return

    def at(self, times):
        """The states at times within the last step; no evaluations."""
        h = self.last[2]
        return self.states(self.weights((np.asarray(times) - self.t_old) / h, h), self.rest)

    def dense_output(self):
        """The solution within the last step, of half the order of the steps."""
        return lambda t: self.at([t])[0]


def lagrange(nodes, at):
    """The Lagrange polynomials of the nodes: the last axis counts the nodes."""
    at = np.asarray(at)[..., None, None]
    different = ~np.eye(nodes.size, dtype=bool)
    ratio = np.where(different, (at - nodes) / np.where(different, nodes[:, None] - nodes, 1.0), 1.0)
    return ratio.prod(axis=-1)
