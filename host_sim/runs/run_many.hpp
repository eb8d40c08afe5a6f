/// Many independent runs at once: on threads, and in SIMD lanes those that suit them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <type_traits>
#include <vector>

#include "host_sim/runs/batch/run_dahl_plants.hpp"

namespace sonoglide::runs {

/// Threads that work is done on now.
std::size_t thread_count();

/// Runs, by their numbers in some list.
using Places = std::vector<std::size_t>;

/// Runs as calls that are worth making.
struct Calls {
  std::vector<Places> together;  ///< each in lanes
  Places alone;
};

/// Those of one group together, some hundreds at most, and fewer where that gives each thread a
/// call; the others alone.
/// @param group_of  gives an ordered value for the place of each run: who may be together in lanes;
///                  absent: alone
template <class GroupOf>
Calls divide(const Places& places, const GroupOf& group_of) {
  constexpr std::size_t fewest_in_lanes = 16;
  constexpr std::size_t lanes_many_times_over = 256;
  using Group = typename std::invoke_result_t<GroupOf, std::size_t>::value_type;
  Calls calls;
  std::map<Group, Places> groups;
  for (const std::size_t place : places) {
    const auto group = group_of(place);
    (group ? groups[*group] : calls.alone).push_back(place);
  }
  const std::size_t share = std::clamp((places.size() - calls.alone.size()) / thread_count(),
                                       fewest_in_lanes, lanes_many_times_over);
  for (const auto& group : groups) {
    const Places& all = group.second;
    for (std::size_t begin = 0; begin < all.size(); begin += share) {
      const std::size_t end = std::min(begin + share, all.size());
      calls.together.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(begin),
                                  all.begin() + static_cast<std::ptrdiff_t>(end));
    }
  }
  return calls;
}

/// Of runs in lanes, each with a status, those that the lanes have given up.
template <class Run>
Places given_up(const Places& places, const std::vector<Run>& runs) {
  Places unsolved;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (runs[i].status != batch::RunStatus::solved) {
      unsolved.push_back(places[i]);
    }
  }
  return unsolved;
}

/// Makes the calls, on all threads.
/// @param together  runs these in lanes, @return those that the lanes give up: they are run alone
/// @param alone     runs one
/// @throws what these throw
void run_many(const Calls& calls, const std::function<Places(const Places& places)>& together,
              const std::function<void(std::size_t place)>& alone);

/// Visits each of these numbers on all threads, some at a time.
/// @param visit  @return false: the number is unusable
/// @param done   told how many more have been visited
/// @return the lowest that is unusable; `end` if none is
std::size_t visit_all(
    std::size_t first, std::size_t end, std::size_t some,
    const std::function<bool(std::size_t)>& visit,
    const std::function<void(std::size_t)>& done = [](std::size_t) {});

}  // namespace sonoglide::runs
