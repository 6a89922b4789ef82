// Conversion between values of Python and C++.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string>
#include <vector>

#include "compare/sweep/point_result.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::python {

// "key=value" for each entry. changes: a dict of keys and values (numbers, flags, strings, lists of
// these; None removes the part), or a list of strings as for --set. Throws py::type_error for
// anything else.
std::vector<std::string> overrides_of(const pybind11::object& changes);

// scene: a path (os.PathLike, or a string of one line) or the text of a scene (a string of several
// lines).
scene::Scene scene_of(const pybind11::object& scene, const std::vector<std::string>& overrides);

// Returns a thread-safe function that makes the scene with further changes. The file is read once.
std::function<scene::Scene(const std::vector<std::string>& changes)> points_of(
    const pybind11::object& scene, const std::vector<std::string>& overrides);

// {"series", "impacts", "events": {column: array}, "columns": {file: {column: {"unit",
// "meaning"}}}, "scene_text", "summary"}: what rotorub.read() returns for a folder.
pybind11::dict run_dict(const scene::Scene& scene, const Trajectory& trajectory);

// {"point", ..., figures}: arrays in the order of the points; NaN and "" for missing values.
pybind11::dict points_dict(const std::vector<sweep::PointResult>& points);

}  // namespace rotorub::python
