#include "host_sim/runs/run_many.hpp"
#include "host_sim/process/thread_limit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>
#include <vector>

namespace sonoglide::runs::run_many_test {
namespace {

Places numbers(std::size_t count) {
  Places all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

/// Multiples of seven alone, the others by whether they are even.
std::optional<std::size_t> group_of(std::size_t place) {
  return place % 7 == 0 ? std::nullopt : std::optional(place % 2);
}

TEST(RunMany, DividesByGroupsInSharesForTheThreads) {
  const process::ThreadLimit limit(2);
  const Calls calls = divide(numbers(700), group_of);
  EXPECT_EQ(calls.alone.size(), 100U);
  Places seen = calls.alone;
  for (const Places& call : calls.together) {
    EXPECT_LE(call.size(), 256U);
    for (const std::size_t place : call) {
      EXPECT_EQ(group_of(place), group_of(call.front()));
    }
    seen.insert(seen.end(), call.begin(), call.end());
  }
  EXPECT_EQ(calls.together.size(), 4U);
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(seen, numbers(700));
}

TEST(RunMany, KeepsLanesBusyBeforeThreads) {
  const process::ThreadLimit limit(64);
  const Calls calls = divide(numbers(40), [](std::size_t) { return std::optional(0); });
  ASSERT_EQ(calls.together.size(), 3U);
  EXPECT_EQ(calls.together.front().size(), 16U);
}

TEST(RunMany, WhatTheLanesGiveUpIsRunAlone) {
  const Calls calls = divide(numbers(100), group_of);
  std::mutex mutex;
  Places in_lanes;
  Places alone;
  run_many(
      calls,
      [&](const Places& places) {
        const std::lock_guard<std::mutex> lock(mutex);
        Places unsolved;
        for (const std::size_t place : places) {
          (place % 5 == 0 ? unsolved : in_lanes).push_back(place);
        }
        return unsolved;
      },
      [&](std::size_t place) {
        const std::lock_guard<std::mutex> lock(mutex);
        alone.push_back(place);
      });
  for (const std::size_t place : alone) {
    EXPECT_TRUE(place % 5 == 0 || place % 7 == 0) << place;
  }
  in_lanes.insert(in_lanes.end(), alone.begin(), alone.end());
  std::sort(in_lanes.begin(), in_lanes.end());
  EXPECT_EQ(in_lanes, numbers(100));
}

TEST(RunMany, VisitsNameTheLowestUnusableNumber) {
  for (int repeat = 0; repeat < 20; ++repeat) {
    EXPECT_EQ(visit_all(10, 1000, 7, [](std::size_t i) { return i % 100 != 37; }), 37U);
  }
  EXPECT_EQ(visit_all(10, 37, 7, [](std::size_t i) { return i % 100 != 37; }), 37U);
}

TEST(RunMany, VisitsAllAndTellsOfAll) {
  std::mutex mutex;
  Places seen;
  std::size_t done = 0;
  visit_all(
      3, 100, 10,
      [&](std::size_t i) {
        const std::lock_guard<std::mutex> lock(mutex);
        seen.push_back(i);
        return true;
      },
      [&](std::size_t more) {
        const std::lock_guard<std::mutex> lock(mutex);
        done += more;
      });
  std::sort(seen.begin(), seen.end());
  Places expected(97);
  std::iota(expected.begin(), expected.end(), std::size_t{3});
  EXPECT_EQ(seen, expected);
  EXPECT_EQ(done, 97U);
}

}  // namespace
}  // namespace sonoglide::runs::run_many_test
