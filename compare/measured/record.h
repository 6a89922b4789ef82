// A measured run as read from its file, in SI: the times of the record's own clock and the values
// measured at them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/scene/units.h"

namespace rotorub {

// The axis of a column in the plane of the contact; a pair x, y turns with the sensors' frame.
enum class Axis : std::uint8_t { kNone, kX, kY };

// A quantity that a column of a record may hold, and the run's column that it is compared with.
struct Measurable {
  std::string_view name;    // in the header of the file
  std::string_view other;   // name in the program's own series; "": none
  std::string_view series;  // column of a run; "": the contact force averaged over a sample
  std::string_view rate;    // column of its rate, for interpolation between rows; "": linear
  scene::Quantity quantity;
  Axis axis = Axis::kNone;
  int group = 0;  // for the alignment, which uses the first group with a motion
  bool clips =
      false;  // a sensor with a limit: samples that stay at the limit are not values (mark_clipped)
  std::string_view meaning;
  std::string_view unit() const { return quantity.unit; }
};

std::span<const Measurable> measurables();  // all of them; each x comes before its y
// The same quantity along the other axis. what: has an axis.
const Measurable& other_axis(const Measurable& what);
inline constexpr int kChannelGroups = 5;
inline constexpr std::string_view kContactForce =
    "force";  // the only quantity that is averaged over a sample

enum class Sample : std::uint8_t { kGood, kMissing, kClipped };
// The state of a value that is computed from two samples.
Sample both(Sample a, Sample b);

struct MeasuredColumn {
  const Measurable* what = nullptr;
  std::string header;          // as in the file: "rotor_x [um]"
  std::vector<double> value;   // SI; 0 if missing
  std::vector<Sample> sample;  // one per value
  std::size_t count(Sample kind) const;
};

// The column with this name, or null.
template <typename Columns>
auto* find_column(Columns& columns, std::string_view name) {
  const auto found = std::ranges::find_if(columns, [&](auto& c) { return c.what->name == name; });
  return found == columns.end() ? nullptr : &*found;
}

struct MeasuredRecord {
  std::string file;
  std::vector<double> t;  // s, in the record's own time, strictly ascending; at least kLeastSamples
  std::vector<MeasuredColumn> columns;
  std::vector<std::string> left_out;  // columns of the program's own series that are not compared
  bool has_units = true;              // false: no column has a unit, and all values are in SI
  double interval = 0.0;              // s, median between samples
  // rad: the original directions of x and y in the present frame (resolve_probes).
  double probe_x = 0.0, probe_y = 0.5 * std::numbers::pi;

  const MeasuredColumn* find(std::string_view name) const { return find_column(columns, name); }
  double duration() const { return t.back() - t.front(); }  // s
};

inline constexpr std::size_t kLeastSamples = 16;

// A record that does not fit the run; the message is a sentence for the user.
class MeasuredError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Marks the samples of a sensor at its limit, which only bound the value.
//
// Samples at the least or greatest value of a column with a limit (Measurable::clips) are marked
// kClipped if the record reaches that value, stays there bit for bit for at least kLeastClipped
// samples, and leaves it or ends, provided that it does so faster than a peak would. (At the start
// of the record the machine may be at rest.)
//
//   flat part   l l l ... l, of more samples than any other run of equal nonzero values
//   both ends   the sample outside differs from l by more than kSteps times the record's
//               resolution, or a parabola through the three samples outside would pass l by as much
//               at the second sample inside
//
// The resolution is the smallest difference of two values. The peak of a converter is flat too, but
// approaches in single steps. 0 is not a limit, because a force without contact, a ring at rest and
// a gap in contact stay at 0. A limit that is found once applies to every sample with its value.
void mark_clipped(MeasuredRecord& record);

inline constexpr std::size_t kLeastClipped = 3;
inline constexpr double kSteps =
    10.0;  // more than 1/2 (6 + 8 + 3), what rounding does to the parabola

// Probes that are not aligned with x and y: two that measure one place along other directions, such
// as the probes of API 670 at 45 degrees to either side of the vertical.
//
// Takes `rotor_x` and `rotor_y` of a record, and `ring_x` and `ring_y`, as the place along
// directions (cos a, sin a) at these angles (rad, in the scene, from x to y), and replaces them by
// x and y of the scene:
//
//   [cos a  sin a] [x]   [m_1]
//   [cos b  sin b] [y] = [m_2]
//
// If one probe lacks a value or is at its limit, both new values are missing or clipped; clipped
// samples are marked first. Throws MeasuredError if a probe of a pair is missing, if there is no
// pair, or if the directions are within kLeastApart of one line.
void resolve_probes(MeasuredRecord& record, double first, double second);

inline constexpr double kLeastApart = 0.26;  // rad, 15 degrees: errors grow as 1 / sin

}  // namespace rotorub
