#include "compare/sweep/database.h"

#include <sqlite3.h>

namespace rotorub::sweep {
namespace {

std::string doubled(const std::string& text, char quote) {
  std::string out(1, quote);
  for (const char c : text) out.append(c == quote ? 2 : 1, c);
  return out + quote;
}

}  // namespace

std::string quoted_name(const std::string& name) { return doubled(name, '"'); }
std::string quoted_text(const std::string& text) { return doubled(text, '\''); }

Database::Database(const std::filesystem::path& file, Mode mode)
    : file_(file.string()), database_(nullptr, &sqlite3_close_v2) {
  sqlite3* opened = nullptr;
  const int flags =
      mode == Mode::kRead ? SQLITE_OPEN_READWRITE : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  const int code = sqlite3_open_v2(file_.c_str(), &opened, flags, nullptr);
  database_.reset(opened);
  if (code != SQLITE_OK) fail(code);
  // A file may come from anywhere, so its triggers and views are never executed.
  for (const int part : {SQLITE_DBCONFIG_ENABLE_TRIGGER, SQLITE_DBCONFIG_ENABLE_VIEW})
    sqlite3_db_config(opened, part, 0, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  if (mode == Mode::kRead) return;
  // A synced rollback journal makes committed data survive a crash of the process or the computer.
  // It also works on network file systems, where a write-ahead log does not.
  execute("PRAGMA journal_mode = DELETE");
  execute("PRAGMA synchronous = FULL");
  execute("PRAGMA locking_mode = EXCLUSIVE");
  execute("BEGIN EXCLUSIVE");
  execute("COMMIT");
}

void Database::fail(int code) const {
  const int kind = code & 0xff;
  const bool busy = kind == SQLITE_BUSY || kind == SQLITE_LOCKED;
  const std::string why = database_ ? sqlite3_errmsg(database_.get()) : sqlite3_errstr(code);
  throw DatabaseError(file_ + ": " + (busy ? "another sweep is at work on it (" + why + ")" : why),
                      busy);
}

void Database::execute(const std::string& sql) {
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(code);
}

void Database::transact(const std::function<void()>& work) {
  execute("BEGIN");
  try {
    work();
    execute("COMMIT");
  } catch (...) {
    // The failed statement may have rolled it back already, so an error here means nothing.
    sqlite3_exec(database_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
}

Statement::Statement(Database& database, const std::string& sql, const Cells& values)
    : database_(&database), statement_(nullptr, &sqlite3_finalize) {
  sqlite3_stmt* prepared = nullptr;
  const int code =
      sqlite3_prepare_v2(database.database_.get(), sql.c_str(), -1, &prepared, nullptr);
  statement_.reset(prepared);
  if (code != SQLITE_OK) database.fail(code);
  bind(values);
}

void Statement::bind(const Cells& values) {
  int place = 0;  // counts from 1
  for (const Cell& value : values) {
    ++place;
    if (const auto* whole = std::get_if<std::int64_t>(&value)) {
      sqlite3_bind_int64(statement_.get(), place, *whole);
    } else if (const auto* number = std::get_if<double>(&value)) {
      sqlite3_bind_double(statement_.get(), place, *number);
    } else if (const auto* text = std::get_if<std::string>(&value)) {
      sqlite3_bind_text(statement_.get(), place, text->data(), static_cast<int>(text->size()),
                        SQLITE_TRANSIENT);
    } else {
      sqlite3_bind_null(statement_.get(), place);
    }
  }
}

void Statement::run(const Cells& values) {
  bind(values);
  while (step()) {
  }
  sqlite3_reset(statement_.get());
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) database_->fail(code);
  return code == SQLITE_ROW;
}

int Statement::columns() const { return sqlite3_column_count(statement_.get()); }
bool Statement::is_nothing(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}
bool Statement::is_text(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_TEXT;
}
bool Statement::is_whole(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_INTEGER;
}
std::int64_t Statement::whole(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}
double Statement::number(int column) const {
  return sqlite3_column_double(statement_.get(), column);
}
std::string Statement::text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  return text ? std::string(
                    text, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column)))
              : std::string();
}

}  // namespace rotorub::sweep
