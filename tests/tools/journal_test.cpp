#include "morsel/tools/formats/journal.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <limits>
#include <thread>

#include "morsel/core/error.h"
#include "morsel/tools/report/trial_journal.h"
#include "support/scratch.h"

using namespace morsel;
using Catch::Contains;
using tools::Journal;
using tools::Json;

TEST_CASE("a journal gives back the entries of the same key") {
  const test::Scratch folder;
  const std::filesystem::path path = folder / "out.csv.journal";
  const Json key = {{"a", 1}, {"b", "\xff"}};
  {
    Journal journal(path, key);
    CHECK(journal.entries().empty());
    journal.add({{"x", 0.1}});
    journal.add({{"x", std::numeric_limits<double>::denorm_min()}});
  }
  {
    Journal journal(path, key);
    REQUIRE(journal.entries().size() == 2);
    CHECK(journal.entries()[0]["x"].get<double>() == 0.1);
    CHECK(journal.entries()[1]["x"].get<double>() == std::numeric_limits<double>::denorm_min());
    journal.add("third");
  }
  CHECK(Journal(path, key).entries().size() == 3);
  CHECK(Journal(path, {{"a", 2}}).entries().empty());
  CHECK_FALSE(std::filesystem::exists(path));  // it had none, and nobody added any
}

TEST_CASE("a truncated journal is read up to its last complete entry") {
  const test::Scratch folder;
  const Json key = "k";
  const std::string head = "{\"schema\":\"morsel.journal/1\",\"key\":\"k\"}\n";
  const std::string whole = head + "1\n2\n";
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    const std::filesystem::path path = folder.file("j", whole.substr(0, length));
    {
      Journal journal(path, key);
      CHECK(journal.entries().size() == (length < head.size() + 2 ? 0 : length < head.size() + 4 ? 1 : 2));
      CHECK(journal.warnings().empty());
      journal.add(7);
    }
    Journal journal(path, key);
    CHECK(journal.entries().back() == 7);
    journal.finish();
  }
}

