#include "native_model/linear/synchronous_response.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "native_model/linear/free_motion.h"
#include "native_model/linear/linear_loop.h"
#include "native_model/linear/mode_shapes.h"
#include "native_model/model/model.h"
#include "native_model/numerics/root.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/scene.h"

namespace rotorub {
namespace {

using Phasor = std::complex<double>;
using Phasors = std::vector<Phasor>;  // one per probe

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Probe {
  std::string name;
  int plane;
  Eigen::VectorXd shape;  // n, mode values
};

bool shown(StationKind kind) {
  return kind == StationKind::kDisc || kind == StationKind::kBearing ||
         kind == StationKind::kContact || kind == StationKind::kMagneticBearing;
}

std::vector<Probe> probes_of(const scene::Scene& scene, const Model& model, int planes) {
  std::vector<Probe> probes;
  const auto add = [&](const std::string& name, const Eigen::VectorXd& x,
                       const Eigen::VectorXd& y) {
    probes.push_back({name, 0, x});
    if (planes > 1) probes.push_back({name, 1, y});
  };
  if (const auto shapes = mode_shapes(scene)) {
    for (std::size_t k = 0; k < shapes->stations.size(); ++k) {
      if (!shown(shapes->stations[k].kind)) continue;
      const auto row = static_cast<Eigen::Index>(k);
      add(shapes->stations[k].name, shapes->x.at_stations.row(row), shapes->y.at_stations.row(row));
    }
    return probes;
  }
  for (std::size_t k = 0; k < model.auxiliary.size(); ++k) {
    const ModeShape& shape = model.auxiliary[k].shape;
    add(scene.auxiliary.size() > 1 ? "contact " + scene.name_of(k) : "contact", shape.x, shape.y);
  }
  const std::size_t magnets = scene.magnetic_bearings.size();
  for (const StationFeedback& f : model.feedbacks) {
    add(numbered("magnetic bearing", f.number, magnets), f.shape.x, f.shape.y);
    if (f.sensor) add(numbered("sensor", f.number, magnets), f.sensor->x, f.sensor->y);
  }
  return probes;
}

// Adds the forces that turn with the spin as unbalances; returns whether there are any.
bool add_forces(const scene::Scene& scene, Model& model) {
  constexpr double kSame = 1e-9;
  const double speed = scene.rotor.speed;
  bool any = false;
  for (const AppliedForce& f : model.forces) {
    const bool turns = f.kind == scene::ForceKind::kSynchronous ||
                       (f.kind == scene::ForceKind::kRotating &&
                        std::abs(f.frequency - speed) <= kSame * std::abs(speed));
    if (!turns || speed == 0.0 || f.amplitude == 0.0) continue;
    // The phase is relative to the mark, which lies at the spin angle.
    const bool absolute = f.kind == scene::ForceKind::kRotating;
    model.unbalances.push_back(
        {f.shape, f.amplitude / (speed * speed), f.phase - (absolute ? model.spin_angle : 0.0)});
    any = true;
  }
  return any;
}

class Response {
 public:
  Response(const scene::Scene& scene, Model model, std::vector<Probe> probes)
      : scene_(scene),
        model_(std::move(model)),
        probes_(std::move(probes)),
        sense_(scene.rotor.speed < 0.0 ? -1.0 : 1.0) {}

  const std::vector<Probe>& probes() const { return probes_; }

  Phasors at(double size) {
    model_.speed = sense_ * size;
    Phasors all(probes_.size(), Phasor(kNaN, kNaN));
    try {
      const Eigen::VectorXcd q = unbalance_amplitude(scene_, model_);
      const Eigen::Index n = q.size() / 2;
      for (std::size_t k = 0; k < all.size(); ++k) {
        const Probe& probe = probes_[k];
        all[k] = probe.shape.cast<Phasor>().dot(q.segment(probe.plane * n, n));
        // The mark passes under the probe of y a quarter turn later.
        if (probe.plane == 1) all[k] *= Phasor(0.0, sense_);
      }
    } catch (const scene::SceneError&) {
      // There is no steady motion at this speed.
    }
    return all;
  }
  double size(double speed, std::size_t probe) { return std::abs(at(speed)[probe]); }

