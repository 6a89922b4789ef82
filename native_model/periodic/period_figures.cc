#include "native_model/periodic/period_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/event/driver.h"
#include "native_model/model/dynamics.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub::periodic {
namespace {

constexpr int kSamples = 8;  // per stretch

// Follows the figures of the contacts, and the angles that their centres have gone.
class Follower {
 public:
  explicit Follower(const Model& model)
      : model_(&model), figures_(model.auxiliary.size()), turned_(figures_.size()) {
    for (ContactFigures& f : figures_) f.least_gap = std::numeric_limits<double>::infinity();
  }

  void meet(const Snapshot& now) {
    for (std::size_t k = 0; k < figures_.size(); ++k) {
      ContactFigures& f = figures_[k];
      f.largest_force = std::max(f.largest_force, now.contacts[k].normal_force);
      f.amplitude = std::max(f.amplitude, rotor_point(*model_, now.q, k).norm());
      const Eigen::Vector2d d = separation(*model_, now.q, k);
      if (last_.size() == k) last_.push_back(d);
      const Eigen::Vector2d& last = last_[k];
      if (model_->auxiliary[k].contact) {
        f.least_gap = std::min(f.least_gap, model_->auxiliary[k].contact->clearance - d.norm());
      }
      turned_[k] += std::atan2(last.x() * d.y() - last.y() * d.x(), last.dot(d));
      last_[k] = d;
    }
  }
  void last(const SmoothSystem& system, double length) {
    for (std::size_t k = 0; k < figures_.size(); ++k) {
      if (system.in_contact(k)) figures_[k].contact_share += length;
      if (system.state(k).mode == ContactMode::kStick) figures_[k].stuck_share += length;
    }
  }
  ContactFigures& of(std::size_t contact) { return figures_[contact]; }

  std::vector<ContactFigures> over(double period) {
    for (std::size_t k = 0; k < figures_.size(); ++k) {
      figures_[k].contact_share /= period;
      figures_[k].stuck_share /= period;
      figures_[k].whirl = turned_[k] / period;
    }
    return figures_;
  }

 private:
  const Model* model_;
  std::vector<ContactFigures> figures_;
  std::vector<double> turned_;  // rad
  std::vector<Eigen::Vector2d> last_;
};

}  // namespace

PeriodFigures period_figures(const Model& model, const PeriodicMotion& motion,
                             const EventParameters& parameters) {
  PeriodFigures figures;
  Recorder recorder(model, {});
  EventIntegrator run(model, parameters);
  run.begin(motion.start, motion.start.t + motion.period, recorder);
  Follower follower(model);
  follower.meet(run.here());
  while (run.compute_stretch()) {
    const double begin = run.now(), length = run.stretch_end() - begin;
    for (int i = 0; i <= kSamples; ++i) follower.meet(run.within(begin + i * length / kSamples));
    follower.last(run.system(), length);
    const auto contact = run.event_contact();
    if (!contact || run.system().has_margins(*contact)) {
      run.pass();
      continue;
    }
    // A contact that closes. The impulse of a compliant one is 0 up to here.
    const double before = run.normal_impulse(run.within(run.stretch_end()), *contact);
    run.pass();
    ContactFigures& f = follower.of(*contact);
    const double impulse = run.normal_impulse(run.here(), *contact) - before;
    f.largest_impulse = std::max(f.largest_impulse, impulse);
    ++f.impacts;
  }
  figures.status = run.result().status;
  const Snapshot end = run.here();
  for (std::size_t k = 0; k < model.auxiliary.size(); ++k) {
    follower.of(k).mean_force = run.normal_impulse(end, k) / motion.period;
  }
  figures.contacts = follower.over(motion.period);
  figures.passes = recorder.keyphasor().take();
  return figures;
}

}  // namespace rotorub::periodic