TEST_CASE("a damaged line of a journal counts as absent, is reported once, and the others stay") {
  const test::Scratch folder;
  const std::filesystem::path path = folder / "j";
  { Journal(path, "k").add(1); }
  const std::string begin = test::contents(path);
  for (const std::string& line : {std::string("{no json"), std::string(105'000, '['),
                                  std::string("\0\xff", 2), std::string(200'000, 'x'), std::string("2 3")}) {
    folder.file("j", begin + line + "\n3\n");
    {
      Journal journal(path, "k");
      CHECK(journal.entries() == std::vector<Json>{1, 3});
      REQUIRE(journal.warnings().size() == 1);
      CHECK_THAT(journal.warnings()[0], Contains("1 damaged entry counts as absent"));
      journal.add(4);
    }
    Journal journal(path, "k");
    CHECK(journal.entries() == std::vector<Json>{1, 3, 4});
    CHECK(journal.warnings().empty());
    CHECK(test::contents(path).starts_with(begin));
  }
}

TEST_CASE("an entry that its reader refuses is dropped") {
  const test::Scratch folder;
  const std::filesystem::path path = folder / "j";
  {
    Journal journal(path, "k");
    for (const Json& entry : {Json(5), Json{{"a", 1}}, Json{{"a", "x"}}, Json{{"a", 2}}}) journal.add(entry);
  }
  std::vector<std::uint64_t> taken;
  const auto take = [&](const tools::JsonView& entry) { taken.push_back(entry["a"].count()); };
  {
    Journal journal(path, "k");
    journal.take_entries(take);
    REQUIRE(journal.warnings().size() == 1);
    CHECK_THAT(journal.warnings()[0],
               Contains("2 damaged entries count as absent") && Contains("it is not an object"));
  }
  Journal journal(path, "k");
  CHECK(journal.entries().size() == 2);
  journal.take_entries(take);
  CHECK(journal.warnings().empty());
  CHECK(taken == std::vector<std::uint64_t>{1, 2, 1, 2});
}

TEST_CASE("a journal of another key is replaced, with a warning") {
  const test::Scratch folder;
  { Journal(folder / "j", 1).add(1); }
  Journal journal(folder / "j", 2);
  CHECK(journal.entries().empty());
  REQUIRE(journal.warnings().size() == 1);
  CHECK_THAT(journal.warnings()[0], Contains("a new one is started"));
}

TEST_CASE("bug: a file with a journal's name was emptied whatever it was") {
  const test::Scratch folder;
  for (const std::string& text :
       {std::string("\"k\"\n1\n"), std::string("my notes\n"), std::string("no line's end"),
        std::string("\0\1\2\n", 4), std::string("{}\n"), std::string(105'000, '['),
        std::string("{\"schema\":\"morsel.sweep/1\"}\n"), std::string("{\"schema\":5}\n"),
        std::string("\n")}) {
    const std::filesystem::path path = folder.file("j", text);
    CHECK_THROWS_AS(Journal(path, "k"), core::InvalidArgument);
    CHECK(test::contents(path) == text);
  }
  std::filesystem::create_symlink("j", folder / "link");
  CHECK_THROWS_WITH(Journal(folder / "link", "k"), Contains("is a link"));
  std::filesystem::create_directory(folder / "d");
  CHECK_THROWS_AS(Journal(folder / "d", "k"), core::Error);
}

TEST_CASE("a journal is removed once its run is complete, and stays otherwise") {
  const test::Scratch folder;
  const std::filesystem::path path = folder / "j";
  { Journal(path, 1).add(1); }
  CHECK(std::filesystem::exists(path));
  Journal(path, 1).finish();
  CHECK_FALSE(std::filesystem::exists(path));
  { const Journal empty(path, 1); }
  CHECK_FALSE(std::filesystem::exists(path));
}

TEST_CASE("a journal has one writer") {
  const test::Scratch folder;
  const Journal first(folder / "j", 1);
  CHECK_THROWS_WITH(Journal(folder / "j", 1), Contains("another run is writing it"));
  CHECK_THROWS_AS(Journal(folder / "none/j", 1), core::WriteFailed);
}

TEST_CASE("a journal takes entries of several threads") {
  const test::Scratch folder;
  {
    Journal journal(folder / "j", 1);
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&journal, t] {
        for (int i = 0; i < 50; ++i) journal.add(std::string(100, static_cast<char>('a' + t)));
      });
    for (std::thread& thread : threads) thread.join();
  }
  CHECK(Journal(folder / "j", 1).entries().size() == 200);
}

TEST_CASE("trials are read back from their journal unchanged") {
  const test::Scratch folder;
  tools::Trial trial;
  trial.points.minima = 3;
  trial.points.saddles = 4;
  trial.points.saddle_multiplicity = 5;
  trial.points.maxima = 6;
  trial.agreement = {10, 13, 7, 0.1 + 0.2, true};
  trial.chance = 1. / 3;
  const tools::Perturbation noise{tools::PerturbationKind::noise, 0.15, tools::NoiseKind::normal};
  const tools::Perturbation other{tools::PerturbationKind::noise, 0.15, tools::NoiseKind::isotropic};
  {
    Journal journal(folder / "j", 1);
    tools::Trial bounded = trial;
    bounded.agreement.is_least = false;
    tools::TrialJournal(journal, 2).add(noise, 2, {trial, bounded});
  }
  Journal journal(folder / "j", 1);
  const tools::TrialJournal trials(journal, 2);
  CHECK(trials.count() == 1);
  CHECK_FALSE(trials.find(noise, 1));
  CHECK_FALSE(trials.find(other, 2));
  const auto found = trials.find(noise, 2);
  REQUIRE(found);
  REQUIRE(found->size() == 2);
  const tools::Trial& back = found->front();
  CHECK(back.points.total() == 13);
  CHECK(back.points.saddle_multiplicity == 5);
  CHECK(back.agreement.distances == trial.agreement.distances);
  CHECK(back.agreement.matched == 7);
  CHECK(back.chance == trial.chance);
  CHECK(back.agreement.is_least);
  CHECK_FALSE(found->back().agreement.is_least);
}

TEST_CASE("bug: trials in a journal were taken whatever they were") {
  const test::Scratch folder;
  const Json right = {3, 4, 5, 6, 10, 13, 7, 0.5, 0.25, 1};
  const auto count = [&](const Json& entry, std::size_t outcomes) {
    std::filesystem::remove(folder / "j");
    { Journal(folder / "j", 1).add(entry); }
    Journal journal(folder / "j", 1);
    const std::size_t known = tools::TrialJournal(journal, outcomes).count();
    CHECK(journal.warnings().size() == 1 - known);
    return known;
  };
  CHECK(count({{"surface", "s"}, {"trials", Json::array({right})}}, 1) == 1);
  CHECK(count({{"surface", "s"}, {"trials", Json::array({right})}}, 2) == 0);
  CHECK(count({{"surface", 5}, {"trials", Json::array({right})}}, 1) == 0);
  CHECK(count(5, 1) == 0);
  CHECK(count({{"surface", "s"}}, 1) == 0);
  for (std::size_t i = 0; i < right.size(); ++i)
    for (const Json& wrong : {Json(-1), Json("1"), Json(), Json(1e300), Json::array(), Json::object()}) {
      if (i == 7 && wrong == Json(1e300)) continue;  // distances are any
      Json trial = right;
      trial[i] = wrong;
      CHECK(count({{"surface", "s"}, {"trials", Json::array({trial})}}, 1) == 0);
    }
  Json matched_too_often = right;
  matched_too_often[6] = 11;
  CHECK(count({{"surface", "s"}, {"trials", Json::array({matched_too_often})}}, 1) == 0);
}
