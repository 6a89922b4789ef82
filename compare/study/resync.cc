#include "compare/study/resync.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/event/driver.h"
#include "native_model/model/dynamics.h"
#include "native_model/prepare/prepare.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {

void OnsetWatch::step(const WatchedStep& s) {
  const bool force = std::ranges::any_of(
      s.contacts, [](const WatchedContact& c) { return c.normal_impulse > 0.0; });
  if (force && flew()) begin_contact(s);
  if (open_) {
    find_rebound(s);
    if (force) add(s);
  }
  flight_ = force ? 0 : flight_ + 1;
  for (std::size_t i = 0; i < s.contacts.size(); ++i)
    had_force_[i] = s.contacts[i].normal_impulse > 0.0;
  const Layout& l = model_->layout;
  before_.t = s.t;
  before_.q = Eigen::VectorXd::Zero(l.nq());
  before_.v = Eigen::VectorXd::Zero(l.nq());
  before_.q.head(l.coil()) = Eigen::Map<const Eigen::VectorXd>(s.q, l.coil());
  before_.v.head(l.coil()) = Eigen::Map<const Eigen::VectorXd>(s.v, l.coil());
  for (int k = 0; k < l.coils; ++k) before_.v[l.coil() + k] = s.current[k];
}

// Called at the first impulse after a free phase.
void OnsetWatch::begin_contact(const WatchedStep& s) {
  if (open_) onsets_.back().end = 0.5 * (last_force_ + s.t);
  open_ = false;
  Onset onset;
  onset.touch = s.t + s.h;
  bool touched = false;
  for (std::size_t i = 0; i < s.contacts.size(); ++i) {
    if (!(s.contacts[i].normal_impulse > 0.0)) continue;
    const ContactPoint p = contact_point(*model_, before_.q.data(), before_.v.data(), i);
    touched = touched || p.gap <= 0.0;
    if (p.gap_rate >= 0.0) continue;
    const double touch = std::min(before_.t + p.gap / -p.gap_rate, s.t + s.h);
    if (onset.closing > 0.0 && touch >= onset.touch) continue;
    onset.touch = touch;
    onset.closing = -p.gap_rate;
  }
  if (touched || onset.closing == 0.0) {
    ++left_out_;
    return;
  }
  onset.before = before_;
  onsets_.push_back(std::move(onset));
  open_ = true;
  rebounded_ = false;
  window_ = ImpulseWindow(kWindowSteps * s.h);
}

// Adds the impulses of a step. The force of a step that has no impact acts around the start of the
// step.
void OnsetWatch::add(const WatchedStep& s) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  double impulse = 0.0, first_impact = kNever, begin = kNever;
  last_force_ = 0.0;
  for (const WatchedContact& at : s.contacts) {
    if (!(at.normal_impulse > 0.0)) continue;
    impulse += at.normal_impulse;
    if (at.impact) first_impact = std::min(first_impact, at.impact_time);
    begin = std::min(begin, at.impact ? at.impact_time : s.t);
    last_force_ = std::max(last_force_, at.impact ? at.impact_time : s.t + 0.5 * s.h);
  }
  Onset& o = onsets_.back();
  ContactResult& c = o.mujoco;
  if (first_impact < kNever && c.impulse == 0.0) o.touch = first_impact;
  c.impulse += impulse;
  window_.add(begin, impulse);
  c.window_impulse = window_.largest();
  c.duration = std::max(0.0, last_force_ - o.touch);
}

// The first rebound belongs to the first impact, or to the first contact whose force ends.
void OnsetWatch::find_rebound(const WatchedStep& s) {
  if (rebounded_) return;
  double time = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < s.contacts.size(); ++i) {
    const WatchedContact& c = s.contacts[i];
    const bool force = c.normal_impulse > 0.0, ended = had_force_[i] && !force;
    const double at = ended ? s.t : c.impact_time;
    if (!((force && c.impact) || ended) || at >= time) continue;
    time = at;
    onsets_.back().mujoco.rebound =
        ended ? contact_point(*model_, s.q, s.v, i).gap_rate : c.gap_rate_after;
    rebounded_ = true;
  }
}

std::vector<Onset> OnsetWatch::finish(double end) {
  if (open_) {
    onsets_.back().lasts = !flew();
    onsets_.back().end = flew() ? 0.5 * (last_force_ + end) : end;
  }
  open_ = false;
  return std::move(onsets_);
}

