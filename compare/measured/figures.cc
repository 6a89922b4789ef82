#include "compare/measured/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace rotorub {
namespace {

using Complex = std::complex<double>;
using Values = std::vector<double>;

enum Kind : std::size_t {
  kMeanForce,
  kForceDeviation,
  kPeakForce,
  kLeastGap,
  kMeanGap,
  kContact,
  kRotorRms,
  kRotorLargest,
  kRotorFrequency,
  kRotorAmplitude,
  kRotorX,
  kRotorY,
  kRingRms,
  kRingFrequency,
  kRingX,
  kRingY,
  kControlRms,
  kCurrent1,
  kCurrent2,
  kMeanSpin,
  kKinds
};

// In the order of Kind.
const MeasuredFigure kKnown[] = {
    {"mean_force", "mean force", "N", 1.0,
     "Mean of the samples of force; of a run with its impacts, over the same time."},
    {"force_deviation", "force scatter", "N", 1.0, "Standard deviation of the same samples."},
    {"peak_force", "peak force of a sample", "N", 1.0, "Largest sample: an impact's force is averaged over it."},
    {"least_gap", "least gap", "µm", 1e6, "Smallest sample of the gap."},
    {"mean_gap", "mean gap", "µm", 1e6, "Mean of the samples of the gap."},
    {"contact_fraction", "samples in contact", "%", 100.0,
     "Share of the samples with a gap below 1 % of the clearance."},
    {"rotor_rms", "rotor's whirl, rms", "µm", 1e6, "Root mean square of the rotor's distance from its mean place."},
    {"rotor_largest", "rotor's whirl, largest", "µm", 1e6, "Largest distance of the rotor from its mean place."},
    {"rotor_frequency", "rotor's frequency", "Hz", 1.0,
     "Frequency at which the rotor's whirl is largest; negative: backward."},
    {"rotor_amplitude", "amplitude there", "µm", 1e6, "Amplitude of the whirl at that frequency, under a Hann window."},
    {"rotor_x_rms", "rotor along x, rms", "µm", 1e6,
     "Root mean square of it about its mean, where the other axis is not measured."},
    {"rotor_y_rms", "rotor along y, rms", "µm", 1e6,
     "Root mean square of it about its mean, where the other axis is not measured."},
    {"ring_rms", "ring's motion, rms", "µm", 1e6, "Root mean square of the ring's distance from its mean place."},
    {"ring_frequency", "ring's frequency", "Hz", 1.0,
     "Frequency at which the ring's whirl is largest; negative: backward."},
    {"ring_x_rms", "ring along x, rms", "µm", 1e6,
     "Root mean square of it about its mean, where the other axis is not measured."},
    {"ring_y_rms", "ring along y, rms", "µm", 1e6,
     "Root mean square of it about its mean, where the other axis is not measured."},
    {"control_rms", "control force, rms", "N", 1.0, "Root mean square of the actuator's force."},
    {"current_1_rms", "current 1, rms", "A", 1.0, "Root mean square of the first axis' current."},
    {"current_2_rms", "current 2, rms", "A", 1.0, "Root mean square of the second axis' current."},
    {"mean_spin", "mean spin speed", "rpm", 30.0 / std::numbers::pi, "Mean of the samples of the spin speed."},
};
static_assert(std::size(kKnown) == kKinds);

// One or two columns at the samples that both have.
struct Picked {
  std::vector<std::size_t> good, known;  // known: clipped ones too
  bool clipped() const { return known.size() > good.size(); }
};

Picked picked_samples(const HeldColumn& x, const HeldColumn* y) {
  Picked p;
  for (std::size_t i = 0; i < x.sample.size(); ++i) {
    const auto is = [&](Sample kind) { return x.sample[i] == kind || (y && y->sample[i] == kind); };
    if (is(Sample::kMissing)) continue;
    p.known.push_back(i);
    if (!is(Sample::kClipped)) p.good.push_back(i);
  }
  return p;
}

double mean_of(const Values& y, const std::vector<std::size_t>& at) {
  double sum = 0.0;
  for (const std::size_t i : at) sum += y[i];
  return sum / static_cast<double>(at.size());
}

double deviation_about(const Values& y, const std::vector<std::size_t>& at) {
  const double mean = mean_of(y, at);
  double square = 0.0;
  for (const std::size_t i : at) square += (y[i] - mean) * (y[i] - mean);
  return std::sqrt(square / static_cast<double>(at.size()));
}

double rms_of(const Values& y, const std::vector<std::size_t>& at) {
  double square = 0.0;
  for (const std::size_t i : at) square += y[i] * y[i];
  return std::sqrt(square / static_cast<double>(at.size()));
}

double extreme_of(const Values& y, const std::vector<std::size_t>& at, bool largest) {
  double found = y[at.front()];
  for (const std::size_t i : at) found = largest ? std::max(found, y[i]) : std::min(found, y[i]);
  return found;
}

class FigureList {
 public:
  FigureList(const std::vector<HeldColumn>& columns, const FigureFacts& facts) : columns_(columns), facts_(facts) {}

