#include "compare/tune/scene_text.h"

#include <fmt/format.h>

#include <optional>
#include <sstream>
#include <string_view>

#include "native_model/scene/reader.h"

namespace rotorub::tune {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// Where a comment begins that is in no string; npos: nowhere.
std::size_t comment_of(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote == '"' && c == '\\') {
      ++i;
    } else if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      return i;
    }
  }
  return std::string_view::npos;
}

std::string_view without_comment(std::string_view line) {
  return trimmed(line.substr(0, comment_of(line)));
}

bool is_header(std::string_view line) { return trimmed(line).starts_with('['); }

using Lines = std::vector<std::string>;

// Lines of a table, its header not among them.
struct Table {
  std::size_t first = 0, last = 0;
};
std::optional<Table> find_table(const Lines& lines, const std::string& name) {
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (without_comment(lines[k]) != "[" + name + "]") continue;
    Table table{k + 1, k + 1};
    while (table.last < lines.size() && !is_header(lines[table.last])) ++table.last;
    return table;
  }
  return std::nullopt;
}

std::optional<std::size_t> find_key(const Lines& lines, const Table& table,
                                    const std::string& key) {
  for (std::size_t k = table.first; k < table.last; ++k) {
    const std::string_view line = without_comment(lines[k]);
    const std::size_t equals = line.find('=');
    if (equals != std::string_view::npos && trimmed(line.substr(0, equals)) == key) return k;
  }
  return std::nullopt;
}

void put(Lines& lines, const KeyValue& entry) {
  const std::string text = entry.key + " = " + entry.value;
  const bool wanted = !entry.is_default && !entry.value.empty();
  auto table = find_table(lines, entry.table);
  if (!table) {
    if (!wanted) return;
    if (!lines.empty() && !trimmed(lines.back()).empty()) lines.emplace_back();
    lines.push_back("[" + entry.table + "]");
    lines.push_back(text);
    return;
  }
  const auto at = [](std::size_t k) { return static_cast<std::ptrdiff_t>(k); };
  if (const auto line = find_key(lines, *table, entry.key)) {
    if (entry.value.empty()) {
      lines.erase(lines.begin() + at(*line));
      return;
    }
    const std::size_t comment = comment_of(lines[*line]);
    lines[*line] = text + (comment == std::string::npos ? "" : "  " + lines[*line].substr(comment));
    return;
  }
  // Behind the last line of the table that says something: what follows may be the next one's.
  std::size_t end = table->first;
  for (std::size_t k = table->first; k < table->last; ++k) {
    if (!without_comment(lines[k]).empty()) end = k + 1;
  }
  if (wanted) lines.insert(lines.begin() + at(end), text);
}

bool reads_as(const std::string& toml, const std::string& name, const Setting& setting) {
  try {
    const scene::Scene scene = scene::parse_scene(toml, name);
    const bool soft = setting.contact != scene::ContactModel::kRigid;
    return scene.run.step == setting.step && scene.mujoco.contact == setting.contact &&
           scene.run.integrator == scene::Integrator::kEvent &&
           scene.mujoco.integrator == setting.integrator &&
           (!soft || (scene.mujoco.solver == setting.solver &&
                      scene.mujoco.solref_stiffness == setting.stiffness));
  } catch (const scene::SceneError&) {
    return false;
  }
}

}  // namespace

std::string with_values(const std::string& toml, const std::vector<KeyValue>& values) {
  Lines lines;
  std::istringstream in(toml);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  for (const KeyValue& entry : values) put(lines, entry);
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

TunedText tuned_text(const std::string& toml, const std::string& name, const Setting& setting) {
  std::vector<KeyValue> values = key_values(setting);
  values.push_back({"run", "integrator", "\"event\"", true});
  TunedText tuned{with_values(toml, values)};
  if (reads_as(tuned.text, name, setting)) return tuned;
  std::vector<std::string> further;
  for (const KeyValue& v : values) {
    further.push_back(fmt::format("{}.{}={}", v.table, v.key, v.value.empty() ? "none" : v.value));
  }
  return {scene::parse_scene(toml, name, further).text, false};
}

}  // namespace rotorub::tune
