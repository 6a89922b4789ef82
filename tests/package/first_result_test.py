"""The README's way to a first result, command by command as it stands there."""

import json
import os
import re
import shlex
import subprocess
import unittest

from product import BUILD, InAFolder, SOURCE

# What is added to a command, so that a test can wait for it: fewer pictures, a shorter and coarser comparison without films.
QUICKER = {
    "render": ["--size", "320x240", "--slow", "40"],
    "compare": ["--end", "112ms", "--step", "20us", "--twins", "2", "--no-video", "--no-modes-ladder"],
}


def commands():
    section = (SOURCE / "README.md").read_text().split("## First result")[1].split("\n## ")[0]
    block = section.split("```sh\n")[1].split("```")[0]
    return [shlex.split(line, comments=True) for line in block.splitlines()]


class FirstResult(InAFolder):
    def test_every_command_does_what_it_says(self):
        lines = commands()
        self.assertEqual([line[1] for line in lines], ["init", "modes", "run", "run", "render", "compare"])
        path = {**os.environ, "PATH": f"{BUILD / 'bin'}:{os.environ['PATH']}"}
        for line in lines:
            done = subprocess.run(line + QUICKER.get(line[1], []), cwd=self.folder, env=path, text=True,
                                  capture_output=True)
            # So short a comparison may find single impacts further apart than the whole one does.
            codes = (0, 1) if line[1] == "compare" else (0,)
            self.assertIn(done.returncode, codes, f"{line}\n{done.stdout}{done.stderr}")
        before, after = (json.loads((self.folder / run / "summary.json").read_text()) for run in ("before", "after"))
        told = re.search(r"after (\d+) hard impacts.*about ([\d,]+) hard\s+impacts, and lasting contact for about (\d+) % of the time "
                         r"instead of (\d+) %", (SOURCE / "README.md").read_text(), re.S)
        hits, bounces, bouncing, lasting = (int(number.replace(",", "")) for number in told.groups())
        self.assertEqual(before["hard_impacts"], hits)
        self.assertAlmostEqual(after["hard_impacts"], bounces, delta=10)  # it bounces on: other round-off, other impacts
        self.assertAlmostEqual(100.0 * before["lasting_fraction"], lasting, delta=0.5)
        self.assertAlmostEqual(100.0 * after["lasting_fraction"], bouncing, delta=1.0)  # likewise
        self.assertLess(self.hard_impacts(path, "10us"), hits)
        self.assertEqual(self.hard_impacts(path, "2us"), hits)
        self.assertGreater((self.folder / "rub.mp4").stat().st_size, 10_000)
        self.assertIn("</html>", (self.folder / "report/report.html").read_text())

    def hard_impacts(self, path, step):
        """By the rigid law in MuJoCo."""
        done = subprocess.run(["rotorub", "run", "rig.toml", "--engine", "mujoco", "--contact", "rigid", "--step", step, "--json"],
                              cwd=self.folder, env=path, text=True, capture_output=True, check=True)
        return json.loads(done.stdout)["hard_impacts"]


if __name__ == "__main__":
    unittest.main()
