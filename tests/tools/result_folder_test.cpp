#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/results/file_names.h"
#include "morsel/tools/results/result_folder.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::tools;
namespace fs = std::filesystem;

namespace {

constexpr const char* kFirst = "{\"schema\":\"morsel.results/1\"}\n";

/// Without the identities of the files.
std::string list_of(const fs::path& folder) {
  std::string list;
  bool is_identity = false;
  for (const char c : test::contents(folder / FileList::kName)) {
    is_identity = c == ' ' || (is_identity && c != '\n');
    if (!is_identity) list += c;
  }
  return list;
}

void put(ResultFolder& folder, const char* file, const std::string& text) {
  core::write_file(folder.claim(file), text);
}

/// What is thrown, as text.
template <class Error, class Call>
std::string said(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  FAIL("nothing was thrown");
  return "";
}

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a folder of results is a new one, an empty one, or one that has a list", "[results]") {
  const test::Scratch scratch;
  {
    const ResultFolder made(scratch / "a/b");
    CHECK(list_of(scratch / "a/b") == kFirst);
    const ResultFolder again(scratch / "a/b");
    CHECK(list_of(scratch / "a/b") == kFirst);
  }
  fs::create_directory(scratch / "empty");
  {
    const ResultFolder marked(scratch / "empty");
    CHECK(list_of(scratch / "empty") == kFirst);
  }
  fs::create_directory_symlink("empty", scratch / "link");
  { const ResultFolder through(scratch / "link"); }

  const fs::path theirs = scratch.file("full/thesis.txt", "years").parent_path();
  const std::string sentence = said<core::InvalidArgument>([&] { const ResultFolder folder(theirs); });
  CHECK(has(sentence, "not empty (thesis.txt)"));
  CHECK(has(sentence, "choose a new or an empty folder"));
  CHECK(said<core::InvalidArgument>([&] { ResultFolder::check(theirs); }) == sentence);
  CHECK_FALSE(fs::exists(theirs / FileList::kName));
  ResultFolder::check(scratch / "empty");
  ResultFolder::check(scratch / "absent");
  CHECK_FALSE(fs::exists(scratch / "absent"));
  CHECK_THROWS_AS(ResultFolder(theirs / "thesis.txt"), core::WriteFailed);
  CHECK_THROWS_AS(ResultFolder(theirs / "thesis.txt/below"), core::WriteFailed);
}

TEST_CASE("a folder of results in which nothing was made is left unchanged", "[results]") {
  const test::Scratch scratch;
  fs::create_directory(scratch / "empty");
  fs::create_directory_symlink("empty", scratch / "link");
  scratch.file("listed/.morsel-results", kFirst);
  for (const char* name : {"a/b/c", "a/b/c/", "empty", "link", "listed"}) {
    { const ResultFolder unused(scratch / name); }
    INFO(name);
    CHECK_FALSE(fs::exists(scratch / "a"));
    CHECK(fs::is_empty(scratch / "empty"));
    CHECK(list_of(scratch / "listed") == kFirst);
  }
  fs::create_directory(scratch / "a");
  {
    std::optional<ResultFolder> first(std::in_place, scratch / "a/b");
    ResultFolder second(scratch / "a/b");
    first.reset();
    put(second, "c.txt", "1");
  }
  CHECK(list_of(scratch / "a/b") == std::string(kFirst) + "+c.txt\n");
  {
    ResultFolder outer(scratch / "d");
    const ResultFolder inner(scratch / "d/e");
    scratch.file("d/mine.txt", "years");
  }
  CHECK(test::contents(scratch / "d/mine.txt") == "years");
  CHECK_FALSE(fs::exists(scratch / "d/e"));
}

