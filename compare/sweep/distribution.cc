#include "compare/sweep/distribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/triangular.hpp>
#include <boost/math/distributions/weibull.hpp>
#include <boost/math/policies/policy.hpp>
#include <cmath>
#include <string_view>
#include <vector>

#include "native_model/scene/text.h"

namespace rotorub::sweep {
namespace {

// A kind of distribution and the names of its parameters in a study; empty: it has none.
struct Words {
  const char* word;
  const char* centre = "";
  const char* width = "";
  bool width_in_unit = false;
  bool bounded = false;   // needs `from` and `to`
  bool positive = false;  // of numbers above 0
};
// In the order of DistributionKind.
constexpr Words kWords[] = {
    {.word = "uniform", .bounded = true},
    {"normal", "mean", "deviation", true},
    {.word = "lognormal", .centre = "median", .width = "log_deviation", .positive = true},
    {.word = "triangular", .centre = "mode", .bounded = true},
    {.word = "weibull", .centre = "scale", .width = "shape", .positive = true}};

std::vector<std::string_view> all_words() {
  std::vector<std::string_view> all;
  for (const Words& w : kWords) all.emplace_back(w.word);
  return all;
}

const Words& words_of(DistributionKind kind) { return kWords[static_cast<std::size_t>(kind)]; }

// Boost must compute in double. The build supplies the functions that it calls (RotorubMath.cmake),
// so that a study has the same points on every computer.
using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

template <typename Law>
double truncated(const Law& law, const Distribution& d, double share) {
  const double low = std::isfinite(d.from) && d.from > support(law).first ? cdf(law, d.from) : 0.0;
  const double high = std::isfinite(d.to) ? cdf(law, d.to) : 1.0;
  constexpr double kLeast = 0x1p-53;
  const double inside = std::clamp(low + share * (high - low), kLeast, 1.0 - kLeast);
  return std::clamp(quantile(law, inside), d.from, d.to);
}

void check_ends(const StudyTable& table, const Distribution& d) {
  if (!(d.from < d.to)) return table.fail("to", "expected a value above `from`");
  if (d.kind == DistributionKind::kTriangular && (d.centre < d.from || d.centre > d.to))
    return table.fail("mode", "expected a value between `from` and `to`");
  const Words& w = words_of(d.kind);
  if (w.positive && !(d.centre > 0.0)) return table.fail(w.centre, "expected a value above 0");
  if (w.positive && !(d.to > 0.0)) table.fail("to", "expected a value above 0");
}

}  // namespace

double quantile(const Distribution& d, double share) {
  using namespace boost::math;
  switch (d.kind) {
    case DistributionKind::kNormal:
      return truncated(normal_distribution<double, Policy>(d.centre, d.width), d, share);
    case DistributionKind::kLognormal:
      return truncated(lognormal_distribution<double, Policy>(std::log(d.centre), d.width), d,
                       share);
    case DistributionKind::kTriangular:
      return truncated(triangular_distribution<double, Policy>(d.from, d.centre, d.to), d, share);
    case DistributionKind::kWeibull:
      return truncated(weibull_distribution<double, Policy>(d.width, d.centre), d, share);
    case DistributionKind::kUniform:
      break;
  }
  return std::clamp(d.from + share * (d.to - d.from), d.from, d.to);
}

void refuse_parameters(const StudyTable& table) {
  for (const Words& w : kWords) {
    for (const char* key : {w.centre, w.width}) {
      if (*key != '\0' && table.has(key))
        table.missing("distribution", "one of " + scene::join(all_words()));
    }
  }
}

std::optional<Distribution> read_distribution(const StudyTable& table,
                                              const scene::Quantity& quantity) {
  const auto kind = table.word<DistributionKind>("distribution", all_words());
  if (!kind) return std::nullopt;
  Distribution d;
  d.kind = *kind;
  bool whole = true;
  const auto read = [&](const char* key, const scene::Quantity& of, double& value, bool needed) {
    if (needed && !table.has(key)) {
      table.missing(key,
                    fmt::format("{}, of distribution = \"{}\"", of.name, words_of(d.kind).word));
    }
    const auto given = table.number(key, of);
    whole = whole && (given || (!needed && !table.has(key)));
    if (given) value = *given;
  };
  for (const Words& p : kWords) {
    const bool own = &p == &words_of(d.kind);
    for (const char* key : {p.centre, p.width}) {
      if (!own && *key != '\0' && table.has(key))
        table.fail(key, fmt::format("belongs to distribution = \"{}\"", p.word));
    }
    if (!own) continue;
    if (*p.centre != '\0') read(p.centre, quantity, d.centre, true);
    if (*p.width == '\0') continue;
    read(p.width, p.width_in_unit ? quantity : scene::kPure, d.width, true);
    if (whole && !(d.width > 0.0)) table.fail(p.width, "expected a number above 0");
    whole = whole && d.width > 0.0;
  }
  read("from", quantity, d.from, words_of(d.kind).bounded);
  read("to", quantity, d.to, words_of(d.kind).bounded);
  if (whole) check_ends(table, d);
  return whole ? std::optional(d) : std::nullopt;
}

}  // namespace rotorub::sweep
