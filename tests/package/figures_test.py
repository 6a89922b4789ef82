"""Figures that the documents quote, computed anew: each must stand there as the command prints it. Every third of those that take
long is computed each day (`third`), all of them nightly."""

import json
import math
import re

import unittest
from product import NIGHTLY, SOURCE, InAFolder, third

SCENES = SOURCE / "mjcf"
FINDINGS = (SOURCE / "mjcf/docs/findings.md").read_text()
PROSE = " ".join(FINDINGS.split())  # a sentence may be wrapped anywhere


class Figures(InAFolder):
    def run_of(self, scene, *overrides, options=()):
        """The summary, with `largest` (N s), `hits` and `pushed` (N, largest command on an axis in the last fifth)."""
        words = [word for override in overrides for word in ("--set", override)]
        summary = json.loads(self.rotorub("run", SCENES / f"{scene}.toml", *words, *options, "-o", "run", "--json"))
        impacts, rows = self.table("run/impacts.csv"), self.table("run/series.csv")
        summary["largest"] = max((float(row["normal_impulse"]) for row in impacts), default=0.0)
        summary["hits"] = sum(float(row["gap_rate_before"]) < -1e-4 for row in impacts)
        last = rows[len(rows) * 4 // 5:]
        summary["pushed"] = max(abs(float(row.get(f"control_{axis}", 0.0))) for row in last for axis in "xy")
        return summary

    def quoted(self, text):
        self.assertTrue(text in PROSE, text)

    def row(self, name, summary):
        self.quoted(f"| {name} | {summary['mean_force']:.1f} | {summary['largest']:.4f} |"
                    f" {100.0 * summary['contact_fraction']:.1f} |")

    # ------------------------------------------------------------ what control asks for
    def test_what_control_carries(self):
        self.row("passive", self.run_of("paper_passive"))
        for preload in (10, 20):
            summary = self.run_of("paper_sliding", f"controller.preload={preload}")
            self.row(f"`sliding`, preload {preload} N", summary)
            self.assertAlmostEqual(summary["mean_force"], preload, delta=0.01 * preload)
        self.row("`two_phase`", self.run_of("paper_two_phase"))
        stiff = self.run_of("paper_sliding", "stator.stiffness=1e6")
        self.row("`sliding`, preload 10 N, ring of 1e6 N/m", stiff)
        self.assertGreater(stiff["pushed"], 600.0)  # the actuator's limit
        self.row("passive, ring of 1e6 N/m", self.run_of("paper_passive", "stator.stiffness=1e6"))

    def test_the_ring_lies_on_the_critical_speed(self):
        critical = json.loads(self.rotorub("modes", SCENES / "paper_passive.toml", "--json"))["critical_speeds"][0]
        self.quoted(f"{math.sqrt(2e5 / 1.5):.0f} rad/s, within 5 % of the rotor's critical speed, {critical:.0f} rad/s")

    def test_lead_times(self):
        told = re.search(r"switched on at ([\d, ]+) ms it is ([\d., ]+) mN s", PROSE)
        times, impulses = (text.split(", ") for text in told.groups())
        for time, impulse in zip(times, impulses, strict=True):
            summary = self.run_of("paper_sliding", f'controller.on="{time} ms"',
                                  options=("--integrator", "verlet", "--step", "5us", "--end", "0.2s"))
            self.assertEqual(f"{1e3 * summary['largest']:.2g}", impulse, time)

    def test_the_table_of_the_laws(self):
        for name, words in {"`sliding`, continuous, preload 10 N": ("paper_sliding",),
                            "`sliding`, sampled at 100 us": ("paper_sliding", "controller.preload=30",
                                                             'controller.sample_time="100 us"'),
                            "`two_phase`, 20 us": ("paper_two_phase",),
                            "`cross_coupled` alone, 20 us": ("paper_cross_coupled",)}.items():
            summary = self.run_of(*words, options=("--integrator", "verlet", "--step", "5us"))
            line = next(line for line in FINDINGS.splitlines() if line.startswith(f"| {name}"))
            _, _, hits, largest, _, force, contact, _ = (cell.strip() for cell in line.split("|"))
            self.assertEqual(int(hits), summary["hits"], name)
            self.assertAlmostEqual(float(largest), summary["largest"], delta=0.5 * 10.0 ** -len(largest.split(".")[1]))
            self.assertEqual(force, f"{summary['mean_force']:.0f}", name)
            self.assertAlmostEqual(float(contact), 100.0 * summary["contact_fraction"], delta=0.1)

    def test_the_passive_bearing_beside_the_laws(self):
        summary = self.run_of("paper_passive", options=("--integrator", "verlet", "--step", "5us"))
        told = re.search(r"the passive bearing has about (\d+) impacts, the largest of ([\d.]+) N s, an rms gap rate of ([\d.]+) mm/s, "
                         r"a mean force of (\d+) N, and contact for (\d+) % of", PROSE).groups()
        found = (summary["hits"], summary["largest"], 1e3 * summary["gap_rate_rms"], summary["mean_force"], 100.0 * summary["contact_fraction"])
        for said, value in zip(told, found, strict=True):
            self.assertAlmostEqual(float(said), value, delta=0.05 * float(said))

    def test_impacts_over_the_modes_kept(self):
        text = " ".join((SOURCE / "native_model/docs/modes_kept.md").read_text().split())
        counts = dict(re.findall(r"([\d,]+) with (\d+)(?: modes)?[,)]", text.split("the number of impacts (")[1].split("because")[0]))
        self.assertEqual(sorted(counts.values()), ["12", "2", "8"])
        for count, modes in counts.items():
            summary = self.run_of("paper_passive", f"rotor.modes={modes}", options=("--integrator", "event"))
            self.assertEqual(count, f"{summary['hits']:,}", modes)

    # ------------------------------------------------------------ compare/README.md: a run as a measurement
    def test_another_integrators_run_as_a_record(self):
        scene = SCENES / "paper_passive.toml"
        self.rotorub("run", scene, "--integrator", "verlet", "--step", "10us", "--end", "0.15", "--set",
                     "run.output_step=50us", "-o", "rig")
        if NIGHTLY:
            # A resynchronised comparison has the same runs beside the record, but makes none at smaller steps.
            self.rotorub("compare", scene, "--end", "0.15", "--measured", "rig/series.csv", "--no-video", "--mode", "resync",
                         "-o", "out", code=(0, 1))
            measured = json.loads((self.folder / "out" / "compare.json").read_text())["scenes"][0]["measured"]
            sides = "native", "rigid", "coulomb", "cone-coulomb", "cone"
        else:  # two columns of six
            measured = json.loads(self.rotorub("run", scene, "--integrator", "event", "--end", "0.15", "--set", "run.output_step=10us",
                                               "--measured", "rig/series.csv", "-o", "out", "--json"))["measured"]
            sides = "native",
        told = {line.split("|")[1].strip(): [cell.strip() for cell in line.split("|")[2:-1]]
                for line in (SOURCE / "compare" / "README.md").read_text().splitlines() if line.count("|") == 8}
        for name, key, unit, scale in (("mean gap", "mean_gap", "um", 1e6), ("samples in contact", "contact_fraction", "%", 1e2),
                                       ("rotor's whirl, largest", "rotor_largest", "um", 1e6)):
            figure = measured["figures"][key]
            self.assertEqual(told[name][:1 + len(sides)],
                             [f"{scale * value:#.4g}".rstrip(".") + f" {unit}"
                              for value in (figure["measured"], *(figure["runs"][side] for side in sides))])
        rms = [measured["columns"]["gap"]["runs"][side]["rms"] for side in sides]
        self.assertEqual(told["gap, rms of record less run"][1:1 + len(sides)],
                         [f"{1e6 * value:.1f} um" if value > 1e-6 else f"{1e9 * value:.0f} nm" for value in rms])
        self.assertEqual(told["shift"][0], f"{1e9 * measured['alignment']['shift']:.0f} ns")

    # ------------------------------------------------------------ compare/docs/findings.md: MuJoCo's cone
    def test_the_cone_on_the_rig(self):
        lines = (SOURCE / "compare/docs/findings.md").read_text().splitlines()
        columns = (("cone",), ("cone", "mujoco.friction_reference=1"), ("cone-coulomb",), ("rigid",))
        cells = []
        for scene in ("paper_sliding", "paper_passive"):
            told = next(line for line in lines if line.startswith(f"| `{scene}`, 0.5 s |")).split("|")[3:-1]
            cells += [(scene, cell, column) for cell, column in zip(told, columns, strict=True)]
        for scene, cell, (contact, *overrides) in third(cells):
            summary = self.run_of(scene, *overrides, options=("--engine", "mujoco", "--contact", contact))
            force, share = re.match(r" ([\d.]+) N, ([\d.]+) %", cell).groups()
            self.assertAlmostEqual(float(force), summary["mean_force"], delta=0.51 * 10.0 ** -len(force.partition(".")[2]))
            self.assertAlmostEqual(float(share), 100.0 * summary["contact_fraction"],
                                   delta=0.51 * 10.0 ** -len(share.partition(".")[2]))

    # ------------------------------------------------------------ native_model/docs/modes_kept.md
    def test_the_modes_kept(self):
        text = " ".join((SOURCE / "native_model/docs/modes_kept.md").read_text().split())
        rig = (SCENES / "paper_passive.toml").read_text()
        bare = rig[:rig.index("# The sleeve at")] + rig[rig.index("[[rotor.bearing]]"):]
        (self.folder / "bare.toml").write_text(bare)
        told = []
        for scene, words in ((self.folder / "bare", "comes to ([\\d., ]+) N s at most with ([\\d, ]+) modes"),
                             ("paper_passive", "sleeve of 0.2 kg: ([\\d., ]+) N s with ([\\d, ]+) modes")):
            impulses, numbers = (cells.split(", ") for cells in re.search(words, text).groups())
            told += [(scene, *cells) for cells in zip(numbers, impulses, strict=True)]
        self.assertEqual(len(told), 8)
        for scene, modes, impulse in third(told):
            largest = self.run_of(scene, f"rotor.modes={modes}", options=("--integrator", "event"))["largest"]
            self.assertEqual(impulse, f"{largest:.3f}", f"{scene}, {modes} modes")

    # ------------------------------------------------------------ the map over speed and friction, coarse
    def test_the_speed_map(self):
        study = (SCENES / "studies" / "speed_friction.toml").read_text()
        coarse = study.replace("count = 25", "count = 13").replace("count = 31", "count = 7")
        self.assertNotEqual(coarse, study)
        coarse = coarse.replace('"../paper_passive.toml"', f'"{SCENES / "paper_passive.toml"}"')
        (self.folder / "study.toml").write_text(coarse)
        bounces, rubs = self.growths("study.toml", "20Hz:80Hz:13", "0:0.6:7")
        self.assertGreater(len(bounces), 20)
        self.assertGreater(min(bounces), 0.0, "what bounces on has no stable synchronous rub")
        self.assertGreater(sum(growth < 0.0 for growth in rubs), 0.75 * len(rubs))
        self.assertLess(max(rubs), 8.0, "the others grow too slowly for the run")

    def growths(self, study, speeds, frictions):
        """1/s, of the points that bounce to the end and of those that rub synchronously: of the slowest synchronous rub."""
        self.rotorub("sweep", study, "-o", "map")
        rubs = json.loads(self.rotorub("modes", SCENES / "paper_passive.toml", "--rub-map", "--speeds", speeds,
                                       "--frictions", frictions, "--json"))["rub_map"]["points"]
        slowest = {(round(point["speed"], 6), round(point["friction"], 6)):
                   min((rub["growth_rate"] for rub in point["rubs"] if rub["kind"] == "forced"), default=math.inf)
                   for point in rubs}
        found = {"bouncing": [], "synchronous rub": []}
        for point in self.table("map/results.csv"):
            place = round(float(point["rotor.speed"]), 6), round(float(point["contact.friction"]), 6)
            found.get(point["attractor"], []).append(slowest[place])
        return found.values()


if __name__ == "__main__":
    unittest.main()
