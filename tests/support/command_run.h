/// @file
/// The command as a user starts it, by the shell.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "command_path.h"
#include "tests/support/temporary_folder.h"

namespace support {

struct Finished {
  int status;  ///< the exit code; -1 if a signal ended the command
  std::string out;
  std::string err;
};

/// Runs `umbrella ARGUMENTS` in the folder, where it leaves its streams as the
/// files `out` (unless another is named) and `err`.
inline Finished run_command(const TemporaryFolder& folder,
                            const std::string& arguments,
                            const std::string& input = "/dev/null",
                            const std::string& output = "out") {
  const std::string line = "cd '" + folder.path("") + "' && '" + kCommandPath +
                           "' " + arguments + " 2>err <" + input + " >" +
                           output;
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, folder.content("out"),
          folder.content("err")};
}

}  // namespace support
