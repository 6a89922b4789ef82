// The largest number of contacts in a model, and a list with that capacity that needs no heap
// memory, for data of all contacts or of the closed ones.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>

namespace rotorub {

inline constexpr int kMaxContacts = 8;

template <class T>
class ContactList {
 public:
  void push_back(const T& item) {
    assert(size_ < items_.size());
    items_[size_++] = item;
  }
  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T* data() const { return items_.data(); }
  T* data() { return items_.data(); }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T& operator[](std::size_t i) const { return items_[i]; }
  T& operator[](std::size_t i) { return items_[i]; }

 private:
  std::array<T, kMaxContacts> items_{};
  std::size_t size_ = 0;
};

}  // namespace rotorub
