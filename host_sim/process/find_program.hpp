/// Where a program is, or what to install for it.
#pragma once

#include <filesystem>
#include <string>

namespace sonoglide::process {

/// @param package  of Debian, that has the program
/// @return the program's place in PATH
/// @throws ProcessError  it has none
std::filesystem::path require_program(const std::string& program, const std::string& package);

}  // namespace sonoglide::process
