#include "native_model/scene/diagnostic.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <tuple>
#include <utility>

#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

std::vector<Diagnostic> ordered(std::vector<Diagnostic> diagnostics) {
  std::stable_sort(diagnostics.begin(), diagnostics.end(),
                   [](const Diagnostic& a, const Diagnostic& b) {
                     return std::tie(a.file, a.line) < std::tie(b.file, b.line);
                   });
  return diagnostics;
}

// Longer messages help nobody. Limits of each part in bytes, of the number of problems and of the
// whole text in bytes.
constexpr std::size_t kLongestFile = 300, kLongestKey = 120, kLongestReason = 2000;
constexpr std::size_t kMostLines = 100, kLongestText = 12000;

std::string lines(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (std::size_t i = 0; i < diagnostics.size(); ++i) {
    if (i > 0) text += '\n';
    if (i == kMostLines || text.size() > kLongestText) {
      return text + "and " + std::to_string(diagnostics.size() - i) + " more";
    }
    text += to_string(diagnostics[i]);
  }
  return text;
}

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

// Optimal string alignment distance: insertions, deletions, substitutions and swaps of neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = std::exchange(above, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0u : 1u)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
          lower(a[i - 2]) == lower(b[j - 1])) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
  }
  return row[b.size()];
}

}  // namespace

std::string to_string(const Diagnostic& diagnostic) {
  std::string text = printable(diagnostic.file, kLongestFile);
  if (diagnostic.line > 0) text += ":" + std::to_string(diagnostic.line);
  if (!text.empty()) text += ": ";
  if (!diagnostic.key.empty()) text += printable(diagnostic.key, kLongestKey) + ": ";
  return text + printable(diagnostic.reason, kLongestReason);
}

SceneError::SceneError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(lines(ordered(diagnostics))), diagnostics_(ordered(diagnostics)) {}

std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates) {
  constexpr std::size_t kLongestWord = 64;  // longer words are not misspellings of ours
  if (word.size() > kLongestWord) return {};
  std::string_view best;
  std::size_t best_distance = word.size() < 3 ? 0 : std::max<std::size_t>(1, word.size() / 3);
  for (std::string_view candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance || (distance == best_distance && best.empty())) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string suggestion(std::string_view word, std::span<const std::string_view> accepted) {
  const std::string_view meant = nearest(word, accepted);
  const std::string how = meant.empty()
                              ? "; choose from "
                              : ", did you mean `" + std::string(meant) + "`? Choose from ";
  return how + join(accepted);
}

std::string join(std::span<const std::string_view> words) {
  std::string text;
  for (std::string_view word : words) {
    if (!text.empty()) text += ", ";
    text += word;
  }
  return text;
}

}  // namespace rotorub::scene
