/// Writes plants.csv: what random plants are identified as. An argument is their number, 500 without one.
#include <cstdint>
#include <cstdio>
#include <string>

#include "tests/host_sim/studies/identify/plant/commissioned/commissioned.hpp"

int main(int argc, char** argv) {
  namespace test = sonoglide::identify::plant::test;
  const std::uint64_t count = argc > 1 ? std::stoul(argv[1]) : 500;
  std::fputs(test::columns().c_str(), stdout);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    std::fputs(test::row(seed, test::commissioned(TARGET_STEP, seed)).c_str(), stdout);
    std::fflush(stdout);
  }
  return 0;
}
