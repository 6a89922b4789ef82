#include "compare/measured/measured_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "compare/measured/clipping.h"
#include "compare/measured/figures.h"
#include "compare/metrics/spectrum.h"

namespace rotorub {
namespace {

// A record being laid beside its runs.
class LayingIn {
 public:
  LayingIn(MeasuredRecord record, const scene::Scene& scene) : record_(std::move(record)), scene_(scene) {
    out_.file = record_.file;
    out_.interval = record_.interval;
    out_.samples = record_.t.size();
  }

  MeasuredRun beside(const std::vector<RunToHold>& runs, const AlignmentOptions& options) {
    mark_clipped(record_);
    std::vector<SampledRun> sampled;
    for (const RunToHold& run : runs) {
      if (run.trajectory->rows() < 2) continue;
      sampled.emplace_back(*run.trajectory);
      out_.labels.push_back(run.label);
    }
    if (sampled.empty() || runs.front().trajectory->rows() < 2) {
      throw MeasuredError("the native run has no two rows to lay the record beside");
    }
    keep_comparable(sampled);
    refuse_other_units(*runs.front().trajectory);
    out_.alignment = align(record_, sampled.front(), options);
    keep_samples(sampled.front());
    for (const MeasuredColumn& c : record_.columns) hold(c, sampled);
    add_figures(*runs.front().trajectory);
    lay_into_the_scene(sampled);
    return std::move(out_);
  }

 private:
  // Drops columns that no run has, and says so.
  void keep_comparable(const std::vector<SampledRun>& runs) {
    std::vector<MeasuredColumn> kept;
    for (MeasuredColumn& c : record_.columns) {
      const bool contact = c.what->name != "gap" && c.what->name != kContactForce && c.what->name != "normal_force" &&
                                   c.what->name != "friction_force"
                               ? true
                               : scene_.contact.has_value();
      const bool have = contact && std::all_of(runs.begin(), runs.end(), [&](const auto& r) { return r.has(*c.what); });
      if (have) {
        kept.push_back(std::move(c));
      } else {
        out_.remarks.push_back(fmt::format("{} is left out: the scene's runs have no such quantity", c.what->name));
      }
    }
    record_.columns = std::move(kept);
    if (record_.columns.empty()) throw MeasuredError("no column of the record is a quantity of the scene's runs");
    if (!record_.left_out.empty()) {
      std::string names;
      for (const std::string& name : record_.left_out) names += (names.empty() ? "" : ", ") + name;
      out_.remarks.push_back("not compared: " + names);
    }
    if (!record_.has_units) out_.remarks.push_back("the header has no unit: all is taken in SI");
  }

  // A unit that is wrong by a prefix: an orbit a thousand times that of the run, or a thousandth. A model that is right
  // to a factor of 30 is still one to be compared.
  void refuse_other_units(const Trajectory& native) const {
    constexpr double kFar = 100.0;
    for (const MeasuredColumn& c : record_.columns) {
      if (!c.what->name.starts_with("rotor_") || !native.has(std::string(c.what->series))) continue;
      double measured = 0.0, run = 0.0;
      for (std::size_t i = 0; i < c.value.size(); ++i) {
        if (c.sample[i] != Sample::kMissing) measured = std::max(measured, std::abs(c.value[i]));
      }
      for (const double x : native.column(std::string(c.what->series))) run = std::max(run, std::abs(x));
      if (measured == 0.0 || run == 0.0) continue;
      if (measured < kFar * run && run < kFar * measured) continue;
      throw MeasuredError(fmt::format(
          "{}: reaches {:.3g} m, and the native run {:.3g} m, {:.2g} times as far: is its unit right? Accepted is the unit "
          "in the header that the numbers are in, as rotor_x [um]",
          c.header, measured, run, run / measured));
    }
  }

  // Those on the native run.
  void keep_samples(const SampledRun& native) {
    const double shift = out_.alignment.shift, slack = 1e-6 * record_.interval;
    for (std::size_t i = 0; i < record_.t.size(); ++i) {
      const double t = record_.t[i] + shift;
      if (t >= native.start() - slack && t <= native.end() + slack) on_.push_back(i);
    }
    const SampleTimes all = shifted(sample_times(record_.t, record_.interval), shift);
    for (const std::size_t i : on_) {
      times_.t.push_back(std::clamp(all.t[i], native.start(), native.end()));
      times_.from.push_back(all.from[i]);
      times_.to.push_back(all.to[i]);
    }
    // A sample that reaches beyond the run's ends is averaged over what no run has.
    for (std::size_t k = 0; k < on_.size(); ++k) {
      whole_.push_back(times_.from[k] >= native.start() - slack && times_.to[k] <= native.end() + slack);
    }
    if (on_.size() < record_.t.size()) {
      out_.remarks.push_back(fmt::format("{} of {} samples lie on the run", on_.size(), record_.t.size()));
    }
  }

