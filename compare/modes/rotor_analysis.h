// Everything that `rotorub modes` says of a rotor, computed once for text, JSON and page: whirl at
// given spin speeds, critical speeds, the threshold of stability, mode shapes, lasting rubs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/modes/response_text.h"
#include "compare/modes/rub_analysis.h"
#include "native_model/linear/campbell.h"
#include "native_model/linear/levitation.h"
#include "native_model/linear/mode_shapes.h"
#include "native_model/linear/whirl_system.h"
#include "native_model/rotor/mode_truncation.h"
#include "native_model/scene/scene.h"

namespace rotorub {

struct RotorAnalysis {
  WhirlSystem system;
  std::vector<WhirlSpectrum> spectra;  // at the speeds asked for
  // rad/s, ascending; sizes, of a spin of the scene's sense, up to critical_bound.
  std::vector<double> critical_speeds;
  std::vector<WhirlSense> critical_senses;  // of each
  double critical_bound = 0.0;              // rad/s, beyond which none is listed
  double table_end = 0.0;               // rad/s, where the bearings' tables end; 0: there are none
  std::vector<UnstableRange> unstable;  // rad/s, likewise
  double stability_bound = 0.0;         // rad/s, may be infinite (campbell.h)
  std::optional<double> stability_threshold() const {
    return unstable.empty() ? std::nullopt : std::optional(unstable.front().from);
  }
  std::optional<ModeShapes> shapes;      // geometry form only
  std::vector<WhirlShape> whirl_shapes;  // at the scene's own speed; geometry form only
  std::vector<WhirlMode> torsion;
  bool motor_is_held = false;     // in torsion: there is no drive
  std::vector<RubAnalyses> rubs;  // of each contact, at the same speeds as the spectra
  std::vector<ContactPlace> contacts;
  // At the same speeds, of the modes kept; none without a contact or magnetic bearings that
  // control.
  std::vector<RotorResponse> responses;
  // At the same speeds, of the modes kept; without magnetic bearings that control none.
  std::vector<Levitation> levitations;
  std::optional<ContactMass> contact_mass;  // geometry form with a contact only
};

// speeds: rad/s, of either sign; none: the scene's own rotor.speed. Throws scene::SceneError for a
// rotor without modes (modal_rotor.h), std::runtime_error where an eigenvalue iteration fails.
RotorAnalysis analyse_rotor(const scene::Scene& scene, const std::vector<double>& speeds);
// The same of the free rotor alone, without its rubs.
RotorAnalysis analyse_free_rotor(const scene::Scene& scene, const std::vector<double>& speeds);

// "forward", "backward", "overdamped", or "rigid" for s = 0: forward with the spin, and at rest
// from x to y.
const char* sense_of(const WhirlMode& mode, double speed);
// Whether a whirl grows at this speed (rad/s, its size).
bool is_unstable(const RotorAnalysis& analysis, double speed);
// One sentence without a full stop: "unstable from ... to ... and above ...", "no whirl grows up to
// ...", or at any speed.
std::string stability_text(const RotorAnalysis& analysis);

// As JSON (public contract):
// {"speeds": [{"speed", "modes": [{"frequency", "damping_ratio"}]}], "critical_speeds": [],
// "critical": [{"speed", "whirl": "forward", "backward" or "planar"}], "stability_threshold": null,
// "unstable_ranges": [[from, to]], "stability_bound"}: rad/s; forward whirl positive, backward
// negative; modes by rising absolute frequency. No threshold up to the bound: null; a bound of
// null: nothing can grow at any speed; `to` is null where a whirl grows up to the bound.
//
// And "torsion": [{"frequency", "damping_ratio"}], "mode_shapes": {"z": m, "stations": [{"kind",
// "name", "z"}], "same_planes", "x", "y": [{"frequency": rad/s at rest, undamped, "shape": along z,
// "at_stations"}]}; modes scaled as the coordinates of a run are (mode_shapes.h). Modal form:
// "mode_shapes" is null. With a [contact] each speed has "response", that of the first one
// (response_text.h), and "rub": rub_analysis.h; where its rubs cannot be analysed it is null, and
// "rub_refused" says why. Of several "contacts" has the same of each with its "name". "notes":
// sentences on where the response does not hold. "levitation": levitation_text.h.
nlohmann::json modes_json(const RotorAnalysis& analysis);

// The same for people, with Hz and rpm; ends with a line break. Of the shapes, the values at the
// stations, of the first modes.
std::string modes_table(const std::string& name, const RotorAnalysis& analysis);

// "disc", "bearing", "contact", "drive", "magnetic_bearing", "force".
const char* to_string(StationKind kind);

}  // namespace rotorub
