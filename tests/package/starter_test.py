"""rotorub init: what it writes runs at once, on every engine, with what was asked for in it. Every third machine is tried each day
(`third`), all of them nightly."""

import itertools
import json
import math
import pathlib
import re
import subprocess
import tomllib
import unittest

from product import BINARY, InAFolder, third

FORMS = ["geometry", "modal", "rig", "controller", "overhung", "vertical", "two-catchers"]
LOSE_MASS = ["geometry", "modal", "overhung", "vertical"]
# Sizes of a watch's and a turbine's order, above and below the first critical speed.
MACHINES = {
    "small": ["--speed", "1 kHz", "--length", "60 mm", "--diameter", "3 mm", "--disc-mass", "10 g",
              "--clearance", "50 um"],
    "large": ["--speed", "3000 rpm", "--length", "4", "--diameter", "40 cm", "--disc-mass", "2 t",
              "--clearance", "1 mm"],
    "slippery": ["--speed", "120", "--friction", "0"],
    "rough": ["--speed", "90 Hz", "--friction", "0.6"],
}


class Starter(InAFolder):
    def summary(self, file, *words):
        return json.loads(self.rotorub("run", file, "--json", "-o", "out", *words))

    def test_every_form_runs_and_touches(self):
        by_verlet = third(FORMS)
        for form in FORMS:
            self.rotorub("init", form, "--form", form)
            for engine in ([], *([["--integrator", "verlet", "--end", "0.2"]] if form in by_verlet else [])):
                summary = self.summary(f"{form}.toml", *engine)
                self.assertEqual(summary["status"], "ok", form)
                self.assertGreater(summary["impacts"], 0, form)
                self.assertGreater(summary["contact_fraction"], 0.1, form)

    def test_the_balance_is_no_worse_than_g_6_3(self):
        """ISO 21940-11 has 6.3 mm/s for fans and pumps; an orbit of a tenth of a wide clearance would need G 94 and more."""
        for form in FORMS:
            for words in ([], ["--speed", "1500 rpm"], ["--speed", "9000 rpm", "--clearance", "1 mm"]):
                self.rotorub("init", "balanced", "--form", form, "--force", *words)
                scene = tomllib.loads((pathlib.Path(self.folder) / "balanced.toml").read_text())
                value, _, unit = str(scene["rotor"]["speed"]).partition(" ")
                speed = float(value) * {"Hz": 2 * math.pi, "rpm": math.pi / 30}[unit]
                if form == "modal":
                    eccentricity = scene["force"][0]["static_moment"] / 2.0  # of a disc of 2 kg
                else:
                    disc = scene["rotor"]["disc"][0]
                    eccentricity = disc.get("eccentricity", 0.0)
                    self.assertTrue(eccentricity or disc["balance_grade"] == "G 6.3", form)
                self.assertLess(speed * eccentricity, 6.3e-3 * 1.05, f"{form} {words}")

    def test_the_words_in_comments_are_words(self):
        self.rotorub("init", "words")
        file = pathlib.Path(self.folder) / "words.toml"
        text = file.read_text()
        for said, instead in (("\neccentricity", "\n# eccentricity"), ("# unbalance", "unbalance"), ("# damping", "damping")):
            self.assertEqual(text.count(said), 1, said)
            text = text.replace(said, instead)
        file.write_text(text)
        self.assertEqual(self.summary("words.toml")["status"], "ok")

    def test_its_mjcf_loads(self):
        for form in FORMS:
            self.rotorub("init", form, "--form", form)
            # MuJoCo's cone knows one contact of a modal chain.
            for contact in ("rigid", "coulomb" if form == "two-catchers" else "cone")[:2 if form in third(FORMS) else 1]:
                summary = self.summary(f"{form}.toml", "--engine", "mujoco", "--contact", contact, "--end", "20ms")
                self.assertEqual(summary["status"], "ok", f"{form} {contact}")

    def test_its_rules_hold(self):
        for form in third(FORMS):
            self.rotorub("init", form, "--form", form)
            shorter = "run.end=200ms" if form == "modal" else "run.end=125ms"  # all touch by then
            cases = json.loads(self.rotorub("check", f"{form}.toml", "--json", "--set", shorter))["cases"]
            native = [case["outcome"] for case in cases if case["engine"].startswith("native")]
            self.assertEqual(set(native), {"pass"}, form)

    def test_machines_of_other_sizes_touch_too(self):
        for (name, words), form in third(itertools.product(MACHINES.items(), FORMS)):
            self.rotorub("init", name, "--form", form, "--force", *words)
            summary = self.summary(f"{name}.toml")
            self.assertEqual(summary["status"], "ok", f"{name} {form}")
            self.assertGreater(summary["contact_fraction"], 0.0, f"{name} {form}")

    def test_two_catchers_bear_their_own_weight(self):
        """The rings of a slow machine are stiff enough not to sag below the rotor, which levitates until the magnets fail."""
        speeds, masses = ("60", "120", "1200 rpm", "3000 rpm", "200 Hz"), ("200 g", "2 kg", "10 kg")
        for clearance, mass, speed in third(itertools.product(("0.2 mm", "0.5 mm"), masses, speeds)):
            with self.subTest(speed=speed, mass=mass, clearance=clearance):
                self.rotorub("init", "hung", "--form", "two-catchers", "--force", "--speed", speed,
                             "--disc-mass", mass, "--clearance", clearance)
                scene = tomllib.loads((self.folder / "hung.toml").read_text())
                fails = scene["magnetic_bearing"][0]["control"]["fails_at"]
                summary = self.summary("hung.toml")
                self.assertEqual(summary["status"], "ok")
                touches = [contact["first_touch"] for contact in summary["contacts"]]
                self.assertGreater(min(touch for touch in touches if touch is not None), fails)
                self.assertGreater(summary["impacts"], 0)

    def test_what_is_asked_for_stands_in_it(self):
        words = ["--speed", "61 Hz", "--length", "0.7", "--diameter", "21 mm", "--disc-mass", "2.5 kg",
                 "--clearance", "0.4 mm", "--friction", "25 %"]
        for form in FORMS:
            scene = tomllib.loads(self.rotorub("init", "-o", "-", "--form", form, *words))
            self.assertEqual(scene["rotor"]["speed"], "61 Hz")
            contacts = scene["contact"] if isinstance(scene["contact"], list) else [scene["contact"]]
            self.assertEqual(len(contacts), 2 if form == "two-catchers" else 1)
            for contact in contacts:
                self.assertEqual(contact["clearance"], "0.4 mm")
                self.assertEqual(contact["friction"], "25 %")
            if form == "modal":
                # 48 E I / L^3, and the disc with 17/35 of the shaft.
                self.assertAlmostEqual(scene["rotor"]["modal"]["stiffness"][0] / 280537, 1, places=3)
                self.assertAlmostEqual(scene["rotor"]["modal"]["mass"][0] / 3.4244, 1, places=3)
            else:
                self.assertEqual(scene["rotor"]["length"], 0.7)
                self.assertEqual(scene["rotor"]["section"][0]["diameter"], "21 mm")
                self.assertEqual(scene["rotor"]["disc"][0]["mass"], "2.5 kg")

    def test_the_controller_of_the_rig_can_be_switched_on(self):
        text = self.rotorub("init", "-o", "-", "--form", "rig")
        lines = [line[1:] if line.startswith("#") and not line.startswith("# ") else line for line in text.splitlines()]
        self.assertIn("[controller]", lines)
        (self.folder / "active.toml").write_text("\n".join(lines))
        passive = self.folder / "passive.toml"
        passive.write_text(text)
        hardest = {}
        for name in ("active", "passive"):
            self.assertEqual(self.summary(f"{name}.toml")["status"], "ok")
            hardest[name] = max(float(row["normal_impulse"]) for row in self.table("out/impacts.csv"))
        self.assertLess(hardest["active"], 0.5 * hardest["passive"])

    def test_the_controller_form_is_the_rig_with_it_switched_on(self):
        rig, active = (tomllib.loads(self.rotorub("init", "-o", "-", "--form", form)) for form in ("rig", "controller"))
        self.assertEqual(active.pop("controller")["kind"], "sliding")
        self.assertEqual(active, rig)

    # The three are one law, so that the runs are one run.
    def test_the_controller_form_has_a_law_in_three_languages(self):
        said = self.rotorub("init", "laws", "--form", "controller")
        folder = self.folder / "laws_controller"
        built = {}
        # As a reader of their heads does: in this folder, one after the other, and nothing tidied up between.
        for source in ("follow.c", "follow.cc", "follow_law.py"):
            text = (folder / source).read_text()
            commands = [re.sub(r"\\\n[\s*/]*", " ", line) for line in
                        re.findall(r"^\W*((?:c(?:c|\+\+)|rotorub) (?:.*\\\n)*.*?)(?: \*/)?$", text, re.MULTILINE)]
            *compiled, run = commands
            self.assertEqual(len(compiled), 0 if source.endswith(".py") else 1, commands)
            self.assertEqual(run.split()[0], "rotorub", commands)
            run = re.sub("^rotorub ", f"{BINARY} ", run) + f" --end 0.15 -q -o ../{source}_run"
            for command in (*compiled, run):
                subprocess.run(["bash", "-euc", command], cwd=folder, check=True)
            built[source] = (self.folder / f"{source}_run" / "series.csv").read_text()
        self.assertEqual(len(set(built.values())), 1)
        summary = json.loads((self.folder / "follow.c_run" / "summary.json").read_text())
        self.assertGreater(summary["control_force"], 1.0)
        # What is printed works; what is there is not written over.
        for command in (line.removeprefix("try:").strip() for line in said.splitlines()[-2:]):
            subprocess.run(["bash", "-euc", re.sub("^rotorub ", f"{BINARY} ", command)], cwd=self.folder, check=True,
                           stdout=subprocess.DEVNULL)
        (self.folder / "laws.toml").unlink()
        self.rotorub("init", "laws", "--form", "controller", code=2)
        self.assertIn("laws_controller exists already", self.said)

    def test_an_unbalance_that_is_known_takes_the_place_of_the_one_that_is_sized(self):
        for form in LOSE_MASS:
            text = self.rotorub("init", "-o", "-", "--form", form, "--unbalance", "0.5 oz in")
            blade = tomllib.loads(text)["force"][-1]
            self.assertEqual((blade["kind"], blade["static_moment"]), ("unbalance", "0.5 oz in"))
        for form in set(FORMS) - set(LOSE_MASS):
            self.rotorub("init", "-o", "-", "--form", form, "--unbalance", "30 g mm", code=2)
            self.assertIn("loses no mass", self.said)

    def test_an_unbalance_that_does_not_touch_has_no_rule_that_it_does(self):
        self.rotorub("init", "light", "--unbalance", "1 g mm")
        self.assertEqual(self.summary("light.toml")["impacts"], 0)
        self.rotorub("check", "light.toml", "--set", "run.end=125ms")

    def test_nothing_is_written_over(self):
        self.rotorub("init", "mine")
        file = self.folder / "mine.toml"
        file.write_text("mine")
        self.rotorub("init", "mine", code=2)
        self.assertIn("mine.toml exists already; give another name, or --force to overwrite it", self.said)
        self.rotorub("init", "-o", "mine.toml", code=2)
        self.assertEqual(file.read_text(), "mine")
        self.rotorub("init", "mine", "--force")
        self.assertIn("[rotor]", file.read_text())
        self.assertEqual([f.name for f in self.folder.iterdir()], ["mine.toml"])

    def test_what_makes_no_machine_is_refused(self):
        for words in (["--speed", "0"], ["--speed", "-50 Hz"], ["--length", "2 kg"], ["--friction", "-0.1"],
                      ["--diameter", "0.5 m"], ["--clearance", "1 m"], ["--disc-mass", "nan"], ["--length", "1e9"],
                      ["--unbalance", "30 g"], ["--unbalance", "0"], ["-o", "nowhere/rotor.toml"]):
            self.rotorub("init", *words, code=2)
            self.assertNotEqual(self.said, "")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_the_same_words_give_the_same_text(self):
        first, second = (self.rotorub("init", "-o", "-", "--form", "rig") for _ in range(2))
        self.assertEqual(first, second)
        said = json.loads(self.rotorub("init", "rig", "--form", "rig", "--json"))
        self.assertEqual(pathlib.Path(said["file"]), pathlib.Path("rig.toml"))


if __name__ == "__main__":
    unittest.main()
