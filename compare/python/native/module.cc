// The Python module rotorub_native: runs scenes and studies with the native model in the Python
// process.

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "compare/base/version.h"
#include "compare/engine/engine.h"
#include "compare/python/native/convert.h"
#include "compare/sweep/point_run.h"
#include "compare/sweep/sample.h"
#include "native_model/control/library.h"
#include "native_model/scene/text.h"

namespace py = pybind11;

namespace rotorub::python {
namespace {

using Words = std::vector<std::string>;

std::optional<scene::Integrator> integrator_of(const std::optional<std::string>& name) {
  if (!name) return std::nullopt;
  if (const auto one = integrator_named(scene::current_word(*name))) return one;
  throw py::value_error(fmt::format("integrator: {}; choose event, verlet or euler", *name));
}

// The overrides with the step and the end of a call: seconds, or a string with a unit.
Words with_run(const py::object& overrides, const py::object& step, const py::object& end) {
  Words all = overrides_of(overrides);
  py::dict run;
  if (!step.is_none()) run["run.step"] = step;
  if (!end.is_none()) run["run.end"] = end;
  for (std::string& text : overrides_of(run)) all.push_back(std::move(text));
  return all;
}

// Runs work(interrupt) on another thread without Python's lock, so that other Python threads
// continue. Rethrows its exception; raises KeyboardInterrupt after a signal.
template <class Result>
Result in_background(const std::function<Result(const std::atomic<bool>&)>& work) {
  // Interval of checking for signals, which Python handles on this thread.
  constexpr std::chrono::milliseconds kLook{50};
  std::atomic<bool> interrupt{false};
  bool raised = false;
  auto result = std::async(std::launch::async, [&] { return work(interrupt); });
  {
    const py::gil_scoped_release free;
    while (result.wait_for(kLook) != std::future_status::ready) {
      const py::gil_scoped_acquire lock;
      if (interrupt || PyErr_CheckSignals() == 0) continue;
      raised = interrupt = true;
    }
  }
  if (raised) throw py::error_already_set();
  return result.get();
}

// Sets whether scenes' libraries may be opened while this object exists.
struct OpenedLibraries {
  explicit OpenedLibraries(bool may) {
    set_scene_libraries(may ? SceneLibraries::kAllowed : SceneLibraries::kAsked);
  }
  ~OpenedLibraries() { set_scene_libraries(SceneLibraries::kAsked); }
  OpenedLibraries(const OpenedLibraries&) = delete;
  OpenedLibraries& operator=(const OpenedLibraries&) = delete;
};

py::dict run(const py::object& scene, const py::object& overrides,
             const std::optional<std::string>& integrator, const py::object& step,
             const py::object& end, std::optional<std::vector<double>> output_times,
             bool may_open) {
  const OpenedLibraries opened(may_open);
  const scene::Scene made = scene_of(scene, with_run(overrides, step, end));
  const auto engine = native_engine(integrator_of(integrator).value_or(made.run.integrator));
  const Trajectory trajectory = in_background<Trajectory>([&](const std::atomic<bool>& interrupt) {
    RunRequest request;
    request.output_times = output_times;
    request.interrupt = &interrupt;
    return engine->run(made, request);
  });
  return run_dict(made, trajectory);
}

py::dict sweep_points(const py::object& scene, const std::vector<py::object>& points,
                      const py::object& overrides, const std::optional<std::string>& integrator,
                      const py::object& step, const py::object& end, bool may_open) {
  const OpenedLibraries opened(may_open);
  const Words common = with_run(overrides, step, end);
  std::vector<Words> changes;
  for (const py::object& point : points) changes.push_back(overrides_of(point));
  sweep::Study study;
  study.integrator = integrator_of(integrator);
  const auto scene_at = points_of(scene, common);
  const auto results =
      in_background<std::vector<sweep::PointResult>>([&](const std::atomic<bool>& interrupt) {
        return sweep::run_points(
            study, static_cast<std::int64_t>(changes.size()),
            [&](std::int64_t k) { return scene_at(changes[static_cast<std::size_t>(k)]); },
            interrupt);
      });
  return points_dict(results);
}

// The varied values of each point, before the figures.
py::dict study_dict(const sweep::PointScenes& scenes,
                    const std::vector<sweep::PointResult>& results) {
  py::dict all;
  const auto& vary = scenes.study().vary;
  for (std::size_t k = 0; k < vary.size(); ++k) {
    py::list values;
    for (const sweep::PointResult& result : results) {
      const sweep::Value value = scenes.sample().at(result.point)[k];
      values.append(value.number ? py::object(py::float_(*value.number))
                                 : py::object(py::str(value.text)));
    }
    all[vary[k].key.c_str()] = py::module_::import("numpy").attr("array")(values);
  }
  for (const auto& [key, column] : points_dict(results)) all[key] = column;
  return all;
}

py::dict study(const py::object& file, const py::object& overrides, bool may_open) {
  const OpenedLibraries opened(may_open);
  const sweep::Study read =
      sweep::read_study(py::module_::import("os").attr("fspath")(file).cast<std::string>());
  if (read.engine != sweep::EngineKind::kNative) {
    throw py::value_error(
        "run.engine: rotorub_native runs the native model; rotorub sweep runs studies in MuJoCo");
  }
  const sweep::PointScenes scenes(read, overrides_of(overrides));
  scenes.check();
  const auto results =
      in_background<std::vector<sweep::PointResult>>([&](const std::atomic<bool>& interrupt) {
        return sweep::run_points(
            read, scenes.sample().size(), [&](std::int64_t k) { return scenes.at(k); }, interrupt);
      });
  return study_dict(scenes, results);
}

// Raises SceneError, a ValueError whose `diagnostics` is a list of {"file", "line", "key",
// "reason"}; its `file`, `line`, `key` and `reason` come from the first diagnostic.
void raise(const py::object& type, const scene::SceneError& error) {
  py::list all;
  for (const scene::Diagnostic& d : error.diagnostics()) {
    py::dict one;
    one["file"] = d.file;
    one["line"] = d.line;
    one["key"] = d.key;
    one["reason"] = d.reason;
    all.append(one);
  }
  const py::object made = type(error.what());
  made.attr("diagnostics") = all;
  for (const char* name : {"file", "line", "key", "reason"}) {
    made.attr(name) = all.empty() ? py::object(py::none()) : py::object(all[0][name]);
  }
  PyErr_SetObject(type.ptr(), made.ptr());
}

}  // namespace
}  // namespace rotorub::python

