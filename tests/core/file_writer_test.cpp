#include "morsel/core/io/file_writer.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/temporary_file.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::test;
using core::FileWriter;
using core::WriteFailed;
namespace fs = std::filesystem;

namespace {

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// Files of this process may not grow beyond `bytes` while it lives: what a full disk does, without one.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~SmallDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

}  // namespace

TEST_CASE("a file appears when it is committed and not before") {
  const Scratch scratch;
  const fs::path path = scratch / "report.json";
  {
    FileWriter writer(path);
    writer.write("a ");
    writer.write_number(0.1);
    writer.write(" ");
    writer.write_number(std::uint64_t{18446744073709551615u});
    writer.stream() << ' ' << 1e6 << ' ' << 12;
    writer.write_bytes("\0z", 2);
    CHECK_FALSE(fs::exists(path));
    writer.commit();
    writer.commit();
    CHECK_THROWS_AS(writer.write("late"), std::logic_error);
  }
  CHECK(contents(path) == std::string("a 0.1 18446744073709551615 1000000 12\0z", 39));
  CHECK(files_in(scratch.path()) == 1);
}

TEST_CASE("what is not committed leaves the old file and nothing else") {
  const Scratch scratch;
  const fs::path path = scratch / "report.json";
  core::write_file(path, "old");
  try {
    FileWriter writer(path);
    writer.write(std::string(1 << 20, 'x'));
    throw core::Cancelled();
  } catch (const core::Cancelled&) {
  }
  CHECK(contents(path) == "old");
  CHECK(files_in(scratch.path()) == 1);
  core::write_file(path, "new");
  CHECK(contents(path) == "new");
}

TEST_CASE("an incomplete file has no name, or one that is removed once no process locks it") {
  const Scratch scratch;
  const std::string left = ".morsel-4194305-0.tmp";
  fs::create_directory(scratch / "other");
  std::ofstream(scratch / "other" / left) << "of a killed process";
  std::ofstream(scratch / "other" / ".morsel-1-0.tmp.txt") << "no temporary file";
  fs::create_symlink("../other", scratch / "other" / ".morsel-4194305-1.tmp");
  {
    FileWriter writer(scratch / "other" / "report.json");  // the first one in that folder
    writer.write("a");
    CHECK_FALSE(fs::exists(scratch / "other" / left));
    CHECK(fs::is_symlink(scratch / "other" / ".morsel-4194305-1.tmp"));
    core::unlink_temporary_files();
    CHECK(files_in(scratch / "other") == 2);
  }
  CHECK(fs::exists(scratch / "other" / ".morsel-1-0.tmp.txt"));
}

TEST_CASE("a file that appeared meanwhile is replaced whole") {
  const Scratch scratch;
  FileWriter writer(scratch / "report.json");
  writer.write("new");
  std::ofstream(scratch / "report.json") << "of somebody else, longer";
  writer.commit();
  CHECK(contents(scratch / "report.json") == "new");
  CHECK(files_in(scratch.path()) == 1);
}

TEST_CASE("a full disk fails with the reason and leaves the old file") {
  const Scratch scratch;
  const fs::path path = scratch / "report.json";
  core::write_file(path, "old");
  const std::string much(3 << 20, 'x');
  for (const bool through_stream : {false, true}) {
    const SmallDisk disk(1 << 20);
    const auto write = [&] {
      FileWriter writer(path);
      if (through_stream)
        writer.stream() << much;
      else
        writer.write(much);
      writer.commit();
    };
    CHECK_THROWS_WITH(write(), Catch::Contains("report.json") && Catch::Contains("File too large"));
    CHECK_THROWS_AS(write(), WriteFailed);
  }
  CHECK(contents(path) == "old");
  CHECK(files_in(scratch.path()) == 1);
}

