// What is wrong with a scene, and the exception that carries all of it at once.
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
  int line = 0;        // from 1; 0: no line
  std::string key;     // dotted, elements from 0: `rotor.disc[1].mass`; empty: the file as a whole
  std::string reason;  // what is wrong and what would be accepted
};

// `file:line: key: reason`, without the parts that are unknown; one line that a terminal can show
// (printable() of text.h).
std::string to_string(const Diagnostic& diagnostic);

// A scene that cannot be used. what() has one line per diagnostic (of the first
// hundred, and 12 kB), ordered by file and line.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<Diagnostic> diagnostics);
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

// The candidate that `word` was probably meant to be, or an empty view. Upper and lower case are
// the same; a third of the letters (at least one, for words of three letters or more) may differ.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

// "a, b, c"
std::string join(std::span<const std::string_view> words);

}  // namespace rotorub::scene
