"""The table of the README, computed anew by the command that stands beside it."""

import json
import re
import unittest

from product import SOURCE, InAFolder

SIDES = "native", "rigid", "cone-coulomb", "cone"


def table():
    """{scene's word: {row: [cell of each side]}} of "What it found"."""
    section = (SOURCE / "README.md").read_text().split("## What it found")[1].split("\n## ")[0]
    told, scene = {}, None
    for line in section.splitlines():
        if not line.startswith("| ") or line.startswith("| |") or line.startswith("| ---"):
            continue
        first, *cells = (cell.strip() for cell in line.split("|")[1:-1])
        found = re.match(r"\*\*(.*)\*\*: (.*)", first)
        if found:
            scene, first = found.groups()
        told.setdefault(scene, {})[first] = cells
    return told


class Table(InAFolder):
    def found(self, scene):
        """What compare says of the scene, without twins: figures of single runs do not depend on them."""
        said = self.rotorub("compare", SOURCE / "mjcf" / f"{scene}.toml", "--twins", "0", "--no-video", "--no-modes-ladder",
                            "--json", "-o", "out", code=(0, 1), timeout=600)
        return json.loads(said)["scenes"][0]

    def check(self, told, scene):
        metrics = {side: scene["runs"][side]["metrics"] for side in SIDES}
        for row, key, pattern in (("mean normal force", "mean_force", r"([\d.]+) N"),
                                  ("lasting contact", "lasting_fraction", r"([\d.]+) %"), ("hard impacts", "hard_impacts", r"(\d+)")):
            for side, cell in zip(SIDES, told[row], strict=True):
                number = re.fullmatch(pattern, cell)[1]
                value = metrics[side][key] * (100.0 if key == "lasting_fraction" else 1.0)
                self.assertEqual(number, f"{value:.{len(number.partition('.')[2])}f}", f"{row}, {side}")
        self.assertEqual(told["trusted"][0], "")

    def test_under_control(self):
        told, scene = table()["under control"], self.found("paper_sliding")
        self.check(told, scene)
        for side, cell in zip(SIDES[1:], told["trusted"][1:], strict=True):
            self.assertEqual(cell, scene["differences"][side]["trusted"], side)

    def test_passive(self):
        told, scene = table()["passive"], self.found("paper_passive")
        self.check(told, scene)
        for side, cell in zip(SIDES[2:], told["trusted"][2:], strict=True):
            self.assertEqual(cell, scene["differences"][side]["trusted"], side)
        # What twins cannot decide at 1 %, the number of impacts, is all that a single run of `rigid` is outside by.
        self.assertEqual(told["trusted"][1], "yes, but for the number of impacts")
        figures = scene["differences"]["rigid"]["figures"]
        outside = [name for name, figure in figures.items()
                   if figure["judged"] and figure["difference"] is not None and not figure["within"]]
        self.assertEqual(outside, ["hard_impacts"])


if __name__ == "__main__":
    unittest.main()
