#include "compare/check/metric.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/figures/figure.h"
#include "compare/metrics/metrics.h"
#include "compare/run_files/summary.h"
#include "native_model/scene/diagnostic.h"

namespace rotorub::check {
namespace {

using nlohmann::json;

constexpr std::array kEventKinds{EventKind::kImpact, EventKind::kSlide, EventKind::kStick,
                                 EventKind::kLiftOff, EventKind::kReverse};

// The rest of `metric` after `prefix`; empty if it begins otherwise.
std::optional<std::string> after(const std::string& metric, const std::string& prefix) {
  if (!metric.starts_with(prefix)) return std::nullopt;
  return metric.substr(prefix.size());
}

json residuals(const scene::Scene& scene, const Trajectory& trajectory) {
  return residuals_json(largest_residuals(trajectory, contact_facts(scene)));
}

// null counts as a number, because a run may lack the value.
std::vector<std::string> numbers_of(const json& object, const std::string& before = {}) {
  std::vector<std::string> names;
  for (const auto& [key, value] : object.items()) {
    if (value.is_number() || value.is_null()) names.push_back(before + key);
  }
  return names;
}

[[noreturn]] void refuse(const std::string& metric, const std::vector<std::string>& accepted) {
  const std::vector<std::string_view> words(accepted.begin(), accepted.end());
  throw NoSuchMetric(fmt::format("there is no `{}`{}", metric, scene::suggestion(metric, words)));
}

const std::vector<double>& column(const std::string& metric, const std::string& name,
                                  const Trajectory& trajectory) {
  if (trajectory.has(name)) return trajectory.column(name);
  const std::string before = metric.substr(0, metric.size() - name.size());
  std::vector<std::string> names;
  for (const Column& c : trajectory.series) names.push_back(before + c.name);
  refuse(metric, names);
}

double number_of(const json& object, const std::string& key, const std::string& metric) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number())
    refuse(metric, numbers_of(object, metric.substr(0, metric.size() - key.size())));
  return found->get<double>();
}

// Over the rows at equal times. Both lists ascend, and every engine returns a requested time
// exactly.
double largest_difference(const std::string& metric, const std::string& name, const Trajectory& a,
                          const Trajectory& b) {
  const auto &ta = a.column("t"), &tb = b.column("t");
  const auto &xa = column(metric, name, a), &xb = column(metric, name, b);
  double largest = 0.0;
  for (std::size_t i = 0, j = 0; i < ta.size() && j < tb.size();) {
    if (ta[i] == tb[j]) {
      const double apart = std::abs(xa[i++] - xb[j++]);
      if (!(apart <= largest)) largest = apart;  // stays NaN
    } else {
      (ta[i] < tb[j] ? i : j) += 1;
    }
  }
  return largest;
}

std::int64_t count_of(const std::string& metric, const std::string& name,
                      const Trajectory& trajectory) {
  std::vector<std::string> names;
  for (const EventKind kind : kEventKinds) {
    if (name == to_string(kind)) {
      return std::count_if(trajectory.events.begin(), trajectory.events.end(),
                           [&](const Event& e) { return e.kind == kind; });
    }
    names.push_back("count." + std::string(to_string(kind)));
  }
  refuse(metric, names);
}

}  // namespace

bool needs_reference(const std::string& metric) { return metric.starts_with(kErrorPrefix); }

void check_name(const std::string& metric) {
  if (after(metric, kErrorPrefix) || after(metric, "end.") || after(metric, "largest.")) return;
  // Names do not depend on values, so an empty run has them all.
  if (const auto name = after(metric, "count.")) {
    count_of(metric, *name, {});
  } else if (const auto residual = after(metric, "residual.")) {
    number_of(residuals_json({}), *residual, metric);
  } else {
    const json numbers = metrics_json({});
    if (numbers.contains(metric) && !numbers[metric].is_structured()) return;
    std::vector<std::string> names = numbers_of(numbers);
    names.insert(names.end(), {"error.<column>", "end.<column>", "largest.<column>",
                               "residual.<name>", "count.<event>"});
    refuse(metric, names);
  }
}

double measure(const std::string& metric, const scene::Scene& scene, const Trajectory& trajectory,
               const Trajectory* reference) {
  if (const auto name = after(metric, kErrorPrefix)) {
    if (reference == nullptr) throw std::invalid_argument(metric + " without a reference");
    return largest_difference(metric, *name, trajectory, *reference);
  }
  if (const auto name = after(metric, "end.")) {
    const std::vector<double>& values = column(metric, *name, trajectory);
    return values.empty() ? std::nan("") : values.back();
  }
  if (const auto name = after(metric, "largest.")) {
    double largest = 0.0;
    for (const double value : column(metric, *name, trajectory)) {
      if (!(std::abs(value) <= largest)) largest = std::abs(value);  // stays NaN
    }
    return largest;
  }
  if (const auto name = after(metric, "count.")) {
    return static_cast<double>(count_of(metric, *name, trajectory));
  }
  if (const auto name = after(metric, "residual.")) {
    return number_of(residuals(scene, trajectory), *name, metric);
  }
  return number_of(run_numbers_json(scene, trajectory), metric, metric);
}

}  // namespace rotorub::check
