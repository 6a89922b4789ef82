// The faults of a scene, and the exception that reports all of them at once.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rotorub::scene {

// One problem.
struct Diagnostic {
  std::string file;    // as given by the caller; "--set" for an override
  int line = 0;        // from 1; 0: unknown
  std::string key;     // dotted, elements from 0: `rotor.disc[1].mass`; empty: the whole file
  std::string reason;  // what is wrong and what would be accepted
};

// `file:line: key: reason`, without the unknown parts, as one line that is safe on a terminal
// (printable() of text.h).
std::string to_string(const Diagnostic& diagnostic);

// Thrown for a scene that cannot be used. what() has one line per diagnostic, ordered by file and
// line, for the first hundred and at most 12 kB.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<Diagnostic> diagnostics);
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

// The candidate that `word` most likely misspells, or an empty view. Case is ignored. Up to a third
// of the letters may differ (at least one in words of three letters or more).
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

// How a message about an unknown word ends: ", did you mean `event`? Choose from event, verlet", or
// "; choose from event, verlet" if no word is near.
std::string suggestion(std::string_view word, std::span<const std::string_view> accepted);

// "a, b, c"
std::string join(std::span<const std::string_view> words);

}  // namespace rotorub::scene
