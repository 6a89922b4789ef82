// The one result type: what every engine gives and everything downstream reads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "native_model/contact/impact_record.h"
#include "native_model/contact/planar_contact.h"
#include "native_model/model/model.h"
#include "native_model/numerics/status.h"
#include "native_model/trajectory/full_passes.h"
#include "native_model/trajectory/keyphasor.h"

namespace rotorub {

const char* to_string(Mode mode);  // "free", "slide", "stick"

// One column of the series. `mode` holds the number of the Mode.
struct Column {
  std::string name;
  std::string unit;
  std::vector<double> values;
};

// kReverse: the slip changes its sign without sticking.
enum class EventKind : std::uint8_t { kImpact, kSlide, kStick, kLiftOff, kReverse };
const char* to_string(EventKind kind);
struct Event {
  double t = 0.0;
  EventKind kind = EventKind::kImpact;
  int contact = 0;  // which of several, from 0
};

const char* to_string(Status status);  // "ok", "diverged", ...: as in summary.json

// Of one of several contacts.
struct ContactStatistics {
  double first_touch = -1.0;      // s; -1: never touched
  double contact_time = 0.0;      // s with normal force > 0; an impact of a fixed step: one step
  double impulse_total = 0.0;     // N s, normal
  double friction_impulse = 0.0;  // N s, signed
  double friction_work = 0.0;     // J, <= 0
  // m, of rows and ends of steps; infinity: no contact
  double least_gap = std::numeric_limits<double>::infinity();
  double max_penetration = 0.0;  // m
  // N, largest impulse of a step / step, or force of one that gives
  double peak_force = 0.0;
  FullPasses passes;  // of the rotor around the ring from the first touch on

  // Impulses (N s) and the work of friction (J).
  void add(double normal, double friction, double work) {
    impulse_total += normal;
    friction_impulse += friction;
    friction_work += work;
  }
  void touch(double t) {
    if (first_touch < 0.0) first_touch = t;
  }
  void meet_gap(double gap) {
    least_gap = std::min(least_gap, gap);
    max_penetration = std::max(max_penetration, -gap);
  }
};

// Figures gathered over every step, whatever the spacing of the series; its own contact's are those
// of all, the time that in which some contact has a normal force, the peak that of the sum of their
// forces, and the passes those of the one with the most.
struct Statistics : ContactStatistics {
  // s of contact_time that are impacts: their steps, or soft contacts shorter than the window
  double impact_time = 0.0;
  double penetration_square = 0.0;  // m^2 s, integral of penetration^2
  double force_square = 0.0;        // N^2 s, integral of (impulse of the step / step)^2 in contact
  double window_impulse = 0.0;      // N s, largest normal impulse within the window (recorder.h)
  double gap_rate_square = 0.0;     // m^2/s, integral of gap_rate^2 from first touch
  double energy_start = 0.0;        // J
  double energy_end = 0.0;          // J
  double external_work = 0.0;       // J, of all forces that are not springs or contact
  double contact_work = 0.0;        // J
  double energy_scale = 0.0;        // J, largest energy met; of a contact at the end: N delta_0
  std::vector<ContactStatistics> contacts;  // of each where there are several, else empty
  double energy_residual() const;           // |E_end - E_start - works| / scale, 0 for a scale of 0
};

class MissingColumn : public std::runtime_error {  // what() names it
  using std::runtime_error::runtime_error;
};

struct Trajectory {                               // what a run gives; series: columns of one length
  std::string engine, integrator, contact_model;  // contact_model: "rigid", "coulomb", "cone"
  double step = 0.0;                              // s; `event`: 0
  std::size_t contacts = 1;                       // auxiliary bearings of the model
  std::int64_t steps = 0;
  double wall_s = 0.0;  // integration alone
  double end = 0.0;     // s, reached
  std::vector<Column> series;
  std::vector<Impact> impacts;
  std::vector<Event> events;
  std::vector<KeyphasorPass> keyphasor;
  Statistics statistics;
  Status status = Status::kOk;
  std::string message;

  std::size_t rows() const { return series.empty() ? 0 : series.front().values.size(); }
  // Throws MissingColumn: a series may come from a file.
  const std::vector<double>& column(const std::string& name) const;
  bool has(const std::string& name) const;
  double contact_fraction() const;  // from first touch to the end, 0 when never touched
  double mean_force() const;        // N, impulse_total / (end - first touch)
};

}  // namespace rotorub
