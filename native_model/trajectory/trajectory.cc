#include "native_model/trajectory/trajectory.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rotorub {
namespace {

// In the order of their values.
constexpr std::array kModeNames{"free", "slide", "stick"};
constexpr std::array kEventNames{"impact", "slide", "stick", "lift_off", "reverse"};
constexpr std::array kStatusNames{"ok",          "diverged",         "no_solution",
                                  "ambiguous",   "step_too_large",   "out_of_range",
                                  "interrupted", "controller_failed"};

}  // namespace

const char* to_string(ContactMode mode) { return kModeNames.at(static_cast<std::size_t>(mode)); }
const char* to_string(EventKind kind) { return kEventNames.at(static_cast<std::size_t>(kind)); }
const char* to_string(Status status) { return kStatusNames.at(static_cast<std::size_t>(status)); }

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
