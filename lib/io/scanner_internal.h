/// @file
/// Text as rows of words and numbers, with errors that say where.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace io {

/// A file name for messages: `-` is <stdin>, control characters are escaped.
std::string display_name(std::string_view path);

/// As display_name; but `-` is <stdout>.
std::string display_output(std::string_view path);

/// 'text', for messages: escaped, and cut when long.
std::string quoted(std::string_view text);

struct Syntax {
  bool hash_comments = false;   ///< # to the end of the line
  bool slash_comments = false;  ///< // to the end of the line
  bool separators = false;      ///< , and ; may stand between values
};

/// A row is a line that is neither blank nor only a comment; lines end with
/// LF, CR LF or CR.
class Scanner {
 public:
  /// @param file  as shown in messages
  Scanner(std::string_view file, std::string_view text, Syntax syntax = {});

  /// Moves to the first value of the next row, from wherever it stands; the
  /// first call finds the first row. False if there is none.
  bool next_row();

  /// Moves over blanks and at most one separator to the next value of the
  /// row. False at its end.
  /// @throws ParseError  the kind of separator has changed within the file
  bool more();

  /// The value here, up to a blank, a separator or the end of the row.
  std::string_view word();
  /// The next value of the row; fails on none, and on what is no finite
  /// number. Too small a number is 0 or subnormal.
  double number();
  /// The next value of the row, within [low, high].
  std::int64_t integer(std::int64_t low, std::int64_t high,
                       std::string_view what);

  /// Bytes before the place that the scanner is at.
  std::size_t offset() const { return here_ - begin_; }
  std::size_t remaining() const { return end_ - here_; }

  /// Throws ParseError: `file:line:column: what`, at the current place or at
  /// the start of the value read last.
  [[noreturn]] void fail_here(const std::string& what) const;
  [[noreturn]] void fail_at_last(const std::string& what) const;

 private:
  enum class Kind : std::uint8_t { Word, Blank, Separator, LineEnd, Comment };

  Kind kind(const char* p) const;
  void skip_blanks();
  void skip_line();
  [[noreturn]] void fail(const char* at, const std::string& what) const;

  std::array<Kind, 256> kinds_;
  bool slash_comments_;
  std::string_view file_;
  const char* begin_;
  const char* end_;
  const char* here_;
  const char* line_begin_;
  const char* last_;  // start of the value read last
  std::uint64_t line_ = 1;
  bool in_row_ = false;    // next_row has to leave the current line first
  char separator_ = '\0';  // the file's: ' ' ',' ';' or not known yet
};

}  // namespace io
