"""What is linked and how: bound and locked before main, stacks and copies watched, and no start pays for Mesa."""

import subprocess
import unittest

from product import BUILD

FILES = [BUILD / "bin" / "rotorub", BUILD / "lib" / "librotorub_mujoco.so"]


def readelf(option, file):
    return subprocess.run(["readelf", "-W", option, file], text=True, capture_output=True, check=True).stdout


class Hardened(unittest.TestCase):
    def test_addresses_are_bound_and_locked(self):
        for file in FILES:
            self.assertIn("GNU_RELRO", readelf("-l", file), file)
            self.assertRegex(readelf("-d", file), r"BIND_NOW|FLAGS_1.*NOW", file)

    def test_stacks_and_copies_are_watched(self):
        for file in FILES:
            symbols = readelf("--dyn-syms", file)
            self.assertIn("__stack_chk_fail", symbols, file)
            self.assertRegex(symbols, r"__\w+_chk\b", file)

    # Mesa brings LLVM, two thirds of the time that a start takes: it is loaded where a picture is made.
    def test_mesa_is_loaded_for_pictures_alone(self):
        linked = subprocess.run(["ldd", FILES[0]], text=True, capture_output=True, check=True).stdout
        self.assertIn("libmujoco", linked)
        self.assertNotIn("OSMesa", linked)

    # Loaded into foreign processes: small, with its debug information in a file beside it.
    def test_the_plugin_has_its_debug_information_beside_it(self):
        plugin = FILES[1]
        self.assertLess(plugin.stat().st_size, 10e6)
        self.assertIn(".gnu_debuglink", readelf("-S", plugin))
        self.assertIn(".debug_line", readelf("-S", plugin.with_name(plugin.name + ".debug")))


if __name__ == "__main__":
    unittest.main()
