#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <cctype>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "compare/result/result.h"

namespace rotorub::result {
namespace {

using boost::algorithm::replace_all_copy;
using boost::algorithm::trim_copy;
using nlohmann::json;

const char* word_of(Tone tone) {
  return tone == Tone::kGood ? "good" : tone == Tone::kPart ? "part" : "bad";
}

json cell_json(const Item& item) {
  const std::string text = trim_copy(text_of(item));
  if (item.tone == Tone::kPlain && item.note.empty() && item.beside.empty()) return text;
  json cell{{"text", text}};
  if (!item.beside.empty()) cell["beside"] = item.beside;
  if (item.tone != Tone::kPlain) cell["tone"] = word_of(item.tone);
  if (!item.note.empty()) cell["note"] = item.note;
  return cell;
}

bool is_mark(const std::string& lead) {
  return std::ranges::none_of(lead, [](unsigned char c) { return std::isalnum(c); });
}

// Sets "mark" if the lead is one.
void add_mark(json& shown, const std::string& lead) {
  const std::string mark = trim_copy(lead);
  if (is_mark(mark) && !mark.empty()) shown["mark"] = mark;
}

// Adds the parts of a section to the list of a page.
class PageWriter {
 public:
  explicit PageWriter(json& list) : list_(list) {}

  void operator()(const Data&) {}

  void operator()(const Sentence& s) {
    const std::string lead = is_mark(s.lead) ? "" : s.lead, text = trim_copy(lead + s.text);
    if (!(s.seen & kPage) || text.empty()) return;
    if (s.role == Role::kCaption) {
      caption_ = text;
    } else if (s.role == Role::kHeading) {
      list_.push_back({{"heading", text}});
    } else if (text.find('\n') != std::string::npos) {
      list_.push_back({{"lines", s.lead + s.text}});
    } else {
      list_.push_back({{"text", text}});
      add_mark(list_.back(), s.lead);
      if (s.tone == Tone::kPlain) return;
      list_.back()["tone"] = word_of(s.tone);
      list_.back()["toned"] = trim_copy(s.toned.empty() ? s.lead : s.toned);
    }
  }

  void operator()(const Table& table) {
    if (!(table.seen & kPage)) return;
    json columns = json::array(), rows = json::array();
    for (const Column& column : table.columns) {
      if (!(column.seen & kPage)) continue;
      columns.push_back(
          {{"text", trim_copy(column.title.empty() ? column.heading : column.title)}});
      if (column.width > 0) columns.back()["number"] = true;
    }
    for (const Row& row : table.rows) {
      if (row.seen & kPage) rows.push_back(row_json(table, row));
    }
    const std::string caption = std::exchange(caption_, "");
    if (rows.empty() || columns.empty()) return;
    json shown{{"rows", rows}, {"columns", columns}};
    if (!caption.empty()) shown["caption"] = caption;
    list_.push_back(std::move(shown));
  }

  void operator()(const Section& section) {
    if (!(section.seen & kPage)) return;
    if (section.title.empty()) {
      for (const Part& part : section.parts) std::visit(*this, part);
      return;
    }
    json parts = json::array();
    PageWriter inner(parts);
    for (const Part& part : section.parts) std::visit(inner, part);
    if (parts.empty()) return;
    const std::string id = section.id.empty() ? id_of(section.place) : section.id;
    list_.push_back({{"id", id}, {"title", section.title}, {"parts", parts}});
  }

 private:
  static json row_json(const Table& table, const Row& row) {
    json cells = json::array();
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      if (!(table.columns[k].seen & kPage)) continue;
      cells.push_back(cell_json(k < row.items.size() ? row.items[k] : Item{}));
    }
    json shown{{"cells", cells}};
    add_mark(shown, row.lead);
    if (row.note.seen & kPage && !row.note.text.empty())
      shown["note"] = trim_copy(row.note.lead + row.note.text);
    return shown;
  }

  std::string id_of(const std::string& place) {
    const std::string number = std::to_string(++elements_[place]);
    return replace_all_copy(replace_all_copy(place, "#", number), "/", "-");
  }

  json& list_;
  std::string caption_{};                  // of the next table
  std::map<std::string, int> elements_{};  // sections at each place
};

}  // namespace

json page_json(const Section& result) {
  json list = json::array();
  PageWriter writer(list);
  for (const Part& part : result.parts) std::visit(writer, part);
  return list;
}

}  // namespace rotorub::result
