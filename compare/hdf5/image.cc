// The module: writes the file into memory, so that the program can write it completely or not at
// all. No times are stored, so the bytes depend only on the content.
#include <hdf5.h>

#include <algorithm>
#include <stdexcept>

#include "compare/hdf5/module.h"

namespace rotorub::hdf5 {
namespace {

// Owns a handle of the library.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id_ < 0) throw std::runtime_error("HDF5: cannot make " + what);
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void check(herr_t result, const std::string& what) {
  if (result < 0) throw std::runtime_error("HDF5: cannot write " + what);
}

// length: H5T_VARIABLE, or a number of bytes that is padded with zeros.
Handle string_type(std::size_t length) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  if (type >= 0) {
    H5Tset_size(type, length);
    H5Tset_cset(type, H5T_CSET_UTF8);
    if (length != H5T_VARIABLE) H5Tset_strpad(type, H5T_STR_NULLPAD);
  }
  return {type, H5Tclose, "a string"};
}

void set_attribute(hid_t object, const std::string& name, hid_t type, hid_t space,
                   const void* value) {
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose, name);
  check(H5Awrite(attribute, type, value), name);
}

void set_attribute(hid_t object, const Attribute& attribute) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, attribute.name);
  if (const auto* text = std::get_if<std::string>(&attribute.value)) {
    const char* start = text->c_str();
    set_attribute(object, attribute.name, string_type(H5T_VARIABLE), space, &start);
  } else if (const auto* number = std::get_if<double>(&attribute.value)) {
    set_attribute(object, attribute.name, H5T_IEEE_F64LE, space, number);
  } else {
    set_attribute(object, attribute.name, H5T_STD_I64LE, space,
                  &std::get<std::int64_t>(attribute.value));
  }
}

void write_dataset(hid_t group, const Column& column, hid_t type, std::size_t rows,
                   const void* values) {
  const hsize_t size = rows;
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, column.name),
      plain(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, column.name);
  check(H5Pset_obj_track_times(plain, false), column.name);
  const Handle dataset(
      H5Dcreate2(group, column.name.c_str(), type, space, H5P_DEFAULT, plain, H5P_DEFAULT),
      H5Dclose, column.name);
  if (rows > 0) check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), column.name);
  set_attribute(dataset, {"unit", column.unit});
  set_attribute(dataset, {"meaning", column.meaning});
}

void write_column(hid_t group, const Column& column) {
  if (column.words.empty()) {
    write_dataset(group, column, H5T_IEEE_F64LE, column.numbers.size(), column.numbers.data());
    return;
  }
  std::size_t length = 1;
  for (const std::string& word : column.words) length = std::max(length, word.size());
  std::string text;
  for (const int which : column.which) {
    text += column.words[static_cast<std::size_t>(which)];
    text.resize((text.size() + length - 1) / length * length, '\0');
  }
  write_dataset(group, column, string_type(length), column.which.size(), text.data());
}

void write_table(hid_t file, const Table& table) {
  const Handle plain(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, table.name);
  check(H5Pset_obj_track_times(plain, false), table.name);
  const Handle group(H5Gcreate2(file, table.name.c_str(), H5P_DEFAULT, plain, H5P_DEFAULT),
                     H5Gclose, table.name);
  std::vector<const char*> names;
  for (const Column& column : table.columns) {
    write_column(group, column);
    names.push_back(column.name.c_str());
  }
  const hsize_t size = names.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, table.name);
  set_attribute(group, "columns", string_type(H5T_VARIABLE), space, names.data());
}

}  // namespace

extern "C" std::string rotorub_hdf5_image(const Content& content) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors become exceptions
  constexpr std::size_t kGrow = 1 << 20;        // bytes
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "a file"),
      plain(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "a file");
  check(H5Pset_fapl_core(access, kGrow, false), "into memory");
  check(H5Pset_obj_track_times(plain, false), "a file");
  const Handle file(H5Fcreate("run.h5", H5F_ACC_TRUNC, plain, access), H5Fclose, "a file");
  for (const Attribute& attribute : content.attributes) set_attribute(file, attribute);
  for (const Table& table : content.tables) write_table(file, table);
  check(H5Fflush(file, H5F_SCOPE_GLOBAL), "the file");
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size <= 0) throw std::runtime_error("HDF5: the file has no image");
  std::string image(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file, image.data(), image.size()) != size)
    throw std::runtime_error("HDF5: the image is cut");
  return image;
}

}  // namespace rotorub::hdf5
