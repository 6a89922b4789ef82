"""Every C++ file is as clang-format leaves it after .clang-format."""

import subprocess
import unittest

from product import SOURCE

ROOMS = ("native_model", "mjcf", "plugin", "compare", "renders", "tests")


class Format(unittest.TestCase):
    def test_every_file(self):
        files = [str(path) for room in ROOMS for path in sorted((SOURCE / room).rglob("*"))
                 if path.suffix in (".cc", ".h", ".c")]
        self.assertGreater(len(files), 500)
        done = subprocess.run(["clang-format", "--dry-run", "--Werror", *files], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"`clang-format -i` these:\n{done.stderr[:4000]}")


if __name__ == "__main__":
    unittest.main()
