/// @file
/// Rows of different lengths in one flat array.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <vector>

namespace ilp {

/// So that a vector's resize() leaves new items unset.
template <class T>
struct LeavesUnset : std::allocator<T> {
  LeavesUnset() = default;
  template <class U>
  explicit LeavesUnset(const LeavesUnset<U>&) {}
  void construct(T* item) { ::new (static_cast<void*>(item)) T; }
};

template <class T>
class Rows {
 public:
  std::size_t size() const { return begin_.size() - 1; }
  std::size_t n_items() const { return items_.size(); }
  std::span<const T> operator[](std::size_t row) const {
    return {items_.data() + begin_[row], items_.data() + begin_[row + 1]};
  }
  /// Of all rows, one after the other.
  std::span<const T> items() const { return items_; }

  void reserve(std::size_t n_rows, std::size_t n_items) {
    begin_.reserve(n_rows + 1);
    items_.reserve(n_items);
  }

  /// @throws std::length_error  there would be 2^32 items
  void add(std::span<const T> row) {
    constexpr std::size_t kMax = std::numeric_limits<std::uint32_t>::max();
    if (row.size() > kMax - items_.size())
      throw std::length_error("ilp: the constraints have 2^32 terms");
    items_.insert(items_.end(), row.begin(), row.end());
    begin_.push_back(static_cast<std::uint32_t>(items_.size()));
  }

  /// Rows 0 .. n_rows-1 of the entries (key_of(i), item_of(i)), i < n_entries,
  /// each row in ascending i.
  template <class KeyOf, class ItemOf>
  static Rows grouped(std::size_t n_rows, std::size_t n_entries, KeyOf key_of,
                      ItemOf item_of) {
    Rows rows;
    rows.begin_.assign(n_rows + 1, 0);
    for (std::size_t i = 0; i < n_entries; ++i) ++rows.begin_[key_of(i)];
    rows.add_up();
    for (std::size_t i = n_entries; i-- > 0;)
      rows.items_[--rows.begin_[key_of(i)]] = item_of(i);
    return rows;
  }

  /// Rows 0 .. n_rows-1: for each item of the other rows, item_of(row, item)
  /// in row key_of(item), in the order of the items.
  template <class U, class KeyOf, class ItemOf>
  static Rows inverted(std::size_t n_rows, const Rows<U>& other, KeyOf key_of,
                       ItemOf item_of) {
    Rows rows;
    rows.begin_.assign(n_rows + 1, 0);
    for (const U& item : other.items()) ++rows.begin_[key_of(item)];
    rows.add_up();
    T* const items = rows.items_.data();
    std::uint32_t* const begin = rows.begin_.data();
    const U* item = other.items().data() + other.n_items();
    for (std::size_t r = other.size(); r-- > 0;)
      for (const U* const first = other[r].data(); item != first;) {
        --item;
        items[--begin[key_of(*item)]] =
            item_of(static_cast<std::uint32_t>(r), *item);
      }
    return rows;
  }

 private:
  // From sizes to ends, which become begins as the rows are filled.
  void add_up() {
    std::uint32_t end = 0;
    for (std::uint32_t& begin : begin_) begin = end += begin;
    items_.resize(end);
  }

  std::vector<T, LeavesUnset<T>> items_;
  std::vector<std::uint32_t> begin_ = {0};
};

}  // namespace ilp
