#include "compare/sweep/folder.h"

#include <fstream>
#include <stdexcept>

#include "native_model/scene/reader.h"
#include "native_model/trajectory/output.h"

namespace rotorub::sweep {
namespace {

bool is_other(const std::filesystem::path& file, const std::string& text) {
  if (!std::filesystem::exists(file)) return false;
  const std::string there = scene::file_text(file);
  if (file.filename() != kStudyFile) return there != text;
  return study_identity(there) != study_identity(text);
}

std::string field_of(const Statement& row, int column) {
  if (row.is_nothing(column)) return {};
  if (row.is_text(column)) return row.text(column);
  return row.is_whole(column) ? std::to_string(row.whole(column)) : csv_number(row.number(column));
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

}  // namespace

std::string csv_number(const std::optional<double>& value) {
  std::string digits;
  if (value) append_number(digits, *value);
  return digits;
}

std::string csv_line(const std::vector<std::string>& texts) {
  std::string line;
  for (const std::string& text : texts) line += csv_field(text) + ',';
  line.back() = '\n';
  return line;
}

StudyIdentity identity_of(const PointScenes& scenes) {
  const std::string all = scenes.study().identity + '\0' + scenes.scene_text();
  return {scene::text_hash(all), scenes.sample().size()};
}

void keep_study(const std::filesystem::path& folder, const PointScenes& scenes) {
  std::filesystem::create_directories(folder);
  std::vector<std::pair<const char*, const std::string&>> files{{kStudyFile, scenes.study().text},
                                                                {kSceneFile, scenes.scene_text()}};
  if (!scenes.study().points.empty()) files.emplace_back(kPointsFile, scenes.study().points);
  for (const auto& [name, text] : files) {
    if (is_other(folder / name, text) && !result_files(folder).empty()) {
      throw StoreMismatch((folder / name).string() +
                          ": the folder holds results of another study (the study, its scene or "
                          "--set has changed); give another folder with -o");
    }
  }
  for (const auto& [name, text] : files) write_whole(folder / name, text);
}

// Written line by line, because the table may exceed the memory.
void write_csv(Store& store, const std::filesystem::path& file) {
  const std::filesystem::path aside = part_of(file);
  std::ofstream out(aside, std::ios::binary | std::ios::trunc);
  out << csv_line(store.names());
  std::vector<std::string> fields;
  store.each([&](const Statement& row) {
    fields.clear();
    for (int column = 0; column < row.columns(); ++column) fields.push_back(field_of(row, column));
    out << csv_line(fields);
  });
  out.close();
  if (!out) {
    std::error_code none;
    std::filesystem::remove(aside, none);
    throw std::runtime_error("cannot write " + file.string());
  }
  std::filesystem::rename(aside, file);
}

}  // namespace rotorub::sweep
