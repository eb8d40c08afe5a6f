/// Where the paper cannot be right as printed, and what each fault does to a number.
#pragma once

#include <string>
#include <vector>

namespace sonoglide::paper {

struct Fault {
  std::string in_print;
  std::string effect;  ///< measured
  std::string here;
};

std::vector<Fault> faults();

}  // namespace sonoglide::paper
