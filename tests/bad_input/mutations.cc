#include "tests/bad_input/mutations.h"
#include "tests/bad_input/odd_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <vector>

namespace rotorub::test {
namespace {

struct Span {
  std::size_t begin = 0, end = 0;
  bool empty() const { return begin == end; }
};

bool is_number_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+' ||
         c == '_';
}

// Words that begin as numbers do, outside comments and keys.
std::vector<Span> numbers(const std::string& text) {
  std::vector<Span> all;
  bool value = false, comment = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') value = comment = false;
    if (c == '#') comment = true;
    if (c == '=' || c == ',') value = true;
    const bool starts = std::isdigit(static_cast<unsigned char>(c)) || c == '-';
    const bool inside = i > 0 && is_number_character(text[i - 1]);
    if (!value || comment || !starts || inside) continue;
    std::size_t end = i;
    while (end < text.size() && is_number_character(text[end])) ++end;
    all.push_back({i, end});
    i = end - 1;
  }
  return all;
}

std::vector<Span> lines(const std::string& text) {
  std::vector<Span> all;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    all.push_back({begin, end});
    begin = end;
  }
  return all;
}

std::string part(const std::string& text, Span span) {
  return text.substr(span.begin, span.end - span.begin);
}

void replace(std::string& text, Span span, const std::string& with) {
  text.replace(span.begin, span.end - span.begin, with);
}

// The lines `key = value`.
std::vector<Span> assignments(const std::string& text) {
  std::vector<Span> all;
  for (const Span line : lines(text)) {
    const std::string words = part(text, line);
    if (words[0] != '#' && words.find('=') != std::string::npos) all.push_back(line);
  }
  return all;
}

// A section reaches from one header to the next.
std::vector<Span> tables(const std::string& text) {
  std::vector<Span> all;
  for (const Span line : lines(text)) {
    if (text[line.begin] == '[' || all.empty()) all.push_back(line);
    all.back().end = line.end;
  }
  return all;
}

// A mutation leaves the text unchanged if it finds nothing to change.
Span one_of(const std::vector<Span>& all, Random& random) {
  return all.empty() ? Span{} : random.of(all);
}

void set_value(std::string& text, Random& random, const std::string& value) {
  const Span line = one_of(assignments(text), random);
  if (line.empty()) return;
  const std::size_t equals = text.find('=', line.begin);
  replace(text, {equals + 1, line.end}, " " + value + "\n");
}

void number(std::string& text, Random& random) {
  const Span place = one_of(numbers(text), random);
  if (!place.empty()) replace(text, place, random.of(kNumbers));
}

void scaled_number(std::string& text, Random& random) {
  const Span place = one_of(numbers(text), random);
  if (place.empty()) return;
  constexpr std::array kScales{"e3",   "e-3", "e6",   "e-6",  "e12",
                               "e-12", "e30", "e-30", "e150", "e300"};
  std::string digits = part(text, place);
  digits.resize(std::min(digits.find_first_of("eE"), digits.size()));
  replace(text, place, (random.below(4) == 0 ? "-" : "") + digits + random.of(kScales));
}

void unit(std::string& text, Random& random) {
  set_value(text, random, std::string("\"") + random.of(kNumbers) + " " + random.of(kUnits) + "\"");
}

void type(std::string& text, Random& random) { set_value(text, random, random.of(kTypes)); }

void long_text(std::string& text, Random& random) {
  set_value(text, random, "\"" + std::string(std::size_t{1} << (8 + random.below(13)), 'a') + "\"");
}

void escape_code(std::string& text, Random& random) {
  const std::string code = random.of(kCodes);
  switch (random.below(4)) {
    case 0:
      return set_value(text, random, "\"\\u001b[31m\\u202e\"");  // as TOML allows it
    case 1:
      return set_value(text, random, "\"" + code + "\"");
    case 2:
      return void(text.insert(random.below(text.size() + 1), "\n\"\\u001b[31mkey\" = 1\n"));
    default:
      text.insert(random.below(text.size() + 1), code);
  }
}

void delete_line(std::string& text, Random& random) {
  replace(text, one_of(lines(text), random), "");
}

void duplicate_line(std::string& text, Random& random) {
  const Span line = one_of(lines(text), random);
  text.insert(line.end, part(text, line));
}

void delete_table(std::string& text, Random& random) {
  replace(text, one_of(tables(text), random), "");
}

void duplicate_table(std::string& text, Random& random) {
  text += "\n" + part(text, one_of(tables(text), random));
}

void swap_lines(std::string& text, Random& random) {
  const auto all = lines(text);
  if (all.size() < 2) return;
  Span a = random.of(all), b = random.of(all);
  if (a.begin > b.begin) std::swap(a, b);
  if (a.begin == b.begin) return;
  const std::string first = part(text, a), second = part(text, b);
  replace(text, b, first);
  replace(text, a, second);
}