TEST_CASE("a folder of a batch of version 0.1 is recognised", "[results]") {
  const test::Scratch scratch;
  scratch.file("out/state/sub/a.off.json", "{\"files\": [], \"schema\": \"morsel.batch-state/1\"}");
  CHECK(has(said<core::InvalidArgument>([&] { const ResultFolder folder(scratch / "out"); }), "morsel 0.1"));
  scratch.file("other/state/a.json", "{\"schema\": \"mine\"}");
  CHECK_FALSE(has(said<core::InvalidArgument>([&] { const ResultFolder folder(scratch / "other"); }), "0.1"));
}

TEST_CASE("results are listed and may be replaced", "[results]") {
  const test::Scratch scratch;
  const std::string odd = "odd\n%\xff \"name";
  {
    ResultFolder folder(scratch / "out");
    put(folder, "a.txt", "1");
    put(folder, "sub/deeper/b.txt", "1");
    put(folder, odd.c_str(), "1");
  }
  {
    ResultFolder folder(scratch / "out");
    put(folder, "a.txt", "2");
    put(folder, odd.c_str(), "2");
  }
  CHECK(test::contents(scratch / "out/a.txt") == "2");
  CHECK(test::contents(scratch / "out" / odd) == "2");
  CHECK(list_of(scratch / "out") == std::string(kFirst) +
                                        "+a.txt\n+sub/deeper/b.txt\n+odd%0A%25%FF%20%22name\n" +
                                        "+a.txt\n+odd%0A%25%FF%20%22name\n");
}

TEST_CASE("another file of a listed name is neither replaced nor removed", "[results]") {
  const test::Scratch scratch;
  ResultFolder folder(scratch / "out");
  for (const char* name : {"deleted", "removed", "edited"}) put(folder, name, "mine");
  std::this_thread::sleep_for(std::chrono::milliseconds(50));  // more than the grain of file times
  for (const char* name : {"deleted", "removed"}) {
    fs::remove(scratch / "out" / name);
    scratch.file(std::string("out/") + name, "theirs");  // perhaps with the inode of the other
  }
  scratch.file("out/edited", "theirs");
  CHECK_THROWS_AS(folder.claim("deleted"), core::WriteFailed);
  CHECK_THROWS_AS(folder.check_free("deleted"), core::WriteFailed);
  folder.remove("removed");
  CHECK(test::contents(scratch / "out/deleted") == "theirs");
  CHECK(test::contents(scratch / "out/removed") == "theirs");
  put(folder, "edited", "mine");
}

TEST_CASE("what was listed and not made gives no right to a name", "[results]") {
  const test::Scratch scratch;
  ResultFolder folder(scratch / "out");
  {
    core::FileTarget target = folder.claim("a.txt");
    target.before_appearing = [list = target.before_appearing](int file) {
      list(file);
      throw core::WriteFailed("killed here");
    };
    CHECK_THROWS_AS(core::write_file(target, "mine"), core::WriteFailed);
  }
  CHECK_FALSE(fs::exists(scratch / "out/a.txt"));
  CHECK(has(list_of(scratch / "out"), "+a.txt\n"));
  scratch.file("out/a.txt", "theirs");
  CHECK_THROWS_AS(ResultFolder(scratch / "out").claim("a.txt"), core::WriteFailed);

  core::FileTarget late = folder.claim("late");
  scratch.file("out/late", "theirs");
  CHECK_THROWS_AS(core::write_file(late, "mine"), core::WriteFailed);
  CHECK(test::contents(scratch / "out/late") == "theirs");
}

TEST_CASE("a file that was replaced by none of those listed later is still the program's", "[results]") {
  const test::Scratch scratch;
  scratch.file("out/a.txt", "1");
  scratch.file("out/.morsel-results", std::string(kFirst) + "+a.txt\n");  // without an identity
  ResultFolder folder(scratch / "out");
  for (int i = 0; i < 2; ++i) {
    core::FileTarget target = folder.claim("a.txt");
    target.before_appearing = [list = target.before_appearing](int file) {
      list(file);
      throw core::WriteFailed("killed here");
    };
    CHECK_THROWS_AS(core::write_file(target, "2"), core::WriteFailed);
  }
  put(folder, "a.txt", "3");
  CHECK(test::contents(scratch / "out/a.txt") == "3");
}

