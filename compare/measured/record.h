// A measured run as its file gives it, in SI: times of the record's own clock, and what was
// measured at them.
#pragma once

#include <cstdint>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/scene/units.h"

namespace rotorub {

// Where a column lies in the plane of the contact: a pair x, y turns with the frame of the sensors.
enum class Axis : std::uint8_t { kNone, kX, kY };

// What a column of a record may hold, and which column of a run it is held against.
struct Measurable {
  std::string_view name;    // in the file's header
  std::string_view other;   // the same under the name of the product's own series; "": none
  std::string_view series;  // column of a run; "": the contact's force averaged over a sample
  std::string_view rate;    // column of its rate, for values between rows; "": linear between them
  scene::Quantity quantity;
  Axis axis = Axis::kNone;
  int group = 0;  // of those that a record is aligned by: the first of which something moves
  bool clips =
      false;  // a sensor with a limit: samples that stay at it are no values (mark_clipped)
  std::string_view meaning;
  std::string_view unit() const { return quantity.unit; }
};

// All of them; x stands before its y.
std::span<const Measurable> measurables();
inline constexpr int kChannelGroups = 5;
inline constexpr std::string_view kContactForce =
    "force";  // the one that is averaged over a sample

enum class Sample : std::uint8_t { kGood, kMissing, kClipped };

struct MeasuredColumn {
  const Measurable* what = nullptr;
  std::string header;          // as in the file: "rotor_x [um]"
  std::vector<double> value;   // SI; 0 where it is missing
  std::vector<Sample> sample;  // one a value
  std::size_t count(Sample kind) const;
};

struct MeasuredRecord {
  std::string file;
  std::vector<double> t;  // s, of its own clock, strictly ascending; kLeastSamples or more
  std::vector<MeasuredColumn> columns;
  std::vector<std::string> left_out;  // columns of the product's own series that are not compared
  bool has_units = true;              // false: no column has one, and all is taken in SI
  double interval = 0.0;              // s, between samples: the median
  // rad: directions that x and y were read along, in the frame that they are in now (probes.h).
  double probe_x = 0.0, probe_y = 0.5 * std::numbers::pi;

  const MeasuredColumn* find(std::string_view name) const;  // null: none
  double duration() const { return t.back() - t.front(); }  // s
};

inline constexpr std::size_t kLeastSamples = 16;

// A record that cannot be laid beside the run, in a sentence for the user.
class MeasuredError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Samples of a sensor at its limit: the record says "at least so much", and no more.
//
// At the least and the greatest value of a column with a limit (Measurable::clips) samples are
// marked kClipped where the record comes to that value, stays for kLeastClipped samples or more,
// bit for bit, and leaves it or ends, and does so faster than a peak of its own would (what it
// begins with may be a machine at rest):
//
//   flat part   l l l ... l, of more samples than any other equal values in a row but 0
//   both ends   the sample outside is more than kSteps of the record's resolution away from l; or a
//               parabola through the three samples outside would pass l by as much at the second
//               sample inside
//
// The resolution is the least difference of two values: a converter's peak is flat too, but comes
// there in steps of one. 0 is no limit: it is where a force without contact, a ring at rest, or a
// gap in contact stays. A limit that is met once counts for every sample that has its value.
void mark_clipped(MeasuredRecord& record);

inline constexpr std::size_t kLeastClipped = 3;
inline constexpr double kSteps =
    10.0;  // more than 1/2 (6 + 8 + 3), what rounding does to the parabola

}  // namespace rotorub
