// All results of `rotorub modes` for a rotor, computed once for text, JSON and page: whirl at given
// spin speeds, critical speeds, stability threshold, mode shapes and lasting rubs.
#pragma once

#include <optional>
#include <vector>

#include "compare/modes/periodic_rubs.h"
#include "compare/modes/response_text.h"
#include "compare/modes/rub_analysis.h"
#include "compare/modes/speed_margin.h"
#include "native_model/linear/campbell.h"
#include "native_model/linear/levitation.h"
#include "native_model/linear/mode_shapes.h"
#include "native_model/linear/whirl_system.h"
#include "native_model/rotor/mode_truncation.h"
#include "native_model/scene/scene.h"

namespace rotorub {

struct RotorAnalysis {
  WhirlSystem system;
  std::vector<WhirlSpectrum> spectra;  // at the requested speeds
  // rad/s, ascending absolute values up to critical_bound, for a spin in the scene's direction.
  std::vector<double> critical_speeds;
  std::vector<WhirlSense> critical_senses;  // one per critical speed
  double critical_bound = 0.0;              // rad/s; higher critical speeds are not listed
  double table_end = 0.0;                   // rad/s, end of the bearings' tables; 0 without tables
  std::vector<UnstableRange> unstable;      // rad/s, absolute values in the scene's direction
  double stability_bound = 0.0;             // rad/s, may be infinite (campbell.h)
  std::optional<double> stability_threshold() const {
    return unstable.empty() ? std::nullopt : std::optional(unstable.front().from);
  }
  std::optional<ModeShapes> shapes;      // geometry form only
  std::vector<WhirlShape> whirl_shapes;  // at the scene's speed; geometry form only
  std::vector<WhirlMode> torsion;
  bool motor_is_held = false;     // in torsion, because there is no drive
  std::vector<RubAnalyses> rubs;  // one per contact, at the speeds of the spectra
  // At the scene's speed; only if asked for, because it takes runs.
  std::optional<PeriodicRubs> periodic_rubs;
  std::vector<ContactPlace> contacts;
  // At the same speeds, for the kept modes; empty without a contact or a controlled magnetic
  // bearing.
  std::vector<RotorResponse> responses;
  // At the same speeds, for the kept modes; empty without a controlled magnetic bearing.
  std::vector<Levitation> levitations;
  std::optional<ContactMass> contact_mass;  // only in geometry form with a contact
  // Only if asked for, because it takes the response over the speed.
  std::optional<SpeedMargin> margin;
};

// speeds: rad/s, either sign; if empty, the scene's rotor.speed. Throws scene::SceneError for a
// rotor without modes (modal_rotor.h), std::runtime_error if an eigenvalue iteration fails.
RotorAnalysis analyse_rotor(const scene::Scene& scene, const std::vector<double>& speeds);
// The same for the free rotor, without its rubs.
RotorAnalysis analyse_free_rotor(const scene::Scene& scene, const std::vector<double>& speeds);

// "forward", "backward", "overdamped", or "rigid" for s = 0. Forward is the direction of the spin,
// and at rest the direction from x to y.
const char* sense_of(const WhirlMode& mode, double speed);

// "disc", "bearing", "contact", "drive", "magnetic_bearing", "force".
const char* to_string(StationKind kind);

}  // namespace rotorub
