"""What the documents say is there: equations, links, examples, commands."""

import json
import pathlib
import re
import unittest

from product import SOURCE, shipped

NO_SOURCE = ["build", "runs"]  # what a build or a run leaves
CODE = ["native_model", "plugin", "mjcf", "compare", "renders", "tests"]
# What is printed or measured stands in these.
WITH_FIGURES = ["README.md", "compare/README.md", "compare/docs/findings.md", "compare/modes/README.md", "compare/tune/README.md"]
# "(12)", "(12)-(13)" in a comment; not "man(7)", "5(3)", "f(1)".
CITED = re.compile(r"(?<![\w)])\((\d{1,2})\)(?:\s?-\s?\((\d{1,2})\))?")


def documents():
    left_out = {"build", "node_modules"}
    return sorted(file for file in SOURCE.rglob("*.md") if not left_out & set(file.relative_to(SOURCE).parts))


def cited_equations():
    """{number: [file, ...]} of the equations that comments of the code cite."""
    cited = {}
    for folder in CODE:
        for file in [*(SOURCE / folder).rglob("*.h"), *(SOURCE / folder).rglob("*.cc")]:
            for line in file.read_text().splitlines():
                _, _, comment = line.partition("//")
                for first, last in CITED.findall(comment):
                    for number in range(int(first), int(last or first) + 1):
                        cited.setdefault(number, []).append(file.name)
    return cited


def without_code(text):
    return re.sub(r"```.*?```|`[^`\n]*`", "", text, flags=re.S)


