#include "compare/tune/choice.h"

#include <algorithm>
#include <cmath>

#include "native_model/scene/scene.h"

namespace rotorub::tune {
namespace {

using Settings = std::vector<JudgedSetting>;

using Of = std::optional<scene::ContactModel>;  // empty: any model
bool is_of(const JudgedSetting& setting, Of contact) {
  return !contact || setting.setting.contact == *contact;
}

std::optional<std::size_t> cheapest_trusted(const Settings& all, Of contact = {}) {
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!is_of(all[k], contact) || !all[k].is_trusted() || !all[k].cost()) continue;
    if (!best || *all[k].cost() < *all[*best].cost()) best = k;
  }
  return best;
}

// The most expensive setting that costs less than `limit` and ran to its end.
std::optional<std::size_t> below(const Settings& all, double limit) {
  std::optional<std::size_t> found;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto cost = all[k].cost();
    if (!cost || *cost >= limit || !all[k].failure.empty()) continue;
    if (!found || *cost > *all[*found].cost()) found = k;
  }
  return found;
}

// The number of figures of a kind that are outside, and their largest deviation.
std::pair<std::size_t, double> wrong_by(const JudgedSetting& setting, Judged kind) {
  std::pair<std::size_t, double> wrong{0, 0.0};
  for (const JudgedFigure& f : outside(setting.figures)) {
    if (f.figure->judged != kind) continue;
    ++wrong.first;
    wrong.second = std::max(wrong.second, std::abs(f.deviation));
  }
  return wrong;
}

// Compares averages first, because a single moment may be off by any factor.
bool nearer(const JudgedSetting& a, const JudgedSetting& b) {
  const auto key = [](const JudgedSetting& s) {
    return std::pair(wrong_by(s, Judged::kAverage), wrong_by(s, Judged::kPeak));
  };
  return key(a) < key(b);
}

std::optional<std::size_t> nearest(const Settings& all, Of contact = {}) {
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!is_of(all[k], contact) || !all[k].failure.empty()) continue;
    if (!best || nearer(all[k], all[*best])) best = k;
  }
  return best;
}

}  // namespace

std::optional<double> JudgedSetting::cost() const {
  if (us_per_step <= 0.0) return std::nullopt;
  return 1e-6 * us_per_step / setting.step;
}

std::vector<std::string> JudgedSetting::wrong() const {
  if (!failure.empty()) return {"run"};
  std::vector<std::string> keys;
  for (const JudgedFigure& f : outside(figures)) keys.push_back(f.figure->key);
  if (keys.empty() && !luck.empty()) keys.push_back("half_step");
  return keys;
}

Choice choose(const Settings& all) {
  Choice choice;
  choice.trusted = cheapest_trusted(all);
  for (const auto& [contact, word] : scene::kContactModels) {
    std::optional<std::size_t> best = cheapest_trusted(all, contact);
    if (!best) best = nearest(all, contact);
    if (best) choice.best_by_contact.push_back(*best);
  }
  if (!choice.trusted) {
    choice.nearest = nearest(all);
    return choice;
  }
  choice.next_cheaper = below(all, *all[*choice.trusted].cost());
  return choice;
}

}  // namespace rotorub::tune