TEST_CASE("unlisted files are neither replaced nor removed", "[results]") {
  const test::Scratch scratch;
  ResultFolder folder(scratch / "out");
  put(folder, "mine/a.txt", "mine");
  scratch.file("out/mine/b.txt", "theirs");
  scratch.file("out/file", "theirs");
  scratch.file("elsewhere/c.txt", "theirs");
  fs::create_directory_symlink(scratch / "elsewhere", scratch / "out/link");
  fs::create_symlink(scratch / "elsewhere/c.txt", scratch / "out/c.txt");
  fs::create_symlink("nowhere", scratch / "out/dangling");
  fs::create_directory(scratch / "out/d.txt");
  for (const char* place :
       {"mine/b.txt", "file/x", "link/c.txt", "link/new.txt", "c.txt", "dangling", "d.txt"}) {
    CAPTURE(place);
    CHECK_THROWS_AS(folder.claim(place), core::WriteFailed);
    CHECK_THROWS_AS(folder.check_free(place), core::WriteFailed);
    folder.remove(place);
  }
  CHECK_THROWS_AS(folder.check_folder("link"), core::WriteFailed);
  CHECK_THROWS_AS(folder.check_folder("file"), core::WriteFailed);
  folder.check_folder("mine");
  folder.check_folder("absent");
  for (const char* place : {"", "/etc/x", "../x", "a/../../x", "a//b", "./a", "a/.", "a/", FileList::kName})
    CHECK_THROWS_AS(folder.claim(place), core::InvalidArgument);
  folder.remove("mine/a.txt");
  CHECK_FALSE(fs::exists(scratch / "out/mine/a.txt"));
  CHECK(test::contents(scratch / "out/mine/b.txt") == "theirs");
  CHECK(test::contents(scratch / "elsewhere/c.txt") == "theirs");
  CHECK(list_of(scratch / "out") == std::string(kFirst) + "+mine/a.txt\n-mine/a.txt\n");
  // A removed file is no longer listed.
  scratch.file("out/mine/a.txt", "theirs");
  CHECK_THROWS_AS(folder.claim("mine/a.txt"), core::WriteFailed);
}

TEST_CASE("bug: a name that is too long was said to be that of something else", "[results]") {
  const test::Scratch scratch;
  ResultFolder folder(scratch / "out");
  CHECK(has(said<core::WriteFailed>([&] { folder.claim(std::string(256, 'a')); }), "File name too long"));
  FileNames names;
  CHECK(names.next(std::string(200, 'a')) == std::string(200, 'a'));
  CHECK(names.next(std::string(300, 'a')) == std::string(200, 'a') + "-2");
  CHECK(names.next(std::string(199, 'b') + "\u00e9") == std::string(199, 'b'));
}

TEST_CASE("a listed file that has become a link is not followed", "[results]") {
  const test::Scratch scratch;
  ResultFolder folder(scratch / "out");
  put(folder, "a.txt", "mine");
  fs::rename(scratch / "out/a.txt", scratch / "kept.txt");
  fs::create_symlink(scratch / "kept.txt", scratch / "out/a.txt");
  CHECK_THROWS_AS(folder.claim("a.txt"), core::WriteFailed);
  folder.remove("a.txt");
  CHECK(fs::is_symlink(scratch / "out/a.txt"));
  CHECK(test::contents(scratch / "kept.txt") == "mine");
}

TEST_CASE("the run's other outputs are not replaced by the folder", "[results]") {
  const test::Scratch scratch;
  {
    ResultFolder before(scratch / "out");
    put(before, "a.png", "1");
  }
  fs::create_directory_symlink("out", scratch / "link");
  ResultFolder folder(scratch / "out", {{scratch / "link/a.png", scratch / "out/new.json"}, {}});
  CHECK_THROWS_AS(folder.claim("a.png"), core::WriteFailed);
  CHECK_THROWS_AS(folder.claim("new.json"), core::WriteFailed);
  folder.claim("b.png");
}

