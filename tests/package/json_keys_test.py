"""Every key that a command prints as JSON stands in its README, in a column of code; every word of a figure in the glossary."""

import json
import re
import unittest

from product import SOURCE, InAFolder

SCENES = SOURCE / "mjcf"


def keys(value):
    if isinstance(value, dict):
        for key, inner in value.items():
            yield key
            yield from keys(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from keys(inner)


class JsonKeys(InAFolder):
    def told(self, *readmes):
        text = "\n".join((SOURCE / "compare" / name / "README.md").read_text() for name in readmes)
        return set(re.findall(r"\w+", " ".join(re.findall(r"`([^`\n]+)`", text))))

    def check(self, printed, *readmes):
        printed = set(keys(json.loads(printed)))
        self.assertGreater(len(printed), 5)
        self.assertEqual(sorted(printed - self.told(*readmes)), [])

    def test_modes(self):
        for scene in ("bench_whip", "paper_passive"):
            self.check(self.rotorub("modes", SCENES / f"{scene}.toml", "--json"), "modes")
        self.check(self.rotorub("modes", SCENES / "compliant_ring.toml", "--periodic", "--json"), "modes")
        self.check(self.rotorub("modes", SCENES / "bench_whip.toml", "--periodic", "--across", "contact.friction=0.1:0.2:2", "--json"), "modes")

    def test_tune(self):
        self.check(self.rotorub("tune", SCENES / "bench_ring.toml", "--end", "2ms", "--steps", "20us", "--json"), "tune", "study")

    def test_bench(self):
        self.check(self.rotorub("bench", SCENES / "bench_billiard.toml", "--steps", "100us", "--engines",
                                "native-event,native-verlet", "--tolerances", "1e-9", "--repeats", "1", "--json"),
                   "bench", "study")

    def test_identify(self):
        self.rotorub("run", SCENES / "bench_ring.toml", "--end", "20ms", "--set", "run.output_step=50us", "-o", "rig")
        printed = self.rotorub("identify", SCENES / "bench_ring.toml", "--end", "20ms", "--measured", "rig/series.csv",
                               "--measured-shift", "0s", "--fit", "contact.friction=0.05:0.4", "--json")
        self.check(printed, "", "study")

    def test_check(self):
        self.check(self.rotorub("check", SCENES / "hard" / "attractor_free.toml", "--json"), "check")

    def test_the_glossary_has_the_words_of_a_run_and_of_a_comparison(self):
        glossary = (SOURCE / "compare/docs/glossary.md").read_text()
        run = self.rotorub("run", SCENES / "bench_ring.toml", "--end", "20ms", "-o", "run")
        compared = self.rotorub("compare", SCENES / "bench_ring.toml", "--end", "20ms", "--twins", "0", "--no-video",
                                "--no-modes-ladder", "-o", "out", code=(0, 1)).split("difference from native")[0]
        # A figure's line: its name, its unit where it has one, then its values in columns.
        labels = set(re.findall(r"^[* ] ([a-z][^:?\n]*?)(?:, (?:N|N s|J|%|Hz|mm/s|rad/s|µm|ms|ppm|µs))?  +[-\d–]", run + compared, re.M))
        self.assertGreater(len(labels), 15)
        own = {"steps", "time of a step", "computing time per step"}  # of the program, not of the motion
        self.assertEqual(sorted(label for label in labels - own if f"**{label}**" not in glossary), [])
        for contact in ("rigid", "coulomb", "cone", "cone-coulomb", "cone-default"):
            self.assertIn(f"`{contact}`", glossary)
        columns = {column["name"] for column in json.loads((self.folder / "run/columns.json").read_text())["series.csv"]}
        for column in ("gap", "gap_rate", "slip", "normal_force", "friction_force", "mode"):
            self.assertIn(column, columns)
            self.assertIn(f"(`{column}`)", glossary)


if __name__ == "__main__":
    unittest.main()
