#include "compare/measured/channel.h"

#include <cmath>

#include "compare/metrics/rows.h"

namespace rotorub {
namespace {

double deviation(const Eigen::VectorXcd& z) {
  return z.size() == 0 ? 0.0 : without_mean(z).norm() / std::sqrt(static_cast<double>(z.size()));
}

// The samples of the record that are good, of x and of y where it is a pair.
void take_record(const MeasuredColumn& x, const MeasuredColumn* y, Channel& channel) {
  for (std::size_t i = 0; i < x.value.size(); ++i) {
    const bool good = x.sample[i] == Sample::kGood && (!y || y->sample[i] == Sample::kGood);
    if (good) channel.good.push_back(i);
  }
  channel.value.resize(static_cast<Eigen::Index>(channel.good.size()));
  for (Eigen::Index k = 0; k < channel.value.size(); ++k) {
    const std::size_t i = channel.good[static_cast<std::size_t>(k)];
    channel.value[k] = {x.value[i], y ? y->value[i] : 0.0};
  }
}

}  // namespace

Eigen::VectorXcd without_mean(const Eigen::VectorXcd& z) {
  return z.size() == 0 ? z : Eigen::VectorXcd(z.array() - z.mean());
}

std::string Channel::name() const {
  return std::string(pair ? what->name.substr(0, what->name.rfind('_')) : what->name);
}

Eigen::VectorXcd Channel::of(const SampledRun& run, const SampleTimes& times) const {
  using Values = Eigen::Map<const Eigen::VectorXd>;
  const std::vector<double> x = run.values(*what, times, pair ? 0.0 : frame);
  Eigen::VectorXcd z(x.size());
  z.real() = Values(x.data(), z.size());
  z.imag().setZero();
  if (pair) z.imag() = Values(run.values(*(what + 1), times).data(), z.size());
  return z / scale;
}

std::vector<Channel> channels_of(const MeasuredRecord& record, const SampledRun& run,
                                 double angle) {
  constexpr std::size_t kTimes = 4096;  // that tell the size of a motion
  const double apart = record.interval;
  const SampleTimes times = sample_times(even_times(run.start(), run.end(), kTimes), apart);
  const auto column = [&](const Measurable& m) {
    const MeasuredColumn* c = record.find(m.name);
    return c && run.has(m) ? c : nullptr;
  };
  for (int group = 0; group < kChannelGroups; ++group) {
    std::vector<Channel> found;
    for (const Measurable& m : measurables()) {
      const MeasuredColumn* x = column(m);
      if (m.group != group || !x) continue;
      if (m.axis == Axis::kY && column(*(&m - 1))) continue;  // stands with its x
      const MeasuredColumn* y = m.axis == Axis::kX ? column(*(&m + 1)) : nullptr;
      Channel channel{&m, y != nullptr, angle, 1.0, {}, {}};
      take_record(*x, y, channel);
      const double scale = deviation(channel.of(run, times));
      if (!(scale > 0.0) || !(deviation(channel.value) > 0.0)) continue;
      channel.scale = scale;
      channel.value /= scale;
      found.push_back(std::move(channel));
    }
    if (!found.empty()) return found;
  }
  return {};
}

}  // namespace rotorub
