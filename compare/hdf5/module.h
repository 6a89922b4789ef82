// HDF5, of a module of its own (lib/librotorub_hdf5.so), so that the program needs no library for
// what few ask for.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace rotorub::hdf5 {

// A dataset with the attributes `unit` and `meaning`: numbers, or else the words that `which`
// counts through.
struct Column {
  std::string name, unit, meaning;
  std::span<const double> numbers;
  std::vector<std::string> words{};  // empty: numbers
  std::vector<int> which{};
};

// A group with a dataset a column, and their names in order as its attribute `columns`.
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

// The bytes of the file: the same for the same content. Throws std::runtime_error.
using ImageOf = std::string (*)(const Content& content);
inline constexpr const char* kModuleSymbol = "rotorub_hdf5_image";
inline constexpr const char* kPackage = "libhdf5-dev";

// From the module; null, and why in `missing`, where there is none.
ImageOf load(std::string& missing);

}  // namespace rotorub::hdf5
