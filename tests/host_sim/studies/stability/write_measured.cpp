// Writes the verdicts of the first random scenes, as extremes.csv has those of all of them.
#include <exception>
#include <fstream>
#include <iostream>
#include <string>

#include "host_sim/studies/stability/study.hpp"

int main() {
  namespace stability = sonoglide::stability;
  try {
    const std::string table = stability::extremes_csv(
        stability::extremes(SONOGLIDE_STABILITY_MEASURED_SCENES, [](double) {}));
    std::ofstream file(SONOGLIDE_STABILITY_MEASURED, std::ios::binary);
    file.exceptions(std::ios::failbit | std::ios::badbit);
    file << table;
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
