"""The shipped studies of a researcher: each runs, draws its page, and says what can be known beforehand."""

import json
import math
import re
import tomllib

import scipy.integrate
import scipy.stats
import unittest
from product import SOURCE, InAFolder

STUDIES = SOURCE / "mjcf" / "studies"


# Points of each sweep, and the most evaluations of each search, whose CPU time was measured: see the head of the study.
SIZES = {"design_sobol": 512, "drop": 115, "high_friction": 75, "lead_time": 61, "measured_points": 8, "noise_seeds": 160,
         "optimise_levitation": 25, "optimise_ring": 120, "robustness_cross_coupled": 200, "robustness_passive": 200,
         "robustness_sliding": 200, "robustness_two_phase": 200, "speed_bifurcation": 91, "speed_friction": 775, "tolerances": 1000}
LONGEST = 60  # CPU seconds, as told in the head


def size_of(study):
    """How many points a sweep of the study runs, or an optimisation at most."""
    if "optimise" in study:
        return study["optimise"]["evaluations"]
    sample = study["sample"]
    if sample["kind"] == "list":
        lines = (STUDIES / sample["file"]).read_text().splitlines()
        return sum(bool(line) and line[0] != "#" for line in lines) - 1  # without the header
    if sample["kind"] != "grid":
        return sample["runs"]
    return math.prod(len(vary["values"]) if "values" in vary else vary.get("count") or vary["to"] - vary["from"] + 1
                     for vary in study["vary"])


class Studies(InAFolder):
    def test_each_study_tells_its_size_and_its_time(self):
        """Whoever enlarges a study has to measure it anew: its size stands here and, with its time, in its head."""
        files = sorted(STUDIES.glob("*.toml"))
        self.assertEqual([file.stem for file in files], sorted(SIZES))
        for file in files:
            text = file.read_text()
            size = size_of(tomllib.loads(text))
            self.assertEqual(size, SIZES[file.stem], file.stem)
            head = " ".join(line.removeprefix("# ") for line in text.split("\n\n")[0].splitlines())
            told = re.search(r"(\d+) (?:points|evaluations)(?: and their diagram)? take (?:about|less than) (\d+) CPU seconds?\b", head)
            self.assertTrue(told, f"{file.name}: the head tells no time")
            self.assertEqual(int(told[1]), size, file.stem)
            self.assertLess(int(told[2]), LONGEST, file.stem)

    def sweep(self, name, **changes):
        """Runs it with some numbers changed; the rows of its results and of its statistics."""
        text = (STUDIES / f"{name}.toml").read_text().replace('"../', f'"{STUDIES.parent}/')
        for old, new in changes.values():
            self.assertIn(old, text)
            text = text.replace(old, new)
        (self.folder / f"{name}.toml").write_text(text)
        self.rotorub("sweep", f"{name}.toml", "-o", name, "-q")
        self.assertIn("<!doctype html>", (self.folder / name / "sweep.html").read_text()[:20])
        statistics = self.folder / name / "statistics.csv"
        return self.table(f"{name}/results.csv"), self.table(statistics) if statistics.exists() else []

    def test_tolerances(self):
        rows, statistics = self.sweep("tolerances")
        self.assertEqual(len(rows), 1000)
        # A rotor that does not reach its ring: |k - m w^2 + i d w| c is the force that takes it there.
        w = 100.0 * math.pi
        stiffness = math.hypot(2e5 - 2.0 * w * w, 40.0 * w)
        clearance = scipy.stats.norm(0.5e-3, 30e-6)
        free = scipy.integrate.quad(lambda c: clearance.pdf(c) * -math.expm1(-(stiffness * c / 10.0) ** 2), 0.3e-3, 0.7e-3)[0]
        share = next(row for row in statistics if row["statistic"] == "share no contact")
        self.assertLess(float(share["low"]), free)
        self.assertGreater(float(share["high"]), free)

    def test_noise_seeds(self):
        rows, statistics = self.sweep("noise_seeds", seeds=("to = 40", "to = 6"), end=('"0.3 s"', '"0.15 s"'))
        self.assertEqual(len(rows), 24)
        spread = {(row["contact.friction"], row["controller.sensors.position_noise"]): float(row["value"])
                  for row in statistics if (row["figure"], row["statistic"]) == ("mean_force", "deviation")}
        self.assertEqual(len(spread), 4)
        for friction in ("0.15", "0.3"):
            self.assertGreater(spread[friction, "5e-06"], spread[friction, "1e-06"], "more noise scatters more")
            self.assertGreater(spread[friction, "1e-06"], 0.0, "seeds differ")

    def test_measured_points(self):
        (self.folder / "measured_points.csv").write_text((STUDIES / "measured_points.csv").read_text())
        rows, _ = self.sweep("measured_points")
        self.assertEqual(len(rows), 8)
        self.assertAlmostEqual(float(rows[3]["contact.clearance"]), 467e-6, delta=1e-12)
        self.assertEqual({row["status"] for row in rows}, {"ok"})

    def test_design_sobol(self):
        rows, _ = self.sweep("design_sobol", runs=("runs = 512", "runs = 64"))
        # Each half of each range has half of the points.
        self.assertEqual(sum(float(row["contact.friction"]) < 0.225 for row in rows), 32)
        self.assertEqual(sum(float(row["stator.stiffness"]) < 1e5 for row in rows), 32)

    def optimise(self, name, *changes):
        text = (STUDIES / f"{name}.toml").read_text().replace('"../', f'"{STUDIES.parent}/')
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        (self.folder / f"{name}.toml").write_text(text)
        found = json.loads(self.rotorub("optimise", f"{name}.toml", "-o", name, "--json"))
        self.assertIn("Which values of ", (self.folder / name / "optimum.html").read_text())
        return found, self.table(f"{name}/evaluations.csv")

    def test_optimise_ring(self):
        found, rows = self.optimise("optimise_ring")
        kept = [float(row["mean_force"]) for row in rows if row["status"] == "ok" and float(row["violation"]) <= 1e-6]
        best = found["best"]
        self.assertEqual(best["figure"], min(kept))
        self.assertLessEqual(best["constraints"][0]["value"], -20.0 * (1.0 - 1e-6))
        # Near the tuning to the speed, where its mass takes its spring's force.
        self.assertAlmostEqual(best["values"]["stator.stiffness"], (100.0 * math.pi) ** 2, delta=0.05 * 98.7e3)
        # A search over the whole range comes to the same.
        other, _ = self.optimise("optimise_ring", ("evaluations = 120", 'evaluations = 160\nalgorithm = "direct"'))
        for key, value in best["values"].items():
            self.assertAlmostEqual(other["best"]["values"][key], value, delta=2e-3 * value)
        self.assertAlmostEqual(other["best"]["figure"], best["figure"], delta=1e-4 * best["figure"])

    def test_optimise_levitation(self):
        found, rows = self.optimise("optimise_levitation", ("evaluations = 25", "evaluations = 3"))
        best = found["best"]
        self.assertLessEqual(best["constraints"][0]["value"], 3.0 * (1.0 + 1e-6))
        modes = json.loads(self.rotorub("modes", f"{self.folder}/optimise_levitation/best.toml", "--json"))
        poles = modes["speeds"][0]["levitation"]["poles"]
        self.assertEqual(best["figure"], max(pole["real"] for pole in poles))


if __name__ == "__main__":
    unittest.main()
