#include "tests/bench/peers/peer_engine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <utility>

#include "native_model/model/dynamics.h"
#include "native_model/model/model_checks.h"
#include "native_model/prepare/prepare.h"
#include "native_model/trajectory/contact_episodes.h"
#include "native_model/trajectory/range_check.h"
#include "native_model/trajectory/recorder.h"
#include "tests/bench/peers/planar_scene.h"
#include "tests/support/trapezoid_balance.h"

namespace rotorub::peers {
namespace {

constexpr std::int64_t kChunk = 256;

bool finite(const StepRecord& r) {
  double sum = r.angle + r.speed + r.normal + r.friction;
  for (const Pair& p : {r.position, r.velocity, r.ring_position, r.ring_velocity})
    sum += p[0] + p[1];
  return std::isfinite(sum);
}

// Records in the native layout, impacts and modes found from the impulses.
class PeerRecord {
 public:
  PeerRecord(const Model& model, const PlanarSystem& system, PeerContact contact, double step,
             std::vector<double> times)
      : model_(model),
        system_(system),
        soft_(contact == PeerContact::kSoft),
        step_(step),
        recorder_(model, std::move(times)),
        balance_(model),
        episodes_(recorder_) {
    const auto n = static_cast<std::size_t>(model.nq());
    q_.assign(model.q0.data(), model.q0.data() + n);
    v_.assign(model.v0.data(), model.v0.data() + n);
    const ContactSnapshot flight{};
    const Snapshot start{0.0, q_.data(), v_.data(), std::span(&flight, 1)};
    recorder_.begin(start);
    balance_.begin(start);
    point_ = contact_point(model_, q_.data(), v_.data());
  }

  // An impulse after a step without one is an impact where the gap was closing; what follows it is
  // lasting contact.
  void step(std::int64_t k, const StepRecord& r) {
    take(r);
    const double t = static_cast<double>(k + 1) * step_;
    const ContactPoint now = contact_point(model_, q_.data(), v_.data());
    const bool touches = r.normal > 0.0;
    const bool hits = !soft_ && touches && !touched_ && point_.gap_rate < kCountedGapRate;
    Impact impact;
    if (hits) {
      impact = {t, r.normal, r.friction, point_.gap_rate, now.gap_rate, point_.slip, now.slip, 0.0};
      impact.energy_change = 0.5 * (r.normal * (point_.gap_rate + now.gap_rate) +
                                    r.friction * (point_.slip + now.slip));
      recorder_.add(impact);
      recorder_.add(Event{t, EventKind::kImpact});
    }
    const ContactMode mode = !touches || hits ? ContactMode::kFree
                             : std::abs(r.friction) < system_.friction * r.normal * (1.0 - 1e-9)
                                 ? ContactMode::kStick
                                 : ContactMode::kSlide;
    if (soft_) {
      episodes_.step({t - step_, step_, point_, now, r.normal / step_, r.friction / step_, mode});
    } else {
      note(t, mode);
    }
    const double scale = hits ? 0.0 : 1.0 / step_;
    const ContactSnapshot shown{scale * r.normal, scale * r.friction, mode, {}};
    const Snapshot end{t, q_.data(), v_.data(), std::span(&shown, 1)};
    const Impact* hit = hits ? &impact : nullptr;
    recorder_.step(end, r.normal, r.friction, hit, balance_.step(end, r.normal, r.friction, hit));
    touched_ = touches;
    point_ = now;
  }

  const double* q() const { return q_.data(); }
  const double* v() const { return v_.data(); }
  Trajectory finish(const RunEnd& end) {
    if (soft_) episodes_.finish();
    return recorder_.finish(end);
  }

