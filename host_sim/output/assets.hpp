/// Files that go into every page, built into the program (see assets.cmake).
#pragma once

#include <string_view>

namespace sonoglide::output {

std::string_view page_css();
std::string_view page_js();
std::string_view dygraphs_css();
std::string_view dygraphs_js();
std::string_view dygraphs_notice();

}  // namespace sonoglide::output
