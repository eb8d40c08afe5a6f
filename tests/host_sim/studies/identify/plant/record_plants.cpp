/// Writes plants.csv: what random plants are identified as. An argument is their number, 500 without one; a
/// second one the seed of the first, 0 without one.
#include <cstdint>
#include <cstdio>
#include <string>

#include "tests/host_sim/studies/identify/plant/commissioned/commissioned.hpp"

int main(int argc, char** argv) {
  namespace test = sonoglide::identify::plant::test;
  const std::uint64_t count = argc > 1 ? std::stoul(argv[1]) : 500;
  const std::uint64_t first = argc > 2 ? std::stoul(argv[2]) : 0;
  std::fputs(test::columns().c_str(), stdout);
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    std::fputs(test::row(seed, test::commissioned(TARGET_STEP, seed)).c_str(), stdout);
    std::fflush(stdout);
  }
  return 0;
}
