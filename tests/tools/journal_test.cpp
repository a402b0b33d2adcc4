#include "morsel/tools/report/journal.h"

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

TEST_CASE("a journal that was cut off is read to where it is whole") {
  const test::Scratch folder;
  const Json key = "k";
  const std::string whole = "\"k\"\n1\n2\n";
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    const std::filesystem::path path = folder.file("j", whole.substr(0, length));
    {
      Journal journal(path, key);
      CHECK(journal.entries().size() == (length < 6 ? 0 : length < 8 ? 1 : 2));
      journal.add(7);
    }
    Journal journal(path, key);
    CHECK(journal.entries().back() == 7);
    journal.finish();
  }
  CHECK(Journal(folder.file("j", "\"k\"\n1\n{no json\n2\n"), key).entries().size() == 1);
  CHECK(Journal(folder.file("j", std::string("\0\1\2\n", 4)), key).entries().empty());
}

TEST_CASE("a journal is gone once its run is done, and stays if it is not") {
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

TEST_CASE("trials come back from their journal as they were") {
  const test::Scratch folder;
  tools::Trial trial;
  trial.points.minima = 3;
  trial.points.saddles = 4;
  trial.points.saddle_multiplicity = 5;
  trial.points.maxima = 6;
  trial.agreement = {10, 13, 7, 0.1 + 0.2};
  trial.chance = 1. / 3;
  const tools::Perturbation noise{tools::PerturbationKind::noise, 0.15, tools::NoiseKind::normal};
  const tools::Perturbation other{tools::PerturbationKind::noise, 0.15, tools::NoiseKind::isotropic};
  {
    Journal journal(folder / "j", 1);
    tools::TrialJournal(journal).add(noise, 2, {trial, {}});
  }
  Journal journal(folder / "j", 1);
  const tools::TrialJournal trials(journal);
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
}
