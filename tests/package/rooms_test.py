"""The rooms of compare/: each includes the rooms that compare/CMakeLists.txt says it uses, no other, and none in a circle."""

import re
import unittest

from product import SOURCE

COMPARE = SOURCE / "compare"


def declared():
    """{room: rooms that it uses}, in the order of declaration."""
    text = re.sub(r"#.*", "", (COMPARE / "CMakeLists.txt").read_text())
    rooms = {}
    for call in re.findall(r"rotorub_room\(([^)]*)\)", text):
        words = call.split()
        uses = []
        if "USES" in words:
            for word in words[words.index("USES") + 1:]:
                if word.isupper():
                    break
                uses.append(word)
        rooms[words[0]] = uses
    return rooms


def included():
    """{room: {room: a file that includes it}}."""
    rooms = {}
    for file in sorted([*COMPARE.glob("*/**/*.h"), *COMPARE.glob("*/**/*.cc")]):
        room = file.relative_to(COMPARE).parts[0]
        used = rooms.setdefault(room, {})
        for other in re.findall(r'#include "compare/(\w+)/', file.read_text()):
            if other != room:
                used[other] = str(file.relative_to(SOURCE))
    return rooms


class Rooms(unittest.TestCase):
    def test_every_folder_with_sources_is_a_room(self):
        self.assertEqual(sorted(declared()), sorted(set(included()) - {"python"}))  # a library of its own

    def test_a_room_includes_what_it_declares_and_nothing_else(self):
        found = included()
        for room, uses in declared().items():
            with self.subTest(room):
                self.assertEqual({r: f for r, f in found[room].items() if r not in uses}, {}, "included, not declared")
                self.assertEqual(sorted(set(uses) - set(found[room])), [], "declared, not included")

    def test_no_circle(self):
        below = set()
        for room, uses in declared().items():
            self.assertLessEqual(set(uses), below, f"{room} uses a room that is declared after it")
            below.add(room)
        self.assertGreater(len(below), 15)

    def test_the_bottom_includes_nothing_of_compare(self):
        self.assertEqual(included()["base"], {})

    def test_nobody_looks_into_the_commands(self):
        self.assertEqual([room for room, used in included().items() if "commands" in used], [])


if __name__ == "__main__":
    unittest.main()
