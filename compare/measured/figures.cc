#include "compare/measured/figures.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "compare/base/units.h"
#include "compare/metrics/orbit.h"
#include "compare/metrics/rows.h"

namespace rotorub {
namespace {

using Eigen::ArrayXcd;
using Values = std::vector<double>;

// One column, or x + i y of two, from the record or from a run.
struct Motion {
  std::vector<double> t;  // s, of the values in `good`
  ArrayXcd good, known;   // known: including clipped ones
  const FigureFacts& facts;
};
using Statistic = std::optional<double> (*)(const Motion&);

std::optional<double> mean(const Motion& m) { return m.good.real().mean(); }
std::optional<double> known_mean(const Motion& m) { return m.known.real().mean(); }
std::optional<double> least(const Motion& m) { return m.known.real().minCoeff(); }
std::optional<double> largest(const Motion& m) { return m.known.real().maxCoeff(); }
std::optional<double> rms(const Motion& m) { return std::sqrt(m.good.abs2().mean()); }
std::optional<double> deviation(const Motion& m) {
  return std::sqrt((m.good - m.good.mean()).abs2().mean());
}
std::optional<double> farthest(const Motion& m) {
  return (m.known - m.good.mean()).abs().maxCoeff();
}
std::optional<double> contact(const Motion& m) {
  const double touch = kTouchShare * *m.facts.clearance;
  return (m.known.real() < touch).cast<double>().mean();
}

// Resampled at even times, as many as the samples would be without gaps; gaps are interpolated
// linearly.
std::optional<DominantWhirl> whirl(const Motion& m) {
  if (m.t.size() < 2 || !m.facts.rate_tells) return std::nullopt;
  const double span = m.t.back() - m.t.front();
  const auto count = std::max<std::size_t>(2, std::lround(span / m.facts.interval) + 1);
  const Values at = even_times(m.t.front(), m.t.back(), count);
  return dominant_whirl(
      linear(m.t, std::span<const std::complex<double>>(m.good.data(), m.t.size()), at),
      span / static_cast<double>(count - 1));
}
template <double DominantWhirl::*Part>
std::optional<double> dominant(const Motion& m) {
  const auto found = whirl(m);
  return found ? std::optional((*found).*Part) : std::nullopt;
}

// With y it is a pair; x alone is used if y is not measured.
struct KnownFigure {
  FigureText text;
  struct From {
    std::string_view x, y;
    Statistic statistic;
    Bound clipped = Bound::kNone;  // effect of clipped samples
  } from;
};

constexpr Bound kAtLeast = Bound::kAtLeast, kAtMost = Bound::kAtMost;
constexpr const char* kAlone = "Rms about the mean, if the other axis is not measured.";
constexpr KnownFigure kKnown[] = {
    {{"mean_force", "mean force", "N", 1.0, "Mean of the samples of force; a run's impacts count."},
     {kContactForce, "", known_mean, kAtLeast}},
    {{"force_deviation", "force scatter", "N", 1.0, "Standard deviation of the samples of force."},
     {kContactForce, "", deviation}},
    {{"peak_force", "peak force of a sample", "N", 1.0,
      "Largest sample of force; a sample averages an impact."},
     {kContactForce, "", largest, kAtLeast}},
    {{"least_gap", "least gap", "µm", kMicro, "Smallest gap of a sample."},
     {"gap", "", least, kAtMost}},
    {{"mean_gap", "mean gap", "µm", kMicro, "Mean gap of the samples."}, {"gap", "", mean}},
    {{"contact_fraction", "samples in contact", "%", 100.0,
      "Share of the samples with a gap below 1 % of the clearance."},
     {"gap", "", contact}},
    {{"rotor_rms", "rotor's whirl, rms", "µm", kMicro,
      "Rms distance of the rotor from its mean position."},
     {"rotor_x", "rotor_y", deviation}},
    {{"rotor_largest", "rotor's whirl, largest", "µm", kMicro,
      "Largest distance of the rotor from its mean position."},
     {"rotor_x", "rotor_y", farthest, kAtLeast}},
    {{"rotor_frequency", "rotor's frequency", "Hz", 1.0,
      "Dominant frequency of the rotor's whirl; negative: backward."},
     {"rotor_x", "rotor_y", dominant<&DominantWhirl::frequency>}},
    {{"rotor_amplitude", "amplitude there", "µm", kMicro,
      "Amplitude of the whirl at that frequency, with a Hann window."},
     {"rotor_x", "rotor_y", dominant<&DominantWhirl::amplitude>}},
    {{"rotor_x_rms", "rotor along x, rms", "µm", kMicro, kAlone}, {"rotor_x", "", deviation}},
    {{"rotor_y_rms", "rotor along y, rms", "µm", kMicro, kAlone}, {"rotor_y", "", deviation}},
    {{"ring_rms", "ring's motion, rms", "µm", kMicro,
      "Rms distance of the ring from its mean position."},
     {"ring_x", "ring_y", deviation}},
    {{"ring_frequency", "ring's frequency", "Hz", 1.0,
      "Dominant frequency of the ring's whirl; negative: backward."},
     {"ring_x", "ring_y", dominant<&DominantWhirl::frequency>}},
    {{"ring_x_rms", "ring along x, rms", "µm", kMicro, kAlone}, {"ring_x", "", deviation}},
    {{"ring_y_rms", "ring along y, rms", "µm", kMicro, kAlone}, {"ring_y", "", deviation}},
    {{"control_rms", "rms control force", "N", 1.0, "Rms of the actuator's force."},
     {"control_x", "control_y", rms}},
    {{"current_1_rms", "current 1, rms", "A", 1.0, "Rms current of the axis."},
     {"current_1", "", rms}},
    {{"current_2_rms", "current 2, rms", "A", 1.0, "Rms current of the axis."},
     {"current_2", "", rms}},
    {{"mean_spin", "mean spin speed", "rpm", kRpm, "Mean spin speed of the samples."},
     {"spin_speed", "", mean}},
};

// From the record, or from a run.
Motion motion(const HeldColumn& x, const HeldColumn* y, std::optional<std::size_t> run,
              const FigureFacts& facts) {
  const auto value = [&](const HeldColumn& c, std::size_t i) {
    return run ? c.runs[*run][i] : c.value[i];
  };
  Motion m{{}, {}, {}, facts};
  std::vector<std::complex<double>> good, known;
  for (std::size_t i = 0; i < x.sample.size(); ++i) {
    const Sample sample = y ? both(x.sample[i], y->sample[i]) : x.sample[i];
    if (sample == Sample::kMissing) continue;
    known.emplace_back(value(x, i), y ? value(*y, i) : 0.0);
    if (sample == Sample::kClipped) continue;
    good.push_back(known.back());
    m.t.push_back(facts.t[i]);
  }
  const auto array = [](const auto& z) {
    return Eigen::Map<const ArrayXcd>(z.data(), static_cast<Eigen::Index>(z.size()));
  };
  m.good = array(good);
  m.known = array(known);
  return m;
}

}  // namespace

const char* to_string(Bound bound) {
  return bound == Bound::kAtLeast ? "at least" : bound == Bound::kAtMost ? "at most" : "";
}

std::vector<FigureText> measured_figures() {
  std::vector<FigureText> all;
  for (const KnownFigure& k : kKnown) all.push_back(k.text);
  return all;
}

std::vector<MeasuredFigure> figures_of(const std::vector<HeldColumn>& columns,
                                       const FigureFacts& facts) {
  std::vector<MeasuredFigure> all;
  for (const auto& [text, from] : kKnown) {
    const HeldColumn *x = find_column(columns, from.x), *y = find_column(columns, from.y);
    if (!x || (!y && !from.y.empty())) continue;
    const bool alone = from.y.empty() && x->what->axis != Axis::kNone;
    const Measurable* other = x->what + (x->what->axis == Axis::kX ? 1 : -1);
    if (alone && find_column(columns, other->name)) continue;
    if (from.x == "gap" && !facts.clearance) continue;
    Motion record = motion(*x, y, {}, facts);
    if (record.good.size() < (y ? 2 : 1)) continue;
    const auto measured = from.statistic(record);
    if (!measured) continue;
    MeasuredFigure figure{text, *measured};
    for (std::size_t r = 0; r < x->runs.size(); ++r) {
      figure.runs.push_back(from.statistic(motion(*x, y, r, facts)).value_or(0.0));
    }
    if (record.known.size() > record.good.size()) {
      // Clipping at the sensor's upper limit does not affect the least gap.
      record.known = record.good;
      if (from.clipped != kAtMost || *measured < *from.statistic(record)) {
        figure.bound = from.clipped;
      }
    }
    all.push_back(std::move(figure));
  }
  return all;
}

std::optional<DominantWhirl> dominant_whirl(const std::vector<std::complex<double>>& z, double h) {
  if (z.size() < 8) return std::nullopt;
  const FullSpectrum s = full_spectrum(z, h);
  const auto& size = s.amplitude;
  const auto peak =
      static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  const double apart = 1.0 / (static_cast<double>(z.size()) * h);
  const bool turns = std::abs(s.frequency[peak]) >= (kLeastTurns - 0.5) * apart;
  if (!(size[peak] > 0.0) || !turns) return std::nullopt;
  DominantWhirl found{s.frequency[peak], size[peak]};
  if (peak == 0 || peak + 1 == size.size() || !(size[peak - 1] > 0.0) || !(size[peak + 1] > 0.0)) {
    return found;
  }
  const double a = std::log(size[peak - 1]), b = std::log(size[peak]), c = std::log(size[peak + 1]);
  const double bend = a - 2.0 * b + c, by = bend < 0.0 ? 0.5 * (a - c) / bend : 0.0;
  found.frequency += by * apart;
  found.amplitude = std::exp(b - 0.25 * (a - c) * by);
  return found;
}

}  // namespace rotorub
