// Fills a scene's structs from a TOML tree according to the schema, and reports what does not fit.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "native_model/scene/record.h"
#include "native_model/scene/rules.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/toml_source.h"

namespace rotorub::scene {

class TableReader {
 public:
  TableReader(Scene& scene, std::vector<Diagnostic>& diagnostics)
      : scene_(scene), diagnostics_(diagnostics) {}

  // Reads all tables below `root`.
  void read(const TomlNode& root);

  const Record& record() const { return record_; }
  const std::vector<Rule>& rules() const { return rules_; }
  Record take_record() { return std::move(record_); }

 private:
  void fail(const TomlNode& node, const std::string& path, std::string reason);
  void find_form(const TomlNode& root);
  // `above` is the path of `root`, "contact[1]." for an element.
  void read_table(const Table& table, const TomlNode& root, const std::string& above = {});
  void read_list(const Table& table, const TomlNode& list);
  void read_one(const Table& table, const TomlNode& node, const std::string& path);
  void read_object(const Table& table, const TomlNode& node, const std::string& path);
  // True if the parent's `kind` allows the table; if not, reports it.
  bool kind_takes(const Table& table, const TomlNode& root, const TomlNode& node,
                  const std::string& path);
  void read_any(const Table& table, const TomlNode& node, const std::string& path);
  // Returns false if the value cannot be used, after reporting the reason.
  bool read_key(const Key& key, std::string_view kind, const TomlNode& node,
                const std::string& path, void* object);
  void refuse_unknown(const TomlNode& node, std::string_view table_path, const std::string& path);

  // The same for a single value (value_reader.cc).
  bool read_value(const Key& key, const TomlNode& node, const std::string& path, Value& value);

  Scene& scene_;
  std::vector<Diagnostic>& diagnostics_;
  Record record_;
  std::vector<Rule> rules_;
  Form form_ = Form::kEither;  // kEither: unknown
};

}  // namespace rotorub::scene
