#include "compare/tune/choice.h"

#include <algorithm>
#include <cmath>

namespace rotorub::tune {
namespace {

using Settings = std::vector<JudgedSetting>;

std::optional<std::size_t> cheapest_trusted(const Settings& all) {
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!all[k].is_trusted() || !all[k].cost()) continue;
    if (!best || *all[k].cost() < *all[*best].cost()) best = k;
  }
  return best;
}

// Those that cost less than `limit` and ran to their end, the dearest first.
std::vector<std::size_t> below(const Settings& all, double limit) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto cost = all[k].cost();
    if (cost && *cost < limit && all[k].failure.empty()) found.push_back(k);
  }
  std::stable_sort(found.begin(), found.end(),
                   [&](std::size_t a, std::size_t b) { return *all[a].cost() > *all[b].cost(); });
  return found;
}

double worst(const JudgedSetting& setting) {
  const auto far = outside(setting.figures);
  return far.empty() ? 0.0 : std::abs(far.front().deviation);
}

std::optional<std::size_t> nearest(const Settings& all) {
  std::optional<std::size_t> best;
  const auto nearer = [](const JudgedSetting& a, const JudgedSetting& b) {
    const std::size_t m = a.wrong().size(), n = b.wrong().size();
    return m != n ? m < n : worst(a) < worst(b);
  };
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!all[k].failure.empty()) continue;
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
  if (!choice.trusted) {
    choice.nearest = nearest(all);
    return choice;
  }
  std::vector<scene::ContactModel> met;
  for (const std::size_t k : below(all, *all[*choice.trusted].cost())) {
    if (!choice.next_cheaper) choice.next_cheaper = k;
    const auto contact = all[k].setting.contact;
    if (std::find(met.begin(), met.end(), contact) != met.end()) continue;
    met.push_back(contact);
    choice.cheaper_by_contact.push_back(k);
  }
  return choice;
}

}  // namespace rotorub::tune