 private:
  void take(const StepRecord& r) {
    const Layout& l = model_.layout;
    const auto put = [&](int at, const Pair& x, const Pair& v) {
      for (std::size_t i = 0; i < 2; ++i) {
        q_[static_cast<std::size_t>(at) + i] = x[i];
        v_[static_cast<std::size_t>(at) + i] = v[i];
      }
    };
    put(l.x(), r.position, r.velocity);
    if (l.stator) put(l.ring(), r.ring_position, r.ring_velocity);
    if (l.spin) {
      q_[static_cast<std::size_t>(l.phi())] = r.angle;
      v_[static_cast<std::size_t>(l.phi())] = r.speed;
    }
  }

  void note(double t, ContactMode mode) {
    if (mode == mode_) return;
    mode_ = mode;
    recorder_.add(Event{t, mode == ContactMode::kSlide   ? EventKind::kSlide
                           : mode == ContactMode::kStick ? EventKind::kStick
                                                         : EventKind::kLiftOff});
  }

  const Model& model_;
  const PlanarSystem& system_;
  bool soft_;
  double step_;
  Recorder recorder_;
  test::TrapezoidBalance balance_;
  ContactEpisodes episodes_;  // of a soft contact
  std::vector<double> q_, v_;
  ContactPoint point_;
  bool touched_ = false;
  ContactMode mode_ = ContactMode::kFree;
};

class PeerEngine final : public Engine {
 public:
  PeerEngine(std::string name, PeerContact contact, MakeStepper make)
      : name_(std::move(name)), contact_(contact), make_(std::move(make)) {}
  std::string name() const override { return name_; }
  Trajectory run(const scene::Scene& given, const RunRequest& request) const override;

 private:
  std::string name_;
  PeerContact contact_;
  MakeStepper make_;
};

Trajectory PeerEngine::run(const scene::Scene& given, const RunRequest& request) const {
  const scene::Scene scene = perturbed(given, request.perturbation_ulps);
  const PlanarSystem system = planar_system(scene);
  const Model model = prepare(scene);
  const double step = request.step.value_or(scene.run.step);
  const std::vector<double> times = request.output_times.value_or(output_times(scene.run));
  check_run_size(scene, model, step, &times);
  PeerRecord record(model, system, contact_, step, times);
  const std::unique_ptr<Stepper> stepper = make_(system, step);

  const auto steps = static_cast<std::int64_t>(std::ceil(scene.run.end / step - 1e-9));
  std::vector<StepRecord> chunk(kChunk);
  std::chrono::duration<double> wall{0.0};
  Status status = Status::kOk;
  std::string message;
  std::int64_t k = 0;
  while (k < steps && status == Status::kOk) {
    const std::int64_t count = std::min(kChunk, steps - k);
    const auto start = std::chrono::steady_clock::now();
    const bool good = stepper->advance(count, chunk.data());
    wall += std::chrono::steady_clock::now() - start;
    if (!good) {
      status = Status::kDiverged;
      message = stepper->message();
      break;
    }
    for (std::int64_t i = 0; i < count && status == Status::kOk; ++i, ++k) {
      const StepRecord& done = chunk[static_cast<std::size_t>(i)];
      if (!finite(done)) {
        status = Status::kDiverged;
        message = "the state is no longer finite";
        break;
      }
      record.step(k, done);
      if (const auto why = out_of_range(model, record.q(), record.v())) {
        status = Status::kOutOfRange;
        message = *why;
      }
    }
    if (request.interrupt && request.interrupt->load(std::memory_order_relaxed)) {
      status = Status::kInterrupted;
      message = "interrupted";
    }
    if (request.progress) request.progress(static_cast<double>(k) / static_cast<double>(steps));
  }

  const double reached = static_cast<double>(k) * step;
  Trajectory out =
      record.finish({status == Status::kOk ? scene.run.end : reached, k, status, message});
  out.engine = name_;
  out.integrator = "";
  out.contact_model = name_;
  out.step = step;
  out.wall_s = wall.count();
  return out;
}

}  // namespace

std::unique_ptr<Engine> peer_engine(const std::string& name, PeerContact contact,
                                    MakeStepper make) {
  return std::make_unique<PeerEngine>(name, contact, std::move(make));
}

}  // namespace rotorub::peers
