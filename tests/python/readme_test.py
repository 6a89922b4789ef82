"""The blocks of python/README.md run as they stand there."""

import contextlib
import io
import os
import unittest

from support import InFolder, blocks


class Readme(InFolder):
    def test_every_block_runs(self):
        self.readme_commands("python/README.md")
        here = os.getcwd()
        os.chdir(self.folder)
        try:
            said = io.StringIO()
            found = blocks("python/README.md", "python")
            self.assertGreaterEqual(len(found), 4)
            with contextlib.redirect_stdout(said):
                for block in found:
                    exec(compile(block, "python/README.md", "exec"), {})
        finally:
            os.chdir(here)
        self.assertIn("smallest gap", said.getvalue())
        self.assertIn("um off", said.getvalue())


if __name__ == "__main__":
    unittest.main()
