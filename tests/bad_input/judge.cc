#include "tests/bad_input/judge.h"

#include <signal.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "native_model/scene/text.h"
#include "tests/bad_input/files.h"

namespace rotorub::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kInput = "kept/";              // what the command was given, mutated
constexpr std::size_t kLongestMessage = 16u << 10u;  // bytes

// True if `printable` changes no line of the text; it changes terminal codes and invalid UTF-8.
bool shows_plainly(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::replace(line.begin(), line.end(), '\t', ' ');
    if (scene::printable(line, line.size()) != line) return false;
  }
  return true;
}

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '"'; }

// "nan" or "inf" as a word outside quotes.
bool has_no_number(const std::string& text) {
  constexpr std::array kWords{"nan", "inf", "NaN", "Infinity"};
  for (const char* word : kWords) {
    const std::size_t length = std::strlen(word);
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
      const bool begins = at == 0 || !is_word(text[at - 1]);
      const bool ends = at + length >= text.size() || !is_word(text[at + length]);
      if (begins && ends) return true;
    }
  }
  return false;
}

// The JSON without its strings, because strings may contain words such as "nan".
std::string without_strings(const std::string& json) {
  std::string bare;
  bool inside = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    if (inside && json[i] == '\\') {
      ++i;
    } else if (json[i] == '"') {
      inside = !inside;
    } else if (!inside) {
      bare += json[i];
    }
  }
  return bare;
}

// The MJCF without the scene's own text.
std::string without_custom(const std::string& xml) {
  const std::size_t begin = xml.find("<custom>"), end = xml.find("</custom>");
  return begin < end && end != std::string::npos ? xml.substr(0, begin) + xml.substr(end) : xml;
}

void judge_file(const fs::path& file, const std::string& name, std::vector<std::string>& wrong) {
  const std::string extension = file.extension().string();
  if (name.find(".part") != std::string::npos) wrong.push_back("half a file is left: " + name);
  if (extension == ".csv" && has_no_number(text_of(file))) wrong.push_back("no number in " + name);
  if (extension == ".xml" && has_no_number(without_custom(text_of(file))))
    wrong.push_back("no number in " + name);
  if (extension != ".json") return;
  const std::string text = text_of(file);
  if (!nlohmann::json::accept(text)) wrong.push_back("no JSON: " + name);
  if (has_no_number(without_strings(text))) wrong.push_back("no number in " + name);
}

// A table of results has one line per row, with as many fields as its header.
void judge_table(const fs::path& file, const std::string& name, std::vector<std::string>& wrong) {
  std::istringstream lines(text_of(file));
  std::size_t fields = 0, row = 0;
  for (std::string line; std::getline(lines, line); ++row) {
    const std::string bare = without_strings(line);
    const auto here = static_cast<std::size_t>(std::count(bare.begin(), bare.end(), ',')) + 1;
    if (row == 0) fields = here;
    if (here == fields) continue;
    wrong.push_back(name + " has lines of different lengths");
    return;
  }
}

// Expects `scene.toml:7: rotor.speed: reason`; line or key may be missing.
bool names_the_place(const std::string& message, const std::string& input) {
  const std::size_t at = message.find(input);
  if (at == std::string::npos) return false;
  return message.find(": ", at) != std::string::npos;
}

}  // namespace

std::vector<std::string> faults(const Command& command, const Ended& ended,
                                const fs::path& folder) {
  std::vector<std::string> wrong;
  if (ended.signal == SIGXCPU || ended.signal == SIGALRM) {
    wrong.push_back(std::string("did not end in its ") +
                    (ended.signal == SIGALRM ? "time" : "processor time"));
  } else if (ended.signal != 0) {
    wrong.push_back(std::string("ended by a signal: ") + strsignal(ended.signal));
  } else if (std::find(command.codes.begin(), command.codes.end(), ended.code) ==
             command.codes.end()) {
    wrong.push_back("exit code " + std::to_string(ended.code));
  }
  if (ended.code > 1 && ended.err.empty()) wrong.push_back("failed without a word");
  if (ended.code == 1 && ended.err.empty() && ended.out.empty())
    wrong.push_back("failed without a word");
  if (ended.code == 2 && !names_the_place(ended.err, command.input))
    wrong.push_back("a refusal names no place");
  if (ended.code == 2 && !ended.out.empty()) wrong.push_back("a refusal on standard output");
  if (ended.err.size() > kLongestMessage)
    wrong.push_back("a message of " + std::to_string(ended.err.size()) + " bytes");
  if (ended.err.find("bad_alloc") != std::string::npos) wrong.push_back("memory ran out");
  if (!shows_plainly(ended.err)) wrong.push_back("standard error has what a terminal obeys");
  if (!shows_plainly(ended.out)) wrong.push_back("standard output has what a terminal obeys");
  const bool json =
      std::find(command.words.begin(), command.words.end(), "--json") != command.words.end();
  if (json && ended.code == 0 && !nlohmann::json::accept(ended.out))
    wrong.push_back("no JSON on standard output");
  if (has_no_number(without_strings(without_custom(ended.out))))
    wrong.push_back("no number on standard output");
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    if (!entry.is_regular_file() || name.starts_with(kInput)) continue;
    judge_file(entry.path(), name, wrong);
    if (name.ends_with("results.csv")) judge_table(entry.path(), name, wrong);
  }
  return wrong;
}

}  // namespace rotorub::test
