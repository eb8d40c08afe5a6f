/// The only pi of the tests: none of them takes it from the product, nor writes it out again.
#pragma once

namespace sonoglide::tests {

inline constexpr long double long_pi = 3.14159265358979323846264338327950288L;
inline constexpr double pi = static_cast<double>(long_pi);
inline constexpr double two_pi = 2.0 * pi;

}  // namespace sonoglide::tests