  const HeldColumn* find(std::string_view name) const {
    const auto found =
        std::find_if(columns_.begin(), columns_.end(), [&](const auto& c) { return c.what->name == name; });
    return found == columns_.end() ? nullptr : &*found;
  }

  // value(values of one column or two) of the record and of each run.
  template <class Value>
  void add(Kind kind, const HeldColumn& x, const HeldColumn* y, Value value, Bound bound = Bound::kNone) {
    MeasuredFigure figure = kKnown[kind];
    figure.bound = bound;
    figure.measured = value(x.measured, y ? y->measured : x.measured);
    for (std::size_t r = 0; r < x.runs.size(); ++r) figure.runs.push_back(value(x.runs[r], y ? y->runs[r] : x.runs[r]));
    all.push_back(std::move(figure));
  }

  void add_force() {
    const HeldColumn* force = find(kContactForce);
    if (!force) return;
    const Picked p = picked_samples(*force, nullptr);
    if (p.good.empty()) return;
    add(
        kMeanForce, *force, nullptr, [&](const Values& f, const Values&) { return mean_of(f, p.known); },
        p.clipped() ? Bound::kAtLeast : Bound::kNone);
    add(kForceDeviation, *force, nullptr, [&](const Values& f, const Values&) { return deviation_about(f, p.good); });
    add(
        kPeakForce, *force, nullptr, [&](const Values& f, const Values&) { return extreme_of(f, p.known, true); },
        p.clipped() ? Bound::kAtLeast : Bound::kNone);
  }

  void add_gap() {
    const HeldColumn* gap = find("gap");
    if (!gap || !facts_.clearance) return;
    const Picked p = picked_samples(*gap, nullptr);
    if (p.good.empty()) return;
    const bool low =
        p.clipped() && extreme_of(gap->measured, p.known, false) < extreme_of(gap->measured, p.good, false);
    add(
        kLeastGap, *gap, nullptr, [&](const Values& g, const Values&) { return extreme_of(g, p.known, false); },
        low ? Bound::kAtMost : Bound::kNone);
    add(kMeanGap, *gap, nullptr, [&](const Values& g, const Values&) { return mean_of(g, p.good); });
    const double touch = kTouchShare * *facts_.clearance;
    add(kContact, *gap, nullptr, [&](const Values& g, const Values&) {
      const auto count = std::count_if(p.known.begin(), p.known.end(), [&](std::size_t i) { return g[i] < touch; });
      return static_cast<double>(count) / static_cast<double>(p.known.size());
    });
  }

  void add_whirl(std::string_view name_x, std::string_view name_y, Kind rms, std::optional<Kind> largest,
                 Kind frequency, std::optional<Kind> amplitude, bool rate_tells) {
    const HeldColumn *x = find(name_x), *y = find(name_y);
    if (!x || !y) return;
    const Picked p = picked_samples(*x, y);
    if (p.good.size() < 2) return;
    add(rms, *x, y, [&](const Values& a, const Values& b) {
      return std::hypot(deviation_about(a, p.good), deviation_about(b, p.good));
    });
    const auto farthest = [&](const Values& a, const Values& b) {
      const double ma = mean_of(a, p.good), mb = mean_of(b, p.good);
      double far = 0.0;
      for (const std::size_t i : p.known) far = std::max(far, std::hypot(a[i] - ma, b[i] - mb));
      return far;
    };
    if (largest) add(*largest, *x, y, farthest, p.clipped() ? Bound::kAtLeast : Bound::kNone);
    if (!rate_tells) return;
    const auto whirl = [&](const Values& a, const Values& b) {
      return dominant_whirl(even(a, b, p.good), even_interval(p.good));
    };
    if (!whirl(x->measured, y->measured)) return;
    add(frequency, *x, y,
        [&](const Values& a, const Values& b) { return whirl(a, b).value_or(DominantWhirl()).frequency; });
    if (!amplitude) return;
    add(*amplitude, *x, y,
        [&](const Values& a, const Values& b) { return whirl(a, b).value_or(DominantWhirl()).amplitude; });
  }

