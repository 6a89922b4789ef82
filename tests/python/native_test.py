"""rotorub_native: the same bits as the program, figures of many runs, errors with their place."""

import os
import signal
import threading
import time
import unittest

import numpy
import rotorub
import rotorub_native
from support import InFolder, SCENES

RING = SCENES / "bench_ring.toml"


class Native(InFolder):
    def test_a_run_has_the_programs_bits(self):
        for integrator in ("event", "verlet", "euler"):
            self.rotorub("run", RING, "--end", "0.05", "--integrator", integrator, "--set", "contact.friction=0.25",
                         "--step", "20us", "-o", integrator)
            file = rotorub.read(self.folder / integrator)
            own = rotorub_native.run(RING, {"contact.friction": 0.25}, integrator=integrator, step=20e-6, end="0.05 s")
            for name in ("series", "impacts", "events"):
                written = getattr(file, name)
                self.assertEqual(list(own[name]), list(written))
                for column, values in own[name].items():
                    numpy.testing.assert_array_equal(values, written[column], f"{integrator} {name} {column}")
            self.assertEqual(own["columns"], file.columns)
            self.assertEqual(own["summary"]["impulse_total"], file.summary["impulse_total"])
            self.assertEqual(rotorub.run(RING, {"contact.friction": 0.25}, integrator=integrator, step=20e-6,
                                         end=0.05).scene["contact"]["friction"], 0.25)

    def test_a_scene_may_be_text(self):
        by_file = rotorub_native.run(str(RING), end=0.02)
        by_text = rotorub_native.run(RING.read_text(), ["run.end=0.02"])
        numpy.testing.assert_array_equal(by_file["series"]["rotor_x"], by_text["series"]["rotor_x"])

    def test_rows_stand_at_the_times_asked_for(self):
        times = [0.0, 1e-3 / 3, 0.01]
        run = rotorub_native.run(RING, end=0.01, output_times=times)
        self.assertEqual(list(run["series"]["t"]), times)

    def test_overrides_of_every_kind(self):
        run = rotorub.run(RING, {"contact.friction": numpy.float64(0.1), "run.output_times": [0.001, 0.002],
                                 "run.integrator": "verlet", "mujoco.shadow": True, "rotor.modal.mass": numpy.array([2.0]),
                                 "stator": None, "force": None}, end=0.01)
        self.assertEqual(run.summary["integrator"], "verlet")
        self.assertNotIn("stator", run.scene)
        with self.assertRaisesRegex(TypeError, "contact.friction: a dict cannot be a value of a scene"):
            rotorub_native.run(RING, {"contact.friction": {}})

    def test_errors_have_their_place(self):
        text = RING.read_text().replace("friction = ", "frictoin = ")
        self.assertIn("frictoin", text)
        line = 1 + text[:text.index("frictoin")].count("\n")
        with self.assertRaises(rotorub_native.SceneError) as caught:
            rotorub_native.run(text, {"contact.radius": -1})
        error = caught.exception
        self.assertIsInstance(error, ValueError)
        places = {(d["key"], d["line"]) for d in error.diagnostics}
        self.assertIn(("contact.frictoin", line), places)
        self.assertIn("contact.radius", {key for key, _ in places})
        self.assertIn("did you mean", str(error))
        self.assertEqual((error.file, error.line, error.key, error.reason), tuple(
            error.diagnostics[0][k] for k in ("file", "line", "key", "reason")))
        with self.assertRaisesRegex(ValueError, "choose event, verlet"):
            rotorub_native.run(RING, integrator="rk4")
        with self.assertRaises(rotorub_native.SceneError):
            rotorub_native.run("no/such/scene.toml")

    def test_a_sweep_is_its_points_runs(self):
        frictions = [0.05, 0.1, 0.3, -1.0]
        for integrator in ("event", "verlet"):
            table = rotorub_native.sweep(RING, [{"contact.friction": f} for f in frictions], integrator=integrator,
                                         step=1e-4, end=0.1)
            self.assertEqual(list(table["status"]), ["ok", "ok", "ok", "refused"])
            self.assertIn("contact.friction", table["reason"][3])
            self.assertTrue(numpy.isnan(table["mean_force"][3]))
            for k in range(3):
                alone = rotorub_native.run(RING, {"contact.friction": frictions[k]}, integrator=integrator, step=1e-4, end=0.1)
                self.assertEqual(table["impulse_total"][k], alone["summary"]["impulse_total"])
                self.assertEqual(table["impacts"][k], alone["summary"]["impacts"])

    def test_a_study_has_the_programs_table(self):
        (self.folder / "study.toml").write_text(
            f'scene = "{RING}"\n[sample]\nkind = "latin_hypercube"\nruns = 40\nseed = 3\n'
            '[[vary]]\nkey = "contact.friction"\nfrom = 0.05\nto = 0.3\n'
            '[run]\nend = "50 ms"\nstep = "100 us"\nintegrator = "verlet"\n')
        self.rotorub("sweep", "study.toml", "-o", "sweep")
        written = rotorub.read_sweep(self.folder / "sweep")
        own = rotorub_native.study(self.folder / "study.toml")
        self.assertEqual(set(own), set(written))
        for column, values in own.items():
            numpy.testing.assert_array_equal(values, written[column], column)
        (self.folder / "mujoco.toml").write_text(
            f'scene = "{RING}"\n[sample]\nkind = "grid"\n[[vary]]\nkey = "contact.friction"\nvalues = [0.1]\n'
            '[run]\nengine = "mujoco"\n')
        with self.assertRaisesRegex(ValueError, "run.engine"):
            rotorub_native.study(self.folder / "mujoco.toml")

    def test_a_failed_run_says_so(self):
        painleve = rotorub_native.run(SCENES / "hard" / "painleve.toml")
        self.assertNotEqual(painleve["summary"]["status"], "ok")
        self.assertTrue(painleve["summary"]["message"])

    # Python goes on while a scene runs: its lock is free.
    def test_other_threads_run_meanwhile(self):
        ended = threading.Event()
        counted = 0

        def long_run():
            rotorub_native.run(RING, integrator="verlet", step=1e-6, end=1.0)
            ended.set()

        thread = threading.Thread(target=long_run)
        thread.start()
        while not ended.is_set():
            counted += 1
            time.sleep(1e-3)
        thread.join()
        self.assertGreater(counted, 20)

    def test_ctrl_c_ends_a_run(self):
        timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            rotorub_native.run(RING, integrator="verlet", step=1e-7, end=50.0)
        self.assertLess(time.monotonic() - begin, 20.0)

    def test_the_version_is_the_programs(self):
        self.assertEqual(rotorub_native.__version__, rotorub_native.run(RING, end=1e-3)["summary"]["version"])


if __name__ == "__main__":
    unittest.main()
