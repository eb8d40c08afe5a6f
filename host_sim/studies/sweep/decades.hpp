/// Powers of ten and their logarithm with the same bits on every machine. The C library's differ in
/// the last bit from one processor to another.
#pragma once

namespace sonoglide::sweep {

/// 10^x, exact for whole x as far as a double is; 0 and infinity beyond its range.
/// Relative error <= 1e-15 where the result is normal.
double power_of_ten(double x);

/// log10(x), x > 0 and normal; exact for powers of ten. Error <= 4e-16 (1 + |log10(x)|).
double logarithm_to_ten(double x);

}  // namespace sonoglide::sweep
