#include "compare/bench/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>

#include "compare/bench/closed_form.h"
#include "compare/bench/event_engine.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub::bench {
namespace {

// m: some units in the last place of positions of a millimetre.
constexpr double kClosedFormRoundOff = 1e-17;

Trajectory run_event(const scene::Scene& scene, const RunRequest& request, double tolerance) {
  Trajectory t = event_engine(event_parameters(tolerance))->run(scene, request);
  if (t.status != Status::kOk && t.status != Status::kInterrupted) {
    throw std::runtime_error(fmt::format("{}: no reference: event at tolerance {:g}: {}: {}",
                                         scene.name, tolerance, to_string(t.status), t.message));
  }
  return t;
}

}  // namespace

std::vector<double> common_times(const scene::Run& run, const std::vector<double>& steps) {
  constexpr double kNano = 1e-9;   // s
  constexpr double kWhole = 1e-6;  // what a whole number may miss
  std::int64_t common = 1;
  for (const double step : steps) {
    const double nanos = step / kNano;
    const bool whole = nanos > 0.5 && std::abs(nanos - std::round(nanos)) < kWhole * nanos;
    if (!whole || static_cast<double>(common) > run.end / kNano) return output_times(run);
    common = std::lcm(common, static_cast<std::int64_t>(std::llround(nanos)));
  }
  const double least = static_cast<double>(common) * kNano;
  if (run.end / least < kFewestRows) return output_times(run);
  // The end is a row too, where it can be.
  const double most = std::max(1.0, std::ceil(run.end / kMostRows / least - kWhole));
  const auto ends_at_the_end = [&](double factor) {
    const double rows = run.end / (factor * least);
    return std::abs(rows - std::round(rows)) < kWhole;
  };
  double factor = most;
  while (factor < 2.0 * most && !ends_at_the_end(factor)) factor += 1.0;
  const double spacing = least * (ends_at_the_end(factor) ? factor : most);
  std::vector<double> times;
  const auto count = static_cast<std::int64_t>(std::floor(run.end / spacing * (1.0 + 1e-12)));
  for (std::int64_t k = 0; k <= count; ++k) times.push_back(static_cast<double>(k) * spacing);
  times.back() = std::min(times.back(), run.end);
  return times;
}

double position_distance(const Trajectory& a, const Trajectory& b) {
  assert(a.rows() == b.rows());
  double largest = 0.0;
  for (const char* body : {"rotor", "stator"}) {
    const std::string name = body;
    const auto &ax = a.column(name + "_x"), &ay = a.column(name + "_y");
    const auto &bx = b.column(name + "_x"), &by = b.column(name + "_y");
    for (std::size_t k = 0; k < ax.size(); ++k) {
      largest = std::max(largest, std::hypot(ax[k] - bx[k], ay[k] - by[k]));
    }
  }
  return largest;
}

Reference make_reference(const scene::Scene& scene, const RunRequest& request) {
  Reference r;
  r.trajectory = run_event(scene, request, kReferenceTolerance);
  r.times = r.trajectory.column("t");
  const Trajectory event = r.trajectory;
  const std::string form = put_closed_form(scene, r.trajectory);
  if (!form.empty()) {
    r.source = "closed form: " + form;
    r.event_distance = position_distance(event, r.trajectory);
    r.error = kClosedFormRoundOff;
    return r;
  }
  r.source = fmt::format("event at tolerance {:g}", kReferenceTolerance);
  for (const double factor : {3.0, 10.0}) {
    const Trajectory looser = run_event(scene, request, factor * kReferenceTolerance);
    if (looser.rows() != event.rows()) return r;  // interrupted
    r.error = std::max(r.error, position_distance(event, looser));
  }
  return r;
}

}  // namespace rotorub::bench
