#include "compare/sweep/sample.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

namespace rotorub::sweep {
namespace {

Value number(double value) { return {fmt::format("{}", value), value}; }

// In [0, 1): the upper 53 bits.
double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11u) * 0x1p-53; }

Value grid_value(const Vary& vary, std::int64_t i) {
  if (!vary.values.empty()) return vary.values[static_cast<std::size_t>(i)];
  if (vary.count == 1) return number(vary.from);
  return number(between(vary, static_cast<double>(i) / static_cast<double>(vary.count - 1)));
}

}  // namespace

double between(const Vary& vary, double share) {
  if (share <= 0.0) return vary.from;
  if (share >= 1.0) return vary.to;
  if (vary.spacing == Spacing::kLinear) return vary.from + share * (vary.to - vary.from);
  const double low = std::log(vary.from), high = std::log(vary.to);
  return std::exp(low + share * (high - low));
}

Sample::Sample(const Study& study) : study_(&study) {
  switch (study.kind) {
    case SampleKind::kGrid:
      size_ = 1;
      for (const Vary& vary : study.vary) size_ *= vary.count;
      break;
    case SampleKind::kList:
      size_ = study.vary.front().count;
      break;
    case SampleKind::kLatinHypercube:
      size_ = study.runs;
      for (std::size_t k = 0; k < study.vary.size(); ++k) {
        orders_.emplace_back(static_cast<std::uint64_t>(size_), mixed(study.seed, k, 0));
      }
      break;
  }
}

Value Sample::cell_value(std::size_t k, std::int64_t index) const {
  const auto place = static_cast<std::uint64_t>(index);
  const auto cell = static_cast<double>(orders_[k].at(place));
  const double inside = unit(mixed(mixed(study_->seed, k, 1), place, 0));
  return number(between(study_->vary[k], (cell + inside) / static_cast<double>(size_)));
}

std::vector<Value> Sample::at(std::int64_t index) const {
  assert(index >= 0 && index < size_);
  const std::size_t keys = study_->vary.size();
  std::vector<Value> values(keys);
  std::int64_t rest = index;
  for (std::size_t k = keys; k-- > 0;) {
    const Vary& vary = study_->vary[k];
    switch (study_->kind) {
      case SampleKind::kGrid:
        values[k] = grid_value(vary, rest % vary.count);
        rest /= vary.count;
        break;
      case SampleKind::kList:
        values[k] = vary.values[static_cast<std::size_t>(index)];
        break;
      case SampleKind::kLatinHypercube:
        values[k] = cell_value(k, index);
        break;
    }
  }
  return values;
}

}  // namespace rotorub::sweep
