#include "native_model/event/stiffness.h"

#include "native_model/scene/text.h"

namespace rotorub {
namespace {

// Hairer, Norsett, Wanner, section IV.2, and their code DOP853: looked at every so many steps; h
// |lambda| at the border of stability; stiff after so many looks that found it there, unless so
// many in a row did not.
constexpr std::int64_t kStepsBetween = 1000;
constexpr double kBorder = 6.1;
constexpr int kStiffLooks = 15, kSmoothLooks = 6;

// Of coordinate i, as a user calls it.
std::string part_of(const Layout& l, int i) {
  const auto numbered = [i](const char* what, int first) {
    return what + std::to_string(i - first + 1);
  };
  if (i < l.y()) return numbered("the rotor's bending mode x_", l.x());
  if (i < l.phi()) return numbered("the rotor's bending mode y_", l.y());
  if (i < l.theta()) return "the rotor's spin";
  if (i < l.ring()) return numbered("the rotor's torsion mode ", l.theta());
  if (i < l.ring_angle()) return "the ring's motion";
  if (i < l.integral()) return "the ring's spin";
  if (i < l.coil()) return "the magnetic bearing's integrator";
  return numbered("the current of coil ", l.coil());
}

}  // namespace

std::optional<std::string> StiffnessWatch::look(double t, double end, const SmoothStep& step) {
  if (++steps_ % kStepsBetween != 0) return {};
  const SmoothStep::Stability now = step.stability();
  if (now.rate * step.length() < kBorder) {
    if (++smooth_ == kSmoothLooks) stiff_ = 0;
    return {};
  }
  smooth_ = 0;
  if (stiff_++ == 0) begun_ = steps_, since_ = t;
  if (stiff_ <= kStiffLooks) return {};
  const double to_go = (end - t) * static_cast<double>(steps_ - begun_) / (t - since_);
  if (to_go < parameters_->most_stiff_steps) return {};
  const auto text = [](double value) { return scene::number_text(value, 2); };
  return part_of(model_->layout, now.coordinate) + " follows within " + text(1.0 / now.rate) +
         " s, which holds `event` to steps of that size, " + text(to_go) +
         " more of them (give it more inertia or less damping, or take the integrator `verlet`, "
         "whose damping is implicit)";
}

}  // namespace rotorub
