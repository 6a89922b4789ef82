"""The rooms of native_model, plugin and compare: the check of RotorubRooms.cmake, on the sources as they are and on faulty parts."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from product import SOURCE

CMAKE = os.environ["ROTORUB_CMAKE"]
CHECK = SOURCE / "native_model/cmake/RotorubRooms.cmake"
SCRIPT = f"""cmake_minimum_required(VERSION 3.25)
include("{CHECK}")
function(rotorub_room room)  # of compare, without its library
  cmake_parse_arguments(ARG "" "EXCLUDE" "USES;LINK" ${{ARGN}})
  rotorub_declare_room(${{room}} USES ${{ARG_USES}})
endfunction()
"""
PARTS = ["native_model", "plugin", "compare"]
CALL = r"^(?:rotorub_room|rotorub_declare_room|rotorub_rooms_are_all)\([^)]*\)"


def calls(part):
    """The declarations of a part's CMakeLists.txt."""
    return re.findall(CALL, re.sub(r"#.*", "", (SOURCE / part / "CMakeLists.txt").read_text()), re.M)


def refusal(part, declarations):
    """What configuring says of the declarations in the folder of a part; empty where it accepts them."""
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder) / "rooms.cmake"
        script.write_text(SCRIPT + "\n".join(declarations))
        done = subprocess.run([CMAKE, "-P", script], cwd=part, capture_output=True, text=True)
    return "" if done.returncode == 0 else " ".join(done.stderr.split())


class Rooms(unittest.TestCase):
    def test_every_part_keeps_its_walls(self):
        for part in PARTS:
            with self.subTest(part):
                self.assertGreaterEqual(len(calls(part)), 6)
                self.assertEqual(refusal(SOURCE / part, calls(part)), "")

    def test_a_run_and_what_is_below_it_do_without_linear_analysis(self):
        users = [call.split()[0] for call in calls("native_model") if "linear" in call.split()[1:]]
        self.assertEqual(users, ["rotorub_declare_room(prepare"])


class FaultyParts(unittest.TestCase):
    """A part `house` with the rooms low and high, and files in its own folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.house = pathlib.Path(folder.name) / "house"
        self.write("low/low.h", "#include <cmath>\n")
        self.write("high/deep/high.cc", '#include "house/low/low.h"\n')

    def write(self, name, text):
        file = self.house / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def check(self, *declarations):
        return refusal(self.house, [f"rotorub_declare_room({d})" for d in declarations] + ["rotorub_rooms_are_all(EXCEPT spare)"])

    def test_what_is_declared_is_accepted(self):
        self.write("house.cc", '#include "house/high/high.h"\n#include "house/house.h"\n')
        self.write("spare/spare.cc", '#include "house/low/low.h"\n')
        self.assertEqual(self.check("low", "high USES low", ". USES high"), "")

    def test_an_undeclared_include_is_named(self):
        self.assertIn("house/high/deep/high.cc includes the room low, which the room high does not declare", self.check("low", "high"))

    def test_an_include_of_the_files_of_the_part_itself_is_named(self):
        self.write("low/low.cc", '#include "house/house.h"\n')
        self.assertIn("house/low/low.cc includes the room ., which the room low does not declare", self.check("low", "high USES low", "."))

    def test_a_room_that_is_not_included_is_named(self):
        self.write("middle/middle.h", "")
        self.assertIn("the room high declares that it uses middle", self.check("low", "middle", "high USES low middle"))

    def test_a_room_is_declared_before_those_that_use_it(self):
        self.assertIn("the room high uses low, which is not declared before it", self.check("high USES low", "low"))

    def test_a_folder_without_a_declaration_is_named(self):
        self.assertIn("house/high/deep/high.cc is in no room", self.check("low"))


if __name__ == "__main__":
    unittest.main()
