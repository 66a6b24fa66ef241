/// @file
/// The point sets of the paper's Table 2, which cannot be redistributed: read
/// from the folder named by the environment variable UMBRELLA_DATA.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace test_support {

/// Points of `name`.xyz.gz in that folder; none if the variable is not set or
/// the file is not there.
std::optional<std::vector<Eigen::Vector3d>> paper_set(const std::string& name);

}  // namespace test_support
