"""Tables of compare/docs/findings.md and compare/modes/README.md, computed anew: what is cheap enough of them."""

import json
import re
import unittest

from product import SOURCE, InAFolder, third

SCENES = SOURCE / "mjcf"
MUJOCO = ("--engine", "mujoco", "--step", "10us", "--contact")


def rows(document, head):
    """{first cell: [the others]} of the table that begins with the line."""
    lines = (SOURCE / document).read_text().splitlines()
    table = {}
    for line in lines[next(i for i, line in enumerate(lines) if line.startswith(head)) + 2:]:
        if not line.startswith("|"):
            break
        first, *cells = (cell.strip() for cell in line.strip("|").split("|"))
        table.setdefault(first, []).append(cells)
    return table


class Findings(InAFolder):
    def is_as_told(self, told, value):
        """To the digits that are told; -31,416 and 7.0e-9 are numbers too."""
        number = re.match(r"-?[\d.,]+(?:e-?\d+)?", told)[0].replace(",", "")
        mantissa, _, exponent = number.partition("e")
        digits = len(mantissa.partition(".")[2])
        self.assertAlmostEqual(float(number), value, delta=0.51 * 10.0 ** (int(exponent or 0) - digits), msg=told)

    def run_of(self, scene, *words):
        return json.loads(self.rotorub("run", SCENES / f"{scene}.toml", *words, "-o", "run", "--json"))

    def test_the_cone_on_the_bench(self):
        table = rows("compare/docs/findings.md", "| | native `event` | `cone` as it comes |")
        sides = {0: (), 2: (*MUJOCO, "cone", "--set", "mujoco.friction_reference=1"), 3: (*MUJOCO, "cone-coulomb"),
                 4: (*MUJOCO, "rigid")}
        bench = {name: cells for name, [cells] in table.items() if name.startswith("`bench")}
        self.assertEqual(len(bench), 4)
        for name, cells in bench.items():
            scene, end = re.match(r"`(\w+)`, ([\d.]+) s", name).groups()
            for side, words in sides.items():
                summary = self.run_of(scene, *words, "--end", end)
                force, share = re.match(r"([\d.]+)(?: ± [\d.]+)? N, ([\d.]+) %", cells[side]).groups()
                self.is_as_told(force, summary["mean_force"])
                self.is_as_told(share, 100.0 * summary["contact_fraction"])

    def test_the_ball_bearing(self):
        table = rows("compare/docs/findings.md", "| | begins to roll | leaves the ring |")
        self.assertEqual(len(table), 5)
        for name, [(rolls, leaves, speed, force)] in table.items():
            contact = re.search(r"MuJoCo `([\w-]+)`", name)
            self.run_of("touchdown_ball_bearing", *((*MUJOCO, contact[1]) if contact else ()))
            at = min(self.table("run/series.csv"), key=lambda row: abs(float(row["t"]) - 0.1))
            self.is_as_told(speed, float(at["ring_speed"]))
            self.is_as_told(force, float(at["normal_force"]))
            events = [(float(row["t"]), row["event"]) for row in self.table("run/events.csv")]
            self.is_as_told(leaves, [t for t, event in events if event == "lift_off"][-1])
            if name != "MuJoCo `cone`, 10 us":  # whose touches are too short for a mode of their own
                self.is_as_told(rolls, next(t for t, event in events if event == "stick"))

    def test_the_errors_on_the_ring(self):
        table = rows("compare/docs/findings.md", "| `bench_ring`, 0.5 s | 100 us |")
        columns = third(enumerate(("100us", "10us", "1us")))
        said = json.loads(self.rotorub("bench", SCENES / "bench_ring.toml", "--engines", "native,mujoco-rigid", "--steps",
                                       ",".join(step for _, step in columns), "--repeats", "1", "--json"))
        errors = {(point["engine"], f"{1e6 * point['step']:.0f}us"): point["position_error"] for point in said["scenes"][0]["points"]
                  if point["step"] and point["setting"] != "implicit"}
        for name, engine in (("native `verlet`", "native-verlet"),
                             ("MuJoCo `rigid`, which takes the same step", "mujoco-rigid")):
            [cells] = table[name]
            for k, step in columns:
                self.is_as_told(cells[k], errors[engine, step])

    def test_the_rubs_of_the_whip(self):
        table = rows("compare/modes/README.md", "| rub | whirl |")
        rubs = json.loads(self.rotorub("modes", SCENES / "bench_whip.toml", "--json"))["speeds"][0]["rub"]["rubs"]
        told = [(kind, *cells) for kind, lines in table.items() for cells in lines]
        self.assertEqual(len(told), len(rubs))
        for (kind, whirl, force, growth, word), rub in zip(told, rubs):
            self.assertEqual(kind, rub["kind"])
            self.is_as_told(whirl, rub["whirl"])
            self.is_as_told(force, rub["normal_force"])
            self.is_as_told(growth, rub["growth_rate"])
            self.assertEqual(word.startswith("stable"), rub["stable"])


if __name__ == "__main__":
    unittest.main()