void misspell(std::string& text, Random& random) {
  const Span line = one_of(assignments(text), random);
  if (line.empty()) return;
  const std::size_t at = line.begin + random.below(text.find('=', line.begin) - line.begin);
  if (random.below(2) == 0) {
    text.erase(at, 1);
  } else {
    text.insert(at, 1, static_cast<char>('a' + random.below(26)));
  }
}

void list_length(std::string& text, Random& random) {
  std::vector<Span> commas;
  for (const Span line : assignments(text)) {
    for (std::size_t i = line.begin; i < line.end; ++i) {
      if (text[i] == ',' || text[i] == ']') commas.push_back({i, i + 1});
    }
  }
  const Span at = one_of(commas, random);
  if (at.empty()) return;
  if (random.below(2) == 0)
    return void(text.insert(at.begin, std::string(", ") + random.of(kNumbers)));
  std::size_t begin = at.begin;  // the item before it goes
  while (begin > 0 && text[begin - 1] != ',' && text[begin - 1] != '[' && text[begin - 1] != '\n')
    --begin;
  replace(text, {begin, text[at.begin] == ',' ? at.end : at.begin}, "");
}

void truncate(std::string& text, Random& random) { text.resize(random.below(text.size() + 1)); }

void overwrite_bytes(std::string& text, Random& random) {
  for (std::size_t n = 1 + random.below(8); n > 0 && !text.empty(); --n) {
    text[random.below(text.size())] = static_cast<char>(random.below(256));
  }
}

void insert_bytes(std::string& text, Random& random) {
  std::string bytes;
  for (std::size_t n = 1 + random.below(64); n > 0; --n)
    bytes += static_cast<char>(random.below(256));
  text.insert(random.below(text.size() + 1), bytes);
}

void nest(std::string& text, Random& random) {
  const std::size_t depth = std::size_t{1} << (1 + random.below(14));
  constexpr std::array<std::pair<const char*, const char*>, 2> kBrackets{
      {{"[", "]"}, {"{a = ", "}"}}};
  const auto& [open, close] = random.of(kBrackets);
  std::string value;
  for (std::size_t i = 0; i < depth; ++i) value += open;
  value += "1";
  for (std::size_t i = 0; i < depth; ++i) value += close;
  set_value(text, random, value);
}

void other_lines(std::string& text, Random& random) {
  constexpr std::array kEnds{"\r\n", "\r", "\n\n", " \\\n", "\f\n"};
  const std::string end = random.of(kEnds);
  std::string changed = random.below(3) == 0 ? "\xef\xbb\xbf" : "";
  for (const char c : text) changed += c == '\n' ? end : std::string(1, c);
  text = changed;
}

using Mutation = void (*)(std::string&, Random&);
struct Named {
  const char* name;
  Mutation mutation;
  std::size_t weight;
};
constexpr std::array kMutations{
    Named{"number", number, 12},
    Named{"scaled number", scaled_number, 8},
    Named{"unit", unit, 4},
    Named{"type", type, 4},
    Named{"long text", long_text, 1},
    Named{"escape code", escape_code, 3},
    Named{"deleted line", delete_line, 4},
    Named{"line twice", duplicate_line, 1},
    Named{"deleted table", delete_table, 3},
    Named{"table twice", duplicate_table, 2},
    Named{"swapped lines", swap_lines, 2},
    Named{"misspelt", misspell, 1},
    Named{"length of a list", list_length, 3},
    Named{"cut", truncate, 1},
    Named{"bytes", overwrite_bytes, 1},
    Named{"inserted bytes", insert_bytes, 1},
    Named{"nesting", nest, 1},
    Named{"line ends", other_lines, 1},
};

const Named& one_of_all(Random& random) {
  std::size_t sum = 0;
  for (const Named& m : kMutations) sum += m.weight;
  std::size_t at = random.below(sum);
  for (const Named& m : kMutations) {
    if (at < m.weight) return m;
    at -= m.weight;
  }
  return kMutations[0];
}

}  // namespace

std::string odd_value(Random& random) {
  switch (random.below(4)) {
    case 0:
      return random.of(kTypes);
    case 1:
      return std::string(random.of(kNumbers)) + " " + random.of(kUnits);
    case 2:
      return random.of(kCodes);
    default:
      return random.of(kNumbers);
  }
}

std::string mutated(std::string text, std::span<const std::string> donors, Random& random,
                    std::string& what) {
  constexpr std::array<std::size_t, 5> kHowMany{1, 1, 1, 2, 3};
  for (std::size_t n = random.of(kHowMany); n > 0; --n) {
    what += what.empty() ? "" : ", ";
    if (!donors.empty() && random.below(10) == 0) {
      const std::string& donor = random.of(donors);
      text += "\n" + part(donor, one_of(tables(donor), random));
      what += "table of another";
    } else {
      const Named& m = one_of_all(random);
      m.mutation(text, random);
      what += m.name;
    }
  }
  return text;
}

}  // namespace rotorub::test
