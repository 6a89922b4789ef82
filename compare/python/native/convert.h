// Between Python's values and ours.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string>
#include <vector>

#include "compare/sweep/point_result.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::python {

// "key=value" of each: a dict of keys and values (numbers, flags, strings, lists of these, None:
// takes the part away), or a list of such strings as after --set. Throws py::type_error for
// anything else.
std::vector<std::string> overrides_of(const pybind11::object& changes);

// A path (os.PathLike, or a string of one line), or the text of a scene (a string of several).
scene::Scene scene_of(const pybind11::object& scene, const std::vector<std::string>& overrides);

// The same scene many times, each with changes of its own; thread safe. The file is read once.
std::function<scene::Scene(const std::vector<std::string>& changes)> points_of(
    const pybind11::object& scene, const std::vector<std::string>& overrides);

// {"series", "impacts", "events": {column: array}, "columns": {file: {column: {"unit",
// "meaning"}}}, "scene_text", "summary"}: what rotorub.read() has of a folder.
pybind11::dict run_dict(const scene::Scene& scene, const Trajectory& trajectory);

// {"point", ..., figures}: arrays in the order of the points; NaN and "" where there is none.
pybind11::dict points_dict(const std::vector<sweep::PointResult>& points);

}  // namespace rotorub::python
