#include "native_model/stepping/load_kick.h"

#include <algorithm>
#include <cmath>

#include "native_model/system/actuation.h"

namespace rotorub {

void add_actuators_of_run(const Model& m, const double* q, const double* v, const double* commands,
                          double* f) {
  std::array<Eigen::Vector2d, kMaxContacts> asked;
  for (std::size_t i = 0; i < asked.size(); ++i) asked[i] = {commands[2 * i], commands[2 * i + 1]};
  add_actuators(m, q, v, asked, f);
}

bool feedback_switches(const Model& m) {
  return std::any_of(m.feedbacks.begin(), m.feedbacks.end(), [](const StationFeedback& bearing) {
    const MagneticFeedback<double>& law = bearing.law;
    const bool constant = std::ranges::all_of(
        bearing.works.all(), [](double t) { return t <= 0.0 || t >= scene::kNever; });
    if (law.damping() == 0.0 || (constant && !bearing.works.at(0.0))) return false;
    return std::isfinite(law.current_limit) || law.opposed || !constant;
  });
}

}  // namespace rotorub
