// Measured runs made from simulated ones: another clock, a turned frame, noise, a sensor's limit.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "compare/measured/reader.h"
#include "native_model/trajectory/trajectory.h"
#include "tests/support/native_run.h"

namespace rotorub::test {

struct Sensors {
  double from = 0.01, to = 0.11;  // s, of the scene's clock
  double rate = 20e3;             // samples a second
  double shift = 0.0;             // s, that found is right
  double angle = 0.0;             // rad, that found is right
  double noise = 0.0;             // m, standard deviation of each place
  double limit = 0.0;             // m, of the rotor's sensors; 0: none
  unsigned seed = 1;
};

// The passive rig from rest, because a steady circle does not determine the clock.
inline scene::Scene short_rig() {
  return shipped("paper_passive",
                 {"run.end=0.1", "run.step=1e-5", "run.output_step=1e-4", "initial.steady=false"});
}

// Rows of the reference integrator at these times.
inline Trajectory run_at(const scene::Scene& scene, const std::vector<double>& times) {
  NativeOptions options;
  options.integrator = scene::Integrator::kEvent;
  options.output_times = times;
  return run_native(scene, options);
}

// The scene's times of the samples.
inline std::vector<double> instants(const Sensors& sensors) {
  std::vector<double> t;
  const auto count = static_cast<std::size_t>((sensors.to - sensors.from) * sensors.rate);
  for (std::size_t k = 0; k < count; ++k)
    t.push_back(sensors.from + static_cast<double>(k) / sensors.rate);
  return t;
}

// The text of a record of a run whose rows are the samples; nothing is interpolated. ring: with its
// columns; empty(row): the values of that row are missing.
inline std::string record_text(const Trajectory& run, const Sensors& sensors,
                               const std::function<bool(std::size_t)>& empty = {}) {
  std::mt19937 bits(sensors.seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  const auto noise = [&] { return sensors.noise > 0.0 ? sensors.noise * normal(bits) : 0.0; };
  const std::complex<double> back = std::polar(1.0, -sensors.angle);
  std::string text = "t [ms], rotor_x [um], rotor_y [um], ring_x [um], ring_y [um], gap [um]\n";
  for (std::size_t i = 0; i < run.rows(); ++i) {
    const auto place = [&](const char* x, const char* y) {
      return back * std::complex<double>(run.column(x)[i], run.column(y)[i]) +
             std::complex<double>(noise(), noise());
    };
    const auto held = [&](double v) {
      return sensors.limit > 0.0 ? std::clamp(v, -sensors.limit, sensors.limit) : v;
    };
    const std::complex<double> rotor = place("rotor_x", "rotor_y"),
                               ring = place("stator_x", "stator_y");
    text += fmt::format("{:.17g}", 1e3 * (run.column("t")[i] - sensors.shift));
    if (empty && empty(i)) {
      text += ",,,,,\n";
      continue;
    }
    text += fmt::format(",{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", 1e6 * held(rotor.real()),
                        1e6 * held(rotor.imag()), 1e6 * ring.real(), 1e6 * ring.imag(),
                        1e6 * (run.column("gap")[i] + noise()));
  }
  return text;
}

inline MeasuredRecord record_of(const Trajectory& run, const Sensors& sensors) {
  return parse_measured(record_text(run, sensors), "run.csv");
}

}  // namespace rotorub::test
