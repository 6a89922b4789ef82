"""The public headers: which ones are installed, what they include, and that they say what they are about."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from product import BUILD, SOURCE

LIST = SOURCE / "native_model/cmake/RotorubHeaders.cmake"


def listed():
    text = re.sub(r"#.*", "", LIST.read_text())
    return re.search(r"set\(ROTORUB_PUBLIC_HEADERS([^)]*)\)", text)[1].split()


def controller_header():
    return re.search(r"set\(ROTORUB_CONTROLLER_HEADER (\S+)\)", LIST.read_text())[1]


def included_by(headers):
    """All that they include of ours, directly or not, themselves too."""
    seen, left = set(headers), list(headers)
    while left:
        for header in re.findall(r'^#include "([^"]+)"', (SOURCE / left.pop()).read_text(), re.M):
            if header not in seen:
                seen.add(header)
                left.append(header)
    return seen


def without_explanation(header):
    """Types and functions of a header's namespaces that no comment is about: before it, before its group, or behind it."""
    missing, lines = [], (SOURCE / header).read_text().splitlines()
    depth = explained = 0
    for line in lines:
        code, _, comment = line.partition("//")
        outer = depth == 0 and not line.startswith((" ", "#", "}", "namespace", "extern", "template", "using"))
        if not line.strip():
            explained = False
        elif line.lstrip().startswith(("//", "/*", "* ")) or comment:
            explained = True
        elif outer and not explained and not re.match(r"(class|struct) \w+;", code):
            missing.append(f"{header}: {line}")
        if not re.match(r"namespace|extern", line):
            depth = max(0, depth + code.count("{") - code.count("}"))
    return missing


class Headers(unittest.TestCase):
    def test_the_public_ones_are_installed_and_what_they_include_is_marked_internal(self):
        with tempfile.TemporaryDirectory(prefix="rotorub_headers_") as folder:
            subprocess.run([os.environ["ROTORUB_CMAKE"], "--install", BUILD, "--component", "headers", "--prefix", folder],
                           check=True, stdout=subprocess.DEVNULL)
            place = pathlib.Path(folder) / "include/rotorub"
            found = {str(file.relative_to(place)) for file in place.rglob("*") if file.is_file()}
            [controller] = [file for file in found if "ROTORUB_CONTROLLER_ABI 1" in (place / file).read_text()]
        public = listed()
        self.assertGreater(len(public), 15)
        internal = included_by(public) - set(public)
        self.assertEqual(found, {*public, *(f"internal/{file}" for file in internal), "controller.h"})
        self.assertEqual(controller, "controller.h")

    def test_nothing_of_the_plugin_or_of_mjcf_comes_along(self):
        internal = included_by(listed()) - set(listed())
        self.assertEqual([file for file in internal if not file.startswith("native_model/")], [])

    def test_documents_and_examples_for_users_include_public_ones_alone(self):
        allowed = {*listed(), "rotorub/controller.h"}
        own = re.compile(r'^\s*#include ["<]((?:native_model|mjcf|plugin|rotorub)/[^">]+)', re.M)
        checked = 0
        for file in [*SOURCE.glob("*/**/*.md"), *(SOURCE / "native_model/examples").rglob("*.cc"),
                     *(SOURCE / "native_model/control/examples").glob("*.c"), *(SOURCE / "plugin/examples").glob("*.cc"),
                     SOURCE / "tests/package/outside/main.cc"]:
            if "build" in file.relative_to(SOURCE).parts:
                continue
            includes = own.findall(file.read_text())
            checked += len(includes)
            self.assertLessEqual(set(includes), allowed, file)
        self.assertGreater(checked, 8)

    def test_every_type_and_function_is_explained(self):
        headers = [*listed(), controller_header()]
        self.assertEqual("\n".join(line for header in headers for line in without_explanation(header)), "")

    def test_their_overview_names_what_there_is(self):
        text = (SOURCE / "native_model/docs/public_headers.md").read_text()
        named = set(re.findall(r"`([\w/]+\.h)`", text))
        folder_of = {pathlib.PurePath(file).name: file for file in [*listed(), "rotorub/controller.h"]}
        self.assertGreater(len(named), 8)
        for name in named:
            self.assertIn(pathlib.PurePath(name).name, folder_of, name)


if __name__ == "__main__":
    unittest.main()
