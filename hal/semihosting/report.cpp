#include "hal/semihosting/report.hpp"

namespace sonoglide::hal::semihosting {

void Report::number(const char* name, std::uint64_t value) {
  Figures reversed{};
  std::size_t count = 0;
  do {
    reversed[count++] = static_cast<char>('0' + value % 10);
    value /= 10;
  } while (value > 0);
  Figures figures{};
  for (std::size_t i = 0; i < count; ++i) {
    figures[i] = reversed[count - 1 - i];
  }
  line(name, figures, count);
}

void Report::hash(const char* name, std::uint64_t value) {
  constexpr std::size_t count = 16;
  Figures figures{};
  for (std::size_t i = 0; i < count; ++i) {
    figures[i] = "0123456789abcdef"[value >> (4 * (count - 1 - i)) & 15];
  }
  line(name, figures, count);
}

void Report::line(const char* name, const Figures& figures, std::size_t count) {
  constexpr std::size_t longest_name = 40;
  std::array<char, longest_name + sizeof(Figures) + 2> text{};
  std::size_t size = 0;
  while (name[size] != '\0' && size < longest_name) {
    text[size] = name[size];
    ++size;
  }
  text[size++] = ' ';
  for (std::size_t i = 0; i < count; ++i) {
    text[size++] = figures[i];
  }
  text[size++] = '\n';
  complete_ = complete_ && write_all(output_, text.data(), size);
}

}  // namespace sonoglide::hal::semihosting