TEST_CASE("a folder that becomes empty is removed with its last file", "[results]") {
  const test::Scratch scratch;
  ResultFolder folder(scratch / "out");
  put(folder, "a/b/1", "");
  put(folder, "a/b/2", "");
  put(folder, "a/a name that is longer than what a string holds in itself", "");
  CHECK(folder.files_in("a") ==
        std::vector<std::string>{"a/a name that is longer than what a string holds in itself", "a/b/1",
                                 "a/b/2"});
  CHECK(folder.files_in("a/b") == std::vector<std::string>{"a/b/1", "a/b/2"});
  folder.remove("a/b/1");
  CHECK(fs::exists(scratch / "out/a/b"));
  folder.remove("a/b/2");
  CHECK_FALSE(fs::exists(scratch / "out/a/b"));
  folder.remove("a/a name that is longer than what a string holds in itself");
  CHECK(fs::exists(scratch / "out"));
  CHECK(folder.files_in("a").empty());
}

TEST_CASE("a truncated last line is ignored; any other damage is refused", "[results]") {
  const test::Scratch scratch;
  const auto list = [&](const std::string& text) { return scratch.file("out/.morsel-results", text); };
  scratch.file("out/a.txt", "1");
  scratch.file("out/cut", "theirs");
  list(std::string(kFirst) + "+a.txt\n+cut");
  {
    ResultFolder folder(scratch / "out");
    CHECK_THROWS_AS(folder.claim("cut"), core::WriteFailed);
    put(folder, "a.txt", "2");
    put(folder, "b.txt", "2");
  }
  CHECK(list_of(scratch / "out") ==
        std::string(kFirst) + "+a.txt\n+a.txt\n+b.txt\n");  // one that is replaced

  for (const char* bad : {"+/etc/passwd\n", "+../x\n", "+a/../b\n", "+\n", "\n", "a.txt\n", "*a.txt\n",
                          "+a%0\n", "+a%zz\n", "+a%00b\n", "+a//b\n", "+./a\n", "+.morsel-results\n", "+/\n",
                          "+work//\n", "+a \n", "+a 1,2,3\n", "+a 1,2,3,4,\n", "-a 1,2,3,4\n"}) {
    CAPTURE(bad);
    list(std::string(kFirst) + bad);
    CHECK(has(said<core::BadInput>([&] { const ResultFolder folder(scratch / "out"); }), "line 2"));
  }
  list("[" + std::string(100000, '[') + "\n");
  CHECK_THROWS_AS(ResultFolder(scratch / "out"), core::BadInput);
  list("{\"schema\":\"morsel.results/2\"}\n");
  CHECK_THROWS_AS(ResultFolder(scratch / "out"), core::BadInput);
  list(std::string(kFirst) + "+" + std::string(1 << 20, 'a') + "\n");
  CHECK_THROWS_AS(ResultFolder(scratch / "out"), core::BadInput);
  list(std::string(kFirst) + "+" + std::string(1 << 20, 'a'));
  CHECK_THROWS_AS(ResultFolder(scratch / "out"), core::BadInput);
  list(kFirst);
  fs::resize_file(scratch / "out/.morsel-results", (std::uintmax_t{1} << 28) + 1);  // sparse
  CHECK_THROWS_AS(ResultFolder(scratch / "out"), core::BadInput);

  fs::remove(scratch / "out/.morsel-results");
  fs::create_symlink("a.txt", scratch / "out/.morsel-results");
  CHECK_THROWS_AS(ResultFolder(scratch / "out"), core::BadInput);
  CHECK(test::contents(scratch / "out/a.txt") == "1");
  fs::remove(scratch / "out/.morsel-results");
  fs::create_directory(scratch / "out/.morsel-results");
  CHECK_THROWS_AS(ResultFolder(scratch / "out"), core::BadInput);
}

