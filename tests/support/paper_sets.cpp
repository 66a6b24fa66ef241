#include "tests/support/paper_sets.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace test_support {

std::optional<std::vector<Eigen::Vector3d>> paper_set(const std::string& name) {
  const char* folder = std::getenv("UMBRELLA_DATA");
  if (folder == nullptr) return std::nullopt;
  const auto path = std::filesystem::path(folder) / (name + ".xyz.gz");
  if (!std::filesystem::exists(path)) return std::nullopt;

  const std::string command = "gzip -dc '" + path.string() + "'";
  const auto close = [](std::FILE* f) { pclose(f); };
  const std::unique_ptr<std::FILE, decltype(close)> pipe(
      popen(command.c_str(), "r"), close);
  if (!pipe) throw std::runtime_error("cannot run: " + command);
  std::vector<Eigen::Vector3d> points;
  std::array<char, 256> line;
  while (std::fgets(line.data(), line.size(), pipe.get()) != nullptr) {
    std::istringstream fields(line.data());
    Eigen::Vector3d p;
    if (fields >> p[0] >> p[1] >> p[2]) points.push_back(p);
  }
  if (points.empty()) throw std::runtime_error("no points from: " + command);
  return points;
}

}  // namespace test_support
