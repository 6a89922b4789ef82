"""The description in an FMU is what an importer needs: whole, consistent, and of the binary beside it."""

import itertools
import re
import unittest
import xml.etree.ElementTree as xml
import zipfile

from product import SOURCE, InAFolder, third

SCENES = ["paper_sliding", "two_catchers", "amb_machine", "paper_magnetic", "bench_drop"]


class Description(InAFolder):
    def of(self, scene, version):
        """The root of modelDescription.xml, and the names in the archive."""
        self.rotorub("fmu", SOURCE / "mjcf" / f"{scene}.toml", "--fmi", version, "-q", "-o", "plant.fmu")
        with zipfile.ZipFile(self.folder / "plant.fmu") as archive:
            self.assertIsNone(archive.testzip())
            for entry in archive.infolist():
                self.assertIn(entry.compress_type, (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED))
                self.assertLessEqual(entry.extract_version, 20)
            return xml.fromstring(archive.read("modelDescription.xml")), archive.namelist()

    def check(self, scene, version):
        root, names = self.of(scene, version)
        three = version == "3.0"
        self.assertEqual(root.get("fmiVersion"), version)
        identifier = root.find("CoSimulation").get("modelIdentifier")
        self.assertRegex(identifier, r"^[A-Za-z_]\w*$")
        self.assertIn("resources/scene.toml", names)
        [binary] = [name for name in names if name.startswith("binaries/")]
        self.assertRegex(binary, (r"^binaries/\w+-linux/" if three else "^binaries/linux64/") + identifier + r"\.so$")

        variables = list(root.find("ModelVariables"))
        self.assertGreater(len(variables), 20)
        named, numbered = [v.get("name") for v in variables], [v.get("valueReference") for v in variables]
        self.assertEqual(len(set(named)), len(named))
        self.assertEqual(numbered, sorted(set(numbered), key=int))
        units = {unit.get("name") for unit in root.find("UnitDefinitions")}
        outputs, parameters = [], []
        for i, variable in enumerate(variables):
            kind = variable if three else variable[0]
            whole = (kind.tag in ("Int32", "Integer"))
            self.assertIn(kind.tag, ("Float64", "Int32") if three else ("Real", "Integer"))
            parameter = variable.get("causality") == "parameter"
            self.assertEqual(variable.get("variability"),
                             "fixed" if parameter else "discrete" if whole else "continuous")
            if parameter:
                start = float(kind.get("start"))
                self.assertLessEqual(float(kind.get("min", "-inf")), start)
                self.assertLessEqual(start, float(kind.get("max", "inf")))
                self.assertTrue(variable.get("description"))
                parameters.append(variable.get("name"))
                continue
            self.assertEqual(whole, bool(re.search(r"mode$|^impacts$", variable.get("name"))))
            self.assertTrue(kind.get("unit") is None or kind.get("unit") in units)
            self.assertEqual(kind.get("start"), "0" if variable.get("causality") == "input" else None)
            if variable.get("causality") == "output":
                outputs.append(variable.get("valueReference") if three else str(i + 1))  # FMI 2.0 counts from 1
        self.assertTrue({"contact.friction", "contact[0].friction"} & set(parameters), parameters)
        self.assertFalse([name for name in named if re.search(r"^v?[xy]_\d+$|^torsion", name)])
        structure = root.find("ModelStructure")
        for kind in ("Output", "InitialUnknown"):
            listed = ([v.get("valueReference") for v in structure.findall(kind)] if three else
                      [v.get("index") for v in structure.find(kind + "s")])
            self.assertEqual(listed, outputs)
        self.assertGreater(float(root.find("DefaultExperiment").get("stopTime")), 0.0)

    def test_of_both_versions(self):
        for scene, version in third(itertools.product(SCENES, ("3.0", "2.0"))):
            with self.subTest(scene, version=version):
                self.check(scene, version)


if __name__ == "__main__":
    unittest.main()
