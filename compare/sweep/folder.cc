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

void append_field(std::string& line, const Statement& row, int column) {
  if (row.is_nothing(column)) return;
  if (row.is_text(column)) {
    line += csv_field(row.text(column));
  } else if (row.is_whole(column)) {
    line += std::to_string(row.whole(column));
  } else {
    append_number(line, row.number(column));
  }
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
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
  std::string line;
  for (const std::string& name : store.names()) {
    if (!line.empty()) line += ',';
    line += csv_field(name);
  }
  out << line << '\n';
  store.each([&](const Statement& row) {
    line.clear();
    for (int column = 0; column < row.columns(); ++column) {
      if (column > 0) line += ',';
      append_field(line, row, column);
    }
    out << line << '\n';
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
