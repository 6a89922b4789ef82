"""Help, manual page and completion say the same, and every option that they name is tried here."""

import json
import os
import pathlib
import shutil
import subprocess
import unittest

from product import BUILD, SOURCE, InAFolder, options_of_help

SCENES = SOURCE / "mjcf"
DROP, RING, PAPER = (SCENES / f"{name}.toml" for name in ("bench_drop", "bench_ring", "paper_sliding"))
OWN = BUILD / "lib" / "own_controller.so"
SAMPLED = "--set controller.sample_time=50us"
STUDY = f"""
scene = "{DROP}"
[sample]
kind = "grid"
[[vary]]
key = "contact.restitution"
from = 0.4
to = 0.6
count = 2
[run]
end = "11 ms"
[optimise]
minimise = "impacts"
evaluations = 2
"""

# Command lines, one after the other in one folder; together they name every option of every command. What each does
# is the matter of the tests of its command; here it must be taken, and end as it should.
COLUMNS = "--measured-column t=t --measured-column rotor_x=rotor_x --measured-column rotor_y=rotor_y" \
          " --measured-probes 0deg,90deg"
TRIED = [
    "--help", "-h", "--version",
    "init a --form modal --speed 60Hz --length 0.5 --diameter 20mm --disc-mass 3kg --clearance 0.3mm --friction 0.2 -q",
    "init a --force --quiet",
    "init a --force --json", "init b -q --output c.toml", "init e --unbalance 4e-4 -q", "init -h", "init --help", "init d -o -",
    f"run {DROP} --engine native --integrator verlet --step 20us --end 12ms --output r1 --json",
    f"run {DROP} --engine mujoco --contact cone --end 12ms -o r2 --quiet --format hdf5 --units us",
    f"run {PAPER} --controller {OWN} {SAMPLED} --end 2ms -q -o r3",
    f"run {RING} --end 20ms --lyapunov --allow-library -o r6 -q",
    f"compare {DROP} --mode lockstep --tolerance 1% --contact rigid --twins 2 --no-modes-ladder --no-video --step 20us "
    "--end 12ms --output c1 --json --format hdf5",
    f"compare {PAPER} --modes-ladder --twins 0 --no-video --end 200us --mode resync -o c2 -q --controller {OWN} {SAMPLED}",
    f"compare {DROP} --tune --twins 0 --no-video --end 12ms --step 20us --jobs 2 --allow-library -o c3 --quiet --units si",
    f"modes {RING} --speed 3000rpm -o m.html --up-to 100Hz -q --set contact.friction=0.2",
    f"modes {RING} --rub-map --speeds 40Hz:60Hz:2 --frictions 0.1:0.2:2 --json",
    f"modes {RING} --rub-map --across contact.clearance=0.2mm:1mm:2 --up stator.stiffness=1e5:2e5:2 -q",
    f"modes {RING} --feedback-map --feedbacks 0:1000:2 --speeds 50Hz:51Hz:2 --output f --quiet",
    f"modes {RING} --state-space",
    f"modes {RING} --periodic --units mm",
    f"modes {RING} --periodic --across contact.friction=0.1:0.2:2 -o branches -q",
    f"mjcf {RING} --mujoco 3.12 -o ring.xml --set contact.friction=0.2 --json",
    f"mjcf {RING} --output r.xml --quiet", f"mjcf {RING} -q",
    f"fmu {RING} --set contact.friction=0.2 --fmi 2.0 --modal -o plant.fmu --json", f"fmu {RING} --quiet",
    "render r1 --png --at 10.5ms --size 320x240 --view axis --title Drop -o p.png --json",
    "render r1 --beside r1 --gif --from 9ms --to 10ms --slow 200 --fps 5 --size 320x240 --output two.gif --quiet",
    f"render {DROP} --png --step 20us --end 12ms --size 320x240 --set contact.restitution=0.6 -q -o q.png",
    f"bench {DROP} --engines native-event,native-verlet --steps 100us --tolerances 1e-6 --repeats 1 --end 12ms --json",
    f"bench {DROP} --engines native-verlet --steps 100us --repeats 1 --end 12ms --set contact.restitution=0.4 "
    "--allow-library -q",
    f"bench {PAPER} --controller {OWN} {SAMPLED} --engines native-verlet --steps 20us --repeats 1 --end 1ms -q",
    "sweep study.toml --output s --jobs 1 --json",
    "sweep study.toml -o s1 --shard 1/2 --set contact.friction=0.1 -q",
    "sweep study.toml -o s2 --shard 2/2 --set contact.friction=0.1 -q",
    "sweep study.toml -o s3 --merge s1 s2 --set contact.friction=0.1 --quiet",
    "sweep study.toml -o s4 --slurm --tasks 2 --quiet",
    "sweep study.toml -o s6 --bifurcation --branches -q --allow-library", "sweep study.toml -o s6 --point 0 --point 1 -q",
    "optimise study.toml -o o1 --json", "optimise study.toml --output o2 --quiet --set contact.friction=0.1",
    f"optimise paper.toml -o o3 --controller {OWN} {SAMPLED} -q", "optimise study.toml -o o4 -q --allow-library",
    f"sweep paper.toml -o s5 --controller {OWN} {SAMPLED} -q",
    f"check {DROP} --set run.end=11ms --json", f"check {DROP} --set run.end=11ms --quiet --allow-library --output k1",
    f"compare {DROP} --with k1 --twins 0 --no-modes-ladder --no-video --end 11ms --step 20us -o c4 -q",
    f"run {RING} --integrator event --end 20ms -q -o r4",
    f"run {RING} --integrator event --end 20ms -q -o r7 --measured r4/series.csv --measured-shift 0ms --measured-angle 0deg",
    f"run {RING} --integrator event --end 20ms -q -o r8 --measured r4/series.csv {COLUMNS}",
    f"identify {RING} --measured r4/series.csv --fit contact.friction=0.1:0.2 --measured-shift 0ms --measured-angle 0deg "
    "--end 20ms --step 10us --set contact.restitution=0.5 -o found.toml --json",
    f"identify {RING} --measured r4/series.csv {COLUMNS} --fit contact.friction=0.1:0.2 --end 20ms --allow-library "
    "--output found2.toml --quiet",
    f"identify {PAPER} --controller {OWN} {SAMPLED} --measured r3/series.csv --fit rotor.speed=300:320 --measured-shift 0ms "
    "--end 2ms -q",
    f"compare {RING} --measured r4/series.csv {COLUMNS} --mode resync --no-modes-ladder --no-video --end 20ms -q "
    "-o report7",
    f"compare {RING} --measured r4/series.csv --measured-shift 0ms --measured-angle 0deg --mode resync --no-modes-ladder "
    "--no-video --end 20ms -o c5 -q",
    f"tune {DROP} --tolerance 1% --steps 50us,20us --twins 0 --end 12ms --allow-library -o tuned.toml --json",
    f"tune {PAPER} --controller {OWN} {SAMPLED} --set rotor.modes=2 --steps 20us --twins 0 --end 200us -q",
    "plot r1 -o plot.html --json", "plot r1 -q",
    "schema -o s.json", "schema --output s.json", "manual bash -o m.bash", "manual man --output m.1",
]
# Refused: no scene, so that the option is with it; films of all runs and none; a place below a file. (The files that `bench` writes
# take seconds: they are the matter of CliBenchLong.)
REFUSED = ["plot r1 --set contact.friction=0.2", f"compare {DROP} --all-films --no-video", f"bench {DROP} --output study.toml/b1"]
# What may end with 1: outside the tolerance, or no setting that can be trusted.
MAY_DIFFER = ("compare", "tune")


