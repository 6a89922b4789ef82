"""rotorub.py reads what the program writes, to the bit."""

import csv
import json
import shutil
import unittest

import numpy
import rotorub
from support import InFolder, SCENES


# The keys of nested objects as columns.json names them: "settled.attractor".
def paths(summary, before=""):
    found = set()
    for key, value in summary.items():
        found |= paths(value, f"{before}{key}.") if isinstance(value, dict) else {before + key}
    return found


class Reader(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.rotorub("run", SCENES / "bench_ring.toml", "--end", "0.05", "--set", "contact.friction=0.2", "-o", "run")
        cls.run_ = rotorub.read(cls.folder / "run")

    def rows(self, name):
        with open(self.folder / "run" / name, newline="") as lines:
            return list(csv.DictReader(lines))

    def test_every_number_is_the_files(self):
        for name, table in (("series.csv", self.run_.series), ("impacts.csv", self.run_.impacts),
                            ("events.csv", self.run_.events), ("keyphasor.csv", self.run_.keyphasor)):
            rows = self.rows(name)
            self.assertGreater(len(rows), 0, name)
            self.assertEqual(list(table), list(rows[0]), name)
            for column, values in table.items():
                self.assertEqual(len(values), len(rows))
                for value, row in zip(values, rows):
                    if column in ("mode", "event"):
                        self.assertEqual(value, row[column])
                    else:
                        self.assertEqual(f"{value:.17g}", f"{float(row[column]):.17g}")

    def test_a_column_is_had_by_its_name(self):
        self.assertIs(self.run_["gap"], self.run_.series["gap"])
        self.assertIn("gap", self.run_)
        self.assertEqual(self.run_["t"][-1], 0.05)
        with self.assertRaisesRegex(KeyError, "gab: no column of series.csv; there are: t, rotor_x"):
            self.run_["gab"]

    def test_every_column_has_a_unit_and_a_meaning(self):
        self.assertEqual(list(self.run_.units), list(self.run_.series))
        self.assertEqual(self.run_.units["gap_rate"], "m/s")
        self.assertTrue(all(self.run_.meanings.values()))
        self.assertEqual(self.run_.columns["impacts.csv"]["normal_impulse"]["unit"], "N s")
        summary = self.run_.columns["summary.json"]
        self.assertEqual(summary["mean_force"]["unit"], "N")
        # Objects of the geometry form: null here.
        self.assertEqual(paths(self.run_.summary) - set(summary), {"contact_mass", "above_modes"})

    def test_the_scene_is_that_of_the_run(self):
        self.assertEqual(self.run_.scene["contact"]["friction"], 0.2)
        self.assertIn("[contact]", self.run_.scene_text)

    def test_signs_are_as_said(self):
        impacts = self.run_.impacts
        self.assertTrue((impacts["normal_impulse"] >= 0).all() and (impacts["gap_rate_before"] <= 0).all())
        self.assertTrue((impacts["energy_change"] <= 0).all())
        slides = self.run_["mode"] == "slide"
        self.assertTrue(slides.any())
        friction = -0.2 * self.run_["normal_force"] * numpy.sign(self.run_["slip"])
        numpy.testing.assert_allclose(self.run_["friction_force"][slides], friction[slides], rtol=1e-12)
        ring = numpy.hypot(self.run_["rotor_x"] - self.run_["stator_x"], self.run_["rotor_y"] - self.run_["stator_y"])
        clearance = self.run_["gap"] + ring
        self.assertLess(numpy.ptp(clearance), 1e-15)

    def test_a_run_without_contact_has_empty_tables(self):
        self.rotorub("run", SCENES / "bench_drop.toml", "--end", "1ms", "-o", "short")
        run = rotorub.read(self.folder / "short")
        self.assertEqual(len(run.impacts["t"]), 0)
        self.assertEqual(run.impacts["normal_impulse"].dtype, float)

    def test_an_earlier_versions_folder_has_no_units(self):
        shutil.copytree(self.folder / "run", self.folder / "earlier")
        (self.folder / "earlier" / "columns.json").unlink()
        run = rotorub.read(self.folder / "earlier")
        self.assertEqual(run.units, {})
        self.assertEqual(len(run["t"]), len(self.run_["t"]))

    def test_what_is_no_run_is_refused(self):
        with self.assertRaisesRegex(FileNotFoundError, "nowhere is not the folder of a run"):
            rotorub.read(self.folder / "nowhere")
        shutil.copytree(self.folder / "run", self.folder / "damaged")
        with open(self.folder / "damaged" / "impacts.csv", "a") as file:
            file.write("1,2\n")
        with self.assertRaisesRegex(ValueError, r"impacts.csv:\d+: 2 fields where the header has 8"):
            rotorub.read(self.folder / "damaged")

    def test_a_sweep_is_a_table(self):
        (self.folder / "study.toml").write_text(
            f'scene = "{SCENES}/bench_ring.toml"\n[sample]\nkind = "grid"\n'
            '[[vary]]\nkey = "contact.friction"\nvalues = [0.1, 0.2]\n'
            '[[vary]]\nkey = "contact.restitution"\nvalues = [0.5, 7.0]\n'
            '[run]\nend = "50 ms"\nstep = "100 us"\nintegrator = "verlet"\n')
        self.rotorub("sweep", "study.toml", "-o", "sweep")
        table = rotorub.read_sweep(self.folder / "sweep")
        numpy.testing.assert_array_equal(table["contact.friction"], [0.1, 0.1, 0.2, 0.2])
        self.assertEqual(list(table["status"]), ["ok", "refused", "ok", "refused"])
        self.assertEqual(list(numpy.isnan(table["mean_force"])), [False, True, False, True])
        self.assertEqual(list(table.units), list(table))
        self.assertEqual(table.units["mean_force"], "N")
        self.assertEqual(table.units["contact.friction"], "")

    def test_columns_files_are_json_that_names_every_column(self):
        columns = json.loads((self.folder / "run" / "columns.json").read_text())
        self.assertEqual([c["name"] for c in columns["series.csv"]], list(self.run_.series))


if __name__ == "__main__":
    unittest.main()
