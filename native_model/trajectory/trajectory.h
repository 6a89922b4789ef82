// The result type that every engine returns and everything downstream reads.
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

const char* to_string(ContactMode mode);  // "free", "slide", "stick"

// One column of the series. The column `mode` holds the number of the ContactMode.
struct Column {
  std::string name;
  std::string unit;
  std::vector<double> values;
};

// kReverse: the slip changes sign without sticking.
enum class EventKind : std::uint8_t { kImpact, kSlide, kStick, kLiftOff, kReverse };
const char* to_string(EventKind kind);
struct Event {
  double t = 0.0;
  EventKind kind = EventKind::kImpact;
  int contact = 0;  // index among several, from 0
};

const char* to_string(Status status);  // "ok", "diverged", ..., as in summary.json

// Statistics of one contact.
struct ContactStatistics {
  double first_touch = -1.0;      // s; -1: never touched
  double contact_time = 0.0;      // s with normal force > 0; an impact of a fixed step: one step
  double impulse_total = 0.0;     // N s, normal
  double friction_impulse = 0.0;  // N s, signed
  double friction_work = 0.0;     // J, <= 0
  // m, over the rows and the ends of steps; infinity: no contact.
  double least_gap = std::numeric_limits<double>::infinity();
  double max_penetration = 0.0;  // m
  // N, largest impulse of a step / step, or largest force of a compliant contact. `event`: of one
  // contact only if it is compliant.
  double peak_force = 0.0;
  FullPasses passes;  // of the rotor around the ring, from the first touch on

  // normal, friction: impulses, N s. work: of friction, J.
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

// Statistics over every step, independent of the spacing of the series. The inherited figures cover
// all contacts: contact_time is the time during which any contact has a normal force, peak_force
// the peak of the sum of their forces, and passes those of the contact with the most.
struct Statistics : ContactStatistics {
  // s, part of contact_time that belongs to impacts: their steps, or episodes of soft contact
  // shorter than the window.
  double impact_time = 0.0;
  double penetration_square = 0.0;  // m^2 s, integral of penetration^2, summed over the contacts
  double force_square = 0.0;        // N^2 s, integral of (impulse of the step / step)^2 in contact
  double window_impulse = 0.0;      // N s, largest normal impulse within the window (recorder.h)
  double gap_rate_square = 0.0;     // m^2/s, of gap_rate^2 from the first touch of any contact on
  double energy_start = 0.0;        // J
  double energy_end = 0.0;          // J
  double external_work = 0.0;       // J, of all forces that are not springs or contact
  double contact_work = 0.0;        // J
  // J, largest energy reached, or N delta_0 of contacts closed at the last row.
  double energy_scale = 0.0;
  // One for each auxiliary bearing.
  std::vector<ContactStatistics> contacts = std::vector<ContactStatistics>(1);
  double energy_residual() const;  // |E_end - E_start - works| / scale, 0 for a scale of 0
};

class MissingColumn : public std::runtime_error {  // what() names the column
  using std::runtime_error::runtime_error;
};

// How a run ended.
struct RunEnd {
  double end = 0.0;        // s, time reached
  std::int64_t steps = 0;  // taken; of `event`: accepted
  Status status = Status::kOk;
  std::string message{};
};

// The result of a run; all columns of the series have one length.
struct Trajectory {
  // contact_model is "rigid", "compliant", "coulomb", "cone" or "cone-coulomb".
  std::string engine, integrator, contact_model;
  double step = 0.0;         // s; `event`: 0
  std::size_t contacts = 1;  // number of auxiliary bearings in the model
  std::int64_t steps = 0;
  double wall_s = 0.0;  // integration only
  double end = 0.0;     // s, time reached
  std::vector<Column> series;
  std::vector<Impact> impacts;
  std::vector<Event> events;
  std::vector<KeyphasorPass> keyphasor;
  Statistics statistics;
  Status status = Status::kOk;
  std::string message;

  bool is_rigid() const { return contact_model == "rigid"; }  // its impacts take no time
  std::size_t rows() const { return series.empty() ? 0 : series.front().values.size(); }
  // Throws MissingColumn, since a series may come from a file.
  const std::vector<double>& column(const std::string& name) const;
  bool has(const std::string& name) const;
  double contact_fraction() const;  // from the first touch to the end; 0 if never touched
  double mean_force() const;        // N, impulse_total / (end - first touch)
};

}  // namespace rotorub
