#include "compare/starter/starter_text.h"

#include <fmt/format.h>

#include <optional>

#include "native_model/scene/text.h"

namespace rotorub {
namespace {

// In TOML: a plain number, or a text with its unit.
std::string written(const StarterValue& value) {
  const std::string_view text = scene::trimmed(value.text);
  const bool plain = text.find_first_not_of("0123456789.eE+-") == std::string_view::npos;
  return plain ? scene::number_text(value.value, 15) : "\"" + std::string(text) + "\"";
}

// Without unnecessary digits in the exponent: 2e7 instead of 2e+07.
std::string number(double value) {
  std::string text = scene::number_text(value, 6);
  for (const char* filler : {"e+0", "e+", "e-0"}) {
    const std::size_t at = text.find(filler);
    if (at != std::string::npos)
      text.replace(at, std::string_view(filler).size(), filler[1] == '-' ? "e-" : "e");
  }
  return text;
}

std::string aligned(const std::string& assignment, const std::string& comment) {
  return fmt::format("{:<28} # {}\n", assignment, comment);
}

std::string value(const char* key, const std::string& text, const std::string& comment) {
  return aligned(fmt::format("{} = {}", key, text), comment);
}
std::string value(const char* key, double number_, const std::string& comment) {
  return value(key, number(number_), comment);
}

const char* what_it_is(StarterForm form) {
  switch (form) {
    case StarterForm::kModal:
      return "A Jeffcott rotor, by its one mode: it loses a part of a blade and rubs in its "
             "auxiliary bearing.";
    case StarterForm::kRig:
      return "A test rig: a shaft with a disc, driven by a motor; a magnetic exciter drives it "
             "into its auxiliary\n# bearing, whose ring an actuator can move.";
    case StarterForm::kController:
      return "A test rig: a shaft with a disc, driven by a motor; a magnetic exciter drives it "
             "towards its auxiliary\n# bearing, whose ring a sliding-mode controller brings to "
             "meet it.";
    case StarterForm::kOverhung:
      return "A shaft with a disc beyond the second of its two bearings, a pump's or a fan's "
             "wheel: it loses a part of\n# a blade and rubs in an auxiliary bearing beside the "
             "disc. The ring is centred on the sagging shaft, so\n# there is no [gravity].";
    case StarterForm::kVertical:
      return "A vertical shaft, held by two bearings at its upper end (z = 0), with an impeller at "
             "its lower end: it\n# loses a part of a blade and rubs in the guide bearing above the "
             "impeller. The weight acts along the shaft\n# and does not bend it, so there is no "
             "[gravity].";
    case StarterForm::kTwoCatchers:
      return "A shaft with a disc in two magnetic bearings. They fail, and it drops into two "
             "auxiliary bearings.";
    case StarterForm::kGeometry:
      break;
  }
  return "A shaft with a disc on two bearings: it loses a part of a blade and rubs in its "
         "auxiliary bearing.";
}

std::string head(const Starter& starter) {
  return fmt::format(
      "# {0}\n"
      "# Written by `rotorub init`; change any value. Plain numbers are in SI, a "
      "speed without a\n"
      "# unit in rad/s; a text may have a unit: \"0.5 mm\", \"3000 rpm\", \"20 kN/mm\".\n"
      "#\n"
      "#     rotorub run {1}        the motion: series, impacts, summary\n"
      "#     rotorub modes {1}      whirl frequencies, critical speeds, which rubs last\n"
      "#     rotorub compare {1}    a comparison with MuJoCo: report and films\n"
      "#     rotorub render {1}     a film\n"
      "#     rotorub check {1}      every engine against the rules at the end\n"
      "#\n"
      "# `rotorub schema` prints all tables and keys as a JSON schema, with which an editor "
      "completes and checks.\n\n",
      what_it_is(starter.form), scene::printable(starter.file));
}

std::string run_table(const StarterSizes& s) {
  return "[run]\n" + value("end", s.end, "s") +
         value("step", s.step,
               "s, fixed step of MuJoCo and `verlet`; `event`, the default, chooses its own") +
         "\n";
}

std::string sleeve(double station, const StarterSizes& s) {
  return "\n[[rotor.disc]]                # the sleeve at the contact; without a mass there, the "
         "size of rigid\n                              # impacts does not converge with the number "
         "of modes\n" +
         value("z", station, "m") + value("mass", s.sleeve_mass, "kg") +
         value("Jt", s.sleeve_Jt, "") + value("Jp", s.sleeve_Jp, "");
}

std::string journal(double station, const StarterSizes& s, bool first) {
  return "\n[[rotor.bearing]]\n" + value("z", station, "m") +
         value("stiffness", s.bearing_stiffness,
               first ? "N/m; or [x, y] if the planes differ" : "N/m") +
         (first ? "# damping = 100                # N s/m; oil films: journal, cross_stiffness, "
                  "table_speed; "
                  "misalignment: offset\n"
                : "");
}

std::string magnet(double station, const StarterSizes& s) {
  return "\n[[magnetic_bearing]]          # current of each axis: -proportional x - integral "
         "(integral "
         "of x) - derivative x'\n" +
         value("station", station, "m") +
         value("negative_stiffness", s.negative_stiffness, "N/m, due to the bias current") +
         "[magnetic_bearing.control]\n" + value("force_per_current", s.force_per_current, "N/A") +
         value("proportional", s.proportional, "A/m") +
         value("integral", s.integral, "A/(m s), which carries the weight") +
         value("derivative", s.derivative, "A s/m") +
         value("fails_at", s.on, "s: no force from then on");
}

std::string weight() { return "\n[gravity]\n" + value("acceleration", "[0.0, -9.81]", "m/s^2"); }

std::string shaft(const Starter& starter, const StarterSizes& s) {
  const bool rig = is_rig(starter.form);
  const bool levitates = starter.form == StarterForm::kTwoCatchers;
  return "[rotor]\n" +
         value("speed", written(starter.speed),
               rig ? "spin speed at t = 0" : "spin speed; constant without a [drive]") +
         value("length", written(starter.length), "of the shaft; stations count from its end") +
         value("E", "\"210 GPa\"", "steel") + value("nu", "0.3", "") +
         value("theory", "\"timoshenko\"", "beam with shear deformation; or \"euler-bernoulli\"") +
         value("rho", "7850.0", "kg/m^3") +
         value("modes", "8", "bending modes kept; sizes of impacts depend on them") +
         value("damping_ratio", "0.01", "of each mode") +
         "\n[[rotor.section]]             # pieces of the shaft, from 0 to its length\n" +
         "from = 0.0\n" + value("to", written(starter.length), "") +
         value("diameter", written(starter.diameter), "") +
         "\n[[rotor.disc]]                # the disc\n" + value("z", s.disc_station, "m, station") +
         value("mass", written(starter.disc_mass), "") +
         value("Jt", s.disc_Jt, "kg m^2, about a diameter") +
         value("Jp", s.disc_Jp, "kg m^2, about the shaft") +
         (s.is_graded
              ? value("balance_grade", fmt::format("\"{}\"", kBalanceGrade),
                      "of ISO 21940-11, for fans and pumps: mm/s, eccentricity times speed") +
                    "# unbalance = \"30 g mm\"      # in its place; or eccentricity, in m\n"
              : value("eccentricity", s.eccentricity, "m: an orbit of a tenth of the clearance") +
                    "# unbalance = \"30 g mm\"      # in place of eccentricity; or balance_grade = "
                    "\"G 6.3\"\n") +
         sleeve(s.contact_station, s) +
         (levitates ? sleeve(s.second_contact, s) + magnet(s.first_bearing, s) +
                          magnet(s.last_bearing, s) + weight()
                    : journal(s.first_bearing, s, true) + journal(s.last_bearing, s, false)) +
         "\n";
}

std::string one_mode(const Starter& starter, const StarterSizes& s) {
  return "[rotor]\n" +
         value("speed", written(starter.speed), "spin speed; constant without a [drive]") +
         fmt::format(
             "\n# A disc of {} in the middle of a steel shaft, {} long and {} in diameter: 48 E I "
             "/ L^3, the mass "
             "with\n"
             "# 17/35 of the shaft's. Lists: one value a mode.\n",
             starter.disc_mass.text, starter.length.text, starter.diameter.text) +
         "[rotor.modal]\n" + value("mass", "[" + number(s.modal_mass) + "]", "kg") +
         value("stiffness", "[" + number(s.modal_stiffness) + "]", "N/m") +
         value("damping", "[" + number(s.modal_damping) + "]", "N s/m: a damping ratio of 0.01") +
         "\n" + "[[force]]                     # the residual unbalance\n" +
         value("kind", "\"unbalance\"", "") +
         value("static_moment", s.eccentricity,
               s.is_graded
                   ? fmt::format("kg m, mass times eccentricity: {} of ISO 21940-11", kBalanceGrade)
                   : "kg m, mass times eccentricity: an orbit of a tenth of the clearance") +
         "\n";
}

std::string motor(const Starter& starter, const StarterSizes& s) {
  return "[rotor.torsion]\n" + value("modes", "1", "elastic torsion") + "\n[drive]\n" +
         value("kind", "\"linear\"", "T = gain (speed - Omega)") +
         value("gain", s.motor_gain, "N m s") + value("speed", written(starter.speed), "") +
         value("station", "0.0", "m, where the motor sits") +
         value("inertia", s.motor_inertia, "kg m^2, of its rotor") + "\n";
}

std::string load(const Starter& starter, const StarterSizes& s) {
  const bool modal = starter.form == StarterForm::kModal;
  if (is_rig(starter.form)) {
    return "[[force]]                     # the magnetic exciter: a free orbit of four "
           "clearances\n" +
           value("kind", "\"rotating\"", "") + value("amplitude", s.load, "N") +
           value("frequency", written(starter.speed), "negative: backward") +
           value("on", s.on, "s") + value("station", s.exciter_station, "m") + "\n";
  }
  const std::string moment = starter.unbalance && s.load == starter.unbalance->value
                                 ? written(*starter.unbalance)
                                 : number(s.load);
  return fmt::format(
             "[[force]]                     # the lost blade; alone, without the ring, it "
             "makes an orbit of {} clearances\n",
             scene::number_text(s.load_orbit, 2)) +
         value("kind", "\"unbalance\"", "") +
         value("static_moment", moment, "kg m, mass of the lost part times its radius") +
         value("on", s.on, "s, time of the loss") +
         (modal ? "" : value("station", s.disc_station, "m")) + "\n";
}

// parent: prefix of the ring's table, "" or "contact.".
std::string bearing(const Starter& starter, const StarterSizes& s, const char* head,
                    const char* parent, std::optional<double> station) {
  return head + (station ? value("station", *station, "m") : "") +
         value("radius", s.radius, "m, of the rotor there") +
         value("clearance", written(starter.clearance), "radial") +
         value("friction", written(starter.friction), "Coulomb") +
         value("restitution", "0.5", "of impacts: 0 plastic, 1 elastic") +
         fmt::format(
             "\n{:<30}# the ring of the auxiliary bearing; without this table it is fixed\n",
             fmt::format("[{}stator]", parent)) +
         value("mass", s.ring_mass, "kg") + value("damping", s.ring_damping, "N s/m") +
         value("stiffness", s.ring_stiffness, "N/m") + "\n";
}

std::string bearings(const Starter& starter, const StarterSizes& s) {
  if (starter.form == StarterForm::kModal) return bearing(starter, s, "[contact]\n", "", {});
  if (starter.form != StarterForm::kTwoCatchers)
    return bearing(starter, s, "[contact]\n", "", s.contact_station);
  return bearing(starter, s, "[[contact]]\nname = \"first\"\n", "contact.", s.contact_station) +
         bearing(starter, s, "[[contact]]\nname = \"second\"\n", "contact.", s.second_contact);
}

// The ring's actuator, and its controller, which is active or commented out.
std::string active_ring(const Starter& starter, const StarterSizes& s) {
  const bool works = starter.form == StarterForm::kController;
  const std::string mark = works ? "" : "#";
  const auto key = [&](const char* name, const auto& text, const char* comment) {
    return value((mark + name).c_str(), text, comment);
  };
  return "[actuator]\n" +
         value("force_limit", s.force_limit, "N, on each of the two axes at 45 degrees") +
         (works ? "\n"
                : "\n# A sliding-mode controller brings the ring to the rotor before it "
                  "strikes. To switch it on, uncomment:\n") +
         mark + "[controller]\n" +
         key("kind", "\"sliding\"", works ? "brings the ring to the rotor before it strikes" : "") +
         key("on", s.on, "s") + key("gap_time", "\"8 ms\"", "in which the gap is closed") +
         key("preload", "\"10 N\"", "that the lasting contact then carries") + "\n";
}

std::string rules(const Starter& starter, const StarterSizes& s) {
  const bool falls = starter.form == StarterForm::kTwoCatchers;
  const std::string touches =
      "[[check]]                     # rules of `rotorub check`, on every native engine\n" +
      value("metric", "\"impacts\"", "") + value("min", "1", "") +
      value("why",
            falls ? "\"A rotor that nothing holds falls into its auxiliary bearings.\""
                  : "\"The load is large enough for the rotor to touch.\"",
            "") +
      "\n";
  // An orbit within the clearance may or may not touch during the transient.
  return (falls || s.load_orbit > 1.0 ? touches : "") + "[[check]]\n" +
         value("metric", "\"max_penetration\"", "") +
         value("max", number(starter.clearance.value), "m") +
         value("why", "\"A rigid contact has no penetration; a finite time step leaves a little.\"",
               "");
}

// Removes empty comments.
std::string without_empty_comments(const std::string& text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    std::string line = text.substr(at, end - at);
    if (line.size() > 1 && line.ends_with(" # ")) line.resize(line.size() - 3);
    line.resize(line.find_last_not_of(' ') + 1);
    result += line + "\n";
    at = end + 1;
  }
  return result;
}

}  // namespace

std::string starter_text(const Starter& starter, const StarterSizes& sizes) {
  const bool rig = is_rig(starter.form);
  std::string text = head(starter) + run_table(sizes);
  text += starter.form == StarterForm::kModal ? one_mode(starter, sizes) : shaft(starter, sizes);
  if (rig) text += motor(starter, sizes);
  if (starter.form != StarterForm::kTwoCatchers) text += load(starter, sizes);
  text += bearings(starter, sizes);
  if (rig && sizes.force_limit > 0.0) text += active_ring(starter, sizes);
  text += "[initial]\n" +
          value("steady", "true", "start on the orbit of the loads that act at t = 0") + "\n";
  text += rules(starter, sizes);
  return without_empty_comments(text);
}

}  // namespace rotorub
