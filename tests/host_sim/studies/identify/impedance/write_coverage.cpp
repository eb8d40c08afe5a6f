/// Writes host_sim/studies/identify/impedance/coverage.csv on standard output.

#include <cstdio>

#include "coverage.hpp"

int main() {
  using namespace sonoglide::identify::impedance;
  std::printf("kind,parameter,sweeps,covered,told,told_and_covered\n");
  for (const Kind& kind : kinds) {
    for (const Coverage& each : coverage(kind, recorded_sweeps, 1)) {
      std::printf("%s,%s,%d,%d,%d,%d\n", kind.name, each.parameter.c_str(), each.sweeps,
                  each.covered, each.told, each.told_and_covered);
    }
    std::fflush(stdout);
  }
}
