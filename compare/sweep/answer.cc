#include "compare/sweep/answer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <utility>

#include "compare/base/format.h"

namespace rotorub::sweep {
namespace {

using Numbers = std::vector<std::optional<double>>;  // of each key, SI; empty for words

// A point that has settled to an attractor.
struct Settlement {
  std::int64_t point = 0;
  std::string attractor;
  Numbers values;
};

// The points of one attractor among all.
class Region {
 public:
  Region(const Study& study, const std::vector<Settlement>& all, const std::string& attractor)
      : study_(study), all_(all), attractor_(attractor) {
    for (const Settlement& s : all)
      if (is_inside(&s)) inside_.push_back(&s);
  }
  bool empty() const { return inside_.empty(); }

  std::string text() const {
    if (inside_.size() == all_.size()) return attractor_ + " everywhere";
    for (std::size_t k = study_.vary.size(); k-- > 0;) {
      for (const bool is_upper : {true, false}) {
        const std::string bounded = bounded_text(k, is_upper);
        if (!bounded.empty()) return bounded;
      }
    }
    std::vector<std::string> ranges;
    for (std::size_t k = 0; k < study_.vary.size(); ++k) {
      if (auto range = range_text(k); !range.empty()) ranges.push_back(std::move(range));
    }
    return fmt::format("{} at {} of {} points{}{}", attractor_, inside_.size(), all_.size(),
                       ranges.empty() ? "" : ": ", fmt::join(ranges, ", "));
  }

 private:
  using Line = std::vector<const Settlement*>;  // the points of a grid along one key

  bool is_inside(const Settlement* s) const { return s->attractor == attractor_; }

  // The lines along key k, by the first point that they would have.
  std::map<std::int64_t, Line> lines_along(std::size_t k) const {
    std::int64_t stride = 1;
    for (std::size_t j = k + 1; j < study_.vary.size(); ++j) stride *= study_.vary[j].count;
    std::map<std::int64_t, Line> lines;
    for (const Settlement& s : all_)
      lines[s.point - s.point / stride % study_.vary[k].count * stride].push_back(&s);
    return lines;
  }

  // "bouncing from contact friction 0.2 up, at every rotor speed"; empty if the region has
  // another form. is_upper: it lies above its bound.
  std::string bounded_text(std::size_t k, bool is_upper) const {
    if (study_.kind != SampleKind::kGrid || !study_.vary[k].has_numbers()) return "";
    const Settlement *least = nullptr, *most = nullptr;
    bool is_cut = false, is_over = false, is_partial = false;
    for (auto& [first, line] : lines_along(k)) {
      if (!is_upper) std::ranges::reverse(line);
      const auto begin =
          std::ranges::find_if(line, [&](const Settlement* s) { return is_inside(s); });
      if (begin == line.end()) {
        is_partial = true;
        is_over = least != nullptr;
        continue;
      }
      // A second stretch of lines, or a second piece of a line.
      if (is_over || !std::all_of(begin, line.end(), [&](auto* s) { return is_inside(s); }))
        return "";
      is_cut = is_cut || begin != line.begin();
      if (!least || (*begin)->values[k] < least->values[k]) least = *begin;
      if (!most || (*begin)->values[k] > most->values[k]) most = *begin;
    }
    if (!is_cut || (is_partial && study_.vary.size() > 2)) return "";
    const auto [from, to] = std::pair(*least->values[k], *most->values[k]);
    const Vary& vary = study_.vary[k];
    std::string text = fmt::format(
        "{} {} {} {}", attractor_, is_upper ? "from" : "up to", key_in_words(vary.key),
        from == to ? usual_text(from, vary.unit)
                   : fmt::format("{:.4g} to {}", from * usual_unit(to, vary.unit).per_si,
                                 usual_text(to, vary.unit)));
    if (is_upper) text += " up";
    std::vector<std::string> others;
    for (std::size_t j = 0; j < study_.vary.size(); ++j)
      if (j != k) others.push_back(is_partial ? range_text(j) : key_in_words(study_.vary[j].key));
    if (others.empty()) return text;
    return text + fmt::format(", {} {}",
                              is_partial   ? "for"
                              : from == to ? "at every"
                                           : "depending on",
                              fmt::join(others, " and "));
  }