PYBIND11_MODULE(rotorub_native, module) {
  namespace own = rotorub::python;
  module.doc() =
      "Runs scenes and studies of rotorub by the native model, in the process itself "
      "(compare/python/README.md).";
  module.attr("__version__") = rotorub::program_version();
  static py::object scene_error =
      py::exception<rotorub::scene::SceneError>(module, "SceneError", PyExc_ValueError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const rotorub::scene::SceneError& error) {
      own::raise(scene_error, error);
    }
  });
  const auto none = py::none();
  module.def("run", &own::run, py::arg("scene"), py::arg("overrides") = none, py::kw_only(),
             py::arg("integrator") = none, py::arg("step") = none, py::arg("end") = none,
             py::arg("output_times") = none, py::arg("allow_library") = false,
             "Runs a scene, a path or a text of several lines: a dict with series, impacts and "
             "events (arrays by column), columns (units and meanings), scene_text and summary.\n"
             "\n"
             "overrides: {\"contact.friction\": 0.2}; step, end: seconds, or a string with a unit; "
             "output_times: rows of the series, s, ascending; allow_library: open the library that "
             "the scene names as its controller, if you trust its code.");
  module.def("sweep", &own::sweep_points, py::arg("scene"), py::arg("points"),
             py::arg("overrides") = none, py::kw_only(), py::arg("integrator") = none,
             py::arg("step") = none, py::arg("end") = none, py::arg("allow_library") = false,
             "Runs a scene once for each dict of overrides, on all processors: arrays by the "
             "columns of results.csv. A point that fails says so in status and reason; its figures "
             "are NaN.");
  module.def("study", &own::study, py::arg("file"), py::arg("overrides") = none, py::kw_only(),
             py::arg("allow_library") = false,
             "Runs all points of a study (compare/sweep/README.md), on all processors: as sweep, "
             "with the varied keys.");
}
