// A quantity of a run over time, reduced to few knots so that a page can hold whole runs. The knots
// are dense where the quantity bends or jumps, and a reader recovers the quantity within a
// tolerance at every sample.
//
// Times, values and rates are whole multiples of a tick and of quanta, stored as differences from
// the previous knot. This takes a third of the space of float32 and is equally accurate over the
// whole run, whereas float32 resolves times only to 2 us after 16 s. A reader must also count in
// ticks: it rounds a time to the nearest tick first, so that a sample's time gives the sample.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace rotorub {

// Between two knots: a straight line, the cubic Hermite polynomial of values and rates, or the
// value of the earlier knot.
enum class TrackKind { kLinear, kHermite, kHold };
const char* to_string(TrackKind kind);  // "linear", "hermite", "hold"

// n samples of c components.
struct Samples {
  std::vector<double> t;  // s, n, ascending; two equal times are a jump of value or rate
  std::vector<std::vector<double>> value;  // c x n
  std::vector<std::vector<double>> rate;   // c x n, per second; empty except for kHermite
  std::vector<double> tolerance;           // n, > 0, of the Euclidean error over the components
};

struct Track {
  TrackKind kind = TrackKind::kLinear;
  std::size_t knots = 0, components = 0;
  // Between two knots the value is at least the smallest of both and 0. For a gap of the rigid law,
  // which a cubic between coarse rows would make negative.
  bool floored = false;
  double start = 0.0;         // s, of the first knot
  double tick = 1.0;          // s, > 0
  double quantum = 1.0;       // of the values, > 0
  double rate_quantum = 1.0;  // of the rates, > 0
  // Columns one after another: times, the values of each component, for kHermite the rates of each.
  // A column holds the differences of its whole numbers, the first from 0, in zigzag form (2 n, or
  // -2 n - 1 below 0) and base 128: seven bits per byte, the lowest first, with the highest bit set
  // in all bytes but the last.
  std::string bytes;
};

// A greedy search for few knots, each at a sample. kHold keeps every sample. Asserts columns of
// equal length; without samples there are no knots.
Track pack(TrackKind kind, const Samples& samples, bool floored = false);

// For the page: kind, floored, knots, components, start, tick, quantum, rate_quantum, data (the
// bytes in base 64).
nlohmann::json track_json(const Track& track);

// Appends a column of whole numbers (see Track::bytes).
void put_column(const std::vector<std::int64_t>& numbers, std::string& bytes);

}  // namespace rotorub
