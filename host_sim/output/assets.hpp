/// Files that go into every page, built into the program (see assets.cmake).
#pragma once

#include <string_view>

namespace sonoglide::output {

std::string_view page_css();
// In this order.
std::string_view numbers_js();
std::string_view look_js();
std::string_view chart_js();
std::string_view reading_js();
std::string_view panel_js();
std::string_view page_js();

}  // namespace sonoglide::output
