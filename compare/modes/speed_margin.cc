#include "compare/modes/speed_margin.h"

#include <algorithm>
#include <cmath>

#include "compare/modes/response_text.h"
#include "native_model/linear/synchronous_response.h"

namespace rotorub {

std::optional<SpeedMargin> speed_margin(const scene::Scene& scene,
                                        const std::vector<double>& critical) {
  constexpr double kBeyond = 1.3;  // the response reaches past the peak
  constexpr double kNear = 0.05;   // share by which a damped peak differs from its critical speed
  const double speed = std::abs(scene.rotor.speed);
  if (speed == 0.0 || critical.empty()) return {};
  const double nearest =
      *std::ranges::min_element(critical, {}, [&](double at) { return std::abs(at - speed); });
  const auto response =
      synchronous_response(before_loss(scene).value_or(scene), kBeyond * std::max(nearest, speed));
  if (!response) return {};
  std::optional<SpeedMargin> margin;
  for (const ProbeResponse& probe : response->probes) {
    for (const ResponsePeak& peak : probe.peaks) {
      if (!peak.amplification || std::abs(peak.speed - nearest) > kNear * nearest) continue;
      if (margin && margin->amplification >= *peak.amplification) continue;
      margin = {speed, nearest, *peak.amplification,
                required_margin(*peak.amplification, peak.speed > speed)};
    }
  }
  return margin;
}

}  // namespace rotorub
