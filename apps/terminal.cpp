#include "apps/terminal.h"

#include <unistd.h>

#include <cstdlib>
#include <iostream>

namespace terminal {
namespace {

bool is_terminal(int stream) {
  const char* const kind = std::getenv("TERM");
  return isatty(stream) != 0 && kind != nullptr &&
         std::string_view(kind) != "dumb";
}

}  // namespace

Progress::Progress(bool quiet) : active_(!quiet && is_terminal(2)) {}

void Progress::show(std::string_view text) {
  if (active_) std::cerr << "\r\x1b[K" << text << std::flush;
}

void Progress::clear() { show(""); }

std::string verdict(std::string_view text, bool good, Color color, int stream) {
  // https://no-color.org: the variable counts if it is not empty.
  const char* const no_color = std::getenv("NO_COLOR");
  const bool wanted = no_color == nullptr || *no_color == '\0';
  const bool colored = color == Color::Always ||
                       (color == Color::Auto && wanted && is_terminal(stream));
  if (!colored) return std::string(text);
  std::string out = good ? "\x1b[32m" : "\x1b[31m";
  out += text;
  out += "\x1b[0m";
  return out;
}

}  // namespace terminal
