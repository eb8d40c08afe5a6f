/// Licences that lie in every FMU.
#pragma once

#include <string_view>

namespace sonoglide::fmi {

std::string_view our_licence();
/// Of the libraries that are compiled into its binaries.
std::string_view compiled_in_licences();

}  // namespace sonoglide::fmi
