// Every table and key that a scene may hold, as data: name, quantity, range, default, condition and
// storage. The reader, the search for unknown keys and the reference (mjcf/docs/keys.md) all use
// this one description. The rows are next to the cross-checks, in *_tables.cc, *_table.cc, disc.cc,
// shaft_bearing.cc and rules.cc.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "native_model/scene/scene.h"
#include "native_model/scene/text.h"
#include "native_model/scene/units.h"

namespace rotorub::scene {

// A rotor is given as a shaft (geometry) or by its modes. Some keys belong to only one form.
enum class Form { kEither, kGeometry, kModal };

enum class ValueType {
  kNumber,  // one number
  kWhole,   // one whole number, or one of the key's words
  kWord,    // one of a few words
  kFlag,    // true or false
  kPlanes,  // a number for both bending planes, or [x, y]
  kVector,  // [x, y]
  kList,    // numbers
  kText,    // free text
};

// Allowed numbers; applies to each number of a pair or list.
struct Range {
  // `text` as in rows and messages: "> 0", ">= 0", "in (-1, 0.5]"; "" allows any number.
  Range() = default;
  explicit Range(std::string_view text);

  std::string_view text;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   // low itself is excluded
  bool high_open = false;  // high itself is excluded

  bool contains(double value) const {
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
  }
};

// A value that was read. Only the member for its type is set.
struct Value {
  double number = 0.0;         // kNumber, SI
  int whole = 0;               // kWhole; kWord: index of the word; kFlag: 0, 1
  Eigen::Vector2d pair{0, 0};  // kPlanes, kVector, SI
  std::vector<double> list;    // kList, SI
  std::string text;            // kText; kWhole: the word
};

// True if a list of kinds is empty or has this one.
inline bool allows(const std::vector<std::string_view>& kinds, std::string_view kind) {
  return kinds.empty() || std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

struct Key {
  std::string_view name;
  std::string_view also;  // alternative name; empty: none
  ValueType type = ValueType::kNumber;
  Quantity quantity = kPure;
  std::string_view meaning;
  void (*store)(void* object, const Value& value) = nullptr;  // object: of the table
  std::vector<std::string_view> words;  // kWord: in the order of the enum; kWhole: see ValueType
  Range range;
  Form form = Form::kEither;            // the form it belongs to
  std::vector<std::string_view> kinds;  // values of the table's `kind` with this key; empty: all
  std::string standard;                 // default of the member as text, if it has one
  std::string fallback;                 // default as text; empty: the key is required
  bool listed_only = false;             // allowed only below [[contact]]

  Key& or_called(std::string_view other) { return also = other, *this; }
  Key& in(Form of_form) { return form = of_form, *this; }
  Key& below_list() { return listed_only = true, *this; }

  bool is_called(std::string_view word) const {
    return word == name || (!also.empty() && word == also);
  }
  bool required() const { return fallback.empty(); }
  std::string_view default_word() const;  // kWord; empty: required
  bool belongs_to(Form to_form) const { return form == Form::kEither || form == to_form; }
  bool is_for(std::string_view kind) const { return allows(kinds, kind); }
  std::string expected() const { return expected(type); }  // "a length in m, > 0"
  std::string expected(ValueType as_type) const;
};

struct Table {
  std::string_view path;  // "rotor.disc"
  std::string_view meaning;
  std::string_view when_absent;
  // Creates the part (for a list, one more element) and returns it; the part above is there
  // already. Null: the table is a rule (rules.h), which is kept outside the scene.
  void* (*object)(Scene& scene) = nullptr;
  std::vector<Key> keys;
  // Values of the parent's `kind` that allow this table; empty: all.
  std::vector<std::string_view> kinds{};
  bool any_key = false;  // `object` is a list of entries (config_entry.h), and `keys` are empty
  bool or_list = false;  // [path], or [[path]] with its own parts below each
  bool list = false;     // [[path]]: any number of elements
  bool for_key = false;  // replaces a key of its parent
  Form form = Form::kEither;

  Table& as_list() { return list = true, *this; }
  Table& in(Form of_form) { return form = of_form, *this; }

  std::string_view parent() const;               // path of the table above; empty: top level
  std::string_view name() const;                 // last part of the path
  const Key* find(std::string_view name) const;  // by either of its names
  bool is_for(std::string_view kind) const { return allows(kinds, kind); }
};

// All tables, parents before children.
std::span<const Table> tables();
// "contact.stator" means [stator] below a [[contact]].
const Table* find_table(std::string_view path);
// The path without the elements of lists: "force.on" for "force[0].on" and "force.0.on".
std::string without_elements(std::string_view path);
// The row of the key at a path with or without elements; null if there is none. For a table with
// any keys it is a number without a unit and without a name.
const Key* find_key(std::string_view path);
// True for parts of an auxiliary bearing that stand below each [[contact]]: [stator],
// [controller.sensors].
bool is_part_of_contact(const Table& table);

// The rows of the schema.
Table run_table();
std::vector<Table> rotor_tables();
std::vector<Table> load_tables();
Table base_table();
std::vector<Table> magnetic_tables();
std::vector<Table> contact_tables();
std::vector<Table> ring_tables();
std::vector<Table> actuator_tables();
std::vector<Table> control_tables();
std::vector<Table> start_tables();
Table rule_table();
// geometry_of returns the geometry of the shaft and creates it if needed. The tables are
// [[rotor.disc]], [[rotor.bearing]] and the tables below each bearing.
RotorGeometry& geometry_of(Scene& scene);
Table disc_table();
Table shaft_bearing_table();
Table journal_table();
Table pedestal_table();

// ---------------------------------------------------------------- rows from pointers to members

namespace detail {

template <typename T>
struct IsOptional : std::false_type {};
template <typename T>
struct IsOptional<std::optional<T>> : std::true_type {};

template <typename Member>
struct ClassOf;
template <typename T, typename Class>
struct ClassOf<T Class::*> {
  using type = Class;
};

// Returns object.*first.*rest..., and creates empty optionals on the way.
template <auto First, auto... Rest, typename Object>
auto& resolve(Object& object) {
  auto& member = object.*First;
  if constexpr (sizeof...(Rest) == 0) {
    return member;
  } else if constexpr (IsOptional<std::remove_reference_t<decltype(member)>>::value) {
    if (!member) member.emplace();
    return resolve<Rest...>(*member);
  } else {
    return resolve<Rest...>(member);
  }
}

template <typename T>
void assign(T& target, const Value& value) {
  if constexpr (IsOptional<T>::value) {
    assign(target.emplace(), value);
  } else if constexpr (std::is_same_v<T, double>) {
    target = value.number;
  } else if constexpr (std::is_same_v<T, bool>) {
    target = value.whole != 0;
  } else if constexpr (std::is_same_v<T, int>) {
    target = value.whole;
  } else if constexpr (std::is_enum_v<T>) {
    target = static_cast<T>(value.whole);
  } else if constexpr (std::is_same_v<T, Eigen::Vector2d>) {
    target = value.pair;
  } else if constexpr (std::is_same_v<T, std::string>) {
    target = value.text;
  } else {
    target = value.list;
  }
}

// Sets the type of a key with such a member, and the text of the member's default for the
// reference. Lists, words and optional members have no text here.
template <typename T>
void describe(Key& key, const T& standard) {
  if constexpr (IsOptional<T>::value) {
    describe(key, typename T::value_type{});
    key.standard.clear();
  } else if constexpr (std::is_same_v<T, double>) {
    key.type = ValueType::kNumber;
    key.standard = number_text(standard);
  } else if constexpr (std::is_same_v<T, bool>) {
    key.type = ValueType::kFlag;
    key.standard = standard ? "true" : "false";
  } else if constexpr (std::is_same_v<T, int>) {
    key.type = ValueType::kWhole;
    key.standard = number_text(standard);
  } else if constexpr (std::is_enum_v<T>) {
    key.type = ValueType::kWord;
    key.standard = std::to_string(static_cast<int>(standard));
  } else if constexpr (std::is_same_v<T, Eigen::Vector2d>) {
    key.type = ValueType::kVector;
    key.standard = "[" + number_text(standard.x()) + ", " + number_text(standard.y()) + "]";
  } else if constexpr (std::is_same_v<T, std::string>) {
    key.type = ValueType::kText;
  } else {
    static_assert(std::is_same_v<T, std::vector<double>>);
    key.type = ValueType::kList;
  }
}

}  // namespace detail

// Special values for the default of a row.
inline constexpr std::string_view kRequired{};           // no default: the key is required
inline constexpr std::string_view kStandard = "member";  // the default of the member

// A key that is stored in the member that the pointers lead to, whose type gives the value type.
// `fallback` is the default as text, or one of the constants above; for `kinds` see Key.
template <auto First, auto... Rest>
Key key(std::string_view name, const Quantity& quantity, std::string_view range,
        std::string_view fallback, std::string_view meaning,
        std::vector<std::string_view> kinds = {}) {
  using Object = typename detail::ClassOf<decltype(First)>::type;
  Key result;
  result.name = name;
  result.quantity = quantity;
  result.meaning = meaning;
  result.range = Range(range);
  result.kinds = std::move(kinds);
  Object fresh;
  detail::describe(result, detail::resolve<First, Rest...>(fresh));
  result.fallback = fallback == kStandard ? result.standard : std::string(fallback);
  result.store = [](void* object, const Value& value) {
    detail::assign(detail::resolve<First, Rest...>(*static_cast<Object*>(object)), value);
  };
  return result;
}

// A key with one number for both bending planes, or [x, y].
template <auto Member>
Key planes(std::string_view name, const Quantity& quantity, std::string_view range,
           std::string_view fallback, std::string_view meaning) {
  Key result = key<Member>(name, quantity, range, fallback, meaning);
  result.type = ValueType::kPlanes;
  result.standard = result.standard.substr(1, result.standard.find(',') - 1);
  if (fallback == kStandard) result.fallback = result.standard;
  return result;
}

// A key with one of `words`, which must be in the order of the member's enum.
template <auto... Member>
Key word(std::string_view name, std::vector<std::string_view> words, std::string_view fallback,
         std::string_view meaning, std::vector<std::string_view> kinds = {}) {
  Key result = key<Member...>(name, kPure, {}, fallback, meaning, std::move(kinds));
  result.words = std::move(words);
  result.standard = "`" + std::string(result.words[std::stoul(result.standard)]) + "`";
  if (fallback == kStandard) result.fallback = result.standard;
  return result;
}

}  // namespace rotorub::scene
