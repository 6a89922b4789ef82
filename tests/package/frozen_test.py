"""What a rewrite must not change: every scene by every engine as it was recorded (tests/package/frozen/record).

Each day the cheap cases run; nightly every case does, and the comparison of the main job.
"""

import csv
import sys
import unittest

from product import BINARY, NIGHTLY, SOURCE, nightly

TABLES = SOURCE / "tests" / "package" / "frozen"
sys.path.insert(0, str(TABLES))

import frozen_run  # noqa: E402
import held  # noqa: E402
import verdicts  # noqa: E402

SCENES = frozen_run.scenes(SOURCE)


def outcomes():
    with open(TABLES / "outcomes.csv") as file:
        return list(csv.DictReader(file))


def outcome_faults(row, outcome):
    found = {"exit": str(outcome.exit), "status": outcome.status, "keys": " ".join(outcome.keys)}
    return [f"{key}: {value} is not {row[key]}" for key, value in found.items() if row[key] not in ("*", value)]


def value_faults(table, values):
    """Values that are not as held, or not there."""
    faults = []
    for name, entry in table.items():
        wrong = entry.fault(values[name]) if name in values else "is not there"
        if wrong:
            faults.append(f"{name}: {wrong}")
    return faults


class Frozen(unittest.TestCase):
    def test_every_scene_is_recorded_with_every_engine(self):
        recorded = {(row["scene"], row["engine"]) for row in outcomes()}
        wanted = {(scene, engine) for scene in SCENES for engine in frozen_run.ENGINES}
        self.assertEqual(recorded, wanted, "tests/package/frozen/record BINARY SCENE")
        ran = {(row["scene"], row["engine"]) for row in outcomes() if row["status"] != "refused"}
        self.assertEqual(set(held.read_cells(TABLES / "figures.csv")), ran)
        self.assertEqual({row["scene"] for row in outcomes() if row["runs"] == "daily"}, set(SCENES), "each day every scene")

    def test_runs(self):
        figures, states = (held.read_cells(TABLES / f"{name}.csv") for name in ("figures", "states"))
        faults = []
        for row in outcomes():
            if not NIGHTLY and row["runs"] != "daily":
                continue
            case = row["scene"], row["engine"]
            outcome = frozen_run.run(BINARY, SCENES[row["scene"]], row["engine"])
            wrong = outcome_faults(row, outcome)
            if not wrong:
                wrong = value_faults(figures.get(case, {}), outcome.figures) + value_faults(states.get(case, {}), outcome.last)
            faults += [f"{case[0]} {case[1]} {line}" for line in wrong]
        self.assertEqual(faults, [], f"{len(faults)} deviations:\n" + "\n".join(faults))

    @nightly  # takes four minutes of CPU time
    def test_the_verdicts_of_the_main_job(self):
        faults = verdicts.faults(BINARY, SOURCE / "mjcf", TABLES / "verdicts.csv")
        self.assertEqual(faults, [], f"{len(faults)} deviations:\n" + "\n".join(faults))


if __name__ == "__main__":
    unittest.main()
