// The results of a study or of one shard in a SQLite file:
//   meta    key, value: format, version, study (its identity), points (of the whole study), shard
//   points  point (primary key, from 0 in the study's order), a column per varied key, status,
//           reason, and the columns of result_columns(); no value depends on computing times
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "compare/sweep/database.h"
#include "compare/sweep/point_result.h"
#include "compare/sweep/sample.h"
#include "compare/sweep/shard.h"

namespace rotorub::sweep {

// Identifies results: a store holds the results of one study, computed by one version.
struct StudyIdentity {
  std::string hash;  // of the texts of study and scene, including the overrides of both
  std::int64_t points = 0;
};

class Store {
 public:
  // Opens or creates the file. Throws StoreMismatch if it belongs to another study or version, and
  // DatabaseError. The study's varied keys are columns.
  Store(const std::filesystem::path& file, const Study& study, const StudyIdentity& identity,
        const Shard& shard);

  // Whether each point of the study has a result.
  std::vector<bool> done();
  // Adds results as rows, in one transaction. sample: for the varied values.
  void add(std::span<const PointResult> results, const Sample& sample);
  // Copies all rows of another store. Throws StoreMismatch if it belongs to another study, or if
  // both have a point and its rows differ.
  void merge(const std::filesystem::path& other);

  std::int64_t count();
  std::map<std::string, std::int64_t> count_by_status();
  // Calls `row` for every row in the study's order, with the columns in the order of names().
  void each(const std::function<void(const Statement&)>& row);
  std::vector<std::string> names() const;  // of the columns, beginning with "point"
  // "* FROM points" and the like.
  Statement select(const std::string& what) { return {database_, "SELECT " + what}; }

 private:
  void make_tables();
  void check(const std::string& schema, const std::string& file);

  const Study* study_;
  StudyIdentity identity_;
  Shard shard_;
  Database database_;
};

class StoreMismatch : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The result files of shards in a folder, and results.sqlite if it exists.
std::vector<std::filesystem::path> result_files(const std::filesystem::path& folder);
// The number of shards of the results in a folder; 0 without shards.
int shards_in(const std::filesystem::path& folder);

}  // namespace rotorub::sweep
