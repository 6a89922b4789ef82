#include "compare/report/plot_kinds.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compare/report/contact_plots.h"
#include "compare/report/pack/packed_run.h"
#include "compare/report/run_up_plots.h"
#include "compare/report/whirl_plots.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {
namespace {

bool has(const Trajectory& run, std::size_t contact, const char* column) {
  return run.has(column_of_contact(contact, column));
}
bool always(const ShownRuns&, const Trajectory&, std::size_t) { return true; }
bool touches(const ShownRuns& s, const Trajectory&, std::size_t contact) {
  return s.scene->auxiliary[contact].contact.has_value();
}
bool rubs(const ShownRuns& s, const Trajectory& t, std::size_t contact) {
  return touches(s, t, contact) && !s.scene->auxiliary[contact].contact->friction.is_frictionless();
}
template <const char* column>
bool has_column(const ShownRuns&, const Trajectory& t, std::size_t contact) {
  return has(t, contact, column);
}
constexpr char kCurrent[] = "current_1", kControl[] = "control_x", kTorsion[] = "torsion_1",
               kRingSpeed[] = "ring_speed", kMotor[] = "motor_torque";
bool has_measured_force(const ShownRuns& s, const Trajectory&, std::size_t) {
  return s.measured && !s.measured->forces.empty();
}
bool is_compared(const ShownRuns& s, const Trajectory&, std::size_t) { return s.runs.size() > 1; }
bool turns(const ShownRuns&, const Trajectory& t, std::size_t) { return mean_spin(t) != 0.0; }
bool has_orders(const ShownRuns&, const Trajectory& t, std::size_t) {
  return !orders_data(t).is_null();
}
bool has_cascade(const ShownRuns&, const Trajectory& t, std::size_t) {
  return !cascade_data(t).is_null();
}
bool has_measured_place(const ShownRuns& s, const Trajectory&, std::size_t) {
  return s.measured && s.measured->laid.find("rotor_x") && s.measured->laid.find("rotor_y");
}
bool strikes(const ShownRuns& s, const Trajectory& t, std::size_t contact) {
  return touches(s, t, contact) &&
         !contact_distribution(t, contact, s.scene->is_compliant()).at("impulse").is_null();
}
bool presses(const ShownRuns& s, const Trajectory& t, std::size_t contact) {
  if (!touches(s, t, contact) || !has(t, contact, "normal_force")) return false;
  return std::ranges::any_of(t.column(column_of_contact(contact, "normal_force")),
                             [](double force) { return force > 0.0; });
}
bool is_sampled(const ShownRuns&, const Trajectory& t, std::size_t) {
  return t.rows() >= kLeastSpectrumRows;
}

constexpr auto kRun = PlotOf::kRun, kContact = PlotOf::kContact;
constexpr PlotKind kKinds[] = {
    {"gap", "Gap", "µm", "0: contact; below 0: penetration", "wide", "time", kContact, touches},
    {"gap_rate", "Gap rate", "mm/s", "what control brings to 0 (paper, Fig. 8)", "", "time",
     kContact, touches},
    {"rotor_x", "Rotor", "µm",
     "along x; dotted, where there is control: without it (paper, Fig. 9)", "", "time", kContact,
     always},
    {"normal_force", "Normal force", "N",
     "of lasting contact; impulses of the rigid law's impacts are below", "", "time", kContact,
     touches},
    {"sample_force", "Force of a sample", "N",
     "what the force sensor sees: of every run averaged over the record's samples, impacts "
     "included",
     "wide", "time", kRun, has_measured_force},
    {"friction_force", "Friction force", "N", "on the rotor, along the ring", "", "time", kContact,
     touches},
    {"impacts", "Impacts", "mN s", "normal impulse of each impact or contact episode", "",
     "impacts", kContact, touches},
    {"friction_impacts", "Friction of impacts", "mN s", "size of the tangential impulse of each",
     "", "impacts", kContact, rubs},
    {"normal_law", "Normal contact law", "m/s",
     "gap rates before and after each impact; dashed: the restitution where friction has no part",
     "square", "law", kContact, touches},
    {"friction_law", "Friction law", "",
     "of each impact, tangential over friction times normal impulse (paper, Fig. 5); dashed: "
     "Coulomb's",
     "square", "law", kContact, rubs},
    {"spin", "Spin speed", "rpm", "what friction takes from the drive", "", "time", kRun, always},
    {"ring_speed", "Ring speed", "rpm", "what friction and drag make of the ring that turns", "",
     "time", kContact, has_column<kRingSpeed>},
    {"torsion", "Torsion", "mrad", "twist of the shaft at the contact", "", "time", kRun,
     has_column<kTorsion>},
    {"control", "Control force", "N", "magnitude of the actuators' force on the ring", "", "time",
     kContact, has_column<kControl>},
    {"current", "Coil current", "A", "magnitude of the control currents of the two axes", "",
     "time", kContact, has_column<kCurrent>},
    {"actuator", "Actuator", "N",
     "force of axis 1 over its current, on the characteristic F(s, i) (paper, Fig. 3)", "square",
     "path", kContact, has_column<kCurrent>},
    {"motor", "Motor", "N m",
     "torque over speed; dashed: the motor's characteristic (paper, Fig. 6)", "square", "path",
     kRun, has_column<kMotor>},
    {"force_spread", "Histogram of the force", "% of the time",
     "how long the normal force has which size: a rub that lasts is a peak, bouncing a slope", "",
     "spread", kContact, presses},
    {"impulse_spread", "Exceedance of impulses", "",
     "how many impacts reach an impulse; the longer the tail, the more a few hard ones decide", "",
     "spread", kContact, strikes},
    {"orbit", "Orbits", "µm",
     "rotor solid, ring dotted; the last turns, or the time zoomed to; diamonds: the mark on the "
     "rotor passes +x, one that stays is 1×; arrows and words: with the spin or against it",
     "square", "turns", kContact, always},
    {"relative", "Rotor in the ring", "µm", "relative to the ring's centre; dashed: the clearance",
     "square", "turns", kContact, touches},
    {"measured_minus", "Measured minus run", "µm",
     "along x, at the record's samples: 0 where the run is the record; a constant is a sensor's "
     "zero, a wave an amplitude or a phase that is off",
     "wide", "time", kRun, has_measured_place},
    {"residual", "Away from the first run", "µm",
     "distance of a run's rotor from the first run's; in chaos it grows to the orbit's size", "",
     "time", kRun, is_compared},
    {"spectrum", "Full spectrum", "µm",
     "of the second half: forward whirl above 0 Hz, backward below; dashed: the spin", "", "whirl",
     kRun, is_sampled},
    {"waterfall", "Waterfall", "µm", "the full spectrum over the run, of the first run shown", "",
     "whirl", kRun, is_sampled},
    {"cascade", "Cascade", "µm",
     "full spectra over the speed as it changes, forward whirl right, backward left; a ridge along "
     "1× or 2× is bound to the spin, an upright one is a natural frequency that rings; of the "
     "first "
     "run shown",
     "wide tall", "runup", kRun, has_cascade},
    {"orders", "1× and 2× over the speed", "µm",
     "amplitude and phase against the mark on the rotor, as a probe along x has them, over "
     "four turns; where 1× peaks and falls by half a turn a critical speed is passed; thin: 2×",
     "wide tall", "runup", kRun, has_orders},
    {"orders_polar", "Polar plot of 1×", "µm",
     "the same as the high spot goes on the rotor, the mark to the right: a loop is a critical "
     "speed",
     "square", "runup", kRun, has_orders},
    {"poincare", "Poincaré points", "µm",
     "the rotor once a turn, second half: a point is synchronous, a cloud chaos", "square", "whirl",
     kRun, turns},
};

}  // namespace

std::vector<ShownPlot> plot_kinds(const ShownRuns& shown) {
  std::vector<ShownPlot> plots;
  const std::size_t contacts = shown.scene->auxiliary.size();
  for (const PlotKind& kind : kKinds) {
    for (std::size_t k = 0; k < (kind.of == PlotOf::kContact ? contacts : 1); ++k) {
      if (std::any_of(shown.runs.begin(), shown.runs.end(), [&](const ShownRun& run) {
            return run.trajectory->rows() > 0 && kind.shown(shown, *run.trajectory, k);
          }))
        plots.push_back({&kind, k});
    }
  }
  return plots;
}

}  // namespace rotorub
