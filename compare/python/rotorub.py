"""Reads what rotorub writes: runs, comparisons and sweeps, as numpy arrays.

    run = rotorub.read("runs/paper_passive-native-verlet")
    run["gap"], run.units["gap"]        # a column of series.csv, "m"
    run.impacts["normal_impulse"]       # impacts.csv
    run.events["event"]                 # events.csv
    run.keyphasor["rotor_x"]            # keyphasor.csv: the places once a turn
    run.scene["contact"]["friction"]    # scene.toml
    run.summary["mean_force"]           # summary.json

One file that needs numpy alone (h5py for a folder that holds run.h5 without the tables).
Columns, units and signs: compare/study/README.md.
"""

import csv
import json
import pathlib

import numpy

try:
    import tomllib  # from Python 3.11 on
except ImportError:
    tomllib = None

__all__ = ["read", "read_compare", "read_hdf5", "read_sweep", "run", "Run", "Sweep"]

_TABLES = ("series", "impacts", "events", "keyphasor")
_WORDS = ("mode", "event", "status", "reason", "attractor")  # columns that hold words
_HDF5 = "run.h5"


class Run:
    """A run. `series`, `impacts`, `events` and `keyphasor` are dicts of arrays by column name; run["gap"] is run.series["gap"].

    `units` and `meanings` are those of the series; `columns["impacts.csv"]["normal_impulse"]["unit"]` of any file.
    `scene` is a dict (None where Python has no tomllib, or where the run is of an own MJCF), `scene_text` its text.
    """

    def __init__(self, folder, tables, columns, scene_text, summary):
        self.folder = folder
        self.series, self.impacts, self.events, self.keyphasor = (tables[name] for name in _TABLES)
        self.columns = columns
        self.scene_text = scene_text
        self.scene = tomllib.loads(scene_text) if tomllib and scene_text is not None else None
        self.summary = summary

    def __getitem__(self, name):
        try:
            return self.series[name]
        except KeyError:
            raise KeyError(f"{name}: no column of series.csv; there are: {', '.join(self.series)}") from None

    def __contains__(self, name):
        return name in self.series

    @property
    def units(self):
        return {name: column["unit"] for name, column in self.columns["series.csv"].items()}

    @property
    def meanings(self):
        return {name: column["meaning"] for name, column in self.columns["series.csv"].items()}

    def __repr__(self):
        rows = len(self.series["t"])
        where = f" {self.folder}" if self.folder else ""
        return f"<rotorub run{where}: {rows} rows, {len(self.impacts['t'])} impacts>"


class Sweep(dict):
    """The columns of results.csv as arrays: numbers with NaN where a figure is empty, else words. `units`, `columns`,
    and the texts of `study` and `scene`."""

    def __init__(self, folder, table, columns, study, scene):
        super().__init__(table)
        self.folder = folder
        self.columns = columns
        self.study = study
        self.scene = scene

    @property
    def units(self):
        return {name: column["unit"] for name, column in self.columns.items()}


def read(folder):
    """The run in a folder of `rotorub run`, or of one side of a comparison."""
    folder = pathlib.Path(folder)
    if not (folder / "series.csv").exists() and (folder / _HDF5).exists():
        return read_hdf5(folder / _HDF5)
    if not (folder / "summary.json").exists():
        raise FileNotFoundError(
            f"{folder} is not the folder of a run (summary.json is missing). Give the folder of "
            "rotorub run -o DIR, or use read_compare for the folder of rotorub compare."
        )
    files = {name: folder / f"{name}.csv" for name in _TABLES}
    # A run of an earlier version has no keyphasor.csv.
    tables = {name: _table(file) if name != "keyphasor" or file.exists() else {} for name, file in files.items()}
    scene = folder / "scene.toml"
    return Run(
        folder,
        tables,
        _columns(folder),
        scene.read_text(encoding="utf-8") if scene.exists() else None,
        json.loads((folder / "summary.json").read_text(encoding="utf-8")),
    )


def run(scene, overrides=None, **how):
    """A run made in this process: rotorub_native.run with the same arguments, as a Run."""
    import rotorub_native

    made = rotorub_native.run(scene, overrides, **how)
    return Run(None, {name: made[name] for name in _TABLES}, made["columns"], made["scene_text"], made["summary"])


def read_compare(folder):
    """The runs of a comparison: {scene: {"native": Run, "rigid": Run, ...}}."""
    folder = pathlib.Path(folder)
    if not (folder / "compare.json").exists():
        raise FileNotFoundError(f"{folder}: no comparison: compare.json is missing")
    runs = {}
    for summary in sorted(folder.glob("*/*/summary.json")):
        runs.setdefault(summary.parent.parent.name, {})[summary.parent.name] = read(summary.parent)
    return runs


def read_sweep(folder):
    """The table of a sweep that is done."""
    folder = pathlib.Path(folder)
    if not (folder / "results.csv").exists():
        raise FileNotFoundError(f"{folder}: no finished sweep: results.csv is missing")
    texts = ((folder / name).read_text(encoding="utf-8") for name in ("study.toml", "scene.toml"))
    return Sweep(folder, _table(folder / "results.csv"), _columns(folder).get("results.csv", {}), *texts)


def read_hdf5(file):
    """The run in a file of `--format hdf5`; needs h5py."""
    import h5py

    file = pathlib.Path(file)
    with h5py.File(file, "r") as h5:
        tables, columns = {}, {}
        for name in _TABLES:
            # Groups list their members by name; the order is that of the tables.
            order = [n.decode() if isinstance(n, bytes) else n for n in h5[name].attrs["columns"]]
            tables[name] = {n: h5[name][n].asstr()[()] if n in _WORDS else h5[name][n][()] for n in order}
            for n in _WORDS:
                if n in tables[name]:
                    tables[name][n] = tables[name][n].astype(str)
            columns[f"{name}.csv"] = {
                n: {key: h5[name][n].attrs[key] for key in ("unit", "meaning")} for n in order
            }
        summary = {key: _plain(value) for key, value in h5.attrs.items()}
    return Run(file.parent, tables, columns, summary.pop("scene_text", None), summary)


def _plain(value):
    return value.item() if isinstance(value, numpy.generic) else value


def _columns(folder):
    """columns.json by file and name; nothing for a folder of an earlier version."""
    file = folder / "columns.json"
    if not file.exists():
        return {f"{name}.csv": {} for name in _TABLES}
    files = json.loads(file.read_text(encoding="utf-8"))
    return {name: {c.pop("name"): c for c in columns} for name, columns in files.items()}


def _table(file):
    """A CSV file as arrays by the names of its header."""
    with open(file, newline="", encoding="utf-8") as lines:
        rows = csv.reader(lines)
        header = next(rows, None)
        if not header:
            raise ValueError(f"{file}: is empty")
        fields = []
        for number, row in enumerate(rows, start=2):
            if len(row) != len(header):
                raise ValueError(f"{file}:{number}: {len(row)} fields where the header has {len(header)}")
            fields.append(row)
    by_column = zip(*fields) if fields else [()] * len(header)
    return {name: _array(name, values) for name, values in zip(header, by_column)}


def _array(name, values):
    """Numbers, NaN where there is none; or words."""
    if name not in _WORDS:
        try:
            return numpy.array([float(v) if v else numpy.nan for v in values])
        except ValueError:
            pass
    return numpy.array(values, dtype=str)
