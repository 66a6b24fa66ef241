#include <fast_float/fast_float.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <system_error>

#include "io/error.h"
#include "io/scanner_internal.h"

namespace io {
namespace {

// Control characters as \\x and two digits; with `ascii`, all beyond ASCII too.
std::string escaped(std::string_view text, bool ascii) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f && !(ascii && byte > 0x7f)) {
      out += c;
    } else {
      out += "\\x";
      out += kHex[byte >> 4U];
      out += kHex[byte & 15U];
    }
  }
  return out;
}

}  // namespace

std::string display_name(std::string_view path) {
  return path == "-" ? "<stdin>" : escaped(path, false);
}

std::string display_output(std::string_view path) {
  return path == "-" ? "<stdout>" : escaped(path, false);
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string out = "'";
  out += escaped(text.substr(0, kLongest), true);
  out += text.size() > kLongest ? "...'" : "'";
  return out;
}

Scanner::Scanner(std::string_view file, std::string_view text, Syntax syntax)
    : slash_comments_(syntax.slash_comments),
      file_(file),
      begin_(text.data()),
      end_(begin_ + text.size()),
      here_(begin_),
      line_begin_(begin_),
      last_(begin_) {
  kinds_.fill(Kind::Word);
  for (const unsigned char c : {' ', '\t', '\v', '\f'}) kinds_[c] = Kind::Blank;
  for (const unsigned char c : {'\n', '\r'}) kinds_[c] = Kind::LineEnd;
  if (syntax.hash_comments) kinds_['#'] = Kind::Comment;
  if (syntax.separators)
    for (const unsigned char c : {',', ';'}) kinds_[c] = Kind::Separator;
}

// The end of the text ends a line.
Scanner::Kind Scanner::kind(const char* p) const {
  if (p == end_) return Kind::LineEnd;
  if (slash_comments_ && *p == '/' && p + 1 != end_ && p[1] == '/')
    return Kind::Comment;
  return kinds_[static_cast<unsigned char>(*p)];
}

void Scanner::skip_blanks() {
  while (kind(here_) == Kind::Blank) ++here_;
}

void Scanner::skip_line() {
  while (kind(here_) != Kind::LineEnd) ++here_;
  if (here_ == end_) return;
  const bool pair = *here_ == '\r' && here_ + 1 != end_ && here_[1] == '\n';
  here_ += pair ? 2 : 1;
  line_begin_ = here_;
  ++line_;
}

bool Scanner::next_row() {
  if (in_row_) skip_line();
  in_row_ = true;
  for (;;) {
    skip_blanks();
    const Kind k = kind(here_);
    if (k == Kind::Word || k == Kind::Separator) return true;
    if (here_ == end_) return false;
    skip_line();
  }
}

bool Scanner::more() {
  skip_blanks();
  char separator = ' ';
  if (kind(here_) == Kind::Separator) {
    separator = *here_++;
    skip_blanks();
  }
  const Kind k = kind(here_);
  if (k == Kind::LineEnd || k == Kind::Comment) return false;
  if (separator_ == '\0') separator_ = separator;
  if (separator != separator_)
    fail_here("values are separated in two ways, " + quoted({&separator_, 1}) +
              " and " + quoted({&separator, 1}));
  return true;
}

std::string_view Scanner::word() {
  skip_blanks();
  last_ = here_;
  while (kind(here_) == Kind::Word) ++here_;
  return {last_, static_cast<std::size_t>(here_ - last_)};
}

double Scanner::number() {
  skip_blanks();
  last_ = here_;
  const char* first = here_;
  if (first != end_ && *first == '+') ++first;
  double value = 0;
  const auto [ptr, error] = fast_float::from_chars(first, end_, value);
  const bool complete = ptr != first && kind(ptr) != Kind::Word;
  if (!complete || error == std::errc::invalid_argument) {
    const std::string_view text = word();
    fail_at_last(text.empty() ? "a number is missing"
                              : "not a number: " + quoted(text));
  }
  here_ = ptr;
  if (!std::isfinite(value))
    fail_at_last("not a finite number: " +
                 quoted({last_, static_cast<std::size_t>(ptr - last_)}));
  return value;
}

std::int64_t Scanner::integer(std::int64_t low, std::int64_t high,
                              std::string_view what) {
  const std::string_view text = word();
  const char* const text_end = text.data() + text.size();
  std::int64_t value = 0;
  const auto [ptr, error] = std::from_chars(text.data(), text_end, value);
  const bool in_range = error == std::errc{} && low <= value && value <= high;
  if (ptr == text_end && in_range) return value;
  const std::string name(what);
  if (text.empty()) fail_at_last(name + " is missing");
  const bool is_integer = ptr == text_end && ptr != text.data();
  fail_at_last(name + (is_integer ? " is out of range: " : " is no integer: ") +
               quoted(text));
}

void Scanner::fail_here(const std::string& what) const { fail(here_, what); }

void Scanner::fail_at_last(const std::string& what) const { fail(last_, what); }

void Scanner::fail(const char* at, const std::string& what) const {
  // A value read last may lie on an earlier line only if none was read since.
  const auto column = at >= line_begin_ ? at - line_begin_ + 1 : 1;
  throw ParseError(std::string(file_) + ":" + std::to_string(line_) + ":" +
                   std::to_string(column) + ": " + what);
}

}  // namespace io
