// Cross-checks of magnetic bearings.

#include <algorithm>
#include <cmath>

#include "native_model/scene/reading.h"
#include "native_model/scene/shaft_bearing.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

// Stiffness of the bearing's own linear law, N/m.
double spring_of(const MagneticBearing& bearing) {
  if (!bearing.control) return -bearing.pull();
  return bearing.force_per_current() * bearing.control->proportional - bearing.pull();
}

// True if the other supports hold the shaft at two stations in this plane, so that no rigid motion
// is left.
bool held_without(const Scene& scene, const MagneticBearing& magnetic, int plane) {
  std::vector<double> stations;
  for (const ShaftBearing& bearing : scene.rotor.geometry->bearings) {
    if (stiffness_at(bearing, scene.rotor.speed)[plane] > 0.0) stations.push_back(bearing.z);
  }
  for (const MagneticBearing& other : scene.magnetic_bearings) {
    if (&other != &magnetic && spring_of(other) > 0.0) stations.push_back(other.station);
  }
  return std::any_of(stations.begin(), stations.end(),
                     [&](double z) { return z != stations.front(); });
}

bool touches(const MagneticBearing& bearing, std::size_t mode) {
  return bearing.shape.empty() || (mode < bearing.shape.size() && bearing.shape[mode] != 0.0);
}

// Names the motion that only this magnetic bearing holds; empty if there is none.
std::string held_by_magnets(const Scene& scene, const MagneticBearing& magnetic) {
  const char* planes[] = {"x", "y"};
  if (scene.rotor.geometry) {
    for (int plane : {0, 1}) {
      if (held_without(scene, magnetic, plane)) continue;
      return std::string("the shaft against rigid motion in plane ") + planes[plane];
    }
  }
  if (!scene.rotor.modal) return {};
  const RotorModal& modal = *scene.rotor.modal;
  for (std::size_t k = 0; k < modal.stiffness.size(); ++k) {
    const bool free_y = k < modal.stiffness_y.size() && modal.stiffness_y[k] == 0.0;
    if (!touches(magnetic, k) || !(modal.stiffness[k] == 0.0 || free_y)) continue;
    if (std::any_of(scene.magnetic_bearings.begin(), scene.magnetic_bearings.end(),
                    [&](const MagneticBearing& other) {
                      return &other != &magnetic && touches(other, k) && spring_of(other) > 0.0;
                    }))
      continue;
    return "mode " + std::to_string(k + 1) + ", whose stiffness is 0, in plane " +
           planes[modal.stiffness[k] == 0.0 ? 0 : 1];
  }
  return {};
}

// Checks that the matrices fit each other. `below` is the path of their table, "magnetic_control.".
void check_matrices(const Reading& check, const ControlMatrices& m, const std::string& below,
                    std::size_t ports) {
  if (!check.sound({below + "state_matrix", below + "input_matrix", below + "output_matrix",
                    below + "feedthrough"})) {
    return;
  }
  const auto n =
      static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(m.state.size()))));
  if (n * n != m.state.size()) {
    return check.fail(below + "state_matrix",
                      "expected n times n values, got " + std::to_string(m.state.size()));
  }
  const auto fits = [&](const char* key, const std::vector<double>& list, std::size_t size,
                        const std::string& of) {
    if (list.size() == size) return;
    check.fail(below + key, "expected " + std::to_string(size) + " values, " + of + ", got " +
                                std::to_string(list.size()));
  };
  const std::string rows = std::to_string(n), columns = std::to_string(ports);
  fits("input_matrix", m.input, n * ports, rows + " times " + columns);
  fits("output_matrix", m.output, n * ports, columns + " times " + rows);
  fits("feedthrough", m.feedthrough, ports * ports, columns + " times " + columns);
}

void check_delay(const Reading& check, const std::string& below, double sample_time, double delay) {
  if (!check.given(below + "delay") || !check.sound({below + "sample_time", below + "delay"})) {
    return;
  }
  if (!(sample_time > 0.0)) {
    if (delay > 0.0) check.fail(below + "delay", "needs " + check.full(below + "sample_time"));
    return;
  }
  const double samples = delay / sample_time;
  constexpr double kMost = 20.0;
  if (samples > kMost + 0.5 || std::abs(samples - std::round(samples)) > 1e-6) {
    check.fail(below + "delay", "is " + number_text(samples) +
                                    " sampling intervals; give a whole number of them, at most 20");
  }
}

void check_form(const Reading& check, const BearingControl& control) {
  if (!check.sound({".control.kind"})) return;
  if (control.form == ControlForm::kPid) {
    if (!check.given(".control.proportional"))
      check.missing(".control.proportional", ", of a control of kind \"pid\"");
  } else if (control.form == ControlForm::kShared) {
    if (!check.scene.magnetic_control && !check.given("magnetic_control")) {
      check.fail(".control.kind",
                 "\"shared\" needs [magnetic_control], which commands its currents");
    }
  } else if (!check.given(".control.sample_time")) {
    check.fail(".control.sample_time",
               "missing: expected a time in s, > 0, because this kind is sampled");
  } else if (check.sound({".control.sample_time"}) && control.sample_time == 0.0) {
    check.fail(".control.sample_time", "must be > 0: a law of this kind is sampled");
  }
  check_delay(check, ".control.", control.sample_time, control.delay);
  if (control.form == ControlForm::kStateSpace)
    check_matrices(check, control.matrices, ".control.", 1);
  if (control.form == ControlForm::kTransferFunction &&
      check.sound({".control.numerator", ".control.denominator"})) {
    if (control.denominator.empty() || control.denominator.front() == 0.0) {
      check.fail(".control.denominator", "expected a first value that is not 0");
    }
    if (control.numerator.empty()) check.fail(".control.numerator", "expected at least one value");
  }
}

