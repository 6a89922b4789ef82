// One quantity of a run over time as few knots, so that a page can hold whole runs: adaptive, dense
// where the quantity bends or jumps, and from which a reader gets it back within a tolerance at
// every sample.
//
// Times, values and rates are whole multiples of a tick and of quanta, stored as differences to the
// knot before: a third of the space of float32, and as fine at the end of a long run as at its
// beginning, where a float32 tells times no better than to 2 us after 16 s. A reader counts in
// ticks as well: it takes a time to the nearest one first, so that at a sample it is at the sample.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace rotorub {

// Between two knots: the straight line, the cubic Hermite of values and rates, or the value of the
// earlier.
enum class TrackKind { kLinear, kHermite, kHold };
const char* to_string(TrackKind kind);  // "linear", "hermite", "hold"

// n samples of c components.
struct Samples {
  std::vector<double> t;  // s, n, ascending; two of one time: a jump of value or rate
  std::vector<std::vector<double>> value;  // c x n
  std::vector<std::vector<double>> rate;   // c x n, for kHermite: per second; else empty
  std::vector<double> tolerance;           // n, > 0: of the Euclidean error over the components
};

struct Track {
  TrackKind kind = TrackKind::kLinear;
  std::size_t knots = 0, components = 0;
  // Between two knots never below both of them and 0: of a gap of the rigid law, which a cubic
  // between coarse rows would let go negative.
  bool floored = false;
  double start = 0.0;         // s, of the first knot
  double tick = 1.0;          // s, > 0
  double quantum = 1.0;       // of the values, > 0
  double rate_quantum = 1.0;  // of the rates, > 0
  // Columns, one after another: times, the values of each component, for kHermite the rates of
  // each. A column is the differences of its whole numbers, the first to 0, as zigzag (2 n, or
  // -2 n - 1 below 0) in base 128: seven bits a byte, the lowest first, the highest bit set in all
  // but the last.
  std::string bytes;
};

// The fewest knots that a greedy search finds, each at a sample. kHold keeps every sample. Asserts
// columns of one length; no samples give no knots.
Track pack(TrackKind kind, const Samples& samples, bool floored = false);

// As the page reads it: kind, floored, knots, components, start, tick, quantum, rate_quantum, data
// (bytes in base 64).
nlohmann::json track_json(const Track& track);

// Appends a column of whole numbers (see Track::bytes).
void put_column(const std::vector<std::int64_t>& numbers, std::string& bytes);

}  // namespace rotorub
