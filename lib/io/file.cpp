#include "io/file.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "io/error.h"
#include "io/scanner_internal.h"

namespace io {
namespace {

namespace fs = std::filesystem;

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void fail_write(const std::string& path, const std::string& why) {
  throw WriteError(display_output(path) + ": cannot write: " + why);
}

std::string read_all(std::FILE* file, std::size_t expected,
                     const std::string& path) {
  std::string bytes;
  std::size_t size = 0;
  do {
    // One byte more than expected, so that the end shows without growing.
    bytes.resize(std::max({expected + 1, 2 * size, std::size_t{1} << 16U}));
    errno = 0;
    size += std::fread(bytes.data() + size, 1, bytes.size() - size, file);
    if (std::ferror(file) != 0)
      throw ParseError(display_name(path) + ": cannot read: " + reason(errno));
  } while (size == bytes.size());
  bytes.resize(size);
  return bytes;
}

// False, with errno set, if not everything reached the file.
bool put(std::FILE* file, std::string_view bytes) {
  return std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() &&
         std::fflush(file) == 0;
}

void write_directly(const std::string& path, std::string_view bytes) {
  const File file(std::fopen(path.c_str(), "wb"));
  if (!file || !put(file.get(), bytes)) fail_write(path, reason(errno));
}

void write_and_rename(const std::string& path, const fs::path& target,
                      std::string_view bytes) {
  std::string temporary;
  File file;
  for (int i = 0; !file; ++i) {
    temporary = target.string() + ".part" + std::to_string(i);
    file.reset(std::fopen(temporary.c_str(), "wbx"));
    if (!file && errno != EEXIST) fail_write(path, reason(errno));
  }
  std::error_code error;
  if (!put(file.get(), bytes)) error.assign(errno, std::generic_category());
  if (std::fclose(file.release()) != 0 && !error)
    error.assign(errno, std::generic_category());
  if (!error) fs::rename(temporary, target, error);
  if (!error) return;
  std::error_code ignored;
  fs::remove(temporary, ignored);
  fail_write(path, error.message());
}

// Where the links lead, whether or not there is a file yet.
fs::path behind_links(const std::string& path) {
  constexpr int kMostLinks = 40;  // as Linux has it
  fs::path target = path;
  std::error_code error;
  for (int i = 0; fs::is_symlink(target, error); ++i) {
    if (i == kMostLinks) fail_write(path, reason(ELOOP));
    target = target.parent_path() / fs::read_symlink(target, error);
    if (error) fail_write(path, error.message());
  }
  return target;
}

// Something other than a file or a folder, such as a pipe.
bool is_device(const fs::path& target) {
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  return fs::exists(status) && !fs::is_regular_file(status);
}

fs::path writable_target(const std::string& path) {
  fs::path target = behind_links(path);
  std::error_code error;
  if (fs::is_directory(target, error)) fail_write(path, reason(EISDIR));
  if (is_device(target)) return target;
  // Renaming needs no leave to write the target; respect its protection.
  if (fs::exists(target, error) && !File(std::fopen(target.c_str(), "r+b")))
    fail_write(path, reason(errno));
  const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
  if (access((folder / "").c_str(), W_OK | X_OK) != 0)
    fail_write(path, reason(errno));
  return target;
}

}  // namespace

std::string read_file(const std::string& path) {
  if (path == "-") return read_all(stdin, 0, path);
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file)
    throw ParseError(display_name(path) + ": cannot read: " + reason(errno));
  std::error_code error;
  const bool regular = fs::is_regular_file(path, error);
  const auto size = regular ? fs::file_size(path, error) : 0;
  return read_all(file.get(), error ? 0 : size, path);
}

void require_writable(const std::string& path) {
  if (path != "-") writable_target(path);
}

void write_file(const std::string& path, std::string_view bytes) {
  if (path == "-") {
    if (!put(stdout, bytes)) fail_write(path, reason(errno));
    return;
  }
  const fs::path target = writable_target(path);
  if (is_device(target)) return write_directly(path, bytes);
  write_and_rename(path, target, bytes);
}

}  // namespace io
