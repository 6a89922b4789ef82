"""The tutorials and other documents, command by command as they stand there, and the lines that they show of the output.

A block `sh` is run, line by line. A block with a file's name after its language is that file. A block `text` is lines of
the output of the last `sh`, in their order; white space may differ, and numbers by 3 %: other round-off is another chaotic run.
"""

import json
import os
import re
import shlex
import subprocess
import unittest

from product import BUILD, NIGHTLY, SOURCE, InAFolder

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
QUICKER = " --no-modes-ladder"  # after a comparison: nothing of it is shown
# Comparisons that take up to a minute. They run nightly; every day the shortest one of the tutorials runs, `-o first`.
LONG = re.compile(r"^rotorub compare .* -o (trust|judged|second)$", re.M)


def blocks(name):
    """[(language, file or "", text), ...]"""
    text = (SOURCE / name).read_text()
    return re.findall(r"^```(\w+) ?([\w.]*)\n(.*?)^```$", text, re.S | re.M)


def words_of(line):
    return " ".join(NUMBER.sub("#", line).split())


def close(shown, printed):
    numbers = [float(number) for number in NUMBER.findall(shown)], [float(number) for number in NUMBER.findall(printed)]
    return len(numbers[0]) <= len(numbers[1]) and all(abs(a - b) <= 0.03 * abs(b) for a, b in zip(*numbers))


def shows(shown, printed):
    """The printed line begins as the shown one."""
    return words_of(printed).startswith(words_of(shown)) and close(shown, printed)


class Tutorials(InAFolder):
    def run_line(self, line):
        if line.startswith("rotorub compare"):
            line += QUICKER
        environment = {**os.environ, "PATH": f"{BUILD / 'bin'}:{os.environ['PATH']}",
                       "ROTORUB": str(self.folder / "rotorub")}
        done = subprocess.run(["bash", "-c", line], cwd=self.folder, env=environment, text=True, capture_output=True)
        # Outside the tolerance is an answer of `compare`, no failure.
        self.assertIn(done.returncode, (0, 1) if "compare" in shlex.split(line) else (0,), f"{line}\n{done.stdout}{done.stderr}")
        return done.stdout + done.stderr

    def walk(self, name):
        # The repository as its reader has it: the source with its build in it, wherever the test's build is.
        clone = self.folder / "rotorub"
        clone.mkdir()
        (clone / "build").symlink_to(BUILD)
        for part in ("native_model", "mjcf"):
            (clone / part).symlink_to(SOURCE / part)
        said, shown, left_out = [], 0, False
        for language, file, text in blocks(name):
            if file:
                (self.folder / file).write_text(text)
            elif language == "sh":
                left_out = not NIGHTLY and LONG.search(text)
                if left_out:
                    continue
                said = [line for command in text.splitlines() for line in self.run_line(command).splitlines()]
            elif language == "text":
                at = 0
                for line in [] if left_out else text.splitlines():
                    found = next((i for i in range(at, len(said)) if shows(line, said[i])), None)
                    self.assertIsNotNone(found, f"{name}: not printed after line {at}: {line}\n" + "\n".join(said))
                    at, shown = found + 1, shown + 1
            elif language == "c":
                examples = (SOURCE / "native_model/control/examples").glob("*.c")
                self.assertTrue(any(text in example.read_text() for example in examples), f"{name}: in no example:\n{text}")
            elif language != "toml":  # an excerpt
                self.fail(f"{name}: a block of {language} that nothing reads")
        return shown

    def tutorial(self, name):
        self.assertGreater(self.walk(f"compare/docs/{name}"), 5)

    def test_engineer(self):
        self.tutorial("tutorial_engineer.md")
        self.assertGreater((self.folder / "lost.png").stat().st_size, 10_000)
        self.assertIn("</html>", (self.folder / "lost/plot.html").read_text())

    def test_controls_student(self):
        self.tutorial("tutorial_controls.md")

    def test_mujoco_user(self):
        self.tutorial("tutorial_mujoco.md")

    def test_own_controller(self):
        self.walk("mjcf/docs/own_controller.md")
        for run, least in (("own", 0.9), ("follow", 0.0), ("tracking", 0.5)):  # the one in C holds what it has touched, by a preload
            summary = json.loads((self.folder / run / "summary.json").read_text())
            self.assertEqual(summary["status"], "ok")
            self.assertGreater(summary["contact_fraction"], least)
        # The law of magnetic bearings holds the rotor until they fail.
        summary = json.loads((self.folder / "levitated/summary.json").read_text())
        self.assertEqual(summary["status"], "ok")
        self.assertGreater(summary["first_touch"], 0.1)


class Reader(unittest.TestCase):
    def test_what_is_shown_is_what_is_printed(self):
        self.assertTrue(shows("mean force, N  91.57", "  mean force, N              91.60"))
        self.assertFalse(shows("mean force, N  91.57", "  mean force, N              81.60"))
        self.assertFalse(shows("largest force, N  91.57", "  mean force, N              91.57"))
        self.assertFalse(shows("rubs: yes, 3 ms", "rubs: yes"))


if __name__ == "__main__":
    unittest.main()