class Manual(InAFolder):
    def help_of(self, command):
        return self.rotorub("help", *filter(None, [command]))

    def test_every_option_is_tried(self):
        (self.folder / "study.toml").write_text(STUDY)
        (self.folder / "paper.toml").write_text(STUDY.replace(str(DROP), str(PAPER)).replace("11 ms", "1 ms"))
        # A cluster that takes every job.
        sbatch = self.folder / "bin" / "sbatch"
        sbatch.parent.mkdir()
        sbatch.write_text("#!/bin/sh\necho 1\n")
        sbatch.chmod(0o755)
        path = f"{sbatch.parent}:{os.environ['PATH']}"

        tried = {}
        for line in TRIED + REFUSED:
            words = line.split()
            command = "" if words[0].startswith("-") else words[0]
            codes = 2 if line in REFUSED else (0, 1) if command in MAY_DIFFER else 0
            self.rotorub(*words, code=codes, env={"PATH": path})
            tried.setdefault(command, set()).update(word for word in words if word.startswith("-"))
        for command in ["", *self.commands()]:
            for names in options_of_help(self.help_of(command)):
                if names == ["-h", "--help"]:
                    self.rotorub(*([command] if command else []), "--help")
                    continue
                self.assertTrue(tried.get(command, set()) & set(names), f"{command} {names} is not tried")

    def test_the_manual_page_has_every_option(self):
        page = self.rotorub("manual", "man")
        synopsis = page.split(".SH SYNOPSIS")[1].split(".SH")[0]
        self.assertIn("compare\\fR [\\fIOPTIONS\\fR] \\fISCENE\\fR ...\n", synopsis)
        self.assertIn("run\\fR [\\fIOPTIONS\\fR] \\fISCENE\\fR\n", synopsis)
        commands = self.commands()
        sections = dict(zip(["", *commands], page.split(".SH OPTIONS")[1].split(".SS ")))
        self.assertEqual(list(sections), ["", *commands])
        for command, section in sections.items():
            for names in options_of_help(self.help_of(command)):
                for name in names:
                    self.assertIn("\\fB" + name.replace("-", "\\-") + "\\fR", section, command)

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_groff_prints_the_manual_page(self):
        self.rotorub("manual", "man", "-o", "rotorub.1")
        done = subprocess.run(["groff", "-man", "-Kutf8", "-Tutf8", "-wall", "-P-cbou", "rotorub.1"],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("--clearance LENGTH", done.stdout)

    def completed(self, *words):
        """What bash offers for the last word."""
        script = """source ./rotorub.bash
                    COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _rotorub; printf '%s\\n' "${COMPREPLY[@]}" """
        done = subprocess.run(["bash", "-euc", script, "bash", "rotorub", *words], cwd=self.folder,
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout.split()

    def test_the_completion_offers_every_option(self):
        self.rotorub("manual", "bash", "-o", "rotorub.bash")
        commands = self.commands()
        offered = self.completed("")
        self.assertLessEqual({*commands, "help"}, set(offered))
        for command in commands:
            completed = set(self.completed(command, "-"))
            for names in options_of_help(self.help_of(command)):
                self.assertLessEqual(set(names), completed, command)
        self.assertEqual(self.completed("co"), ["compare"])
        self.assertEqual(self.completed("run", "x.toml", "--integrator", "v"), ["verlet"])
        self.assertEqual(self.completed("help", "ch"), ["check"])
        self.assertEqual(self.completed("run", "x.toml", "--end", ""), [])
        (self.folder / "scene.toml").write_text("")
        self.assertEqual(self.completed("run", "sc"), ["scene.toml"])

    def test_the_build_has_them_as_the_program_writes_them(self):
        for words, file in ((["manual", "man"], "rotorub.1"), (["manual", "bash"], "rotorub.bash"),
                            (["schema"], "scene.schema.json")):
            self.assertEqual((BUILD / "manual" / file).read_text(), self.rotorub(*words), file)


if __name__ == "__main__":
    unittest.main()
