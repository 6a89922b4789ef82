"""One run of a scene by one engine, as the values that are frozen."""

import csv
import json
import os
import pathlib
import re
import subprocess
import tempfile
import tomllib

ENGINES = {
    **{name: ("--engine", "native", "--integrator", name) for name in ("event", "verlet", "euler")},
    **{name: ("--engine", "mujoco", "--contact", name) for name in ("rigid", "coulomb", "cone", "cone-coulomb")},
}
# Not results, or the same for every run of the scene.
LEFT_OUT = re.compile(r"wall_s|us_per_step|real_time_factor|program|version|mujoco_version|scene|scene_hash|engine|integrator|"
                      r"contact_model|step|message|warnings.*|status|contact_mass.*|above_modes|above_modes\.highest_.*|"
                      r"settled\.from|settled\.spin_speed|contacts\[\d\]\.name")
COUNT = re.compile(r"(.*\.)?(impacts|forward_passes|backward_passes)|hard_impacts|impact_rows|events\..*")
RESIDUAL = re.compile(r"energy_residual|residuals\.(?!force_scale).*")
LENGTH = re.compile(r"(.*\.)?(max_penetration|rms_penetration|whirl_penetration|least_gap|near_miss|contact_depth)")
# Another impact, or another row, may decide them in a chaotic run.
EXTREME = re.compile(r"(.*\.)?(peak_impulse|peak_force|impact_impulse|window_impulse|contact_peak|contact_depth|max_penetration|least_gap|"
                     r"whirl_penetration|fastest_whirl)")
SHARE = re.compile(r"settled\.contact_share|above_modes\..*_share")
# Columns of the last row that are the state, and the forces of the contact.
STATE = re.compile(r"(contact\d_)?(rotor_v?[xy]|stator_v?[xy]|ring_(angle|speed)|housing_v?[xy]|normal_force|friction_force|mode|"
                   r"control_.*|current_\d)|spin_(angle|speed)|v?[xy]_\d+|torsion(_speed)?_\d+|(bearing\d_)?bearing_current_[xy]|bearing\d_current_[xy]")
FORCE = re.compile(r"(contact\d_)?(normal|friction)_force")
FASTEST_KEPT = 1e-4  # m/s: an impact counts if it closes faster


def scenes(source):
    """{name: file} of every scene that is frozen."""
    folder = source / "mjcf"
    files = [*folder.glob("*.toml"), *(folder / "hard").glob("*.toml"), *(folder / "examples").glob("*.toml")]
    return {str(file.relative_to(folder).with_suffix("")): file for file in sorted(files)}


def contacts(file):
    """Its contacts, as a list of tables."""
    found = tomllib.loads(file.read_text()).get("contact", [])
    return found if isinstance(found, list) else [found]


def metres(value):
    factor = {"": 1.0, "m": 1.0, "mm": 1e-3, "um": 1e-6}
    number, unit = re.fullmatch(r"([-+.\deE]+)\s*(\w*)", str(value)).groups()
    return float(number) * factor[unit]


class Outcome:
    """What a run came to: exit code, status, keys that a refusal names, figures, last row of the series, the scale of each
    of its columns (if asked for), seconds of CPU time."""

    def __init__(self, **known):
        self.exit, self.status, self.keys, self.seconds, self.mujoco = None, "refused", [], 0.0, None
        self.figures, self.last, self.scales = {}, {}, {}
        vars(self).update(known)


def run(program, file, engine, changes=(), scales=False):
    """Runs the scene in a folder of its own."""
    outcome = Outcome()
    program = pathlib.Path(program)
    words = [program, "run", file, *ENGINES[engine]]
    if tomllib.loads(file.read_text()).get("controller", {}).get("kind") == "library":
        words += ["--controller", program.parent.parent / "lib" / f"{file.stem}.so"]
    for change in changes:
        words += ["--set", change]
    with tempfile.TemporaryDirectory(prefix="rotorub_frozen_") as folder:
        with open(f"{folder}/out", "w+") as out, open(f"{folder}/err", "w+") as err:
            started = subprocess.Popen([*map(str, words), "-o", f"{folder}/run", "--json"], stdout=out, stderr=err, cwd=folder)
            _, state, used = os.wait4(started.pid, 0)
            started.returncode = outcome.exit = os.waitstatus_to_exitcode(state)
            outcome.seconds = used.ru_utime + used.ru_stime
            out.seek(0), err.seek(0)
            said, complaint = out.read(), err.read()
        if outcome.exit == 2:
            outcome.keys = sorted(set(re.findall(r"^(?:rotorub \S+: )?\S+?(?::\d+)?: ([A-Za-z_]+(?:\.[\w\[\]]+)*): ", complaint, re.M)))
        if said:
            read_run(outcome, json.loads(said), pathlib.Path(folder) / "run", scales)
    return outcome


def flat(table, before=""):
    """{"settled.impacts": 3, "contacts[0].impacts": 2, ...}"""
    entries = table.items() if isinstance(table, dict) else enumerate(table)
    found = {}
    for key, value in entries:
        name = f"{before}[{key}]" if isinstance(table, list) else f"{before}.{key}" if before else key
        found.update(flat(value, name) if isinstance(value, (dict, list)) else {name: value})
    return found


def read_run(outcome, summary, folder, scales):
    outcome.status = summary["status"]
    outcome.mujoco = summary["mujoco_version"]
    outcome.figures = {key: value for key, value in flat(summary).items() if not LEFT_OUT.fullmatch(key)}
    with open(folder / "impacts.csv") as file:
        outcome.figures["impact_rows"] = sum(float(row["gap_rate_before"]) < -FASTEST_KEPT for row in csv.DictReader(file))
    kinds = dict.fromkeys(("impact", "slide", "stick", "lift_off", "reverse"), 0)
    with open(folder / "events.csv") as file:
        for row in csv.DictReader(file):
            kinds[row["event"]] = kinds.get(row["event"], 0) + 1
    outcome.figures.update({f"events.{kind}": count for kind, count in kinds.items()})
    with open(folder / "series.csv") as file:
        names, *rows = csv.reader(file)
    kept = [k for k, name in enumerate(names) if STATE.fullmatch(name)]
    if rows:
        outcome.last = {names[k]: value_of(rows[-1][k]) for k in kept}
    if scales:
        outcome.scales = scales_of(names, kept, rows)


def value_of(cell):
    try:
        return float(cell)
    except ValueError:
        return cell


def scales_of(names, kept, rows):
    """Of each column the largest size over the run, of x and y together; of a force the mean size."""
    sizes = {}
    for k in kept:
        column = [abs(value) for row in rows if isinstance(value := value_of(row[k]), float)]
        if column:
            sizes[names[k]] = sum(column) / len(column) if FORCE.fullmatch(names[k]) else max(column)
    pairs = {name: {name, re.sub(r"x(?=$|_\d+$)", "y", name), re.sub(r"y(?=$|_\d+$)", "x", name)} for name in sizes}
    return {name: max(sizes[other] for other in pair if other in sizes) for name, pair in pairs.items()}
