// One pass over a scene's TOML tree: fills the structs according to the rows of the schema, then
// checks what the rows cannot say. Reports everything that does not fit.
#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/scene/record.h"
#include "native_model/scene/rules.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/toml_source.h"

namespace rotorub::scene {

class Reading {
 public:
  // Fills `of_scene`, which also gets the record of its keys.
  Reading(Scene& of_scene, std::vector<Diagnostic>& diagnostics);

  // Reads all tables below `root`, in which misspelt names are corrected.
  void read(TomlNode& root);
  // Reports the contradictions between keys, except for keys that are already known to be faulty.
  void check();

  const std::vector<Rule>& rules() const { return rules_; }

  // ------------------------------------------------------------------------- for the cross-checks
  const Scene& scene;
  // The auxiliary bearing of keys such as "contact", "stator.mass" and "controller.kind".
  std::size_t index = 0;
  const AuxiliaryBearing& bearing() const { return scene.auxiliary[index]; }

  // Path of the element whose keys begin with a dot: ".mass" is "rotor.disc[1].mass".
  std::string at{};

  // The key with the element's path.
  std::string full(std::string_view key) const;
  // The full path of a key, for instance "contact[1].stator.mass" below [[contact]].
  std::string place(std::string_view key) const;
  bool given(std::string_view key) const { return record_->given(place(key)); }
  // True if every key is either sound or absent and optional.
  bool sound(std::initializer_list<std::string_view> keys) const;
  void fail(std::string_view key, std::string reason) const;
  // Reports the absence of a key, with what its row expects.
  void missing(std::string_view key, const std::string& why = {}) const;
  // Reports a given key that has no effect without `other`, a key or a "[table]".
  void needs(std::string_view key, const std::string& other, const std::string& why = {}) const;
  // Reports a key that is given together with `other`. why: for instance ", which sets it".
  void excludes(std::string_view key, std::string_view other, const std::string& why = {}) const;
  // Reports a station beyond the end of the shaft.
  void station(const std::string& path, double z) const;
  // Reports a given list that does not have `length` values (empty: unknown), one for each `of`.
  void list_length(std::string_view key, std::optional<std::size_t> length,
                   const std::string& of) const;
  // Reports a list that is not strictly ascending, whether it was given or not.
  bool ascending(const std::string& path, const std::vector<double>& list) const;
  // Reports the abscissae of a table that are fewer than two ("two speeds") or not ascending.
  void abscissae(const std::string& path, const std::vector<double>& list, const char* two) const;
  // Reports the keys that a coil's voltage limit in the table at `path` still needs.
  void voltage(const std::string& path) const;
  // Number of bending (torsion) modes. Empty if the scene does not state it, as with max_frequency.
  std::optional<std::size_t> bending_modes() const;
  std::optional<std::size_t> torsion_modes() const;

 private:
  // A value and the path of its key.
  struct Spot {
    TomlNode& node;
    std::string path;
    Spot below(TomlNode& inner, std::string_view key) const;
  };
  // Records the key; see Record::note.
  void note(const Spot& here, bool sound, const std::string& written = {});
  // Reports what is wrong at `node`. Always false, as the result of a function that reads.
  bool refuse(const Spot& here, std::string reason);

  void find_form(const Spot& rotor);
  bool is_missing_rotor(const Table& table, const Spot& here) const;
  void refuse_missing_rotor(const Table& table, const Spot& here);
  void refuse_unknown(const Table* table, const Spot& here);
  // Reads the table at `node`, or each element of its list.
  void read_table(const Table& table, const Spot& here);
  void read_list(const Table& table, const Spot& here);
  void read_object(const Table& table, const Spot& here);
  void read_below(const Table& table, std::string_view kind, const Spot& here);
  void read_any(const Table& table, const Spot& here);

  // Each returns false, after reporting the reason, if the value cannot be used.
  bool read_key(const Key& key, std::string_view kind, const Spot& here, void* object);
  bool read_value(const Key& key, const Spot& here, Value& value);
  bool read_number(const Key& key, const Spot& here, double& number);
  bool read_numbers(const Key& key, const Spot& here, std::vector<double>& list);
  bool read_pair(const Key& key, const Spot& here, Eigen::Vector2d& pair);
  bool read_word(const Key& key, const Spot& here, int& word_index);

  Scene& scene_;
  std::vector<Diagnostic>& diagnostics_;
  std::shared_ptr<Record> record_;
  std::vector<Rule> rules_;
  Form form_ = Form::kEither;  // kEither: unknown
};

void check_rotor(Reading& check);                                 // [rotor] and its tables
void check_discs(Reading& check, const RotorGeometry& shaft);     // [[rotor.disc]]
void check_bearings(Reading& check, const RotorGeometry& shaft);  // [[rotor.bearing]]
void check_run(const Reading& check);                             // [run]
void check_loads(Reading& check);  // [drive], [[force]], [base], magnetic bearings
void check_base(Reading& check);   // [base]
void check_magnetic_bearings(Reading& check);
void check_start(const Reading& check);     // [initial], [gravity], [mujoco]
void check_ring(const Reading& check);      // [stator] of one bearing and the tables below it
void check_actuator(const Reading& check);  // [actuator] of one bearing
void check_contact(const Reading& check);   // [contact] of one bearing and its laws
void check_control(const Reading& check);   // [controller] of one bearing and the tables below it
void check_rules(Reading& check);           // [[check]]

// Fills in values that follow from other keys: G from nu, lists of the modal form up to their
// length, the damping of torsion, output_times in ascending order. Call it only if the scene has no
// diagnostics.
void complete(Scene& scene);

}  // namespace rotorub::scene
