#include "apps/paths.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace command {

std::filesystem::path place(const std::string& path) {
  std::error_code error;  // then the path itself has to do
  const auto full = std::filesystem::absolute(path, error);
  const auto canonical = std::filesystem::weakly_canonical(full, error);
  return error ? full : canonical;
}

std::string input_name(const std::string& path) {
  if (path == "-") return "standard input";
  return std::filesystem::path(path).filename().string();
}

void require_no_input(std::span<const std::string> inputs,
                      std::span<const std::string> outputs) {
  for (const std::string& out : outputs)
    for (const std::string& in : inputs)
      if (!in.empty() && !out.empty() && in != "-" && out != "-" &&
          place(in) == place(out))
        throw std::invalid_argument(out + ": would overwrite the input");
}

void require_different(std::span<const std::string> outputs) {
  std::vector<std::filesystem::path> places;
  for (const std::string& out : outputs) {
    if (out.empty()) continue;
    if (std::ranges::find(places, place(out)) != places.end())
      throw std::invalid_argument(out + ": named as two outputs");
    places.push_back(place(out));
  }
}

}  // namespace command
