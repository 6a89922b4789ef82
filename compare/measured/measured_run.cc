#include "compare/measured/measured_run.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>

#include "compare/measured/figures.h"
#include "compare/measured/record.h"
#include "compare/metrics/orbit.h"

namespace rotorub {
namespace {

using Eigen::ArrayXd;

// Compares a record with its runs.
class LayingIn {
 public:
  LayingIn(MeasuredRecord record, const scene::Scene& scene)
      : record_(std::move(record)), scene_(scene) {
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
      throw MeasuredError("the native run has fewer than two rows to compare the record with");
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
  template <class... Words>
  void remark(fmt::format_string<Words...> text, Words&&... words) {
    out_.remarks.push_back(fmt::format(text, std::forward<Words>(words)...));
  }

  // Drops the columns that a run lacks, with a remark.
  void keep_comparable(const std::vector<SampledRun>& runs) {
    std::erase_if(record_.columns, [&](const MeasuredColumn& c) {
      const auto lacks = [&](const SampledRun& run) { return !run.has(*c.what); };
      const bool of_contact = c.what->name == "gap" || c.what->name.ends_with("force");
      const bool none =
          (of_contact && !scene_.has_contact()) || std::any_of(runs.begin(), runs.end(), lacks);
      if (none)
        remark("{} is left out, because the runs of this scene have no such quantity",
               c.what->name);
      return none;
    });
    if (record_.columns.empty()) {
      throw MeasuredError("no column of the record is a quantity that the runs of this scene have");
    }
    if (!record_.left_out.empty()) remark("not compared: {}", fmt::join(record_.left_out, ", "));
    if (!record_.has_units) remark("the header has no units, so all columns are taken in SI");
  }

  // Refuses a unit with a wrong or missing prefix: places a hundred times larger or smaller than
  // the run's. A model that is right to a factor of 30 is still worth comparing.
  void refuse_other_units(const Trajectory& native) const {
    constexpr double kFar = 100.0;
    for (const MeasuredColumn& c : record_.columns) {
      if (c.what->unit() != "m") continue;
      const auto largest = [](const std::vector<double>& y) {
        return ArrayXd::Map(y.data(), static_cast<Eigen::Index>(y.size())).abs().maxCoeff();
      };
      const double measured = largest(c.value);  // missing values are 0
      const double run = largest(native.column(std::string(c.what->series)));
      if (measured == 0.0 || run == 0.0) continue;
      if (measured < kFar * run && run < kFar * measured) continue;
      throw MeasuredError(
          fmt::format("{}: reaches {:.3g} m, but the native run reaches {:.3g} m, {:.2g} times as "
                      "far; check the "
                      "unit in the header, for example rotor_x [um]",
                      c.header, measured, run, run / measured));
    }
  }

  // Keeps the samples on the native run, and marks those whose averages reach beyond its ends.
  void keep_samples(const SampledRun& native) {
    const double slack = 1e-6 * record_.interval;
    const double start = native.start() - slack, end = native.end() + slack;
    const SampleTimes all =
        shifted(sample_times(record_.t, record_.interval), out_.alignment.shift);
    for (std::size_t i = 0; i < all.t.size(); ++i) {
      if (all.t[i] < start || all.t[i] > end) continue;
      on_.push_back(i);
      times_.t.push_back(std::clamp(all.t[i], native.start(), native.end()));
      times_.from.push_back(all.from[i]);
      times_.to.push_back(all.to[i]);
      whole_.push_back(all.from[i] >= start && all.to[i] <= end);
    }
    if (on_.size() < all.t.size()) {
      remark("{} of {} samples lie on the run", on_.size(), all.t.size());
    }
  }

  void hold(const MeasuredColumn& c, const std::vector<SampledRun>& runs) {
    HeldColumn held{{c.what, std::string(c.what->name), {}, {}}, {}};
    for (std::size_t k = 0; k < on_.size(); ++k) {
      const bool unknown = c.what->series.empty() && !whole_[k];
      held.value.push_back(c.value[on_[k]]);
      held.sample.push_back(unknown ? Sample::kMissing : c.sample[on_[k]]);
    }
    for (const SampledRun& run : runs) {
      held.runs.push_back(run.values(*c.what, times_, out_.alignment.angle));
    }
    ColumnFit fit{c.what, held.count(Sample::kGood), held.count(Sample::kMissing),
                  held.count(Sample::kClipped)};
    if (fit.clipped > 0) {
      remark(
          "{}: {} samples at the sensor's limit are left out of the residuals, and extremes are "
          "only "
          "bounds",
          c.what->name, fit.clipped);
    }
    if (fit.good == 0) {
      remark("{} is left out, because it has no good sample on the run", c.what->name);
      return;
    }
    for (const auto& values : held.runs) fit.runs.push_back(residual_of(held, values, fit.good));
    out_.columns.push_back(std::move(fit));
    held_.push_back(std::move(held));
  }

  static ColumnResidual residual_of(const HeldColumn& c, const std::vector<double>& values,
                                    std::size_t good) {
    ArrayXd left(static_cast<Eigen::Index>(good)), run(left.size());
    Eigen::Index k = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (c.sample[i] != Sample::kGood) continue;
      run[k] = values[i];
      left[k++] = c.value[i] - values[i];
    }
    const double offset = left.mean();
    ColumnResidual r{std::sqrt((left - offset).square().mean()), offset, {}};
    const double deviation = std::sqrt((run - run.mean()).square().mean());
    if (deviation > 0.0) r.share = r.rms / deviation;
    return r;
  }

