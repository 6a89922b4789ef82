#include "native_model/control/latency.h"

#include <cmath>
#include <limits>
#include <string>

#include "native_model/control/radial_tracking.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/record.h"
#include "native_model/scene/text.h"

namespace rotorub {

double largest_lead(const Controller::Gains& gains, double ring_mass) {
  const double d = gains.damping / ring_mass, k = gains.stiffness / ring_mass;
  const double square = 0.5 * (d * d + std::sqrt(d * d * d * d + 4.0 * k * k));
  return square > 0.0 ? 1.0 / std::sqrt(square) : std::numeric_limits<double>::infinity();
}

void refuse_lateness(const scene::Scene& scene, const Plant& plant, const Controller& law) {
  using scene::number_text;
  const scene::Controller& c = *scene.first().controller;
  if (c.sample_time <= 0.0) return;
  const double lead = command_lead(c, plant);
  const double most = largest_lead(law.ring_gains(), plant.stator_mass.maxCoeff());
  if (lead <= most) return;
  const double sample = c.sample_time - 2.0 * (lead - most);
  const std::string less = "a smaller `bandwidth` or `switching_gain`/`boundary_layer`";
  throw scene::SceneError(scene::placed(
      scene, {{"", 0, "controller.sample_time",
               "half of it, delay and coil_lag make the command " + number_text(lead) +
                   " s late, and with these gains it would chatter beyond " + number_text(most) +
                   " s; accepted: " +
                   (sample > 0.0 ? "at most " + number_text(sample) + " s, or " + less : less)}}));
}

}  // namespace rotorub
