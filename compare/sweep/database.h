// SQLite with owners: what the results are kept in.
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

// A value of a row; the first: nothing.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

// A prepared statement; parameters and columns are counted from 1 and from 0, as in SQLite.
class Statement {
 public:
  Statement(Database& database, const std::string& sql);
  void bind(int place, const Cell& value);
  bool step();  // true: a row
  void run();   // steps to the end and is ready for another time
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
  // kWrite makes the file where it is missing and keeps other processes out. Throws DatabaseError.
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

// A transaction that is taken back unless it is committed.
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

// "a name" as SQL takes it: in quotes of its own.
std::string quoted_name(const std::string& name);
std::string quoted_text(const std::string& text);

}  // namespace rotorub::sweep