  void add_figures(const Trajectory& native) {
    FigureFacts facts{times_.t, record_.interval, {}};
    if (scene_.has_contact()) facts.clearance = scene_.first().contact->clearance;
    // From the run's own rows, at their resolution.
    constexpr std::size_t kMost = 1 << 14;
    const double from = times_.t.front(), to = times_.t.back(), rate = 1.0 / record_.interval;
    const std::size_t count = std::clamp<std::size_t>(native.rows(), 8, kMost);
    std::optional<DominantWhirl> whirl;
    if (to > from && native.has("rotor_vx")) {
      const double h = (to - from) / static_cast<double>(count - 1);
      whirl = dominant_whirl(even_orbit(native, from, to, count), h);
    }
    facts.rate_tells = !whirl || std::abs(whirl->frequency) < kMostOfRate * rate;
    if (!facts.rate_tells && find_column(held_, "rotor_x") && find_column(held_, "rotor_y")) {
      remark(
          "no frequency: the native rotor's {:.4g} Hz is beyond {:.0f} % of the sample rate, "
          "{:.4g} Hz",
          whirl->frequency, 100.0 * kMostOfRate, rate);
    }
    out_.figures = figures_of(held_, facts);
  }

  void lay_into_the_scene(const std::vector<SampledRun>& runs) {
    MeasuredRecord& laid = out_.laid;
    laid.file = record_.file;
    laid.interval = record_.interval;
    laid.t = times_.t;
    const std::complex<double> turn = std::polar(1.0, out_.alignment.angle);
    for (const HeldColumn& x : held_) {
      if (x.what->axis == Axis::kNone || out_.alignment.angle == 0.0) {
        laid.columns.push_back(x);
        continue;
      }
      // A pair is turned into the scene's frame; a single axis cannot be.
      const HeldColumn* y = find_column(held_, other_axis(*x.what).name);
      if (x.what->axis != Axis::kX || !y) continue;
      MeasuredColumn own = x, other = *y;
      for (std::size_t i = 0; i < own.value.size(); ++i) {
        const auto z = turn * std::complex<double>(own.value[i], other.value[i]);
        own.value[i] = z.real();
        other.value[i] = z.imag();
        own.sample[i] = other.sample[i] = both(own.sample[i], other.sample[i]);
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
  std::vector<std::size_t> on_;  // indices of the record's samples on the run
  SampleTimes times_;            // of these samples, in the scene's time
  std::vector<bool> whole_;      // whether the average of each lies on the run
  std::vector<HeldColumn> held_;
};

}  // namespace

MeasuredRun align_record(MeasuredRecord record, const AlignmentOptions& options,
                         const scene::Scene& scene, const std::vector<RunToHold>& runs) {
  return LayingIn(std::move(record), scene).beside(runs, options);
}

}  // namespace rotorub