TEST_CASE("a device is written directly and its errors are seen") {
  CHECK_NOTHROW(core::write_file("/dev/null", "anything"));
  CHECK_THROWS_WITH(core::write_file("/dev/full", "anything"),
                    Catch::Contains("/dev/full") && Catch::Contains("No space left on device"));
  CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("an open file is written directly, stays open, and its errors name it") {
  const Scratch scratch;
  const std::string path = (scratch / "open").string();
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  REQUIRE(file >= 0);
  const core::FileTarget target = core::FileTarget::open_file(file, "standard output", ".txt");
  core::write_file(target, "one ");
  core::write_file(target, "two");
  CHECK(contents(path) == "one two");
  ::close(file);
  CHECK_THROWS_WITH(core::write_file(target, "three"),
                    "cannot write to standard output: Bad file descriptor");
  const int reading = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  CHECK_THROWS_WITH(FileWriter(core::FileTarget::open_file(reading, "it", "")),
                    "cannot write to it: Bad file descriptor");
  ::close(reading);
}

TEST_CASE("bug: files in /dev/shm were taken for devices and could not be made") {
  if (!fs::is_directory("/dev/shm")) return;
  const fs::path path = "/dev/shm/morsel-file-writer-test-" + std::to_string(::getpid());
  core::write_file(path, "a");
  core::write_file(path, "b");
  CHECK(contents(path) == "b");
  fs::remove(path);
}

TEST_CASE("paths at which no file can be written are refused with a reason") {
  const Scratch scratch;
  CHECK_THROWS_WITH(FileWriter(scratch.path()), Catch::Contains("Is a directory"));
  CHECK_THROWS_AS(FileWriter(""), WriteFailed);
  CHECK_THROWS_AS(FileWriter(scratch.path() / ""), WriteFailed);
  for (const char* name : {"x/../b/a.txt", "x/./d/a.txt", "x/y/../../x/z/a.txt"}) {  // bug: x stayed
    { FileWriter writer(scratch / name); }
    CHECK_FALSE(fs::exists(scratch / "x"));
    CHECK_FALSE(fs::exists(scratch / "b"));
  }
  core::write_file(scratch / "file", "");
  CHECK_THROWS_WITH(FileWriter(scratch / "file" / "a.txt"), Catch::Contains("Not a directory"));
  if (::geteuid() != 0) {
    fs::create_directory(scratch / "locked");
    fs::permissions(scratch / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    CHECK_THROWS_WITH(FileWriter(scratch / "locked" / "a.txt"), Catch::Contains("Permission denied"));
    fs::permissions(scratch / "file", fs::perms::owner_read);
    CHECK_THROWS_WITH(FileWriter(scratch / "file"), Catch::Contains("Permission denied"));
  }
}

TEST_CASE("folders of the target are made, and removed again unless something is in them") {
  const Scratch scratch;
  { FileWriter writer(scratch / "new" / "deep" / "a.txt"); }
  CHECK_FALSE(fs::exists(scratch / "new"));
  {
    FileWriter first(scratch / "new" / "deep" / "a.txt");
    FileWriter second(scratch / "new" / "b.txt");
    second.write("b");
    second.commit();
  }
  CHECK_FALSE(fs::exists(scratch / "new" / "deep"));
  CHECK(contents(scratch / "new" / "b.txt") == "b");
  core::write_file(scratch / "new" / "deep" / "a.txt", "a");
  CHECK(contents(scratch / "new" / "deep" / "a.txt") == "a");
  core::write_file(scratch / "file", "");
  CHECK_THROWS_WITH(FileWriter(scratch / "file" / "deep" / "a.txt"), Catch::Contains("Not a directory"));
}

TEST_CASE("bug: a run that was stopped removed the folder under another, whose result was lost") {
  const Scratch scratch;
  {
    std::optional<FileWriter> stopped(std::in_place, scratch / "new" / "deep" / "b.txt");
    FileWriter writer(scratch / "new" / "deep" / "a.txt");
    writer.write("a");
    stopped.reset();
    writer.commit();
  }
  CHECK(contents(scratch / "new" / "deep" / "a.txt") == "a");
}

TEST_CASE("a target folder that cannot be made again makes the commit fail") {
  const Scratch scratch;
  fs::create_directory(scratch / "folder");
  FileWriter writer(scratch / "folder" / "a.txt");
  writer.write("a");
  fs::remove_all(scratch / "folder");
  core::write_file(scratch / "folder", "a file");
  CHECK_THROWS_AS(writer.commit(), WriteFailed);
}

TEST_CASE("permissions and links of the target are kept") {
  const Scratch scratch;
  core::write_file(scratch / "new", "");
  const mode_t mask = ::umask(0);
  ::umask(mask);
  struct stat status {};
  ::stat((scratch / "new").c_str(), &status);
  CHECK((status.st_mode & 0777) == (0666 & ~mask));

  core::write_file(scratch / "real", "old");
  fs::permissions(scratch / "real", fs::perms(0640));
  fs::create_symlink("real", scratch / "link");
  fs::create_symlink("not-yet", scratch / "dangling");
  core::write_file(scratch / "link", "new");
  core::write_file(scratch / "dangling", "made");
  CHECK(fs::is_symlink(scratch / "link"));
  CHECK(contents(scratch / "real") == "new");
  CHECK(fs::status(scratch / "real").permissions() == fs::perms(0640));
  CHECK(contents(scratch / "not-yet") == "made");
}

TEST_CASE("numbers are written so that they read back the same") {
  const Scratch scratch;
  const std::vector<double> values = {0.1, -0.0, 1e300, 5e-324, 1.0 / 3, std::numeric_limits<double>::max()};
  FileWriter writer(scratch / "numbers");
  for (const double value : values) {
    writer.write_number(value);
    writer.write("\n");
  }
  writer.commit();
  std::ifstream file(scratch / "numbers");
  std::string line;
  for (const double value : values) {
    std::getline(file, line);
    const double back = std::strtod(line.c_str(), nullptr);
    CHECK(back == value);
    CHECK(std::signbit(back) == std::signbit(value));
  }
}