class Documents(unittest.TestCase):
    def test_every_equation_that_the_code_cites_stands_in_the_theory(self):
        numbers = [int(tag) for tag in re.findall(r"\\tag\{(\d+)\}", (SOURCE / "native_model/docs/theory.md").read_text())]
        self.assertEqual(len(numbers), len(set(numbers)), "a number stands twice")
        self.assertEqual(sorted(numbers), list(range(1, len(numbers) + 1)), "no number is left out")
        cited = cited_equations()
        self.assertGreater(len(cited), 15)
        missing = {number: files for number, files in cited.items() if number not in numbers and number > 0}
        self.assertEqual(missing, {})

    def test_every_part_of_the_theory_has_its_evidence(self):
        """Sections of the theory that claim something, and tests that there are."""
        text = (SOURCE / "native_model/docs/evidence.md").read_text()
        sections = re.findall(r"^## (.*)$", (SOURCE / "native_model/docs/theory.md").read_text(), re.M)
        claims = sections[:sections.index("Validation")]
        linked = set(re.findall(r"\(theory\.md#([\w-]+)\)", text))
        self.assertEqual(linked, {re.sub(r"[^\w\- ]", "", section.lower()).replace(" ", "-") for section in claims})
        code = "\n".join(file.read_text() for file in (SOURCE / "tests").rglob("*_test.cc"))
        there = {f"{suite}.{name}" for suite, name in re.findall(r"^TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)", code, re.M)}
        named = re.findall(r"`([A-Z]\w+\.[A-Z]\w+)`", text)
        self.assertGreater(len(named), 50)
        self.assertEqual(sorted(set(named) - there), [])

    def test_contributors_are_led_to_what_is_there(self):
        text = (SOURCE / ".github/CONTRIBUTING.md").read_text()
        named = {word for word in re.findall(r"`([\w./-]+)`", text) if "/" in word}
        self.assertGreater(len(named), 15)
        for place in named - {"mjcf/NAME.toml"}:
            self.assertTrue(place.startswith("build/") or (SOURCE / place).exists(), place)
        presets = {preset["name"] for preset in json.loads((SOURCE / "CMakePresets.json").read_text())["configurePresets"]}
        self.assertLessEqual({"dev", "asan-ubsan", "tsan", "nan-init"}, presets)

    def test_the_top_level_is_the_products(self):
        shown = {entry.name for entry in SOURCE.iterdir() if entry.name[0] != "." and entry.name not in NO_SOURCE}
        self.assertEqual(shown, {"CHANGELOG.md", "CITATION.cff", "CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "compare", "mjcf",
                                 "native_model", "plugin", "renders", "tests"})

    def test_the_version_is_one(self):
        version = re.search(r"^  VERSION (\S+)$", (SOURCE / "CMakeLists.txt").read_text(), re.M)[1]
        newest = re.search(r"^## (\S+), (\S+)$", (SOURCE / "CHANGELOG.md").read_text(), re.M).groups()
        citation = (SOURCE / "CITATION.cff").read_text()
        cited = tuple(re.search(rf'^{key}: "?([^"\n]+)"?$', citation, re.M)[1] for key in ("version", "date-released"))
        self.assertEqual((version, newest), (newest[0], cited))

    def test_every_folder_has_a_readme(self):
        for entry in SOURCE.iterdir():
            if entry.is_dir() and entry.name[0] != "." and entry.name not in NO_SOURCE:
                self.assertTrue((entry / "README.md").is_file(), entry.name)

    def test_every_link_leads_somewhere(self):
        links = 0
        for document in documents():
            for target in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", without_code(document.read_text())):
                if "://" in target or target.startswith("mailto:"):
                    continue
                links += 1
                self.assertTrue((document.parent / target).exists(), f"{document.relative_to(SOURCE)}: {target}")
        self.assertGreater(links, 60)

    def test_every_anchor_is_a_heading(self):
        for document in documents():
            for target, anchor in re.findall(r"\]\(([^)#\s]*)#([^)]*)\)", without_code(document.read_text())):
                if "://" in target:
                    continue
                text = (document.parent / target if target else document).read_text()
                headings = [re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
                            for heading in re.findall(r"^#+ (.*)$", text, re.M)]
                self.assertIn(anchor, headings, f"{document.relative_to(SOURCE)} -> {target}")

    def test_a_stranger_reads_the_readme_to_its_end(self):
        """Short, in the order of a stranger's questions, with one picture of a size that a clone can carry."""
        text = (SOURCE / "README.md").read_text()
        self.assertLessEqual(len(text.split()), 1800)
        self.assertEqual(re.findall(r"^## (.*)$", without_code(text), re.M)[:4],
                         ["Two commands", "First result", "What it found", "Where to go next"])
        [picture] = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", text)
        self.assertLess(text.index(picture), text.index("## Two commands"), "what it answers has the picture")
        self.assertLess((SOURCE / picture).stat().st_size, 150_000)
        self.assertIn(picture, (SOURCE / "renders/samples/make").read_text(), "made by a command")

    def test_the_gallery_has_every_scene_once(self):
        text = (SOURCE / "mjcf/README.md").read_text().split("## Gallery")[1].split("\n## ")[0]
        listed = re.findall(r"^\| `([\w/*]+)` \| [^|]{20,} \|$", text, re.M)
        scenes = [str(file.relative_to(SOURCE / "mjcf").with_suffix("")) for file in shipped()]
        self.assertEqual(sorted(listed), sorted({re.sub("^hard/.*", "hard/*", scene) for scene in scenes}))
        # Its picture has a place for each that can be rendered.
        across, down = map(int, re.search(r"tile=(\d+)x(\d+)", (SOURCE / "mjcf/docs/make_gallery").read_text()).groups())
        pictures = [name for name in listed if "*" not in name and 'kind = "library"' not in (SOURCE / f"mjcf/{name}.toml").read_text()]
        self.assertTrue(across * (down - 1) < len(pictures) <= across * down, len(pictures))

    def test_tables_of_figures_have_their_command(self):
        """Beside each table of results stands what makes it: in the lines of its section before it, or just below."""
        command = re.compile(r"rotorub (run|compare|modes|bench|tune|sweep|check)\b|compare/run|ninja -C build rotorub_\w+|build/bin/test_\w+")
        tables = 0
        for name in WITH_FIGURES:
            lines = (SOURCE / name).read_text().splitlines()
            for i, line in enumerate(lines):
                if not line.startswith("| ---") or i == 0 or lines[i - 1].startswith("| key |"):
                    continue
                body = []
                for row in lines[i + 1:]:
                    if not row.startswith("|"):
                        break
                    body.append(row)
                if len(re.findall(r"\d\.\d|\d %|\d,\d{3}|1e-\d", "\n".join(body))) < 4:
                    continue  # words, no results
                tables += 1
                section = max((j for j in range(i) if lines[j].startswith("#")), default=0)
                around = "\n".join(lines[max(section, i - 14):i - 1] + lines[i + 1 + len(body):i + 7 + len(body)])
                self.assertRegex(around, command, f"{name}:{i}: {lines[i - 1]}")
        self.assertGreater(tables, 9)


if __name__ == "__main__":
    unittest.main()
