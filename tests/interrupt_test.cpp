// Ctrl-C ends the closing, not the command: the surface so far is written.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <vector>

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

// `umbrella ARGUMENTS`, whose standard output is a file.
pid_t start(std::vector<std::string> arguments, const std::string& out) {
  std::vector<char*> words = {nullptr};
  arguments.insert(arguments.begin(), kCommandPath);
  for (std::string& word : arguments)
    words.insert(words.end() - 1, word.data());
  const pid_t child = fork();
  if (child != 0) return child;
  signal(SIGINT, SIG_DFL);
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int stream : {0, 2}) dup2(nowhere, stream);
  dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR), 1);
  execv(kCommandPath, words.data());
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

  const pid_t process =
      start({"reconstruct", points, "-o", folder.path("mesh.ply"), "--report",
             folder.path("report.json")},
            folder.path("out"));
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
  EXPECT_NE(folder.content("out").find(", cut short by Ctrl-C ("),
            std::string::npos);
}

// The least number of variables that meet many random threesomes: a model is
// found at once, and no search of today proves it the least.
std::string hard_program() {
  std::mt19937_64 rng(1);
  std::string text = "min:";
  const auto variable = [](std::uint64_t v) {
    return " +1 x" + std::to_string(v + 1);
  };
  for (std::uint64_t v = 0; v < 300; ++v) text += variable(v);
  text += " ;\n";
  for (int i = 0; i < 1500; ++i) {
    const std::uint64_t v = rng() % 100;
    text += variable(v) + variable(100 + rng() % 100) +
            variable(200 + rng() % 100) + " >= 1 ;\n";
  }
  return text;
}

TEST(Interrupt, PrintsTheBestModelSoFar) {
  const support::TemporaryFolder folder;
  folder.file("p.opb", hard_program());
  const std::string out = folder.path("out");
  const pid_t process = start({"solve", folder.path("p.opb")}, out);
  const auto has_model = [&out] {
    std::ifstream lines(out);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("o ")) return true;
    return false;
  };
  int n_looks = 0;
  while (!has_model() && waitpid(process, nullptr, WNOHANG) == 0 &&
         ++n_looks < 2000)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(process, SIGINT);
  EXPECT_EQ(wait_for(process), 3);
  EXPECT_NE(folder.content("out").find("\ns SATISFIABLE\nv "),
            std::string::npos);
}

}  // namespace
