/// @file
/// Progress and colour on a terminal.
#pragma once

#include <string>
#include <string_view>

namespace terminal {

enum class Color { Auto, Always, Never };

/// Shows one line on standard error that the next call replaces; nothing if
/// standard error is no terminal or `quiet`.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::string_view text);
  void clear();

 private:
  bool active_;
};

/// `text` in green or red where `color` and the stream (1 standard output, 2
/// standard error) say so.
std::string verdict(std::string_view text, bool good, Color color, int stream);

}  // namespace terminal
