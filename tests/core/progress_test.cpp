#include "morsel/core/parallel/progress.h"

#include <catch2/catch.hpp>
#include <string>
#include <thread>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"

using namespace morsel;
using core::Cancelled;
using core::Progress;

TEST_CASE("progress without a hook reports nothing and never stops") {
  const Progress progress;
  CHECK_NOTHROW(progress.update("step", 0.5));
  CHECK_NOTHROW(progress.throw_if_cancelled());
}

TEST_CASE("progress reaches the hook and copies share it") {
  std::string seen;
  const Progress progress([&](std::string_view step, double fraction) {
    seen += std::string(step) + " " + std::to_string(static_cast<int>(100 * fraction)) + ";";
  });
  const Progress copy = progress;
  progress.update("a", 0.25);
  copy.update("b", 1);
  CHECK(seen == "a 25;b 100;");
}

TEST_CASE("the parts of a step stop with it and report nothing") {
  std::stop_source stop;
  int reports = 0;
  const Progress progress([&](std::string_view, double) { ++reports; }, stop.get_token());
  const Progress part = progress.unreported();
  part.update("part", 0);
  CHECK(reports == 0);
  stop.request_stop();
  CHECK_THROWS_AS(part.update("part", 0.5), Cancelled);
  CHECK_THROWS_AS(part.throw_if_cancelled(), Cancelled);
  CHECK(reports == 0);
}

TEST_CASE("a requested stop is thrown after the report and by copies too") {
  std::stop_source stop;
  int reports = 0;
  const Progress progress([&](std::string_view, double) { ++reports; }, stop.get_token());
  const Progress copy = progress;
  CHECK_NOTHROW(progress.update("a", 0));
  stop.request_stop();
  CHECK_THROWS_AS(progress.update("a", 0.5), Cancelled);
  CHECK_THROWS_AS(copy.throw_if_cancelled(), Cancelled);
  CHECK(reports == 2);
  try {
    progress.throw_if_cancelled();
  } catch (const core::Error& error) {
    CHECK(error.kind() == core::ErrorKind::cancelled);
  }
}

TEST_CASE("a stop that another thread requests ends a parallel loop") {
  const core::ThreadLimit limit(4);
  std::stop_source stop;
  const Progress progress({}, stop.get_token());
  const auto endless = [&] {
    const std::jthread other([&] { stop.request_stop(); });
    core::parallel_for(0, 1'000'000'000, 1'000'000, [&](std::size_t, std::size_t) {
      for (;;) {
        progress.throw_if_cancelled();
        std::this_thread::yield();
      }
    });
  };
  CHECK_THROWS_AS(endless(), Cancelled);
}
