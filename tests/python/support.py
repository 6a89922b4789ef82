"""What the tests share: the built program, the shipped scenes, folders that go with the test."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ROOT / "mjcf"
PROGRAM = os.environ["ROTORUB_BINARY"]


def blocks(readme, language):
    """The code blocks of a language in a README of this repository, as they stand."""
    return re.findall(rf"^```{language}\n(.*?)^```$", (ROOT / readme).read_text(), re.S | re.M)


class InFolder(unittest.TestCase):
    """Each test case in a new folder, where `runs` come to stand."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def rotorub(cls, *words, code=0):
        done = subprocess.run([PROGRAM, *map(str, words), "-q"], cwd=cls.folder, capture_output=True, text=True)
        if done.returncode != code:
            raise AssertionError(f"{words}: exit code {done.returncode}: {done.stderr}")
        return done

    @classmethod
    def readme_commands(cls, readme):
        """Runs the commands of a README's first sh block."""
        (cls.folder / "mjcf").symlink_to(SCENES)
        path = f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}"
        subprocess.run(["sh", "-ec", blocks(readme, "sh")[0]], cwd=cls.folder, env={**os.environ, "PATH": path},
                       check=True, stdout=subprocess.DEVNULL)
