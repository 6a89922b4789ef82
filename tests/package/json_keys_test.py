"""Every key that a command prints as JSON stands in its README, in a column of code."""

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

    def test_tune(self):
        self.check(self.rotorub("tune", SCENES / "bench_ring.toml", "--end", "2ms", "--steps", "20us", "--json"), "tune", "study")

    def test_bench(self):
        self.check(self.rotorub("bench", SCENES / "bench_billiard.toml", "--steps", "100us", "--engines",
                                "native-event,native-verlet", "--tolerances", "1e-9", "--repeats", "1", "--json"),
                   "bench", "study")

    def test_check(self):
        self.check(self.rotorub("check", SCENES / "hard" / "attractor_free.toml", "--json"), "check")


if __name__ == "__main__":
    unittest.main()
