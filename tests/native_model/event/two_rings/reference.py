#!/usr/bin/env python3
"""A rotor in two auxiliary bearings, from event to event: a second program for the same equations.

    python3 reference.py            a short case again, against expected.json (exit 1: they differ)
    python3 reference.py drop ...   these cases
    python3 reference.py --write    every case twice, finely and coarsely, and expected.json anew

The motion is in motion.py. Here: its cases, and what is expected of them.
"""
import json
import pathlib
import sys
import tomllib

import numpy as np

sys.dont_write_bytecode = True
from motion import Run

FOLDER = pathlib.Path(__file__).resolve().parent
CASES = ["drop", "rub", "moving", "rolling", "conical", "cylindrical"]
SHORT = "rolling"               # what is computed again without arguments
# Relative tolerance of the integration; m/s, below which an impact has no rebound (the end of an
# accumulation). What the two settings differ by is the error of the finer one.
COARSE, FINE = (1e-12, 1e-8), (1e-13, 1e-9)


def run(case, setting):
    with open(FOLDER / f"{case}.toml", "rb") as file:
        return Run(tomllib.load(file), *setting)


def expect(case):
    """A case under both settings: the finer one's figures, and by how much they differ."""
    coarse, fine = run(case, COARSE), run(case, FINE)
    pairs = list(zip(coarse.rows, fine.rows))
    assert all(rough["modes"] == row["modes"] for rough, row in pairs), case
    rows_error = {key: max(abs(row["state"][key] - rough["state"][key]) for rough, row in pairs)
                  for key in fine.rows[0]["state"]}
    figures, rough = fine.summary(), coarse.summary()
    assert figures["impacts"] == rough["impacts"], case
    error = {key: np.abs(np.subtract(figures[key], rough[key])).tolist() for key in figures}
    return {"scene": f"{case}.toml", "rows": fine.rows, "rows_error": rows_error,
            "contacts": figures, "contacts_error": error, "checks": fine.own_checks()}


def differences(case, known):
    """Of a new run from expected.json: more than ten errors and another machine's round-off."""
    new, wrong = run(case, FINE), []
    for row, old in zip(new.rows, known["rows"], strict=True):
        if row["modes"] != old["modes"]:
            wrong.append(f"{case}, t = {row['t']}: {row['modes']}, not {old['modes']}")
        wrong += [f"{case}, t = {row['t']}: {key} {value}, not {old['state'][key]}"
                  for key, value in row["state"].items()
                  if not abs(value - old["state"][key]) <= 10 * known["rows_error"][key] + 1e-11]
    for key, values in new.summary().items():
        allowed = 10 * np.array(known["contacts_error"][key]) + 1e-11
        if not np.all(np.abs(np.subtract(values, known["contacts"][key])) <= allowed):
            wrong.append(f"{case}: {key} {values}, not {known['contacts'][key]}")
    return wrong


def main(arguments):
    path = FOLDER / "expected.json"
    if arguments == ["--write"]:
        known = {case: expect(case) for case in CASES}
        path.write_text(json.dumps(known, indent=1) + "\n")
        for case, found in known.items():
            largest = max(found["rows_error"].values())
            print(case, "largest error", f"{largest:.1e}", found["contacts"], found["checks"])
        return 0
    known, wrong = json.loads(path.read_text()), []
    for case in arguments or [SHORT]:
        wrong += differences(case, known[case])
    print("\n".join(wrong) or "as expected")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
