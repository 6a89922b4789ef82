#include "compare/sweep/sample.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <boost/random/sobol.hpp>
#include <cassert>
#include <cmath>
#include <optional>

#include "compare/sweep/study_reader.h"
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/overrides.h"

namespace rotorub::sweep {

std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30u)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27u)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31u);
}

std::uint64_t mixed(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return mixed(mixed(mixed(a) ^ b) ^ c);
}

Permutation::Permutation(std::uint64_t n, std::uint64_t key)
    : n_(n), key_(key), half_bits_(std::max(1, (static_cast<int>(std::bit_width(n - 1)) + 1) / 2)) {
  assert(n >= 1);
}

std::uint64_t Permutation::once(std::uint64_t x) const {
  const std::uint64_t mask = (std::uint64_t{1} << half_bits_) - 1;
  std::uint64_t left = x >> half_bits_, right = x & mask;
  for (std::uint64_t round = 0; round < kRounds; ++round) {
    const std::uint64_t next = left ^ (mixed(key_, round, right) & mask);
    left = right;
    right = next;
  }
  return (left << half_bits_) | right;
}

std::uint64_t Permutation::at(std::uint64_t place) const {
  assert(place < n_);
  do place = once(place);
  while (place >= n_);
  return place;
}

// The Gray code of 2^b - 1 is bit b - 1 alone, so these points are the direction numbers.
Sobol::Sobol(std::size_t keys) : keys_(keys) {
  assert(keys >= 1 && keys <= kMostKeys);
  constexpr int kBits = 31;  // of an index; kMostPoints needs 30
  boost::random::sobol engine(keys);
  for (int bit = 0; bit < kBits; ++bit) {
    engine.seed((std::uint64_t{2} << bit) - 2);  // it skips the origin
    std::vector<std::uint64_t>& direction = directions_.emplace_back();
    for (std::size_t k = 0; k < keys; ++k) direction.push_back(engine());
  }
}

std::vector<std::uint64_t> Sobol::at(std::int64_t index) const {
  std::vector<std::uint64_t> point(keys_, 0);
  auto code = static_cast<std::uint64_t>(index);
  code ^= code >> 1u;
  for (std::size_t bit = 0; code != 0; ++bit, code >>= 1u) {
    if ((code & 1u) == 0) continue;
    for (std::size_t k = 0; k < keys_; ++k) point[k] ^= directions_[bit][k];
  }
  return point;
}

namespace {

Value number(double value) { return {number_text(value), value}; }

// A number in [0, 1) from the upper 53 bits.
double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11u) * 0x1p-53; }

// Writes a whole number of any size in digits.
Value whole_number(double value) { return {fmt::format("{:.0f}", value), value}; }

Value grid_value(const Vary& vary, std::int64_t i) {
  if (!vary.values.empty()) return vary.values[static_cast<std::size_t>(i)];
  if (vary.count == 1) return vary.whole ? whole_number(vary.from) : number(vary.from);
  const double value = between(vary, static_cast<double>(i) / static_cast<double>(vary.count - 1));
  return vary.whole ? whole_number(std::round(value)) : number(value);
}

// The index of the cell that contains `share` when [0, 1) is divided into `count` equal cells.
std::int64_t place_of(double share, double count) {
  return static_cast<std::int64_t>(std::min(std::floor(share * count), count - 1.0));
}

Value drawn_value(const Vary& vary, double share) {
  if (!vary.values.empty())
    return vary.values[static_cast<std::size_t>(place_of(share, static_cast<double>(vary.count)))];
  if (vary.whole)
    return whole_number(vary.from +
                        static_cast<double>(place_of(share, vary.to - vary.from + 1.0)));
  return number(vary.distribution ? quantile(*vary.distribution, share) : between(vary, share));
}

std::vector<std::string> joined(const std::vector<std::string>& a, std::span<const std::string> b) {
  std::vector<std::string> all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
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
    case SampleKind::kSobol:
      sobol_.emplace(study.vary.size());
      [[fallthrough]];
    case SampleKind::kRandom:
      size_ = study.runs;
      break;
  }
}

std::vector<double> Sample::shares(std::int64_t index) const {
  const auto place = static_cast<std::uint64_t>(index);
  const std::uint64_t seed = study_->seed;
  std::vector<double> all;
  const auto coordinates = sobol_ ? sobol_->at(index) : std::vector<std::uint64_t>();
  for (std::size_t k = 0; k < study_->vary.size(); ++k) {
    if (study_->kind == SampleKind::kSobol) {
      all.push_back(unit(coordinates[k] ^ mixed(seed, k, 3)));
    } else if (study_->kind == SampleKind::kRandom) {
      all.push_back(unit(mixed(mixed(seed, k, 2), place, 0)));
    } else {
      const auto cell = static_cast<double>(orders_[k].at(place));
      const double inside = unit(mixed(mixed(seed, k, 1), place, 0));
      all.push_back((cell + inside) / static_cast<double>(size_));
    }
  }
  return all;
}

std::vector<Value> Sample::at(std::int64_t index) const {
  assert(index >= 0 && index < size_);
  const std::size_t keys = study_->vary.size();
  std::vector<Value> values(keys);
  const auto drawn = is_drawn(study_->kind) ? shares(index) : std::vector<double>();
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
      default:
        values[k] = drawn_value(vary, drawn[k]);
    }
  }
  return values;
}

PointScenes::PointScenes(const Study& study, std::span<const std::string> overrides)
    : study_(&study), sample_(study), variants_(study.scene, joined(study.overrides, overrides)) {
  std::vector<scene::Diagnostic> twice;
  for (const std::string& text : overrides) {
    const std::string key = scene::override_key(text);
    if (!study.varies(key)) continue;
    twice.push_back({scene::kOverrideFile, 0, key, "varies in the study; set another key"});
  }
  if (!twice.empty()) throw scene::SceneError(std::move(twice));
}

std::vector<std::string> changes_of(const Study& study, const std::vector<Value>& values) {
  std::vector<std::string> changes;
  for (std::size_t k = 0; k < values.size(); ++k) {
    changes.push_back(study.vary[k].key + "=" + values[k].text);
    for (const std::string& key : study.vary[k].also) changes.push_back(key + "=" + values[k].text);
  }
  return changes;
}

scene::Scene PointScenes::scene_at(std::int64_t index, bool with_text) const {
  return variants_.scene(changes_of(*study_, sample_.at(index)), with_text);
}

scene::Scene PointScenes::with_value(double value) const {
  return variants_.scene(changes_of(*study_, {Value{fmt::format("{}", value), value}}), false);
}

void PointScenes::check() const {
  std::optional<scene::SceneError> first;
  for (const std::int64_t index : {std::int64_t{0}, sample_.size() / 2, sample_.size() - 1}) {
    try {
      prepare(at(index));
      return;
    } catch (const scene::SceneError& error) {
      if (!first) first = error;
    }
  }
  throw *first;
}

std::string reason_of(const scene::SceneError& error) {
  std::string text;
  for (scene::Diagnostic d : error.diagnostics()) {
    // Errors in overrides come from the row's own values; for the scene, its file name and line are
    // enough.
    d.file = d.file == scene::kOverrideFile ? std::string()
                                            : std::filesystem::path(d.file).filename().string();
    text += (text.empty() ? "" : "; ") + scene::to_string(d);
  }
  return text;
}

}  // namespace rotorub::sweep
