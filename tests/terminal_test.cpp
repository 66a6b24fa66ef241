// What the command shows on a terminal, and on nothing else.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "command_path.h"
#include "tests/support/temporary_folder.h"

namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

using Variables = std::vector<std::pair<std::string, std::string>>;

class Terminal : public ::testing::Test {
 protected:
  void SetUp() override {
    const int terminal = new_terminal();
    if (terminal < 0) GTEST_SKIP() << "no pseudo-terminals";
    close(terminal);
    const std::string line = std::string(kCommandPath) +
                             " generate sphere -n 300 --noise 0.5 -o " +
                             points_;
    ASSERT_EQ(std::system(line.c_str()), 0);
  }

  // What `umbrella reconstruct OPTIONS` writes to the stream (1 or 2), which is
  // a terminal; the other streams lead nowhere.
  std::string shown(int stream, std::vector<std::string> options,
                    const Variables& variables = {}) {
    const int terminal = new_terminal();
    const int end = open(ptsname(terminal), O_RDWR | O_NOCTTY | O_CLOEXEC);
    const pid_t child = fork();
    if (child == 0) run(end, stream, std::move(options), variables);
    close(end);
    std::string text;
    std::array<char, 4096> bytes;
    for (ssize_t n = 0; (n = read(terminal, bytes.data(), bytes.size())) > 0;)
      text.append(bytes.data(), static_cast<std::size_t>(n));
    close(terminal);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    return text;
  }

 private:
  // Its side that reads; below 0 if there is none.
  static int new_terminal() {
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (terminal < 0) return -1;
    return grantpt(terminal) == 0 && unlockpt(terminal) == 0 ? terminal : -1;
  }

  [[noreturn]] void run(int terminal, int stream,
                        std::vector<std::string> options,
                        const Variables& variables) const {
    setenv("TERM", "xterm", 1);
    unsetenv("NO_COLOR");
    for (const auto& [name, value] : variables)
      setenv(name.c_str(), value.c_str(), 1);
    options.insert(options.begin(), {kCommandPath, "reconstruct", points_});
    std::vector<char*> words;
    for (std::string& word : options) words.push_back(word.data());
    words.push_back(nullptr);
    const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
    for (const int other : {0, 1, 2})
      dup2(other == stream ? terminal : nowhere, other);
    execv(kCommandPath, words.data());
    _exit(127);
  }

  support::TemporaryFolder folder_;
  std::string points_ = folder_.path("points.ply");
};

constexpr const char* kEmptyLine = "\r\x1b[K";

TEST_F(Terminal, ShowsEachStageAndClearsTheLine) {
  const std::string text = shown(2, {});
  std::size_t at = 0;
  for (const std::string stage :
       {"read", "delaunay", "lambda", "filter", "clean_up", "holes", "closing",
        "surface", "certificate", "write"}) {
    SCOPED_TRACE(stage);
    at = text.find(kEmptyLine + stage, at);
    ASSERT_NE(at, std::string::npos) << text;
  }
  EXPECT_THAT(text, EndsWith(kEmptyLine));
}

TEST_F(Terminal, CountsTheRegionsThatAreClosed) {
  const std::string text = shown(2, {});
  const std::size_t closing = text.find(kEmptyLine + std::string("closing"));
  const std::size_t at = text.find(kEmptyLine + std::string("closing: "));
  ASSERT_NE(at, std::string::npos) << text;
  EXPECT_LT(closing, at);
  EXPECT_LT(at, text.find(kEmptyLine + std::string("surface")));
  const std::size_t last = text.rfind("closing: ");
  std::istringstream words(text.substr(last));
  std::string word;
  std::size_t done = 0, all = 0;
  words >> word >> done >> word >> all >> word;
  EXPECT_GT(done, 0U);
  EXPECT_EQ(done, all);
  EXPECT_EQ(word.substr(0, 7), "regions");
}

TEST_F(Terminal, ShowsNoStagesWhereTheyAreNotWanted) {
  EXPECT_EQ(shown(2, {"--quiet"}), "");
  EXPECT_EQ(shown(2, {}, {{"TERM", "dumb"}}), "");
  EXPECT_THAT(shown(1, {}), Not(HasSubstr("delaunay")));
}

TEST_F(Terminal, ColorsTheVerdictUnlessToldOtherwise) {
  const std::string green = "\x1b[32mclosed, manifold\x1b[0m";
  EXPECT_THAT(shown(1, {}), HasSubstr(green));
  EXPECT_THAT(shown(1, {}, {{"NO_COLOR", ""}}), HasSubstr(green));
  EXPECT_THAT(shown(1, {}, {{"NO_COLOR", "1"}}), Not(HasSubstr("\x1b")));
  EXPECT_THAT(shown(1, {}, {{"TERM", "dumb"}}), Not(HasSubstr("\x1b")));
  EXPECT_THAT(shown(1, {"--color", "never"}), Not(HasSubstr("\x1b")));
  EXPECT_THAT(shown(1, {"--color", "always"}, {{"NO_COLOR", "1"}}),
              HasSubstr(green));
}

}  // namespace
