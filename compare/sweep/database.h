// Owners for SQLite, which stores the results.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>

struct sqlite3;
struct sqlite3_stmt;

namespace rotorub::sweep {

class DatabaseError : public std::runtime_error {
 public:
  DatabaseError(const std::string& message, bool is_busy)
      : std::runtime_error(message), busy(is_busy) {}
  bool busy;  // another process holds the file
};

class Database;

// A value of a row; the first alternative is NULL.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

// A prepared statement. Parameters count from 1 and columns from 0, as in SQLite.
class Statement {
 public:
  Statement(Database& database, const std::string& sql);
  void bind(int place, const Cell& value);
  bool step();  // true if there is a row
  void run();   // steps to the end and resets the statement
  int columns() const;
  bool is_nothing(int column) const;
  bool is_text(int column) const;
  bool is_whole(int column) const;
  std::int64_t whole(int column) const;
  double number(int column) const;
  std::string text(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  Database* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

class Database {
 public:
  enum class Mode { kRead, kWrite };
  // kWrite creates the file if it is missing and locks it for other processes. Throws
  // DatabaseError.
  Database(const std::filesystem::path& file, Mode mode);
  void execute(const std::string& sql);
  [[noreturn]] void fail(int code) const;

 private:
  friend class Statement;
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::string file_;
  std::unique_ptr<sqlite3, Close> database_;
};

// A transaction that is rolled back unless it is committed.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(&database) { database.execute("BEGIN"); }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database* database_;
  bool open_ = true;
};

// Quoted for SQL: names in double quotes, texts in single quotes.
std::string quoted_name(const std::string& name);
std::string quoted_text(const std::string& text);

}  // namespace rotorub::sweep
