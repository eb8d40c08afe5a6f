/// `stability` with as much work as is asked for.
#pragma once

#include <cstdint>

#include "host_sim/studies/stability/stability_map.hpp"

namespace CLI {
class App;
}

namespace sonoglide::cli {

struct StabilityWork {
  stability::MapGrid grid;
  std::uint64_t random_scenes = 0;
};

/// The command of commands.hpp does its full work, which takes minutes; a test gives it less.
void add_stability_command_for(CLI::App& program, const StabilityWork& work);

}  // namespace sonoglide::cli
