"""The blocks of compare/python/README.md, and that of compare/docs/program.md, run as they stand there."""

import contextlib
import io
import os
import unittest

from support import SCENES, InFolder, blocks


class Readme(InFolder):
    def said_by(self, readme, count):
        """What its blocks print, each run by itself."""
        found = blocks(readme, "python")
        self.assertEqual(len(found), count)
        said = io.StringIO()
        here = os.getcwd()
        os.chdir(self.folder)
        try:
            with contextlib.redirect_stdout(said):
                for block in found:
                    exec(compile(block, readme, "exec"), {})
        finally:
            os.chdir(here)
        return said.getvalue()

    def test_every_block_runs(self):
        self.readme_commands("compare/python/README.md")
        said = self.said_by("compare/python/README.md", 6)
        self.assertIn("smallest gap", said)
        self.assertRegex(said, r"hardest of \d+ impacts at 0\.1\d+ s: [\d.]+ N s")
        self.assertIn("um off", said)
        self.assertIn("has the least peak force", said)
        self.assertIn("contact.frction", said)
        self.assertRegex(said, r"ok -?[\d.e-]+ N")

    def test_the_projects_own_runs(self):
        self.rotorub("run", SCENES / "paper_passive.toml", "--end", "0.12")
        self.assertRegex(self.said_by("compare/docs/program.md", 1), r"^-?[\d.e-]+ m 0\.\d+ 0\.\d+\n$")


if __name__ == "__main__":
    unittest.main()
