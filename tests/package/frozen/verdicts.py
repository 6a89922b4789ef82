"""The verdicts of `rotorub compare` on the two scenes of the main job, and how they are held.

A verdict is firm if the difference is farther from the tolerance than twice its confidence interval and a twentieth of the
tolerance, and if a second comparison, with a clearance changed by 1e-12, comes to the same word. Any other is near the border: the table
says so, and the test takes the words that are next to it (NEXT). The values of both sides are held by three times the largest deviation of
the native twins, by what the same figure of the run by itself is allowed in figures.csv, or by 1e-7, whichever is most. (The figures
themselves may differ from those of the run, because a comparison looks at more instants.)
"""

import csv
import json
import subprocess
import tempfile

import held

SCENES = "paper_sliding", "paper_passive"
HEAD = ["scene", "contact", "figure", "verdict", "border", "native", "other"]
NEXT = {
    "within": ("within", "undecidable"),
    "outside": ("outside", "undecidable"),
    "undecidable": ("within", "outside", "undecidable"),
    "yes": ("yes", "averages only", "undecidable"),
    "averages only": ("yes", "averages only", "no"),
    "no": ("averages only", "no"),
}
CHANGED = "contact.clearance=0.5000000000005 mm"


def compare(program, folder, *words):
    """Both scenes side by side, as JSON."""
    files = [str(folder / f"{name}.toml") for name in SCENES]
    with tempfile.TemporaryDirectory(prefix="rotorub_frozen_") as place:
        done = subprocess.run([program, "compare", *files, "--no-video", "--no-modes-ladder", "--json", "-o", "out", *words],
                              cwd=place, capture_output=True, text=True)
    if done.returncode not in (0, 1):
        raise RuntimeError(f"rotorub compare: exit code {done.returncode}\n{done.stderr}")
    return json.loads(done.stdout)


def judged(said):
    """{(scene, contact, figure): its entry}, and the answer of each contact model as the figure "trusted"."""
    found = {}
    for scene in said["scenes"]:
        for contact, difference in scene["differences"].items():
            found[scene["scene"], contact, "trusted"] = {"verdict": difference["trusted"]}
            for name, entry in difference["figures"].items():
                if "verdict" in entry and entry["deviation"] is not None:
                    found[scene["scene"], contact, name] = entry
    return found


def is_border(entry, tolerance):
    return abs(abs(entry["deviation"]) - tolerance) < 2.0 * entry["interval"] + 0.05 * tolerance


def cell(figures, case, name, value, twin_deviation):
    """The value within three times the largest deviation of the native twins, and as far as the run's own figure may be off."""
    own = figures.get(case, {}).get(name)
    share = own.width / abs(own.value) if own and own.kind == "near" and own.value else 0.0
    return f"value{held.Held('near', float(value), max(held.TIGHT, 3.0 * twin_deviation, share) * abs(value))}"


def record(program, folder, file, figures):
    write(compare(program, folder), compare(program, folder, "--set", CHANGED), file, figures)


def write(said, changed, file, figures):
    """The table of two comparisons. figures: {(scene, engine): {name: Held}} of the runs."""
    second = judged(changed)
    first = judged(said)
    border = {key for key, entry in first.items() if entry["verdict"] != second[key]["verdict"]}
    border |= {key for key, entry in first.items() if "deviation" in entry and is_border(entry, said["tolerance"])}
    # The answer of a contact model hangs on its figures.
    border |= {(scene, contact, "trusted") for scene, contact, _ in border}
    with open(file, "w") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(HEAD)
        for key, entry in first.items():
            scene, contact, name = key
            values = ["", ""]
            if "deviation" in entry:
                values = [cell(figures, (scene, "event"), name, entry["native"], entry["twin_deviation"]),
                          cell(figures, (scene, contact), name, entry["other"], entry["twin_deviation"])]
            writer.writerow([*key, entry["verdict"], "border" if key in border else "", *values])


def faults(program, folder, file):
    """What a comparison by the program says otherwise than the table, one line each."""
    found = judged(compare(program, folder))
    lines = []
    with open(file) as rows:
        for row in csv.DictReader(rows):
            key = row["scene"], row["contact"], row["figure"]
            entry = found.get(key)
            if entry is None:
                lines.append(f"{' '.join(key)}: not judged any more")
                continue
            accepted = NEXT[row["verdict"]] if row["border"] else (row["verdict"],)
            if entry["verdict"] not in accepted:
                lines.append(f"{' '.join(key)}: {entry['verdict']} in the place of {row['verdict']}")
            for side in ("native", "other"):
                wrong = row[side] and held.Held.read(row[side])[1].fault(entry[side])
                if wrong:
                    lines.append(f"{' '.join(key)}, {side}: {wrong}")
    return lines
