/// Rules of the specification that every modelDescription.xml keeps.
#pragma once

#include <string>
#include <vector>

#include "tests/acceptance/fmu/importer/description.hpp"

namespace sonoglide::acceptance {

/// The names of the elements inside one.
std::vector<std::string> children(const Tree& element);

/// The elements with the attributes that they must and may have; names, references, causality,
/// variability, start values and units of the variables.
/// @param root  fmiModelDescription
void check_description(const Tree& root, bool version_2);

}  // namespace sonoglide::acceptance
