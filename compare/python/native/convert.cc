#include "compare/python/native/convert.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "compare/base/json.h"
#include "compare/run_files/summary.h"
#include "native_model/scene/reader.h"

namespace py = pybind11;

namespace rotorub::python {
namespace {

constexpr const char* kTextName = "scene.toml";  // name of a scene that was given as text

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

// A value in TOML, within a list or by itself.
std::string value_text(const py::handle& value, const std::string& key, bool in_list) {
  if (value.is_none() && !in_list) return "none";
  if (PyBool_Check(value.ptr())) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::str>(value)) {
    const auto text = value.cast<std::string>();
    return in_list ? quoted(text) : text;
  }
  if (PyFloat_Check(value.ptr())) return fmt::format("{}", value.cast<double>());
  if (py::isinstance<py::sequence>(value) || py::isinstance<py::array>(value)) {
    std::string text;
    for (const py::handle& element : value)
      text += (text.empty() ? "" : ", ") + value_text(element, key, true);
    return "[" + text + "]";
  }
  if (PyIndex_Check(value.ptr()))
    return py::str(py::int_(py::reinterpret_borrow<py::object>(value)));
  if (py::hasattr(value, "__float__")) {
    return fmt::format("{}", py::float_(py::reinterpret_borrow<py::object>(value)).cast<double>());
  }
  throw py::type_error(fmt::format(
      "{}: a {} cannot be a value of a scene; give numbers, flags, strings, lists of them or None",
      key, py::str(py::type::of(value).attr("__name__")).cast<std::string>()));
}

// The text of a scene; empty for a path.
std::optional<std::string> text_of(const py::object& scene) {
  if (!py::isinstance<py::str>(scene)) return std::nullopt;
  auto text = scene.cast<std::string>();
  return text.find('\n') != std::string::npos ? std::optional(std::move(text)) : std::nullopt;
}

std::filesystem::path path_of(const py::object& scene) {
  return py::module_::import("os").attr("fspath")(scene).cast<std::string>();
}

py::array_t<double> array_of(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::object parsed_json(const std::string& text) {
  return py::module_::import("json").attr("loads")(text);
}

// A numpy array of the words with the indices `which`.
py::object words_of(const std::vector<std::string>& words, const std::vector<int>& which) {
  const py::module_ numpy = py::module_::import("numpy");
  return numpy.attr("array")(words).attr("take")(
      py::array_t<int>(static_cast<py::ssize_t>(which.size()), which.data()));
}

py::dict series_dict(const Trajectory& t) {
  py::dict all;
  for (const Column& column : t.series) {
    if (contact_of_column(column.name).second == "mode") {
      const std::vector<int> which(column.values.begin(), column.values.end());
      all[column.name.c_str()] = words_of({"free", "slide", "stick"}, which);
    } else {
      all[column.name.c_str()] = array_of(column.values);
    }
  }
  return all;
}

// The array of a member, or of a function's results, for each element.
template <class List, class Value>
py::array_t<double> column_of(const List& list, Value value) {
  std::vector<double> values;
  for (const auto& element : list) values.push_back(std::invoke(value, element));
  return array_of(values);
}

// Adds the contact's number, from 1, if there are several contacts.
template <class List>
void add_contact(py::dict& all, const Trajectory& t, const List& list) {
  if (t.contacts > 1) {
    all["contact"] = column_of(list, [](const auto& element) { return element.contact + 1.0; });
  }
}

py::dict impacts_dict(const Trajectory& t) {
  static constexpr double Impact::*kMembers[] = {&Impact::t,
                                                 &Impact::normal_impulse,
                                                 &Impact::friction_impulse,
                                                 &Impact::gap_rate_before,
                                                 &Impact::gap_rate_after,
                                                 &Impact::slip_before,
                                                 &Impact::slip_after,
                                                 &Impact::energy_change};
  py::dict all;
  std::size_t k = 0;
  for (const ColumnMeaning& column : impact_columns(false))
    all[py::str(std::string(column.name))] = column_of(t.impacts, kMembers[k++]);
  add_contact(all, t, t.impacts);
  return all;
}

py::dict events_dict(const Trajectory& t) {
  std::vector<int> which;
  for (const Event& event : t.events) which.push_back(static_cast<int>(event.kind));
  std::vector<std::string> words;
  for (const EventKind kind : {EventKind::kImpact, EventKind::kSlide, EventKind::kStick,
                               EventKind::kLiftOff, EventKind::kReverse}) {
    words.emplace_back(to_string(kind));
  }
  py::dict all;
  all["t"] = column_of(t.events, &Event::t);
  all["event"] = words_of(words, which);
  add_contact(all, t, t.events);
  return all;
}

py::dict keyphasor_dict(const Trajectory& t) {
  static constexpr double KeyphasorPass::*kMembers[] = {
      &KeyphasorPass::t, &KeyphasorPass::x, &KeyphasorPass::y, &KeyphasorPass::spin_speed};
  py::dict all;
  std::size_t k = 0;
  for (const ColumnMeaning& column : keyphasor_columns())
    all[py::str(std::string(column.name))] = column_of(t.keyphasor, kMembers[k++]);
  return all;
}

}  // namespace

std::vector<std::string> overrides_of(const py::object& changes) {
  std::vector<std::string> all;
  if (changes.is_none()) return all;
  if (py::isinstance<py::dict>(changes)) {
    for (const auto& [key, value] : changes.cast<py::dict>()) {
      const auto name = key.cast<std::string>();
      all.push_back(name + "=" + value_text(value, name, false));
    }
    return all;
  }
  if (py::isinstance<py::str>(changes) || !py::isinstance<py::sequence>(changes)) {
    throw py::type_error(
        "overrides: give a dict of keys and values, or a list of \"table.key=value\"");
  }
  return changes.cast<std::vector<std::string>>();
}

scene::Scene scene_of(const py::object& scene, const std::vector<std::string>& overrides) {
  if (const auto text = text_of(scene)) return scene::parse_scene(*text, kTextName, overrides);
  return scene::read_scene(path_of(scene), overrides);
}

std::function<scene::Scene(const std::vector<std::string>&)> points_of(
    const py::object& scene, const std::vector<std::string>& overrides) {
  if (const auto text = text_of(scene)) {
    return [text = *text, overrides](const std::vector<std::string>& changes) {
      std::vector<std::string> all = overrides;
      all.insert(all.end(), changes.begin(), changes.end());
      return scene::parse_scene(text, kTextName, all);
    };
  }
  const auto variants = std::make_shared<scene::Variants>(path_of(scene), overrides);
  return [variants](const std::vector<std::string>& changes) {
    return variants->scene(changes, false);
  };
}

py::dict run_dict(const scene::Scene& scene, const Trajectory& t) {
  nlohmann::ordered_json by_name = nlohmann::ordered_json::object();
  const nlohmann::ordered_json files = run_columns_json(t);
  for (const auto& [file, columns] : files.items()) {
    for (const auto& column : columns) {
      by_name[file][column.at("name").get<std::string>()] = {{"unit", column.at("unit")},
                                                             {"meaning", column.at("meaning")}};
    }
  }
  py::dict all;
  all["series"] = series_dict(t);
  all["impacts"] = impacts_dict(t);
  all["events"] = events_dict(t);
  all["keyphasor"] = keyphasor_dict(t);
  all["columns"] = parsed_json(by_name.dump());
  all["scene_text"] = scene.text;
  all["summary"] = parsed_json(json_text(summary_json(scene, t)));
  return all;
}

py::dict points_dict(const std::vector<sweep::PointResult>& points) {
  const py::module_ numpy = py::module_::import("numpy");
  py::dict all;
  std::vector<std::string> statuses, reasons;
  for (const sweep::PointResult& p : points) {
    statuses.push_back(p.status);
    reasons.push_back(p.reason);
  }
  all["point"] = column_of(points, [](const auto& p) { return static_cast<double>(p.point); });
  all["status"] = numpy.attr("array")(statuses, "str");
  all["reason"] = numpy.attr("array")(reasons, "str");
  for (const sweep::ResultColumn& column : sweep::result_columns()) {
    const py::str name{std::string(column.name)};
    if (column.value({}).is_string()) {
      std::vector<std::string> words;
      for (const auto& p : points)
        words.push_back(p.figures ? column.value(*p.figures).get<std::string>() : "");
      all[name] = numpy.attr("array")(words, "str");
      continue;
    }
    all[name] = column_of(points, [&](const sweep::PointResult& p) {
      const nlohmann::json value = p.figures ? column.value(*p.figures) : nlohmann::json();
      return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
    });
  }
  return all;
}

}  // namespace rotorub::python
