/// Writes coverage.csv: for each kind of data set and each parameter, whether the intervals of 1000
/// sets have the truth, a digit a set.

#include <cstdio>
#include <string>
#include <vector>

#include "tests/host_sim/studies/identify/friction/synthetic/synthetic.hpp"

int main() {
  namespace synthetic = sonoglide::identify::friction::synthetic;
  std::printf("kind,parameter,covered_percent,sets\n");
  for (const synthetic::Kind& kind : synthetic::kinds()) {
    constexpr unsigned sets = 1000;
    std::vector<std::string> digits;
    for (unsigned set = 0; set < sets; ++set) {
      const std::vector<bool> has = synthetic::covered(kind, set);
      digits.resize(has.size());
      for (std::size_t i = 0; i < has.size(); ++i) {
        digits[i] += has[i] ? '1' : '0';
      }
    }
    for (std::size_t i = 0; i < digits.size(); ++i) {
      int covered = 0;
      for (const char digit : digits[i]) {
        covered += digit == '1' ? 1 : 0;
      }
      std::printf("\"%s\",%zu,%.1f,%s\n", kind.name.c_str(), i, 0.1 * covered, digits[i].c_str());
    }
    std::fflush(stdout);
  }
  return 0;
}
