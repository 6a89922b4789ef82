#include "native_model/stepping/load_kick.h"

#include <algorithm>
#include <cmath>

#include "native_model/system/actuation.h"

namespace rotorub {
namespace {

// What a magnetic bearing does leaves its linear law, of which the damper is in the matrix.
bool feedback_switches(const Model& m) {
  return std::any_of(m.feedbacks.begin(), m.feedbacks.end(), [](const StationFeedback& bearing) {
    const MagneticFeedback<double>& law = bearing.law;
    const bool constant = std::ranges::all_of(
        bearing.works.all(), [](double t) { return t <= 0.0 || t >= scene::kNever; });
    if (law.damping() == 0.0 || (constant && !bearing.works.at(0.0))) return false;
    return std::isfinite(law.current_limit) || law.opposed || !constant;
  });
}

}  // namespace

void add_actuators_of_run(const Model& m, const double* q, const double* v, const double* commands,
                          double* f) {
  std::array<Eigen::Vector2d, kMaxContacts> asked;
  for (std::size_t i = 0; i < asked.size(); ++i) asked[i] = {commands[2 * i], commands[2 * i + 1]};
  add_actuators(m, q, v, asked, f);
}

bool beyond_matrix(const std::vector<const Model*>& models) {
  const Model& m = *models.front();
  const Layout& l = m.layout;
  const bool turns = l.spin && (!m.gyroscopic.absent() || !m.internal_xx.absent() ||
                                !m.internal_yy.absent() || m.coupled_mass());
  const bool curve = m.drive && m.drive->kind() != scene::DriveKind::kLinear &&
                     m.drive->kind() != scene::DriveKind::kFree;
  // Bearings follow the spin, where that is free.
  const bool follows = l.spin && std::ranges::any_of(m.films, [](const StationFilm& film) {
                         return film.law.follows();
                       });
  const bool switches =
      std::ranges::any_of(models, [](const Model* of) { return feedback_switches(*of); });
  return turns || curve || follows || switches || l.integrals > 0 || l.coils > 0 ||
         !m.supports.empty();
}

}  // namespace rotorub
