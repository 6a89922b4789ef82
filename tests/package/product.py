"""The product as a user has it: the program, started in a folder of its own."""

import csv
import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["ROTORUB_SOURCE_DIR"])
BUILD = pathlib.Path(os.environ["ROTORUB_BUILD_DIR"])
BINARY = BUILD / "bin" / "rotorub"
NIGHTLY = os.environ.get("ROTORUB_NIGHTLY") == "1"
nightly = unittest.skipUnless(NIGHTLY, "runs nightly")


def third(cases):
    """Every day the first of each three cases, nightly all of them."""
    return list(cases)[:: 1 if NIGHTLY else 3]


def shipped():
    """Every scene in the repository; studies and what else is TOML are none."""
    return sorted(file for file in (SOURCE / "mjcf").rglob("*.toml") if file.parent.name != "studies")


def options_of_help(text):
    """The options that a help text lists: [["-o", "--output"], ...]; a switch and its opposite are one entry."""
    entries = []
    for line in text.splitlines():
        if line.startswith("  -"):
            names = line.split()[0].split(",")
            entries.append([name.split("{")[0] for name in names])
    return entries


class InAFolder(unittest.TestCase):
    """Each test has an empty folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="rotorub_package_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def rotorub(self, *words, code=0, program=BINARY, env=None, timeout=120):
        """Runs it; the exit code is `code` (one, or several that are right). Gives standard output."""
        done = subprocess.run([program, *map(str, words)], cwd=self.folder, text=True, capture_output=True,
                              env={**os.environ, **(env or {})}, timeout=timeout)
        codes = (code,) if isinstance(code, int) else code
        self.assertIn(done.returncode, codes, f"rotorub {' '.join(map(str, words))}\n{done.stdout}{done.stderr}")
        self.said = done.stderr
        return done.stdout

    def table(self, name):
        """The rows of a CSV file in the folder, a dictionary each."""
        with open(self.folder / name) as file:
            return list(csv.DictReader(file))

    def commands(self):
        """The commands that the program's help lists."""
        listed = self.rotorub("--help").split("Subcommands:")[1]
        return [line.split()[0] for line in listed.splitlines() if line.startswith("  ") and line[2] != " "]