TEST_CASE("a list without its first line is that of an empty folder or none", "[results]") {
  const test::Scratch scratch;
  for (const char* begun : {"", "{\"schema\":\"mors"}) {
    scratch.file("empty/.morsel-results", begun);
    {
      ResultFolder folder(scratch / "empty");
      CHECK(list_of(scratch / "empty") == kFirst);
    }
    scratch.file("full/a.txt");
    scratch.file("full/.morsel-results", begun);
    CHECK_THROWS_AS(ResultFolder(scratch / "full"), core::InvalidArgument);
    CHECK(list_of(scratch / "full") == begun);
  }
}

TEST_CASE("many threads and processes may list their files at the same time", "[results]") {
  const test::Scratch scratch;
  ResultFolder one(scratch / "out");
  ResultFolder other(scratch / "out");
  core::parallel_for(0, 400, 1, [&](std::size_t i, std::size_t) {
    ResultFolder& folder = i % 2 == 0 ? one : other;
    put(folder, ("both" + std::to_string(i / 2)).c_str(), "");
    put(folder, ("each" + std::to_string(i)).c_str(), "");
  });
  const std::string list = list_of(scratch / "out");
  CHECK(std::count(list.begin(), list.end(), '\n') == 1 + 400 + 400);
  ResultFolder again(scratch / "out");
  again.claim("both7");
  CHECK(list_of(scratch / "out") == list);
}

TEST_CASE("10,000 meshes are listed at an equal cost each", "[results]") {
  const test::Scratch scratch;
  ResultFolder folder(scratch / "out");
  const auto seconds = [&](int begin, int end) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = begin; i < end; ++i)
      put(folder, ("reports/mesh-" + std::to_string(i) + ".off.json").c_str(), "");
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const double first = seconds(0, 2000);
  seconds(2000, 10000);
  CHECK(seconds(10000, 12000) < 10 * first + 0.5);
}

TEST_CASE("others wait while one holds the folder, unless stopped", "[results]") {
  const test::Scratch scratch;
  ResultFolder one(scratch / "out");
  std::atomic<bool> released = false;
  bool was_released = false;
  std::stop_source stop;
  ResultFolder stopped(scratch / "out", {{}, stop.get_token()});
  std::thread other;
  {
    const ResultFolder::Hold hold(one);
    one.claim("a");  // which holds it, too
    other = std::thread([&] {
      ResultFolder folder(scratch / "out");
      folder.claim("b");
      was_released = released;
    });
    std::thread ends([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      stop.request_stop();
    });
    CHECK_THROWS_AS(stopped.claim("c"), core::Cancelled);
    ends.join();
    released = true;
  }
  other.join();
  CHECK(was_released);
}

TEST_CASE("work folders belong to their process and are removed with it", "[results]") {
  const test::Scratch scratch;
  ResultFolder folder(scratch / "out");
  scratch.file("kept/a.txt", "theirs");
  {
    const ResultFolder::Work one(folder, "work");
    const ResultFolder::Work other(folder, "work");
    CHECK(one.path() != other.path());
    core::write_file(one.path() / "made", "new");
    fs::create_directory_symlink(scratch / "kept", one.path() / "link");
    fs::create_directories(one.path() / "deep/deeper");
    folder.move(one.relative() / "made", "reports/made");
    CHECK(test::contents(scratch / "out/reports/made") == "new");
    CHECK_THROWS_AS(folder.move(one.relative() / "absent", "reports/absent"), core::WriteFailed);
    ResultFolder(scratch / "out").remove_left_work("work");
    CHECK(fs::exists(one.path()));
    CHECK(fs::exists(other.path()));
  }
  CHECK_FALSE(fs::exists(scratch / "out/work"));
  CHECK(test::contents(scratch / "kept/a.txt") == "theirs");
}

