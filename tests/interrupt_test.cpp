// Ctrl-C ends the closing, not the command: the surface so far is written.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "command_path.h"
#include "tests/support/temporary_folder.h"

namespace {

using Json = nlohmann::json;

// Whether the process has a handler of its own for SIGINT; Linux alone says.
bool catches_interrupts(pid_t process) {
  const std::filesystem::path processes = "/proc";
  std::ifstream status(processes / std::to_string(process) / "status");
  const std::string key = "SigCgt:";
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key))
      return (std::stoull(line.substr(key.size()), nullptr, 16) >>
                  (SIGINT - 1) &
              1U) != 0;
  return false;
}

// `umbrella reconstruct`, whose output goes nowhere.
pid_t start_reconstruct(const std::string& in, const std::string& out,
                        const std::string& report) {
  const pid_t child = fork();
  if (child != 0) return child;
  signal(SIGINT, SIG_DFL);
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int stream : {0, 1, 2}) dup2(nowhere, stream);
  execl(kCommandPath, kCommandPath, "reconstruct", in.c_str(), "-o",
        out.c_str(), "--report", report.c_str(), nullptr);
  _exit(127);
}

// The exit code; -1 if a signal ended the process.
int wait_for(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Interrupt, WritesTheBestSurfaceSoFar) {
  if (access("/proc/self/status", R_OK) != 0) GTEST_SKIP() << "no /proc";
  const support::TemporaryFolder folder;
  const std::string points = folder.path("points.ply");
  std::string generate = kCommandPath;
  generate += " generate sphere -n 10000 --noise 1 -o " + points;
  ASSERT_EQ(std::system(generate.c_str()), 0);

  const pid_t process = start_reconstruct(points, folder.path("mesh.ply"),
                                          folder.path("report.json"));
  int n_looks = 0;
  while (!catches_interrupts(process) &&
         waitpid(process, nullptr, WNOHANG) == 0 && ++n_looks < 100'000)
    std::this_thread::yield();
  kill(process, SIGINT);
  EXPECT_EQ(wait_for(process), 3);
  const Json report = Json::parse(folder.content("report.json"));
  EXPECT_EQ(report["closing"]["interrupted"], true);
  EXPECT_GT(report["closing"]["undecided"], 0);
  EXPECT_GT(report["surface"]["triangles"], 0);
  EXPECT_FALSE(folder.content("mesh.ply").empty());
}

}  // namespace
