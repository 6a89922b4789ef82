// The results of a study, or of a shard of it, in a SQLite file:
//   meta    key, value: format, version, study (its identity), points (of the whole study), shard
//   points  point (primary key, from 0 in the study's order), a column for each varied key, status,
//           reason, and the columns of result_columns(); nothing in them depends on times
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

// What results belong to: a store takes those of one study alone, computed by one version.
struct StudyIdentity {
  std::string hash;  // of the study's text and of the scene's, with the overrides of both
  std::int64_t points = 0;
};

class Store {
 public:
  // Opens or makes the file. Throws StoreMismatch where it is of another study or version, and
  // DatabaseError. `vary`: names of the columns.
  Store(const std::filesystem::path& file, const Study& study, const StudyIdentity& identity,
        const Shard& shard);

  // Whether each point of the study is there.
  std::vector<bool> done();
  // Rows for the results, in one transaction. `sample` gives the varied values.
  void add(std::span<const PointResult> results, const Sample& sample);
  // Takes over all rows of another store. Throws StoreMismatch where that is of another study, or
  // where a point is in both and differs.
  void merge(const std::filesystem::path& other);

  std::int64_t count();
  std::map<std::string, std::int64_t> count_by_status();
  // Every row in the study's order: its columns as they stand in `names`.
  void each(const std::function<void(const Statement&)>& row);
  std::vector<std::string> names() const;  // of the columns, from "point" on

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

// The shards whose results are in a folder, and results.sqlite if it is there.
std::vector<std::filesystem::path> result_files(const std::filesystem::path& folder);
// Into how many shards the results in a folder are cut; 0: into none.
int shards_in(const std::filesystem::path& folder);

}  // namespace rotorub::sweep
