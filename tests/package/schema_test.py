"""rotorub schema: what it takes the program takes to read, and a slip is seen by both."""

import copy
import json
import tomllib
import unittest

import jsonschema

from product import NIGHTLY, SOURCE, InAFolder, shipped


def tables_of(scene, path=()):
    """Every table of a scene by its path."""
    yield path, scene
    for name, value in scene.items():
        for i, table in enumerate(value if isinstance(value, list) else [value]):
            if isinstance(table, dict):
                yield from tables_of(table, (*path, (name, i) if isinstance(value, list) else name))


def at(scene, path):
    for step in path:
        scene = scene[step[0]][step[1]] if isinstance(step, tuple) else scene[step]
    return scene


def written(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, dict)):
        if isinstance(value, list):
            return "[" + ", ".join(map(written, value)) + "]"
        return "{" + ", ".join(f"{key} = {written(inner)}" for key, inner in value.items()) + "}"
    return json.dumps(value) if isinstance(value, str) else repr(value)


class Schema(InAFolder):
    def setUp(self):
        super().setUp()
        self.schema = json.loads(self.rotorub("schema"))
        self.validator = jsonschema.Draft7Validator(self.schema)

    def slips(self, scene):
        return [error.message for error in self.validator.iter_errors(scene)]

    def reader_takes(self, scene):
        (self.folder / "slip.toml").write_text("\n".join(f"{key} = {written(value)}" for key, value in scene.items()))
        self.rotorub("mjcf", "slip.toml", "-o", "slip.xml", code=(0, 2))
        return (self.said == "", self.said)

    def test_it_is_a_schema_of_draft_7(self):
        jsonschema.Draft7Validator.check_schema(self.schema)
        self.rotorub("schema", "-o", "scene.json")
        self.assertEqual(json.loads((self.folder / "scene.json").read_text()), self.schema)

    def test_every_shipped_scene_fits(self):
        scenes = shipped()
        self.assertGreater(len(scenes), 60)
        for file in scenes:
            self.assertEqual(self.slips(tomllib.loads(file.read_text())), [], file)

    def test_what_init_writes_fits(self):
        for form in ("geometry", "modal", "rig"):
            self.assertEqual(self.slips(tomllib.loads(self.rotorub("init", "-o", "-", "--form", form))), [], form)

    def test_a_misspelt_key_fits_nowhere(self):
        for name in ("paper_sliding", "paper_magnetic", "bench_whip", "touchdown", "run_up_kloss"):
            scene = tomllib.loads((SOURCE / "mjcf" / f"{name}.toml").read_text())
            for path, _ in tables_of(scene):
                slip = copy.deepcopy(scene)
                at(slip, path)["stifness"] = 1.0
                self.assertNotEqual(self.slips(slip), [], f"{name} {path}")

    def test_what_it_refuses_the_program_refuses(self):
        """Every key renamed, and in the place of every value another one: the schema is never the stricter."""
        seen = 0
        for name in ("paper_magnetic", "touchdown_ball_bearing"):
            scene = tomllib.loads((SOURCE / "mjcf" / f"{name}.toml").read_text())
            for path, table in tables_of(scene):
                for key in table:
                    for change in ("rename", "drop", "true", "word", "negative"):
                        slip = copy.deepcopy(scene)
                        value = at(slip, path).pop(key)
                        if change == "rename":
                            at(slip, path)[key + "_"] = value
                        elif change != "drop":
                            at(slip, path)[key] = {"true": True, "word": "blue", "negative": -1e9}[change]
                        if self.slips(slip):
                            seen += 1
                            # Each takes a process: every eighth, and nightly every renamed key.
                            if seen % 8 == 0 or (NIGHTLY and change == "rename"):
                                taken, said = self.reader_takes(slip)
                                self.assertFalse(taken, f"{name} {path} {key} {change}: {said}")
        self.assertGreater(seen, 150)

    def test_values_are_held_to_type_word_bound_and_kind(self):
        scene = tomllib.loads((SOURCE / "mjcf" / "paper_sliding.toml").read_text())
        for path, key, value in ((["contact"], "friction", -0.1), (["contact"], "restitution", 1.5),
                                 (["contact"], "clearance", "wide"), (["contact"], "clearance", [1, 2]),
                                 (["controller"], "kind", "slidng"), (["stator"], "mass", [1, 1, 1]),
                                 (["rotor"], "modes", 2.5), (["rotor"], "modes", "some"),
                                 (["controller"], "feedback", 1000.0),  # of another kind
                                 (["rotor"], "modal", {"mass": [1], "stiffness": [1]})):  # both forms
            slip = copy.deepcopy(scene)
            at(slip, path)[key] = value
            self.assertNotEqual(self.slips(slip), [], f"{path} {key} {value}")
        for path, key, value in ((["contact"], "clearance", 0.0005), (["stator"], "mass", [1.5, 2]),
                                 (["rotor"], "modes", "auto"), (["contact"], "friction", "30 %")):
            good = copy.deepcopy(scene)
            at(good, path)[key] = value
            self.assertEqual(self.slips(good), [], f"{path} {key} {value}")
        for missing in ("friction", "radius"):
            slip = copy.deepcopy(scene)
            del slip["contact"][missing]
            self.assertNotEqual(self.slips(slip), [], missing)
        # One place has two names: either will do, one of them is needed, both are too many.
        disc = scene["rotor"]["disc"][0]
        disc["station"] = disc["z"]
        self.assertNotEqual(self.slips(scene), [])
        del disc["z"]
        self.assertEqual(self.slips(scene), [])
        del disc["station"]
        self.assertNotEqual(self.slips(scene), [])
        disc["z"] = 0.3
        self.assertEqual(self.slips(scene), [])
        del scene["drive"]["gain"]
        self.assertNotEqual(self.slips(scene), [])


if __name__ == "__main__":
    unittest.main()
