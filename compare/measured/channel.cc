#include "compare/measured/channel.h"

#include <algorithm>
#include <cmath>

namespace rotorub {
namespace {

using Complex = std::complex<double>;

// Columns of one group; a pair where both are there.
const std::vector<std::vector<std::vector<std::string_view>>>& channel_groups() {
  static const std::vector<std::vector<std::vector<std::string_view>>> groups = {
      {{"rotor_x", "rotor_y"}, {"ring_x", "ring_y"}, {"gap"}},
      {{kContactForce}},
      {{"normal_force"}, {"friction_force"}},
      {{"control_x", "control_y"}, {"current_1"}, {"current_2"}},
      {{"spin_speed"}}};
  return groups;
}

double deviation_of(const std::vector<Complex>& z) {
  Complex mean = 0.0;
  for (const Complex& value : z) mean += value;
  mean /= static_cast<double>(std::max<std::size_t>(z.size(), 1));
  double square = 0.0;
  for (const Complex& value : z) square += std::norm(value - mean);
  return z.empty() ? 0.0 : std::sqrt(square / static_cast<double>(z.size()));
}

// At as many even times as tell its size.
double run_deviation(const Channel& channel, const SampledRun& run, double interval) {
  constexpr std::size_t kTimes = 4096;
  std::vector<double> t;
  for (std::size_t k = 0; k < kTimes; ++k) {
    t.push_back(run.start() + (run.end() - run.start()) * static_cast<double>(k) / static_cast<double>(kTimes - 1));
  }
  return deviation_of(run_values(channel, run, sample_times(t, interval)));
}

double record_deviation(const Channel& channel) {
  std::vector<Complex> good;
  for (std::size_t i = 0; i < channel.x->value.size(); ++i) {
    if (is_good(channel, i)) good.push_back(record_value(channel, i));
  }
  return deviation_of(good);
}

}  // namespace

std::string Channel::name() const {
  const std::string_view whole = x->what->name;
  return std::string(is_pair() ? whole.substr(0, whole.rfind('_')) : whole);
}

std::vector<Channel> channels_of(const MeasuredRecord& record, const SampledRun& run, double angle) {
  for (const auto& group : channel_groups()) {
    std::vector<Channel> found;
    for (const auto& names : group) {
      std::vector<const MeasuredColumn*> columns;
      for (const std::string_view name : names) {
        const MeasuredColumn* c = record.find(name);
        if (c && run.has(*c->what)) columns.push_back(c);
      }
      if (columns.empty()) continue;
      Channel channel{columns.front(), columns.size() > 1 ? columns.back() : nullptr, angle};
      channel.scale = run_deviation(channel, run, record.interval);
      if (channel.scale > 0.0 && record_deviation(channel) > 0.0) found.push_back(channel);
    }
    if (!found.empty()) return found;
  }
  return {};
}

Complex record_value(const Channel& channel, std::size_t sample) {
  return {channel.x->value[sample], channel.y ? channel.y->value[sample] : 0.0};
}

bool is_good(const Channel& channel, std::size_t sample) {
  return channel.x->sample[sample] == Sample::kGood && (!channel.y || channel.y->sample[sample] == Sample::kGood);
}

std::vector<Complex> run_values(const Channel& channel, const SampledRun& run, const SampleTimes& times) {
  const auto x = values_in_frame(run, *channel.x->what, times, channel.is_pair() ? 0.0 : channel.frame);
  std::vector<double> y(x.size(), 0.0);
  if (channel.y) y = run.values(*channel.y->what, times);
  std::vector<Complex> z;
  for (std::size_t i = 0; i < x.size(); ++i) z.emplace_back(x[i], y[i]);
  return z;
}

}  // namespace rotorub
