// Owners for SQLite, which stores the results.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace rotorub::sweep {

class DatabaseError : public std::runtime_error {
 public:
  DatabaseError(const std::string& message, bool is_busy)
      : std::runtime_error(message), busy(is_busy) {}
  bool busy;  // another process holds the file
};

// A value of a row; the first alternative is NULL.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;
using Cells = std::vector<Cell>;

class Database {
 public:
  enum class Mode { kRead, kWrite };
  // kWrite creates the file if it is missing and locks it for other processes. Throws
  // DatabaseError.
  Database(const std::filesystem::path& file, Mode mode);
  void execute(const std::string& sql);
  // Calls `work` in a transaction, which is rolled back if it throws.
  void transact(const std::function<void()>& work);

 private:
  friend class Statement;
  [[noreturn]] void fail(int code) const;

  std::string file_;
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> database_;
};

// A prepared statement with values for its parameters. Columns count from 0.
class Statement {
 public:
  Statement(Database& database, const std::string& sql, const Cells& values = {});
  void run(const Cells& values);  // with other values, to the end
  bool step();                    // true if there is a row
  int columns() const;
  bool is_nothing(int column) const;
  bool is_text(int column) const;
  bool is_whole(int column) const;
  std::int64_t whole(int column) const;
  double number(int column) const;
  std::string text(int column) const;

 private:
  void bind(const Cells& values);

  Database* database_;
  std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement_;
};

// Quoted for SQL: names in double quotes, texts in single quotes.
std::string quoted_name(const std::string& name);
std::string quoted_text(const std::string& text);

}  // namespace rotorub::sweep
