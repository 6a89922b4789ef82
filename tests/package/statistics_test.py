"""Drawn points and their statistics beside scipy's."""

import json

import numpy
import scipy.stats
import unittest
from product import SOURCE, InAFolder

SCENE = SOURCE / "mjcf" / "bench_ring.toml"
RUN = '[run]\nintegrator = "verlet"\nstep = "100 us"\nend = "20 ms"\n'
DRAWN = """
[[vary]]
key = "contact.friction"
distribution = "normal"
mean = 0.3
deviation = 0.05
from = 0.2
[[vary]]
key = "force[0].amplitude"
distribution = "weibull"
scale = 150.0
shape = 2.0
[[vary]]
key = "stator.stiffness"
distribution = "lognormal"
median = "100 kN/m"
log_deviation = 0.2
[[vary]]
key = "stator.damping"
distribution = "triangular"
from = 100.0
mode = 200.0
to = 400.0
[[vary]]
key = "contact.restitution"
values = [0.2, 0.8]
"""


class Statistics(InAFolder):
    def sweep(self, kind, runs, vary, more=""):
        (self.folder / "study.toml").write_text(
            f'scene = "{SCENE}"\n[sample]\nkind = "{kind}"\nruns = {runs}\nseed = 3\n{vary}{RUN}{more}')
        self.rotorub("sweep", "study.toml", "-o", kind, "-q")
        return self.table(f"{kind}/results.csv")

    def test_the_values_have_their_distributions(self):
        rows = self.sweep("random", 4000, DRAWN)
        column = lambda key: numpy.array([float(row[key]) for row in rows])
        laws = {"contact.friction": scipy.stats.truncnorm(-2.0, numpy.inf, 0.3, 0.05),
                "force[0].amplitude": scipy.stats.weibull_min(2.0, scale=150.0),
                "stator.stiffness": scipy.stats.lognorm(0.2, scale=1e5),
                "stator.damping": scipy.stats.triang(1.0 / 3.0, 100.0, 300.0)}
        for key, law in laws.items():
            self.assertGreater(scipy.stats.kstest(column(key), law.cdf).pvalue, 1e-3, key)
        # Independent: each correlation within four standard deviations.
        table = numpy.array([scipy.stats.rankdata(column(key)) for key in [*laws, "contact.restitution"]])
        correlation = numpy.corrcoef(table) - numpy.eye(len(table))
        self.assertLess(abs(correlation).max(), 4.0 / len(rows) ** 0.5)

    def test_statistics_of_groups(self):
        rows = self.sweep("random", 150, DRAWN, '[statistics]\nby = ["contact.restitution"]\nconfidence = 0.9\n'
                          'figures = ["status", "attractor", "mean_force"]\nquantiles = [0.1, 0.5, 0.99]\n')
        found = {(row["contact.restitution"], row["figure"], row["statistic"]): row for row in self.table("random/statistics.csv")}
        names = [c["name"] for c in json.loads((self.folder / "random" / "columns.json").read_text())["statistics.csv"]]
        self.assertEqual(names, list(next(iter(found.values()))))
        page = (self.folder / "random" / "sweep.html").read_text()
        self.assertIn('"confidence":0.9', page)

        def near(text, value):
            self.assertAlmostEqual(float(text), value, delta=1e-9 * max(abs(value), 1e-3))

        for group in ("0.2", "0.8"):
            own = [row for row in rows if float(row["contact.restitution"]) == float(group)]
            force = numpy.array([float(row["mean_force"]) for row in own if row["mean_force"]])
            for p in (0.1, 0.5, 0.99):
                row = found[group, "mean_force", f"quantile {p}"]
                self.assertEqual(int(row["count"]), len(force))
                near(row["value"], numpy.quantile(force, p))
                # Of the n + 1 gaps between the sorted values, the p-quantile lies above the first l with binom.cdf(l - 1).
                below = scipy.stats.binom.cdf(numpy.arange(-1, len(force) + 1), len(force), p)
                ends = numpy.sort(force)
                low = numpy.flatnonzero(below <= 0.05)[-1]
                high = numpy.flatnonzero(below >= 0.95)[0]
                for word, place in (("low", low), ("high", high)):
                    if 1 <= place <= len(force):
                        near(row[word], ends[place - 1])
                    else:
                        self.assertEqual(row[word], "", (group, p, word))
            mean = found[group, "mean_force", "mean"]
            low, high = scipy.stats.t.interval(0.9, len(force) - 1, force.mean(), scipy.stats.sem(force))
            near(mean["value"], force.mean())
            near(mean["low"], low)
            near(mean["high"], high)
            near(found[group, "mean_force", "deviation"]["value"], force.std(ddof=1))
            for word in {row["attractor"] for row in own}:
                hits = sum(row["attractor"] == word for row in own)
                exact = scipy.stats.binomtest(hits, len(own)).proportion_ci(0.9, "exact")
                share = found[group, "attractor", f"share {word}"]
                near(share["value"], hits / len(own))
                near(share["low"], exact.low)
                near(share["high"], exact.high)

    def test_other_statistics_need_no_other_run(self):
        vary = '[[vary]]\nkey = "contact.friction"\nfrom = 0.1\nto = 0.3\n'
        self.sweep("random", 8, vary)
        before = (self.folder / "random" / "results.csv").read_bytes()
        self.sweep("random", 8, vary, '[statistics]\nfigures = ["peak_force"]\n')
        self.assertEqual((self.folder / "random" / "results.csv").read_bytes(), before)
        self.assertTrue((self.folder / "random" / "statistics.csv").exists())

    def test_even_points_have_no_bounds(self):
        self.sweep("latin_hypercube", 20, '[[vary]]\nkey = "contact.friction"\nfrom = 0.1\nto = 0.3\n', "[statistics]\n")
        self.assertTrue(all(row["low"] == row["high"] == "" for row in self.table("latin_hypercube/statistics.csv")))


if __name__ == "__main__":
    unittest.main()
