// The scene that `rotorub init` writes: it runs immediately, and every value has a comment.
//
// Its sizes follow from six given values, so that any of them can be changed and the machine stays
// consistent: the shaft's stiffness is 48 E I / L^3, the bearings are stiffer by a fixed factor,
// and the ring is proportional to the disc and the speed. The load, unless it is given, is
// determined with the native model for a free orbit of a few clearances, so that the rotor touches.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace rotorub {

enum class StarterForm {
  kGeometry,  // a shaft with disc, sleeve and two bearings that loses a blade
  kModal,     // the same as a Jeffcott rotor with one mode
  kRig,  // the reference rig: torsion, motor, magnetic exciter, actuator, prepared for a controller
  kController,  // the same with an active sliding-mode controller
  kOverhung,    // like kGeometry with the disc beyond the second bearing, as in a pump or fan
  // Suspended from two bearings at the upper end, with the auxiliary bearing as a guide below.
  kVertical,
  kTwoCatchers,  // in two magnetic bearings that fail, so that it drops into two auxiliary bearings
};

struct StarterFormWord {
  StarterForm form;
  const char* word;  // of --form
};
inline constexpr std::array kStarterForms{
    StarterFormWord{StarterForm::kGeometry, "geometry"},
    StarterFormWord{StarterForm::kModal, "modal"},
    StarterFormWord{StarterForm::kRig, "rig"},
    StarterFormWord{StarterForm::kController, "controller"},
    StarterFormWord{StarterForm::kOverhung, "overhung"},
    StarterFormWord{StarterForm::kVertical, "vertical"},
    StarterFormWord{StarterForm::kTwoCatchers, "two-catchers"}};

// Driven by a motor, and pushed into the ring by a magnetic exciter.
constexpr bool is_rig(StarterForm form) {
  return form == StarterForm::kRig || form == StarterForm::kController;
}
// Whether an unbalance that appears later starts the rub.
constexpr bool loses_mass(StarterForm form) {
  return !is_rig(form) && form != StarterForm::kTwoCatchers;
}

// A value as given by the user, and in SI.
struct StarterValue {
  std::string text;
  double value = 0.0;
};

struct Starter {
  StarterForm form = StarterForm::kGeometry;
  StarterValue speed{"50 Hz", 314.159265358979312};  // > 0
  StarterValue length{"0.6 m", 0.6};                 // > 0
  StarterValue diameter{"18 mm", 0.018};             // > 0, below length / 5
  StarterValue disc_mass{"2 kg", 2.0};               // > 0
  StarterValue clearance{"0.5 mm", 0.5e-3};          // > 0
  StarterValue friction{"0.15", 0.15};               // >= 0
  // kg m, > 0, static moment of the lost mass (loses_mass); if empty, for a free orbit of two
  // clearances.
  std::optional<StarterValue> unbalance;
  std::string file = "rotor.toml";  // mentioned in its comments
};

// The scene's text. Throws scene::SceneError if the values do not make a machine that runs.
std::string starter_scene(const Starter& starter);

}  // namespace rotorub
