/// @file
/// What io throws. Every message is one printable line.
#pragma once

#include <stdexcept>

namespace io {

/// An input that cannot be read or is malformed: `file: what` or
/// `file:line:column: what, the value`; in binary data `file:byte n: what`.
/// Lines, columns and bytes count from 1, 1 and 0.
class ParseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An output that cannot be written: `file: what`.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace io
