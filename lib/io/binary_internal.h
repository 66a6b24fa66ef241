/// @file
/// Numbers out of bytes of either order, with errors that say where.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "io/error.h"

namespace io {

class BinaryReader {
 public:
  BinaryReader(std::string_view file, std::string_view bytes, std::endian order,
               std::size_t begin = 0)
      : file_(file), bytes_(bytes), at_(begin), last_(begin), order_(order) {}

  template <class Number>
  requires std::is_arithmetic_v<Number> Number read() {
    skip(sizeof(Number));
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), bytes_.data() + last_, sizeof(Number));
    if (order_ != std::endian::native) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<Number>(raw);
  }

  /// As read; fails on a NaN and on an infinity.
  template <class Number>
  Number finite() {
    const Number value = read<Number>();
    if constexpr (std::is_floating_point_v<Number>)
      if (!std::isfinite(value))
        fail_at_last("not a finite number: '" + std::to_string(value) + "'");
    return value;
  }

  void skip(std::size_t n_bytes) {
    last_ = at_;
    if (n_bytes > remaining()) fail_at_last("the file is cut off");
    at_ += n_bytes;
  }

  std::size_t remaining() const { return bytes_.size() - at_; }

  /// Throws ParseError at the start of the value read or skipped last.
  [[noreturn]] void fail_at_last(const std::string& what) const {
    throw ParseError(std::string(file_) + ":byte " + std::to_string(last_) +
                     ": " + what);
  }

 private:
  std::string_view file_;
  std::string_view bytes_;
  std::size_t at_;
  std::size_t last_;
  std::endian order_;
};

}  // namespace io
