"""--format hdf5: the values of the tables to the bit, the same bytes for the same run, and a word where it is missing."""

import shutil
import subprocess
import unittest

import h5py
import numpy
import rotorub
from support import PROGRAM, SCENES, InFolder

RUN = ("run", SCENES / "paper_sliding.toml", "--integrator", "verlet", "--end", "0.12", "--format", "hdf5")


class Hdf5(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.rotorub(*RUN, "-o", "run")
        cls.file = cls.folder / "run" / "run.h5"

    def test_it_holds_the_tables(self):
        tables, own = rotorub.read(self.folder / "run"), rotorub.read_hdf5(self.file)
        self.assertGreater(len(tables.impacts["t"]), 0)
        for name in ("series", "impacts", "events", "keyphasor"):
            written = getattr(tables, name)
            self.assertEqual(list(getattr(own, name)), list(written))
            for column, values in getattr(own, name).items():
                numpy.testing.assert_array_equal(values, written[column], f"{name} {column}")
            self.assertEqual(own.columns[f"{name}.csv"], tables.columns[f"{name}.csv"])
        self.assertEqual(own.scene_text, tables.scene_text)
        for key in ("scene", "scene_hash", "engine", "integrator", "step", "steps", "status", "mean_force", "impacts"):
            self.assertEqual(own.summary[key], tables.summary[key], key)

    def test_any_reader_finds_units(self):
        with h5py.File(self.file) as h5:
            self.assertEqual(h5["series/gap"].attrs["unit"], "m")
            self.assertIn("negative: closing", h5["series/gap_rate"].attrs["meaning"])
            self.assertEqual(h5["series/gap"].dtype, numpy.float64)
            self.assertIn("[contact]", h5.attrs["scene_text"])
            self.assertEqual(h5.attrs["engine"], "native")

    def test_the_same_run_has_the_same_bytes(self):
        self.rotorub(*RUN, "-o", "again")
        self.assertEqual((self.folder / "again" / "run.h5").read_bytes(), self.file.read_bytes())

    def test_it_is_read_where_the_tables_are_gone(self):
        shutil.copytree(self.folder / "run", self.folder / "alone")
        for name in ("series.csv", "impacts.csv", "events.csv", "keyphasor.csv"):
            (self.folder / "alone" / name).unlink()
        numpy.testing.assert_array_equal(rotorub.read(self.folder / "alone")["gap"], rotorub.read(self.folder / "run")["gap"])

    def test_a_run_without_impacts(self):
        self.rotorub("run", SCENES / "bench_drop.toml", "--end", "1ms", "--format", "hdf5", "-o", "short")
        run = rotorub.read_hdf5(self.folder / "short" / "run.h5")
        self.assertEqual((len(run.impacts["t"]), len(run.events["event"])), (0, 0))

    # The file of an earlier run is none of this one's.
    def test_a_run_without_it_leaves_none(self):
        self.rotorub("run", SCENES / "bench_drop.toml", "--end", "1ms", "--format", "hdf5", "-o", "twice")
        self.rotorub("run", SCENES / "bench_drop.toml", "--end", "2ms", "-o", "twice")
        self.assertFalse((self.folder / "twice" / "run.h5").exists())

    def test_every_run_of_a_comparison_has_one(self):
        self.rotorub("compare", SCENES / "bench_ring.toml", "--end", "20ms", "--no-video", "--twins", "2", "--format",
                     "hdf5", "-o", "compare")
        for side, run in rotorub.read_compare(self.folder / "compare")["bench_ring"].items():
            own = rotorub.read_hdf5(self.folder / "compare" / "bench_ring" / side / "run.h5")
            numpy.testing.assert_array_equal(own["rotor_x"], run["rotor_x"], side)

    # A program without its module says what is missing, before it runs anything.
    def test_without_the_module_it_names_the_package(self):
        program = self.folder / "bin" / "rotorub"
        program.parent.mkdir()
        shutil.copy(PROGRAM, program)
        done = subprocess.run([program, *map(str, RUN), "-o", "none"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--format hdf5: built without it; install libhdf5-dev and build again", done.stderr)
        self.assertFalse((self.folder / "none").exists())


if __name__ == "__main__":
    unittest.main()
