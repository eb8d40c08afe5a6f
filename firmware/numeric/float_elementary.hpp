/// Elementary functions of float and double from + - * / and bit casts alone.
///
/// The same bits on every machine that has IEEE-754 arithmetic and does not contract a * b + c. The
/// float versions use no double. Errors are in units in the last place (ulp) of the result. NaN in
/// gives NaN out; a zero result may have either sign.
#pragma once

#include "firmware/numeric/float_exponential.hpp"
#include "firmware/numeric/float_sqrt.hpp"
#include "firmware/numeric/float_trigonometric.hpp"
