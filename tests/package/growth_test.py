"""The growth table of tests/bench: its command in a short form, and whether README.md still shows what the command runs."""

import re
import sys
import unittest

from product import BUILD, SOURCE

sys.path.insert(0, str(SOURCE / "tests/bench"))
import growth  # noqa: E402


def readme_rows():
    """The rows of the table in tests/bench/README.md: name, then the other cells."""
    text = (SOURCE / "tests/bench/README.md").read_text()
    lines = text.split("## Growth")[1].split("\n## ")[0].splitlines()
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("| ")]
    return [(row[0], row[1:]) for row in cells if row[0] not in ("", "---")]


class Growth(unittest.TestCase):
    def test_the_exponent_is_the_slope_of_the_logarithms(self):
        self.assertAlmostEqual(growth.exponent([(1, 3.0), (2, 12.0), (4, 48.0)]), 2.0, places=12)
        self.assertAlmostEqual(growth.exponent([(0, 1.0), (1, 5.0), (8, 5.0)]), 0.0, places=12)

    def test_the_short_form_runs_every_kind(self):
        measured = growth.measure(BUILD / "bin/rotorub", 1, short=True)
        self.assertEqual(list(measured), list(growth.SIZES))
        for kind, rows in measured.items():
            self.assertEqual(len(rows), 2, kind)
            for _, verlet, event in rows:
                self.assertGreater(verlet["wall_s"], 0.0)
                self.assertGreater(verlet["impacts"] + event["impacts"], 0, f"{kind}: no contact")
        steps = [verlet["steps"] for _, verlet, _ in measured["duration, s"]]
        self.assertEqual(steps, [4000, 8000])
        self.assertEqual(growth.table(measured).count("*exponent*"), len(growth.SIZES))

    def test_the_readme_shows_the_scenes_of_the_command(self):
        rows = readme_rows()
        expected = [f"{kind}: {size:g}" for kind in growth.SIZES for size in growth.SIZES[kind]]
        self.assertEqual([name for name, _ in rows if not name.startswith("*")], expected)
        fitted = [name for name, _ in rows if name.startswith("*")]
        self.assertEqual(len(fitted), len(growth.SIZES))

    def test_the_readme_shows_the_steps_of_the_base_scene(self):
        """The steps of `event` depend on no machine; round-off may move an impact."""
        shown = dict(readme_rows())["contacts: 1"][2]
        [(size, _, event)] = growth.measure(BUILD / "bin/rotorub", 1, kinds=("contacts",), most=1)["contacts"]
        self.assertEqual(size, 1)
        self.assertAlmostEqual(event["steps"], int(re.sub(r"\D", "", shown)), delta=0.1 * event["steps"])


if __name__ == "__main__":
    unittest.main()
