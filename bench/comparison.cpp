#include "bench/comparison.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>

namespace bench {
namespace {

double median(std::vector<double> values) {
  const auto middle =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

void Comparison::Column::add(double our_seconds, double peer_seconds) {
  ours.push_back(our_seconds);
  peer.push_back(peer_seconds);
  ratio.push_back(our_seconds / peer_seconds);
}

std::string Comparison::Column::row() const {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%9.4f %9.4f %6.2f", median(ours),
                median(peer), median(ratio));
  return text.data();
}

void Comparison::add(const Seconds& ours, const Seconds& peer) {
  user_.add(ours.user, peer.user);
  wall_.add(ours.wall, peer.wall);
}

std::string Comparison::header() {
  return "ours user CGAL user  ratio ours wall CGAL wall  ratio";
}

std::string Comparison::row() const { return user_.row() + " " + wall_.row(); }

}  // namespace bench