TEST_CASE("bug: a folder of results that was removed was made again without its list", "[results]") {
  const test::Scratch scratch;
  for (const bool has_other : {false, true}) {
    ResultFolder folder(scratch / "out");
    {
      const ResultFolder::Work work(folder, "work");
      fs::remove_all(scratch / "out");
      core::write_file(work.path() / "0/report.json", "late");
      if (has_other) scratch.file("out/thesis.txt", "theirs");
    }
    CHECK_FALSE(fs::exists(scratch / "out/work"));
    CHECK(fs::exists(scratch / "out") == has_other);
  }
}

TEST_CASE("work folders of a killed run are removed, and nothing else", "[results]") {
  const test::Scratch scratch;
  { const ResultFolder made(scratch / "out"); }
  scratch.file("out/.morsel-results",
               std::string(kFirst) + "+work/killed/\n+work/early/\n+work/link/\n+work/gone/\n");
  scratch.file("out/work/killed/lock");
  scratch.file("out/work/killed/0/report.json");
  fs::create_directories(scratch / "out/work/early");  // before there was a lock
  scratch.file("out/work/foreign/lock");
  scratch.file("kept/lock", "theirs");
  scratch.file("kept/a.txt", "theirs");
  fs::create_directory_symlink(scratch / "kept", scratch / "out/work/link");
  ResultFolder folder(scratch / "out");
  folder.remove_left_work("work");
  CHECK_FALSE(fs::exists(scratch / "out/work/killed"));
  CHECK_FALSE(fs::exists(scratch / "out/work/early"));
  CHECK(fs::exists(scratch / "out/work/foreign/lock"));
  CHECK(fs::is_symlink(scratch / "out/work/link"));
  CHECK(test::contents(scratch / "kept/a.txt") == "theirs");
  CHECK(test::contents(scratch / "kept/lock") == "theirs");

  fs::rename(scratch / "out/work", scratch / "elsewhere");
  fs::create_directory_symlink(scratch / "elsewhere", scratch / "out/work");
  CHECK_THROWS_AS(ResultFolder::Work(folder, "work"), core::WriteFailed);
  CHECK(fs::exists(scratch / "elsewhere/foreign/lock"));
}

TEST_CASE("different paths of one file are equal", "[results]") {
  const test::Scratch scratch;
  const fs::path file = scratch.file("folder/a");
  fs::create_hard_link(file, scratch / "hard");
  fs::create_symlink("folder/a", scratch / "soft");
  fs::create_symlink("folder/new", scratch / "dangling");
  fs::create_symlink("loop", scratch / "loop");
  fs::create_directory_symlink("folder", scratch / "link");
  for (const fs::path& other :
       {scratch / "hard", scratch / "soft", scratch / "link/a", scratch / "link/../folder/./a"})
    CHECK(file_place(other) == file_place(file));
  for (const fs::path& other : {scratch / "dangling", scratch / "link/new", scratch / "folder/../link/new"})
    CHECK(file_place(other) == file_place(scratch / "folder/new"));
  CHECK(file_place(scratch / "folder/new") != file_place(scratch / "folder/other"));
  CHECK(file_place(scratch / "absent/b/../c") == file_place(scratch / "absent/c"));
  CHECK(file_place(scratch / "loop") == file_place(scratch / "loop"));
  CHECK(file_place(scratch / "loop") != file_place(file));
  CHECK(file_place("/dev/null").is_device);
  CHECK(file_place("/dev/../dev/stdout").is_system);
  CHECK_FALSE(file_place(file).is_device);
  CHECK_FALSE(file_place(file).is_system);
  CHECK(file_place("absent") == file_place(fs::current_path() / "absent"));
  CHECK(file_place("./absent/") == file_place("absent"));

  CHECK(is_in(file, scratch / "folder"));
  CHECK(is_in(scratch / "link/new/deep", scratch / "folder"));
  CHECK(is_in(scratch / "folder", scratch / "link"));
  CHECK_FALSE(is_in(scratch / "folder", file));
  CHECK_FALSE(is_in(scratch / "folder2", scratch / "folder"));
  CHECK(is_in(scratch / "absent/in", scratch / "absent"));
}
