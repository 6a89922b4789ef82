"""The laws of contact as lists of cases, and the search through all combinations of them.

Of one contact, y = (g_N', g_T') and x = (normal, tangential impulse); or g'' and forces. A case is
a name, two linear equations (= 0) and some inequalities (>= 0); each row holds the factors of y_N,
y_T, x_N, x_T, and what is taken off. Several contacts: y = y0 + A x, A the Delassus matrix.
"""
import itertools

import numpy as np

OPEN, STICK, PLUS, MINUS = "open", "stick", "slide+", "slide-"
SIGN = {PLUS: 1.0, MINUS: -1.0}


def coulomb_case(mode, mu, known=False):
    if mode == OPEN:
        return mode, [(0, 0, 1, 0, 0), (0, 0, 0, 1, 0)], [(1, 0, 0, 0, 0)]
    if mode == STICK:
        return (mode, [(1, 0, 0, 0, 0), (0, 1, 0, 0, 0)],
                [(0, 0, 1, 0, 0), (0, 0, mu, 1, 0), (0, 0, mu, -1, 0)])
    s = SIGN[mode]
    slips_on = [] if known else [(0, s, 0, 0, 0)]
    return mode, [(1, 0, 0, 0, 0), (0, 0, s * mu, 1, 0)], [(0, 0, 1, 0, 0)] + slips_on


def coulomb(mu, slip=0.0):
    """Compression (velocities), or who stays (accelerations; a slip that is there goes on)."""
    if slip != 0.0:
        return [coulomb_case(mode, mu, known=True) for mode in (OPEN, PLUS if slip > 0 else MINUS)]
    modes = (OPEN, STICK, PLUS, MINUS) if mu > 0 else (OPEN, PLUS, MINUS)
    return [coulomb_case(mode, mu) for mode in modes]


def expansion(mu, eps, eps_t, compression):
    """Poisson's law, along the tangent with Beitelschmidt's; `compression`: its two impulses."""
    least_n, least_t = eps * compression[0], eps * eps_t * abs(compression[1])
    normal = [([(0, 0, 1, 0, least_n)], [(1, 0, 0, 0, 0)]),
              ([(1, 0, 0, 0, 0)], [(0, 0, 1, 0, least_n)])]
    s = np.sign(compression[1])
    if s == 0:
        tangent = [([(0, 1, 0, 0, 0)], [(0, 0, mu, 1, 0), (0, 0, mu, -1, 0)]),
                   ([(0, 0, mu, 1, 0)], [(0, 1, 0, 0, 0)]),
                   ([(0, 0, -mu, 1, 0)], [(0, -1, 0, 0, 0)])]
    else:
        tangent = [([(0, 0, -mu, s, 0)], [(0, -s, 0, 0, 0)]),
                   ([(0, 1, 0, 0, 0)], [(0, 0, 0, s, least_t), (0, 0, mu, -s, 0)]),
                   ([(0, 0, 0, s, least_t)], [(0, s, 0, 0, 0)])]
    return [("", n[0] + t[0], n[1] + t[1]) for n in normal for t in tangent]


def stack(groups):
    """Rows of each contact -> (of all y, of all x, right-hand side)."""
    total = sum(len(group) for group in groups)
    of_y, of_x = np.zeros((total, 2 * len(groups))), np.zeros((total, 2 * len(groups)))
    numbered = [(k, row) for k, group in enumerate(groups) for row in group]
    for i, (k, row) in enumerate(numbered):
        of_y[i, 2 * k:2 * k + 2], of_x[i, 2 * k:2 * k + 2] = row[:2], row[2:4]
    return of_y, of_x, np.array([row[4] for _, row in numbered])


def solve(cases, y0, A):
    """x of one combination, of least norm where it is not unique; nan where there is none."""
    of_y, of_x, right = stack([case[1] for case in cases])
    matrix, right = of_y @ A + of_x, right - of_y @ y0
    size = np.abs(matrix).max(axis=1)                       # velocities and impulses in one size
    matrix, right = matrix / size[:, None], right / size
    if np.linalg.cond(matrix) < 1e10:
        return np.linalg.solve(matrix, right)
    x = np.linalg.lstsq(matrix, right, rcond=1e-11)[0]
    return x if np.allclose(matrix @ x, right, rtol=1e-9, atol=1e-12) else np.full(len(y0), np.nan)


class Ambiguous(RuntimeError):
    """No combination of cases fits, or two that move differently."""


def enumerate_cases(laws, y0, A, floor):
    """Names, x and y of the combination that holds; y below `floor` 1e-9 is round-off."""
    found, impulse_size = [], np.abs(np.diag(A)).mean()
    for cases in itertools.product(*laws):
        x = solve(cases, y0, A)
        if np.isnan(x).any():
            continue
        y = y0 + A @ x
        of_y, of_x, right = stack([case[2] for case in cases])
        short = max(0.0, -(of_y @ y + impulse_size * (of_x @ x - right)).min())
        found.append((short, len(found), [case[0] for case in cases], x, y))
    if not found:
        raise Ambiguous("no combination of cases can be solved")
    short, _, names, x, y = min(found, key=lambda f: f[:2])
    size = np.abs(A @ x).max() + floor
    if short > 1e-9 * size:
        raise Ambiguous(f"no solution: {names}, the nearest, fails by {short:.2e} of {size:.2e}")
    for other in found:
        if other[0] == 0.0 and np.abs(other[4] - y).max() > 1e-7 * size:
            raise Ambiguous(f"two motions: {names} to {y}, {other[2]} to {other[4]}")
    for k, name in enumerate(names):                            # exactly 0 where the case says so
        y[2 * k] = 0.0 if name in (STICK, PLUS, MINUS) else y[2 * k]
        y[2 * k + 1] = 0.0 if name == STICK else y[2 * k + 1]
    return names, x, y
