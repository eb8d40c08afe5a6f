/// Numbers as an engineer reads them.
#pragma once

#include <string>

namespace sonoglide::design {

/// Four digits with the prefix that suits: `526.3 N`, `26.72 mm/s`; `-` for what is not defined.
std::string quantity(double value, const char* unit);

/// Four digits without a prefix.
std::string number(double value);

}  // namespace sonoglide::design