  // "rotor speed 35 Hz to 80 Hz"; empty if the key takes all its values here, or words.
  std::string range_text(std::size_t k) const {
    if (!study_.vary[k].has_numbers()) return "";
    const auto number = [k](const Settlement& s) { return s.values[k]; };
    const auto of_inside = [&](const Settlement* s) { return number(*s); };
    const auto [low, high] = std::ranges::minmax(inside_, {}, of_inside);
    const auto [least, most] = std::ranges::minmax_element(all_, {}, number);
    if (number(*low) == number(*least) && number(*high) == number(*most)) return "";
    const Vary& vary = study_.vary[k];
    const std::string from = usual_text(*number(*low), vary.unit),
                      to = usual_text(*number(*high), vary.unit);
    return fmt::format("{} {}{}", key_in_words(vary.key), from, from == to ? "" : " to " + to);
  }

  const Study& study_;
  const std::vector<Settlement>& all_;
  const std::string attractor_;
  std::vector<const Settlement*> inside_{};
};

// Attractors with contact come first, the most dangerous before all others.
constexpr const char* kOrder[] = {"backward whip",   "rolling", "bouncing",   "forward rub",
                                  "synchronous rub", "resting", "no contact", "unknown"};

std::string attractors_sentence(const Study& study, const std::vector<Settlement>& all) {
  std::vector<std::string> clauses;
  for (const char* attractor : kOrder) {
    const Region region(study, all, attractor);
    if (!region.empty()) clauses.push_back(region.text());
  }
  std::string text = fmt::format("{}.", fmt::join(clauses, "; "));
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

std::string counts_sentence(Store& store) {
  const auto counts = store.count_by_status();
  const std::int64_t all = store.count();
  std::vector<std::string> others;
  for (const auto& [status, count] : counts)
    if (status != "ok") others.push_back(fmt::format("{} {}", count, status));
  if (others.empty()) return fmt::format("All {} points ran to their end.", all);
  const std::int64_t ok = counts.contains("ok") ? counts.at("ok") : 0;
  return fmt::format("{} of {} points ran to their end; {}.", ok, all, fmt::join(others, ", "));
}

}  // namespace

std::vector<std::string> answer_of(Store& store, const Study& study) {
  const auto names = store.names();
  const auto column = [&](const char* name) {
    return static_cast<int>(std::ranges::find(names, name) - names.begin());
  };
  const int impulse = column("peak_impulse"), attractor = column("attractor");
  const std::size_t keys = study.vary.size();
  const auto is_word = [](const Statement& row, int at) { return row.is_text(at); };
  std::vector<Settlement> all;
  double peak = 0.0;
  std::string hardest;
  store.each([&](const Statement& row) {
    if (!row.is_nothing(attractor)) {
      Settlement& s =
          all.emplace_back(Settlement{row.whole(0), row.text(attractor), Numbers(keys)});
      for (std::size_t k = 0; k < keys; ++k)
        if (const int at = static_cast<int>(k) + 1; !is_word(row, at)) s.values[k] = row.number(at);
    }
    if (row.is_nothing(impulse) || row.number(impulse) <= peak) return;
    peak = row.number(impulse);
    hardest = fmt::format("The largest impact is {:.4g} N s, at point {}:", peak, row.whole(0));
    for (std::size_t k = 0; k < keys; ++k) {
      const int at = static_cast<int>(k) + 1;
      hardest += fmt::format(
          "{} {} {}", k > 0 ? "," : "", key_in_words(study.vary[k].key),
          is_word(row, at) ? row.text(at) : usual_text(row.number(at), study.vary[k].unit));
    }
  });
  std::vector<std::string> sentences;
  if (!all.empty()) sentences.push_back(attractors_sentence(study, all));
  sentences.push_back(counts_sentence(store));
  if (!hardest.empty()) sentences.push_back(hardest + ".");
  return sentences;
}

}  // namespace rotorub::sweep
