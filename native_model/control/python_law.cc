#include "native_model/control/python_law.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "native_model/scene/text.h"

namespace rotorub {
namespace {

constexpr std::size_t kMostReason = 2000;  // bytes
constexpr char kSucceeded = 0;             // first byte of an answer (python_runner.h)

// ------------------------------------------------------------------ values as Python sees them

// The setup as the text of a dict in JSON, with the names of rotorub/controller.h.
class Dict {
 public:
  void add(const char* key, double value) { put(key, text_of(value)); }
  void add(const char* key, const double (&pair)[2]) {
    put(key, "[" + text_of(pair[0]) + "," + text_of(pair[1]) + "]");
  }
  void add(const char* key, const char* text) { put(key, quoted(text)); }
  void add(const char* key, const Dict& dict) { put(key, dict.text()); }
  void add(const char* key, const std::vector<Dict>& dicts) {
    std::string list;
    for (const Dict& dict : dicts) list += (list.empty() ? "" : ",") + dict.text();
    put(key, "[" + list + "]");
  }
  std::string text() const { return "{" + entries_ + "}"; }

 private:
  void put(const char* key, const std::string& value) {
    entries_ += (entries_.empty() ? "" : ",") + quoted(key) + ":" + value;
  }
  // Python's JSON knows Infinity.
  static std::string text_of(double value) {
    if (std::isinf(value)) return value > 0.0 ? "Infinity" : "-Infinity";
    std::array<char, 32> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
  }
  static std::string quoted(std::string_view text) {
    std::string all = "\"";
    for (const char c : text) {
      std::array<char, 8> code{};
      std::snprintf(code.data(), code.size(), "\\u%04x", static_cast<unsigned char>(c));
      const bool plain = static_cast<unsigned char>(c) >= 0x20 && c != '"' && c != '\\';
      all += plain ? std::string(1, c) : std::string(code.data());
    }
    return all + "\"";
  }

  std::string entries_;
};

Dict config_of(const rotorub_entry* entries, std::size_t count) {
  Dict config;
  for (const rotorub_entry* e = entries; e != entries + count; ++e) {
    if (e->text != nullptr)
      config.add(e->key, e->text);
    else
      config.add(e->key, e->number);
  }
  return config;
}

Dict dict_of(const rotorub_setup& setup) {
  Dict dict;
  dict.add("sample_time", setup.sample_time);
  dict.add("clearance", setup.clearance);
  dict.add("measured", static_cast<double>(setup.measured));
  dict.add("stator_mass", setup.stator_mass);
  dict.add("stator_damping", setup.stator_damping);
  dict.add("stator_stiffness", setup.stator_stiffness);
  dict.add("force_limit", setup.force_limit);
  dict.add("current_limit", setup.current_limit);
  dict.add("config", config_of(setup.config, setup.entries));
  return dict;
}

Dict dict_of(const rotorub_magnetic_setup& setup) {
  std::vector<Dict> bearings(setup.ports / 2);
  for (std::size_t k = 0; k < bearings.size(); ++k) {
    const rotorub_magnetic_bearing& b = setup.bearings[k];
    bearings[k].add("force_per_current", b.force_per_current);
    bearings[k].add("negative_stiffness", b.negative_stiffness);
    bearings[k].add("current_limit", b.current_limit);
    bearings[k].add("force_constant", b.force_constant);
    bearings[k].add("bias_current", b.bias_current);
    bearings[k].add("air_gap", b.air_gap);
    bearings[k].add("bandwidth", b.bandwidth);
  }
  Dict dict;
  dict.add("sample_time", setup.sample_time);
  dict.add("delay", setup.delay);
  dict.add("ports", static_cast<double>(setup.ports));
  dict.add("bearings", bearings);
  dict.add("config", config_of(setup.config, setup.entries));
  return dict;
}

std::size_t commands_of(const rotorub_setup&) { return 2; }
std::size_t commands_of(const rotorub_magnetic_setup& setup) { return setup.ports; }

// Calls visit(name, values, count) for each measured value in order; count 0 is a single number,
// and `sample` a whole one.
template <class Visit>
void each_value(const rotorub_measurement& now, std::size_t, Visit visit) {
  const auto sample = static_cast<double>(now.sample);
  visit("t", &now.t, 0);
  visit("sample", &sample, 0);
  visit("rotor", now.rotor, 2);
  visit("rotor_velocity", now.rotor_velocity, 2);
  visit("stator", now.stator, 2);
  visit("stator_velocity", now.stator_velocity, 2);
  visit("spin_angle", &now.spin_angle, 0);
  visit("spin_speed", &now.spin_speed, 0);
  visit("current", now.current, 2);
}
template <class Visit>
void each_value(const rotorub_magnetic_measurement& now, std::size_t ports, Visit visit) {
  const auto sample = static_cast<double>(now.sample);
  visit("t", &now.t, 0);
  visit("sample", &sample, 0);
  visit("deflection", now.deflection, ports);
  visit("current", now.current, ports);
  visit("spin_angle", &now.spin_angle, 0);
  visit("spin_speed", &now.spin_speed, 0);
}

// The names and counts of the measured values in JSON.
template <class Measurement>
std::string shape_of(std::size_t commands) {
  std::string shape;
  each_value(Measurement{}, commands, [&](std::string_view name, const double*, std::size_t count) {
    const std::string kind = count > 0          ? std::to_string(count)
                             : name == "sample" ? "\"int\""
                                                : "\"float\"";
    shape += (shape.empty() ? "[\"" : ",[\"") + std::string(name) + "\"," + kind + "]";
  });
  return "[" + shape + "]";
}

void append(std::string& bytes, const double* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof *values);
}

}  // namespace

