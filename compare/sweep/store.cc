#include "compare/sweep/store.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "compare/base/columns.h"
#include "compare/base/version.h"
#include "native_model/scene/text.h"

namespace rotorub::sweep {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "1";  // of the tables

std::int64_t counted(Database& database, const std::string& from) {
  Statement rows(database, "SELECT count(*) FROM " + from);
  rows.step();
  return rows.whole(0);
}

const char* sql_type(const ResultColumn& column) {
  const json value = column.value({});
  return value.is_string() ? "TEXT" : value.is_number_integer() ? "INTEGER" : "REAL";
}

Cell cell_of(const ResultColumn& column, const std::optional<Metrics>& figures) {
  const json value = figures ? column.value(*figures) : json();
  if (value.is_null()) return {};
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_integer()) return value.get<std::int64_t>();
  return value.get<double>();  // SQLite stores NaN as NULL
}

}  // namespace

Store::Store(const std::filesystem::path& file, const Study& study, const StudyIdentity& identity,
             const Shard& shard)
    : study_(&study), identity_(identity), shard_(shard), database_(file, Database::Mode::kWrite) {
  if (counted(database_, "sqlite_master WHERE name = 'meta'") == 0)
    database_.transact([&] { make_tables(); });
  check("main", file.string());
}

void Store::make_tables() {
  database_.execute("CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT NOT NULL)");
  Statement insert(database_, "INSERT INTO meta VALUES (?, ?)");
  insert.run({"format", kFormat});
  insert.run({"version", program_version()});
  insert.run({"study", identity_.hash});
  insert.run({"points", std::to_string(identity_.points)});
  insert.run({"shard", fmt::format("{}/{}", shard_.number, shard_.count)});
  std::string columns = "point INTEGER PRIMARY KEY";
  for (const Vary& vary : study_->vary) columns += ", " + quoted_name(vary.key);
  columns += ", status TEXT NOT NULL, reason TEXT NOT NULL";
  for (const ResultColumn& column : result_columns()) {
    columns += fmt::format(", {} {}", quoted_name(std::string(column.name)), sql_type(column));
  }
  database_.execute("CREATE TABLE points (" + columns + ")");
}

void Store::check(const std::string& schema, const std::string& file) {
  // Finds everything but our two tables. SQLite's own indices have no SQL text and are allowed.
  Statement foreign(database_, "SELECT type, name FROM " + schema +
                                   ".sqlite_master WHERE sql IS NOT NULL AND NOT (type = 'table' "
                                   "AND name IN ('meta', 'points') AND sql LIKE 'CREATE TABLE %')");
  if (foreign.step()) {
    throw StoreMismatch(
        fmt::format("{}: holds the {} `{}`, which no sweep writes; a sweep's file has only the "
                    "tables meta and points",
                    file, scene::printable(foreign.text(0)), scene::printable(foreign.text(1))));
  }
  const auto value = [&](const char* key) {
    Statement row(database_, "SELECT value FROM " + schema + ".meta WHERE key = ?", {key});
    return row.step() ? row.text(0) : std::string();
  };
  if (value("format") != kFormat) {
    throw StoreMismatch(file + ": no results of a sweep that this version can read");
  }
  if (value("study") != identity_.hash) {
    throw StoreMismatch(file +
                        ": holds results of another study (the study, its scene or --set has "
                        "changed); give another folder with -o, or remove this file");
  }
  if (value("version") != program_version()) {
    throw StoreMismatch(fmt::format(
        "{}: was begun by version {}, this is {}; give another folder with -o, or remove this file",
        file, value("version"), program_version()));
  }
}

std::vector<std::string> Store::names() const { return column_names(csv_columns(*study_)); }

std::vector<bool> Store::done() {
  std::vector<bool> all(static_cast<std::size_t>(identity_.points), false);
  Statement rows = select("point FROM points");
  while (rows.step()) {
    const std::int64_t point = rows.whole(0);
    if (point < 0 || point >= identity_.points) {
      throw StoreMismatch(
          fmt::format("the stored results contain point {}, but the points of this study are 0 to "
                      "{}; give another folder with -o, or remove the stored results",
                      point, identity_.points - 1));
    }
    all[static_cast<std::size_t>(point)] = true;
  }
  return all;
}

void Store::add(std::span<const PointResult> results, const Sample& sample) {
  std::string places = "?";
  for (std::size_t k = 1; k < names().size(); ++k) places += ", ?";
  Statement insert(database_, "INSERT INTO points VALUES (" + places + ")");
  database_.transact([&] {
    for (const PointResult& result : results) {
      Cells row{result.point};
      for (const Value& value : sample.at(result.point))
        row.push_back(value.number ? Cell(*value.number) : Cell(value.text));
      row.insert(row.end(), {result.status, result.reason});
      for (const ResultColumn& column : result_columns())
        row.push_back(cell_of(column, result.figures));
      insert.run(row);
    }
  });
}

void Store::merge(const std::filesystem::path& other) {
  // It is first opened separately, so that a missing file is not created and a file locked by a
  // sweep is distinguished from one that is not a database.
  { Database look(other, Database::Mode::kRead); }
  database_.execute("ATTACH DATABASE " + quoted_text(other.string()) + " AS other");
  check("other", other.string());
  Statement differing(database_,
                      "SELECT point FROM (SELECT * FROM other.points WHERE point IN "
                      "(SELECT point FROM main.points) EXCEPT SELECT * FROM main.points) "
                      "ORDER BY point LIMIT 1");
  if (differing.step()) {
    throw StoreMismatch(fmt::format("{}: point {} differs from the one that is there already",
                                    other.string(), differing.whole(0)));
  }
  database_.transact(
      [&] { database_.execute("INSERT OR IGNORE INTO main.points SELECT * FROM other.points"); });
  database_.execute("DETACH DATABASE other");
}

std::int64_t Store::count() { return counted(database_, "points"); }

std::map<std::string, std::int64_t> Store::count_by_status() {
  std::map<std::string, std::int64_t> counts;
  Statement rows = select("status, count(*) FROM points GROUP BY status");
  while (rows.step()) counts[rows.text(0)] = rows.whole(1);
  return counts;
}

void Store::each(const std::function<void(const Statement&)>& row) {
  Statement rows = select("* FROM points ORDER BY point");
  while (rows.step()) row(rows);
}

std::vector<std::filesystem::path> result_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("results.") && name.ends_with(".sqlite")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

int shards_in(const std::filesystem::path& folder) {
  for (const auto& file : result_files(folder)) {
    int number = 0, count = 0;
    const std::string name = file.filename().string();
    if (std::sscanf(name.c_str(), "results.%d-of-%d.sqlite", &number, &count) == 2) return count;
  }
  return 0;
}

}  // namespace rotorub::sweep