  void hold(const MeasuredColumn& c, const std::vector<SampledRun>& runs) {
    HeldColumn held{c.what, {}, {}, {}};
    for (std::size_t k = 0; k < on_.size(); ++k) {
      held.measured.push_back(c.value[on_[k]]);
      held.sample.push_back(c.what->series.empty() && !whole_[k] ? Sample::kMissing : c.sample[on_[k]]);
    }
    for (const SampledRun& run : runs) held.runs.push_back(values_in_frame(run, *c.what, times_, out_.alignment.angle));
    ColumnFit fit{c.what};
    for (const Sample s : held.sample) {
      fit.good += s == Sample::kGood ? 1 : 0;
      fit.missing += s == Sample::kMissing ? 1 : 0;
      fit.clipped += s == Sample::kClipped ? 1 : 0;
    }
    if (fit.clipped > 0) {
      out_.remarks.push_back(
          fmt::format("{}: {} samples at the sensor's limit are left out of residuals, and make extremes bounds",
                      c.what->name, fit.clipped));
    }
    if (fit.good == 0) {
      out_.remarks.push_back(fmt::format("{} is left out: no good sample on the run", c.what->name));
      return;
    }
    for (const auto& values : held.runs) fit.runs.push_back(residual_of(held, values, fit.good));
    out_.columns.push_back(std::move(fit));
    held_.push_back(std::move(held));
  }

  static ColumnResidual residual_of(const HeldColumn& c, const std::vector<double>& run, std::size_t good) {
    const auto n = static_cast<double>(good);
    double square = 0.0, sum = 0.0, mean = 0.0, spread = 0.0;
    for (std::size_t i = 0; i < run.size(); ++i) {
      if (c.sample[i] != Sample::kGood) continue;
      const double left = c.measured[i] - run[i];
      square += left * left;
      sum += left;
      mean += run[i] / n;
    }
    for (std::size_t i = 0; i < run.size(); ++i) {
      if (c.sample[i] == Sample::kGood) spread += (run[i] - mean) * (run[i] - mean);
    }
    ColumnResidual r{std::sqrt(square / n), sum / n, {}};
    const double deviation = std::sqrt(spread / n);
    if (deviation > 0.0) r.share = r.rms / deviation;
    return r;
  }

  void add_figures(const Trajectory& native) {
    FigureFacts facts{times_.t, record_.interval, {}};
    if (scene_.contact) facts.clearance = scene_.contact->clearance;
    // From the run's own rows, as fine as they are.
    constexpr std::size_t kMost = 1 << 14;
    const double from = times_.t.front(), to = times_.t.back();
    const std::size_t count = std::clamp<std::size_t>(native.rows(), 8, kMost);
    double frequency = 0.0;
    if (to > from && native.has("rotor_vx")) {
      const auto whirl =
          dominant_whirl(even_orbit(native, from, to, count), (to - from) / static_cast<double>(count - 1));
      if (whirl) frequency = whirl->frequency;
    }
    out_.figures = figures_of(held_, facts, frequency, out_.remarks);
  }

  void lay_into_the_scene(const std::vector<SampledRun>& runs) {
    MeasuredRecord& laid = out_.laid;
    laid.file = record_.file;
    laid.interval = record_.interval;
    laid.t = times_.t;
    const std::complex<double> turn = std::polar(1.0, out_.alignment.angle);
    for (std::size_t k = 0; k < held_.size(); ++k) {
      const HeldColumn& x = held_[k];
      MeasuredColumn own{x.what, std::string(x.what->name), x.measured, x.sample};
      if (x.what->axis == Axis::kNone || out_.alignment.angle == 0.0) {
        laid.columns.push_back(std::move(own));
        continue;
      }
      if (x.what->axis != Axis::kX) continue;
      const Measurable* across = x.what + 1;
      const auto y = std::find_if(held_.begin(), held_.end(), [&](const auto& c) { return c.what == across; });
      if (y == held_.end()) continue;
      MeasuredColumn other{across, std::string(across->name), y->measured, y->sample};
      for (std::size_t i = 0; i < own.value.size(); ++i) {
        const std::complex<double> z = turn * std::complex<double>(own.value[i], other.value[i]);
        own.value[i] = z.real();
        other.value[i] = z.imag();
        const auto is = [&](Sample s) { return own.sample[i] == s || other.sample[i] == s; };
        own.sample[i] = other.sample[i] = is(Sample::kMissing)   ? Sample::kMissing
                                          : is(Sample::kClipped) ? Sample::kClipped
                                                                 : Sample::kGood;
      }
      laid.columns.push_back(std::move(own));
      laid.columns.push_back(std::move(other));
    }
    const MeasuredColumn* force = laid.find(kContactForce);
    if (!force) return;
    for (const SampledRun& run : runs) out_.forces.push_back(run.values(*force->what, times_));
  }

  MeasuredRecord record_;
  const scene::Scene& scene_;
  MeasuredRun out_;
  std::vector<std::size_t> on_;  // samples of the record on the run
  SampleTimes times_;            // theirs, by the scene's clock
  std::vector<bool> whole_;      // their averages are
  std::vector<HeldColumn> held_;
};

}  // namespace

MeasuredRun lay_in(MeasuredRecord record, const AlignmentOptions& options, const scene::Scene& scene,
                   const std::vector<RunToHold>& runs) {
  return LayingIn(std::move(record), scene).beside(runs, options);
}

}  // namespace rotorub
