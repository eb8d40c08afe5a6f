// The division of 64 bits that the compiler calls, in the place of its library's, which takes twice as long: a
// controller in Q31 divides where it learns or changes its target. Source: Arm, Run-time ABI for the Arm
// Architecture, integer division functions.
#include <cstdint>

extern "C" {

std::int64_t sonoglide_divide(std::int64_t dividend, std::int64_t divisor, std::int64_t* rest);

// Returns the quotient in r0 and r1, and the rest in r2 and r3.
[[gnu::naked, gnu::used]] void __aeabi_ldivmod() {
  asm volatile(
      "push {r4, lr} \n"
      "sub  sp, #16 \n"
      "add  r4, sp, #8 \n"
      "str  r4, [sp] \n"
      "bl   sonoglide_divide \n"
      "ldr  r2, [sp, #8] \n"
      "ldr  r3, [sp, #12] \n"
      "add  sp, #16 \n"
      "pop  {r4, pc} \n");
}

}  // extern "C"

namespace {

struct Division {
  std::uint64_t quotient;
  std::uint64_t rest;
};

std::uint64_t magnitude(std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  return value < 0 ? 0 - bits : bits;
}

/// Where the quotient fits a word and the divisor is 2^31 at most, as those of Q31: five clocks a digit. The carry
/// brings each digit of the quotient into the place that the dividend left. Apart, because the compiler does not
/// know how long it is.
[[gnu::noinline]] Division divide_narrow(std::uint64_t dividend, std::uint32_t divisor) {
  auto rest = static_cast<std::uint32_t>(dividend >> 32);
  auto digits = static_cast<std::uint32_t>(dividend);
  asm(".syntax unified \n"
      "adds %0, %0 \n"
      ".rept 32 \n"
      "adcs %1, %1 \n"
      "cmp  %1, %2 \n"
      "bcc  1f \n"
      "subs %1, %2 \n"
      "1: \n"
      "adcs %0, %0 \n"
      ".endr \n"
      : "+l"(digits), "+l"(rest)
      : "l"(divisor)
      : "cc");
  return {digits, rest};
}

Division divide_wide(std::uint64_t dividend, std::uint64_t divisor) {
  Division result{dividend, 0};
  for (int digit = 0; digit < 64; ++digit) {
    const bool carry = (result.rest >> 63) != 0;
    result.rest = 2 * result.rest + (result.quotient >> 63);
    result.quotient *= 2;
    if (carry || result.rest >= divisor) {
      result.rest -= divisor;
      ++result.quotient;
    }
  }
  return result;
}

Division divide(std::uint64_t dividend, std::uint64_t divisor) {
  if (divisor > 1U << 31) {
    return divide_wide(dividend, divisor);
  }
  const auto word = static_cast<std::uint32_t>(divisor);
  if (dividend >> 32 < word) {
    return divide_narrow(dividend, word);
  }
  const Division upper = divide_narrow(dividend >> 32, word);
  const Division lower = divide_narrow((upper.rest << 32) | (dividend & 0xffffffff), word);
  return {(upper.quotient << 32) | lower.quotient, lower.rest};
}

}  // namespace

std::int64_t sonoglide_divide(std::int64_t dividend, std::int64_t divisor, std::int64_t* rest) {
  const std::uint64_t over = magnitude(dividend);
  const std::uint64_t under = magnitude(divisor);
  const Division result = divide(over, under);
  const bool negative = (dividend < 0) != (divisor < 0);
  *rest = static_cast<std::int64_t>(dividend < 0 ? 0 - result.rest : result.rest);
  return static_cast<std::int64_t>(negative ? 0 - result.quotient : result.quotient);
}
