// stand [KEY=VALUE]...: a unit of target_step in a plant with these changes. Its serial device is printed; it runs until
// the end of the standard input.
#include "stand.hpp"

#include <cstdio>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  const sonoglide::app::scene_units_test::Stand stand(
      std::vector<std::string>(argv + 1, argv + argc));
  std::puts(stand.device().c_str());
  std::fflush(stdout);
  while (std::getchar() != EOF) {
  }
}
