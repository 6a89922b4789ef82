// HDF5 output from a separate module (lib/librotorub_hdf5.so), so that the program itself does not
// depend on the library.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace rotorub::hdf5 {

// A dataset with the attributes `unit` and `meaning`. It contains numbers, or the words with the
// indices `which`.
struct Column {
  std::string name, unit, meaning;
  std::span<const double> numbers;
  std::vector<std::string> words{};  // empty: numbers
  std::vector<int> which{};
};

// A group with one dataset per column; the attribute `columns` lists their names in order.
struct Table {
  std::string name;
  std::vector<Column> columns;
};

struct Attribute {
  std::string name;
  std::variant<std::string, double, std::int64_t> value;
};

struct Content {
  std::vector<Attribute> attributes;  // of the file
  std::vector<Table> tables;
};

// Makes the bytes of the file; equal for equal content. Throws std::runtime_error.
using ImageOf = std::string (*)(const Content& content);
inline constexpr const char* kModuleSymbol = "rotorub_hdf5_image";
inline constexpr const char* kPackage = "libhdf5-dev";

// Loads the function from the module. If it is missing, returns null and sets the reason in
// `missing`.
ImageOf load(std::string& missing);

}  // namespace rotorub::hdf5
