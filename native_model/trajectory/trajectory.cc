#include "native_model/trajectory/trajectory.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rotorub {

const char* to_string(Mode mode) {
  switch (mode) {
    case Mode::kFree:
      return "free";
    case Mode::kSlide:
      return "slide";
    case Mode::kStick:
      return "stick";
  }
  return "";
}

const char* to_string(EventKind kind) {
  switch (kind) {
    case EventKind::kImpact:
      return "impact";
    case EventKind::kSlide:
      return "slide";
    case EventKind::kStick:
      return "stick";
    case EventKind::kLiftOff:
      return "lift_off";
    case EventKind::kReverse:
      return "reverse";
  }
  return "";
}

const char* to_string(Status status) {
  switch (status) {
    case Status::kOk:
      return "ok";
    case Status::kDiverged:
      return "diverged";
    case Status::kNoSolution:
      return "no_solution";
    case Status::kAmbiguous:
      return "ambiguous";
    case Status::kStepTooLarge:
      return "step_too_large";
    case Status::kOutOfRange:
      return "out_of_range";
    case Status::kControllerFailed:
      return "controller_failed";
    case Status::kInterrupted:
      return "interrupted";
  }
  return "";
}

double Statistics::energy_residual() const {
  if (energy_scale <= 0.0) return 0.0;
  const double change = energy_end - energy_start - external_work - contact_work;
  return std::abs(change) / energy_scale;
}

const std::vector<double>& Trajectory::column(const std::string& name) const {
  const auto at = std::find_if(series.begin(), series.end(),
                               [&](const Column& column) { return column.name == name; });
  if (at == series.end()) throw MissingColumn("the series has no column `" + name + "`");
  return at->values;
}

bool Trajectory::has(const std::string& name) const {
  return std::any_of(series.begin(), series.end(),
                     [&](const Column& column) { return column.name == name; });
}

double Trajectory::contact_fraction() const {
  const double window = end - statistics.first_touch;
  if (statistics.first_touch < 0.0 || window <= 0.0) return 0.0;
  return std::min(1.0, statistics.contact_time / window);
}

double Trajectory::mean_force() const {
  const double window = end - statistics.first_touch;
  if (statistics.first_touch < 0.0 || window <= 0.0) return 0.0;
  return statistics.impulse_total / window;
}

}  // namespace rotorub
