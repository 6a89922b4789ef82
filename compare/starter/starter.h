// The scene that `rotorub init` writes: one that runs at once, with a word on every value.
//
// Its sizes follow from six that are asked for, so that any of them can be changed and the machine
// stays one: the shaft's stiffness 48 E I / L^3, the bearings stiffer by a fixed factor, the ring
// in proportion to the disc and the speed. The load, unless it is asked for, is found by the native
// model: a free orbit of a few clearances, so that the rotor touches.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace rotorub {

enum class StarterForm {
  kGeometry,  // a shaft with disc, sleeve and two bearings, which loses a blade
  kModal,     // the same as a Jeffcott rotor: one mode
  kRig,  // the reference rig: torsion, motor, magnetic exciter, actuator, room for a controller
  kController,   // the same with a sliding-mode controller at work
  kOverhung,     // as kGeometry, the disc beyond the second bearing: a pump's or fan's wheel
  kVertical,     // hung from two bearings at its upper end, guided by the auxiliary bearing below
  kTwoCatchers,  // in two magnetic bearings, which fail: it drops into two auxiliary bearings
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

// Driven by a motor, into its ring by a magnetic exciter.
constexpr bool is_rig(StarterForm form) {
  return form == StarterForm::kRig || form == StarterForm::kController;
}
// An unbalance that comes begins the rub.
constexpr bool loses_mass(StarterForm form) {
  return !is_rig(form) && form != StarterForm::kTwoCatchers;
}

// A value as the user wrote it, and in SI.
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
  // kg m, > 0, of the mass that is lost (loses_mass); absent: one of a free orbit of two clearances
  std::optional<StarterValue> unbalance;
  std::string file = "rotor.toml";  // named in its comments
};

// The scene's text. Throws scene::SceneError where the values make no machine that runs.
std::string starter_scene(const Starter& starter);

}  // namespace rotorub
