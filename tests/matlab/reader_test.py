"""Octave reads a run with compare/matlab/rotorub_read.m, and runs the blocks of compare/matlab/README.md."""

import pathlib
import shutil
import subprocess
import unittest

from support import ROOT, SCENES, InFolder, blocks

HERE = pathlib.Path(__file__).resolve().parent


class Matlab(InFolder):
    def octave(self, text):
        done = subprocess.run(["octave-cli", "--norc", "--quiet", "--eval", text], cwd=self.folder, capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_it_reads_what_the_files_say(self):
        # 250 rows, as Octave takes a second for 5,000 numbers.
        self.rotorub("run", SCENES / "bench_ring.toml", "--end", "0.05", "--set", "run.output_step=200us", "-o", "run")
        self.rotorub("run", SCENES / "bench_drop.toml", "--end", "1ms", "-o", "empty")
        for name, line in (("short", "1,2\n"), ("word", "1,2,3,4,5,6,7,nonsense\n")):
            shutil.copytree(self.folder / "run", self.folder / name)
            with open(self.folder / name / "impacts.csv", "a") as file:
                file.write(line)
        said = self.octave(f"addpath('{ROOT}/compare/matlab', '{HERE}'); reader_test('run', {{'short', 'word', 'nowhere'}}); "
                           "run = rotorub_read('empty'); printf('%d', numel(run.impacts.t) + numel(run.events.event));")
        self.assertEqual(said, "all is well\n0")

    def test_the_blocks_of_the_readme_run(self):
        (self.folder / "compare").mkdir()
        (self.folder / "compare/matlab").symlink_to(ROOT / "compare/matlab")
        self.readme_commands("compare/matlab/README.md")
        found = blocks("compare/matlab/README.md", "matlab")
        self.assertEqual(len(found), 2)
        said = self.octave("\n".join(found))
        self.assertRegex(said, r"hardest of \d+ impacts: [\d.]+ N s at 0.1")


if __name__ == "__main__":
    unittest.main()