 private:
  const scene::Scene& scene_;
  Model model_;
  std::vector<Probe> probes_;
  double sense_;
};

struct SpeedPoint {
  double speed;
  Phasors deflection;
};

bool known(const SpeedPoint& s) {
  return std::none_of(s.deflection.begin(), s.deflection.end(),
                      [](const Phasor& x) { return std::isnan(x.real()); });
}

// Whether a straight line from a to b would miss the point in the middle.
bool bends(const SpeedPoint& a, const SpeedPoint& middle, const SpeedPoint& b) {
  constexpr double kAccuracy = 0.003;
  if (!known(a) || !known(middle) || !known(b)) return known(a) != known(b);
  for (std::size_t k = 0; k < middle.deflection.size(); ++k) {
    const Phasor line = 0.5 * (a.deflection[k] + b.deflection[k]);
    if (std::abs(line - middle.deflection[k]) > kAccuracy * std::abs(middle.deflection[k])) {
      return true;
    }
  }
  return false;
}

// Appends the points after a, up to and including b.
void refine(Response& response, const SpeedPoint& a, const SpeedPoint& b, int halvings,
            std::vector<SpeedPoint>& out) {
  const double speed = 0.5 * (a.speed + b.speed);
  const SpeedPoint middle{speed, response.at(speed)};
  if (halvings > 0 && bends(a, middle, b)) {
    refine(response, a, middle, halvings - 1, out);
    refine(response, middle, b, halvings - 1, out);
    return;
  }
  out.push_back(middle);
  out.push_back(b);
}

// Speed at which |X| falls to `level`, in the direction of `step` (-1 or 1) from the peak, found
// between two samples. Empty if |X| does not fall that far.
std::optional<double> half_power(Response& response, const std::vector<SpeedPoint>& samples,
                                 std::size_t peak, std::size_t probe, double at, double level,
                                 int step) {
  double inside = at;
  for (std::size_t k = peak; k < samples.size(); k += static_cast<std::size_t>(step)) {
    const double size = std::abs(samples[k].deflection[probe]), speed = samples[k].speed;
    if (std::isnan(size)) return std::nullopt;
    const bool beyond = step > 0 ? speed > at : speed < at;
    if (beyond && size <= level) {
      const auto miss = [&](double x) { return response.size(x, probe) - level; };
      const double low = std::min(inside, speed), high = std::max(inside, speed);
      return root(miss, low, high, miss(low), miss(high), 1e-9 * high).first;
    }
    if (beyond) inside = speed;
  }
  return std::nullopt;
}

std::vector<ResponsePeak> peaks_of(Response& response, const std::vector<SpeedPoint>& samples,
                                   std::size_t probe) {
  std::vector<ResponsePeak> peaks;
  const auto size = [&](std::size_t k) { return std::abs(samples[k].deflection[probe]); };
  constexpr int kBits = std::numeric_limits<double>::digits / 2;
  for (std::size_t k = 1; k + 1 < samples.size(); ++k) {
    if (!(size(k) > size(k - 1) && size(k) >= size(k + 1))) continue;
    const auto [speed, less] =
        boost::math::tools::brent_find_minima([&](double x) { return -response.size(x, probe); },
                                              samples[k - 1].speed, samples[k + 1].speed, kBits);
    ResponsePeak peak{speed, response.at(speed)[probe], {}};
    const double level = -less * std::numbers::sqrt2 / 2.0;
    const auto before = half_power(response, samples, k, probe, speed, level, -1),
               after = half_power(response, samples, k, probe, speed, level, 1);
    if (before && after) peak.amplification = speed / (*after - *before);
    peaks.push_back(peak);
  }
  return peaks;
}

}  // namespace

std::optional<double> required_margin(double amplification, bool above) {
  if (amplification < 2.5) return std::nullopt;
  return 0.17 * (1.0 - 1.0 / (amplification - 1.5)) + (above ? 0.1 : 0.0);
}

std::optional<SynchronousResponse> synchronous_response(const scene::Scene& scene, double top) {
  constexpr int kSpeeds = 80, kHalvings = 9;
  const scene::Scene free = without_start(scene);
  Model model = always_working(make_model(free));
  SynchronousResponse out;
  out.forces = add_forces(scene, model);
  if (model.unbalances.empty()) return std::nullopt;
  out.same_planes = whirl_system(scene).isotropic;
  Response response(free, model, probes_of(scene, model, out.same_planes ? 1 : 2));

  std::vector<double> at = even_speeds(top, kSpeeds + 1);
  at.front() = std::abs(scene.rotor.speed);
  std::sort(at.begin(), at.end());
  std::vector<SpeedPoint> samples;
  for (const double speed : at) {
    if (speed == 0.0 || speed > top || (!samples.empty() && speed == samples.back().speed))
      continue;
    SpeedPoint next{speed, response.at(speed)};
    if (samples.empty()) {
      samples.push_back(std::move(next));
    } else {
      const SpeedPoint last = samples.back();
      refine(response, last, next, kHalvings, samples);
    }
  }
  if (std::none_of(samples.begin(), samples.end(), known)) return std::nullopt;
  for (const SpeedPoint& s : samples) out.speed.push_back(s.speed);
  for (std::size_t probe = 0; probe < response.probes().size(); ++probe) {
    ProbeResponse of{response.probes()[probe].name, response.probes()[probe].plane, {}, {}};
    for (const SpeedPoint& s : samples) of.deflection.push_back(s.deflection[probe]);
    of.peaks = peaks_of(response, samples, probe);
    out.probes.push_back(std::move(of));
  }
  return out;
}

}  // namespace rotorub