// Checks the switching times and the current limit.
void check_control_limits(const Reading& check, const MagneticBearing& magnetic) {
  const BearingControl& control = *magnetic.control;
  const bool fails = check.given(".control.fails_at");
  if (check.given(".control.returns_at") &&
      check.sound({".control.fails_at", ".control.returns_at"}) &&
      control.returns_at <= control.fails_at) {
    check.fail(".control.returns_at",
               fails ? "must be after `fails_at` = " + number_text(control.fails_at) + " s"
                     : "needs " + check.at + ".control.fails_at, after which it returns");
  }
  if (check.given(".control.on") && fails && check.sound({".control.on", ".control.fails_at"}) &&
      control.fails_at < control.works_from) {
    check.fail(".control.fails_at",
               "must not be before `on` = " + number_text(control.works_from) + " s");
  }
  const bool per_current = check.given(".control.force_per_current");
  if (magnetic.kind != MagnetKind::kElectromagnet) {
    if (!per_current)
      check.missing(".control.force_per_current", ", of a bearing of kind \"linear\"");
    return;
  }
  if (per_current) {
    check.fail(".control.force_per_current",
               "belongs to kind = \"linear\"; for an electromagnet it follows from force_constant, "
               "bias_current and air_gap, so remove it");
  }
  if (check.given(".control.current_limit") &&
      check.sound({".control.current_limit", ".bias_current"}) &&
      control.current_limit > magnetic.bias_current) {
    check.fail(".control.current_limit", "must be at most " + check.at + ".bias_current = " +
                                             number_text(magnetic.bias_current) +
                                             " A: beyond it a magnet's current would reverse");
  }
}

// A magnetic bearing must be stiff enough to hold what nothing else holds.
void check_magnetic_bearing(const Reading& check, const MagneticBearing& magnetic) {
  check.station(".station", magnetic.station);
  check.station(".sensor_station", magnetic.sensor_station.value_or(0.0));
  for (const char* key : {".shape", ".sensor_shape"})
    check.list_length(key, check.bending_modes(), "bending mode");
  if (magnetic.amplifier && magnetic.control) check.voltage(".amplifier");
  if (!magnetic.control) {
    if (magnetic.amplifier)
      check.fail(".amplifier", "needs " + check.at + ".control, which commands the current");
    for (const char* key : {".sensor_station", ".sensor_shape"}) {
      if (!check.given(key)) continue;
      check.fail(key, "belongs to the sensor of " + check.at +
                          ".control, which is missing; add the control, or remove this key");
    }
    return;
  }
  check_form(check, *magnetic.control);
  check_control_limits(check, magnetic);
  if (!check.sound({".kind", ".negative_stiffness", ".force_constant", ".bias_current", ".air_gap",
                    ".control.force_per_current", ".control.proportional"}) ||
      !(magnetic.force_per_current() > 0.0)) {
    return;
  }
  const BearingControl& control = *magnetic.control;
  if (control.integral > 0.0 && control.proportional == 0.0) {
    check.fail(".control.integral",
               "needs " + check.at +
                   ".control.proportional, whose force the integrator replaces within P / I");
  }
  const double gain = magnetic.force_per_current();
  const double magnets = gain * control.proportional, against = magnetic.pull();
  if (magnets > against) return;
  const std::string held = held_by_magnets(check.scene, magnetic);
  if (held.empty()) return;
  check.fail(
      ".control.proportional",
      "times force_per_current is " + number_text(magnets) + " N/m, and " +
          (magnetic.kind == MagnetKind::kLinear ? "negative_stiffness" : "the magnets' pull") +
          " takes " + number_text(against) + " N/m of it: " + number_text(against - magnets) +
          " N/m too little to hold " + held + ", which nothing else holds; give more than " +
          number_text(against / gain) + " A/m");
}

}  // namespace

void check_magnetic_bearings(Reading& check) {
  if (const auto& shared = check.scene.magnetic_control) {
    const auto& all = check.scene.magnetic_bearings;
    const auto takes_part = [](const MagneticBearing& bearing) {
      return bearing.control && bearing.control->form == ControlForm::kShared;
    };
    const auto ports = 2 * static_cast<std::size_t>(std::ranges::count_if(all, takes_part));
    if (ports == 0) {
      check.fail("magnetic_control",
                 "commands nothing, because no magnetic bearing has a control of kind \"shared\"; "
                 "give one "
                 "that kind");
    } else if (!shared->by_library()) {
      check_matrices(check, shared->matrices, "magnetic_control.", ports);
    }
    check_delay(check, "magnetic_control.", shared->sample_time, shared->delay);
  }
  for (std::size_t k = 0; k < check.scene.magnetic_bearings.size(); ++k) {
    check.at = magnetic_bearing_path(check.scene, k);
    check_magnetic_bearing(check, check.scene.magnetic_bearings[k]);
  }
}

}  // namespace rotorub::scene