namespace {

template <class Value>
double largest(const Resync& all, Value value) {
  double found = 0.0;
  for (const PredictedOnset& o : all.onsets) found = std::max(found, value(o));
  return found;
}

const ResyncFigure kResyncFigures[] = {
    {{"impulse", "impulse", "mN s", 1e3,
      "Normal impulse of the contact, its small bounces with it."},
     "the contact's own, or the largest impact where that is more",
     &ContactResult::impulse,
     [](const PredictedOnset& o, const Resync& all) {
       return std::max(o.native.impulse, all.largest_impact);
     }},
    {{"window_impulse", "largest impulse", "mN s", 1e3,
      "Largest normal impulse within 20 steps: an impact's, however many of them a soft contact "
      "spreads it over."},
     "the largest of all contacts",
     &ContactResult::window_impulse,
     [](const PredictedOnset&, const Resync& all) {
       return largest(all, [](const PredictedOnset& o) { return o.native.window_impulse; });
     }},
    {{"duration", "duration", "µs", 1e6, "From the touch to the last force."},
     "the time until half-way through the next flight",
     &ContactResult::duration,
     [](const PredictedOnset& o, const Resync&) { return o.end - o.touch; }},
    {{"rebound", "rebound", "mm/s", 1e3,
      "Gap rate after the first impact; of a soft contact where its force first ends."},
     "the fastest approach of all contacts",
     &ContactResult::rebound,
     [](const PredictedOnset&, const Resync& all) {
       return largest(all, [](const PredictedOnset& o) { return o.closing; });
     }},
};

constexpr std::size_t kImpulse = 0;  // row of the impulse

double share(double difference, double of) { return difference == 0.0 ? 0.0 : difference / of; }

// The smallest of the ascending values v for which at least the fraction `part` of them is <= v.
double quantile(const std::vector<double>& ascending, double part) {
  const double rank = std::ceil(part * static_cast<double>(ascending.size()) - 1e-9);
  return ascending[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

ResyncRow row(const ResyncFigure& figure, const Resync& all, double tolerance) {
  ResyncRow r;
  r.figure = &figure;
  std::vector<double> sizes;
  for (const PredictedOnset& o : all.onsets) {
    if (o.status != Status::kOk) continue;
    const double native = o.native.*figure.value, mujoco = o.mujoco.*figure.value;
    r.native += native;
    r.mujoco += mujoco;
    const double d = share(mujoco - native, figure.scale(o, all));
    sizes.push_back(std::abs(d));
    if (sizes.size() > 1 && sizes.back() <= r.worst) continue;
    r.worst = sizes.back();
    r.worst_signed = d;
    r.worst_time = o.touch;
  }
  r.bias = share(r.mujoco - r.native, r.native);
  r.native /= static_cast<double>(sizes.size());
  r.mujoco /= static_cast<double>(sizes.size());
  std::sort(sizes.begin(), sizes.end());
  r.median = quantile(sizes, 0.5);
  r.ninetieth = quantile(sizes, 0.9);
  r.verdict = r.worst <= tolerance ? FigureVerdict::kWithin : FigureVerdict::kOutside;
  return r;
}

Trust trust_of(const Resync& r, double tolerance) {
  if (r.failed > 0) return Trust::kNo;
  if (r.rows.empty()) return r.touches ? Trust::kUndecidable : Trust::kYes;
  const bool all = std::all_of(r.rows.begin(), r.rows.end(), [](const ResyncRow& row) {
    return row.verdict == FigureVerdict::kWithin;
  });
  if (all) return Trust::kYes;
  // The mean difference of the durations, relative to the mean time, because a rigid duration may
  // be 0.
  double late = 0.0, time = 0.0;
  for (const PredictedOnset& o : r.onsets) {
    late += o.mujoco.duration - o.native.duration;
    time += o.end - o.touch;
  }
  const bool means =
      std::abs(r.rows[kImpulse].bias) <= tolerance && std::abs(share(late, time)) <= tolerance;
  return means ? Trust::kAveragesOnly : Trust::kNo;
}

// Reads the result of the native run that starts at an onset.
void read(const Trajectory& t, PredictedOnset& o) {
  const Statistics& s = t.statistics;
  o.native.impulse = s.impulse_total;
  o.native.window_impulse = s.window_impulse;
  std::vector<bool> lasts(t.contacts, false);
  double last = s.first_touch;
  for (const Event& e : t.events) {
    if (e.kind == EventKind::kSlide || e.kind == EventKind::kStick)
      lasts[static_cast<std::size_t>(e.contact)] = true;
    if (e.kind == EventKind::kLiftOff) lasts[static_cast<std::size_t>(e.contact)] = false;
    if (e.kind == EventKind::kImpact || e.kind == EventKind::kLiftOff) last = e.t;
  }
  if (std::ranges::count(lasts, true) > 0) last = t.end;
  if (s.first_touch >= 0.0) o.native.duration = std::max(0.0, last - s.first_touch);
  if (!t.impacts.empty()) o.native.rebound = t.impacts.front().gap_rate_after;
  for (const Impact& impact : t.impacts) {
    o.largest_impact = std::max(o.largest_impact, impact.normal_impulse);
  }
}

}  // namespace

std::span<const ResyncFigure> resync_figures() { return kResyncFigures; }

std::vector<PredictedOnset> predict(const scene::Scene& scene, const std::vector<Onset>& onsets,
                                    std::shared_ptr<const CommandRecord> commands, double step,
                                    const std::function<void(double)>& progress,
                                    const std::atomic<bool>* interrupt) {
  const Model model = replayed(prepare(scene), std::move(commands));
  EventParameters settings;
  settings.force_bin = step;
  EventIntegrator integrator(model, settings);
  std::vector<PredictedOnset> predicted;
  for (const Onset& onset : onsets) {
    if (interrupt && interrupt->load(std::memory_order_relaxed)) break;
    PredictedOnset o{onset, {}, 0.0, Status::kOk, {}};
    Recorder recorder(model, {}, kWindowSteps * step);
    const RunEnd result = integrator.run(onset.before, onset.end, recorder, {}, interrupt);
    o.status = result.status;
    o.message = result.message;
    read(recorder.finish(result), o);
    predicted.push_back(std::move(o));
    if (progress) {
      progress(static_cast<double>(predicted.size()) / static_cast<double>(onsets.size()));
    }
  }
  return predicted;
}

Resync judge_resync(std::vector<PredictedOnset> onsets, bool touches, double tolerance) {
  Resync r;
  r.touches = touches;
  r.onsets = std::move(onsets);
  std::size_t good = 0;
  for (const PredictedOnset& o : r.onsets) {
    if (o.status == Status::kOk) {
      ++good;
      r.largest_impact = std::max(r.largest_impact, o.largest_impact);
    } else if (r.failed++ == 0) {
      r.failure = o.message;
    }
  }
  if (good > 0) {
    for (const ResyncFigure& figure : kResyncFigures) r.rows.push_back(row(figure, r, tolerance));
  }
  r.trust = trust_of(r, tolerance);
  return r;
}

}  // namespace rotorub
