"""A study of many points: its memory, what a kill costs, and whether shards and kills change a byte of its results.

    python3 tests/bench/large_study.py build/bin/rotorub [--points 100000]

The study varies four values of bench_ring by Sobol's sequence, 1,000 steps of `verlet` each. It runs

- as a whole, while its resident memory is read every half second;
- as a whole, killed with SIGKILL three times and resumed, which must not lose a point;
- in 8 shards, each in its own folder as the tasks of an array job, which are then merged.

All three must write the same results.csv, columns.json and sweep.json, byte for byte. sweep.html differs only by the
folder that its commands name. With Chromium the time until the page is shown is measured too. The program prints one
line for each figure and fails if a condition does not hold. tests/bench/README.md has the figures of 100,000 points.
"""

import argparse
import pathlib
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import time

SCENE = pathlib.Path(__file__).resolve().parents[2] / "mjcf/bench_ring.toml"
STUDY = f"""
scene = "{SCENE}"

[sample]
kind = "sobol"
runs = POINTS
seed = 1

[[vary]]
key = "stator.stiffness"
from = "20 kN/m"
to = "500 kN/m"
spacing = "log"

[[vary]]
key = "stator.damping"
from = 20.0
to = 2000.0
spacing = "log"

[[vary]]
key = "contact.friction"
from = 0.05
to = 0.4

[[vary]]
key = "rotor.speed"
also = ["drive.speed", "force[0].frequency"]
from = "40 Hz"
to = "60 Hz"

[run]
integrator = "verlet"
step = "20 us"
end = "0.02 s"
"""
SHARDS = 8
SAME = ("results.csv", "columns.json", "sweep.json")


class Study:
    def __init__(self, rotorub, folder, points):
        self.rotorub, self.folder, self.points = rotorub, pathlib.Path(folder), points
        self.file = self.folder / "study.toml"
        self.file.write_text(STUDY.replace("POINTS", str(points)))

    def start(self, out, *options):
        return subprocess.Popen([self.rotorub, "sweep", self.file, "-o", self.folder / out, "--jobs", "1", "-q", *options])

    def run(self, out, *options):
        code = self.start(out, *options).wait()
        require(code == 0, f"sweep {out}: exit code {code}")

    def done(self, out):
        """How many points the study in the folder has stored."""
        with sqlite3.connect(self.folder / out / "results.sqlite") as data:
            return data.execute("select count(*) from points").fetchone()[0]


def require(condition, what):
    if not condition:
        sys.exit(f"failed: {what}")


def resident(process):
    """kB."""
    try:
        status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    except OSError:
        return 0
    found = re.search(r"VmRSS:\s*(\d+)", status)
    return int(found.group(1)) if found else 0


def whole(study):
    """The study as a whole, s. While points run, its memory must not grow after the first tenth."""
    begin, process, memory = time.monotonic(), study.start("whole"), []
    while process.poll() is None:
        if not (study.folder / "whole/results.csv").exists():
            memory.append(resident(process))
        time.sleep(0.5)
    require(process.returncode == 0, f"sweep: exit code {process.returncode}")
    took = time.monotonic() - begin
    print(f"whole study: {took:.1f} s by the clock")
    memory = [size for size in memory if size > 0][:-1]  # the last one may already belong to the files of the results
    if len(memory) >= 10:
        first = max(memory[: len(memory) // 10])
        print(f"resident memory while points run: {first} kB after a tenth, {max(memory)} kB at most")
        require(max(memory) < 1.1 * first, "the memory grows with the points")
    return took


def killed(study, took):
    """The study, killed after each fifth of the time `took` (s). Each start must go on where the last one was killed."""
    kept = [0]
    for _ in range(3):
        process = study.start("killed")
        time.sleep(0.2 * took)
        process.kill()
        process.wait()
        kept.append(study.done("killed"))
        require(kept[-1] > kept[-2], f"{kept[-2]} points before a start that was killed, {kept[-1]} after it")
    print(f"points stored after each kill: {kept[1:]}")
    study.run("killed")
    require(study.done("killed") == study.points, "points are missing")


def shards(study):
    folders = [f"shard-{k}" for k in range(1, SHARDS + 1)]
    for k, folder in enumerate(folders, 1):
        study.run(folder, "--shard", f"{k}/{SHARDS}")
    study.run("merged", "--merge", *(study.folder / folder for folder in folders))


def compare(study, other):
    for name in SAME:
        same = (study.folder / "whole" / name).read_bytes() == (study.folder / other / name).read_bytes()
        require(same, f"{name} of `{other}` differs from the whole study's file")
    pages = [(study.folder / out / "sweep.html").read_text().replace(str(study.folder / out), "FOLDER") for out in ("whole", other)]
    require(pages[0] == pages[1], f"sweep.html of `{other}` differs by more than its folder")
    print(f"{other}: the same bytes")


def opened(page):
    """Prints the time until the page is loaded, its scripts have run and its layout is known, three times."""
    chromium = shutil.which("chromium")
    if not chromium:
        return
    timed = page.with_name("timed.html")
    timed.write_text(page.read_text() + "<script>addEventListener('load', () => { document.body.getBoundingClientRect();"
                                        "document.title = 'SHOWN ' + Math.round(performance.now()); });</script>")
    for _ in range(3):
        text = subprocess.run([chromium, "--headless", "--no-sandbox", "--disable-gpu", "--timeout=20000", "--dump-dom", f"file://{timed}"],
                              capture_output=True, text=True).stdout
        shown = re.search(r"SHOWN (\d+)", text)
        require(shown, "the page is not shown within 20 s")
        print(f"the page of {page.stat().st_size / 1e6:.1f} MB is shown after {shown.group(1)} ms")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rotorub")
    parser.add_argument("--points", type=int, default=100000)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        study = Study(given.rotorub, folder, given.points)
        killed(study, whole(study))
        shards(study)
        for other in ("killed", "merged"):
            compare(study, other)
        opened(study.folder / "whole/sweep.html")


if __name__ == "__main__":
    main()