  // Of a column whose other axis is not there.
  void add_alone(Kind kind, std::string_view name, std::string_view across) {
    const HeldColumn* x = find(name);
    if (!x || find(across)) return;
    const Picked p = picked_samples(*x, nullptr);
    if (p.good.empty()) return;
    add(kind, *x, nullptr, [&](const Values& a, const Values&) { return deviation_about(a, p.good); });
  }

  void add_rms(Kind kind, std::string_view name_x, std::string_view name_y = {}) {
    const HeldColumn *x = find(name_x), *y = name_y.empty() ? nullptr : find(name_y);
    if (!x || (!name_y.empty() && !y)) return;
    const Picked p = picked_samples(*x, y);
    if (p.good.empty()) return;
    add(kind, *x, y, [&](const Values& a, const Values& b) {
      return y ? std::hypot(rms_of(a, p.good), rms_of(b, p.good)) : rms_of(a, p.good);
    });
  }

  void add_spin() {
    const HeldColumn* spin = find("spin_speed");
    if (!spin) return;
    const Picked p = picked_samples(*spin, nullptr);
    if (p.good.empty()) return;
    add(kMeanSpin, *spin, nullptr, [&](const Values& v, const Values&) { return mean_of(v, p.good); });
  }

  std::vector<MeasuredFigure> all;

 private:
  // As many even times as there are good samples from the first to the last; linear over what is missing.
  std::size_t even_count(const std::vector<std::size_t>& good) const {
    const double span = facts_.t[good.back()] - facts_.t[good.front()];
    return std::max<std::size_t>(2, static_cast<std::size_t>(span / facts_.interval + 0.5) + 1);
  }
  double even_interval(const std::vector<std::size_t>& good) const {
    return (facts_.t[good.back()] - facts_.t[good.front()]) / static_cast<double>(even_count(good) - 1);
  }
  std::vector<Complex> even(const Values& a, const Values& b, const std::vector<std::size_t>& good) const {
    std::vector<Complex> z;
    const double from = facts_.t[good.front()], h = even_interval(good);
    std::size_t k = 0;
    for (std::size_t j = 0; j < even_count(good); ++j) {
      const double at = from + static_cast<double>(j) * h;
      while (k + 2 < good.size() && facts_.t[good[k + 1]] <= at) ++k;
      const std::size_t p = good[k], q = good[k + 1];
      const double share = std::clamp((at - facts_.t[p]) / (facts_.t[q] - facts_.t[p]), 0.0, 1.0);
      z.push_back(Complex(a[p], b[p]) + share * (Complex(a[q], b[q]) - Complex(a[p], b[p])));
    }
    return z;
  }

  const std::vector<HeldColumn>& columns_;
  const FigureFacts& facts_;
};

}  // namespace

const char* to_string(Bound bound) {
  return bound == Bound::kAtLeast ? "at least" : bound == Bound::kAtMost ? "at most" : "";
}

std::vector<MeasuredFigure> measured_figures() { return {std::begin(kKnown), std::end(kKnown)}; }

std::vector<MeasuredFigure> figures_of(const std::vector<HeldColumn>& columns, const FigureFacts& facts,
                                       double run_frequency, std::vector<std::string>& remarks) {
  FigureList list(columns, facts);
  const double rate = 1.0 / facts.interval;
  const bool rate_tells = std::abs(run_frequency) < kMostOfRate * rate;
  const bool whirls = list.find("rotor_x") && list.find("rotor_y");
  if (whirls && !rate_tells) {
    remarks.push_back(
        fmt::format("no frequency: the native rotor's {:.4g} Hz is beyond {:.0f} % of the sample rate, {:.4g} Hz",
                    run_frequency, 100.0 * kMostOfRate, rate));
  }
  list.add_force();
  list.add_gap();
  list.add_whirl("rotor_x", "rotor_y", kRotorRms, kRotorLargest, kRotorFrequency, kRotorAmplitude, rate_tells);
  list.add_whirl("ring_x", "ring_y", kRingRms, std::nullopt, kRingFrequency, std::nullopt, rate_tells);
  list.add_alone(kRotorX, "rotor_x", "rotor_y");
  list.add_alone(kRotorY, "rotor_y", "rotor_x");
  list.add_alone(kRingX, "ring_x", "ring_y");
  list.add_alone(kRingY, "ring_y", "ring_x");
  list.add_rms(kControlRms, "control_x", "control_y");
  list.add_rms(kCurrent1, "current_1");
  list.add_rms(kCurrent2, "current_2");
  list.add_spin();
  return std::move(list.all);
}

}  // namespace rotorub