// ------------------------------------------------------------------ the law

template <class Kind>
PythonLaw<Kind>::PythonLaw(const std::filesystem::path& file)
    : file_(std::filesystem::absolute(file).lexically_normal()),
      process_(process_for(file_.string())),
      number_(process_->next_law()) {
  std::string word;
  const std::string failed = failure_of('L', file_.string(), &word);
  if (!failed.empty()) {
    failure_of('E', "", &word);
    throw std::runtime_error(failed);
  }
  if (word == "current") command_ = ROTORUB_CURRENT;
}

template <class Kind>
PythonLaw<Kind>::~PythonLaw() {
  std::string nothing;
  failure_of('E', "", &nothing);
}

template <class Kind>
std::string PythonLaw<Kind>::failure_of(char kind, std::string_view request,
                                        std::string* answer) const {
  std::string whole(1, kind);
  whole.append(reinterpret_cast<const char*>(&number_), sizeof number_);
  whole += request;
  try {
    *answer = process_->ask(whole);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  const bool good = !answer->empty() && answer->front() == kSucceeded;
  answer->erase(0, 1);
  return good ? "" : scene::printable(*answer, kMostReason);
}

template <class Kind>
std::string PythonLaw<Kind>::create(const typename Kind::Setup& setup) {
  commands_ = commands_of(setup);
  const std::string request = R"({"setup":)" + dict_of(setup).text() + R"(,"shape":)" +
                              shape_of<typename Kind::Measurement>(commands_) + R"(,"commands":)" +
                              std::to_string(commands_) + "}";
  std::string state;
  std::string failed = failure_of('C', request, &state);
  if (!failed.empty()) return failed;
  start_.resize(state.size() / sizeof(double));
  std::memcpy(start_.data(), state.data(), state.size());
  return "";
}

template <class Kind>
void PythonLaw<Kind>::start(double* state) const {
  std::copy(start_.begin(), start_.end(), state);
}

template <class Kind>
std::string PythonLaw<Kind>::step(const typename Kind::Measurement& now, double* state,
                                  double* output) const {
  std::string request;
  each_value(now, commands_, [&](const char*, const double* values, std::size_t count) {
    append(request, values, std::max<std::size_t>(count, 1));
  });
  append(request, state, start_.size());
  std::string answer;
  std::string failed = failure_of('S', request, &answer);
  if (!failed.empty()) return failed;
  std::memcpy(output, answer.data(), commands_ * sizeof *output);
  std::memcpy(state, answer.data() + commands_ * sizeof *output, start_.size() * sizeof *state);
  return "";
}

template class PythonLaw<RingLaw>;
template class PythonLaw<MagneticLaw>;

}  // namespace rotorub
