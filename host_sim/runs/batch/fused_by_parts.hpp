/// Products with a sum, rounded once, on machines whose instructions round twice.
///
/// The C library's fma does the same there, but takes twenty times as long: it switches the rounding
/// mode of the processor.
/// Source: Boldo and Melquiond, "Emulation of a FMA and correctly rounded sums: proved algorithms
/// using rounding to odd", IEEE Trans. Computers 57 (2008) 462-471.
#pragma once

#include <cstddef>

namespace sonoglide::batch {

/// sums[i] becomes a[i] b[i] + sums[i], the nearest of all numbers to it, as std::fma has it.
void fuse(const double* a, const double* b, double* sums, std::size_t count);
void fuse(const float* a, const float* b, float* sums, std::size_t count);

}  // namespace sonoglide::batch
