// rotorub with bad input, as often as asked for: mutated scenes, options, studies and run folders.
//   rotorub_bad_input --first N --runs N     cases by number; exit code 1 if any goes wrong
//   rotorub_bad_input --first N --keep DIR   one case, its files kept

#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

#include "native_model/scene/text.h"
#include "tests/bad_input/cases.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace rotorub::test;
namespace fs = std::filesystem;

std::string spoken(const Command& command) {
  std::string text;
  for (const std::string& word : command.words) text += " " + rotorub::scene::printable(word, 200);
  return text;
}

// True if the case passed.
bool try_case(std::uint64_t number, const fs::path& folder) {
  fs::create_directories(folder);
  const Case c = make_case(number, folder);
  std::vector<std::string> words{ROTORUB_BINARY};
  words.insert(words.end(), c.command.words.begin(), c.command.words.end());
  const Ended ended = bounded_run(folder, words);
  const auto wrong = faults(c.command, ended, folder);
  if (wrong.empty()) return true;
  std::cout << "case " << number << ":" << spoken(c.command) << "\n  ("
            << rotorub::scene::printable(c.what, 300) << ")\n";
  for (const std::string& fault : wrong) std::cout << "  " << fault << "\n";
  std::cout << "  said: " << rotorub::scene::printable(ended.err, 400) << std::endl;
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t first = 0, runs = 1;
  std::string keep;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string_view word = argv[i];
    if (word == "--first") first = std::strtoull(argv[i + 1], nullptr, 10);
    if (word == "--runs") runs = std::strtoull(argv[i + 1], nullptr, 10);
    if (word == "--keep") keep = argv[i + 1];
  }
  const TemporaryFolder temporary;
  const fs::path top = keep.empty() ? temporary.path() : fs::path(keep);
  std::uint64_t failed = 0;
  for (std::uint64_t number = first; number < first + runs; ++number) {
    if (!try_case(number, top / "case")) ++failed;
    if (keep.empty()) fs::remove_all(top / "case");
  }
  std::cout << runs << " cases, " << failed << " went wrong\n";
  return failed == 0 ? 0 : 1;
}
