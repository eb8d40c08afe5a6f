#include "host_sim/long_work/record.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <system_error>

#include "host_sim/process/checksum.hpp"
#include "host_sim/process/file_error.hpp"

namespace sonoglide::long_work {
namespace {

constexpr std::size_t checksum_digits = 16;

}  // namespace

std::string sealed(std::string_view text) {
  return fmt::format("{:016x} {}", process::checksum(text), text);
}

std::optional<std::string_view> unsealed(std::string_view line) {
  if (line.size() <= checksum_digits) {
    return std::nullopt;
  }
  const std::string_view text = line.substr(checksum_digits + 1);
  if (line.substr(0, checksum_digits + 1) != fmt::format("{:016x} ", process::checksum(text))) {
    return std::nullopt;
  }
  return text;
}

bool next_line(std::ifstream& file, std::string& line) {
  // A scene in JSON, each of its bytes escaped.
  constexpr std::size_t longest = std::size_t{16} << 20U;
  line.clear();
  std::filebuf& bytes = *file.rdbuf();
  for (int byte = bytes.sbumpc(); byte != std::filebuf::traits_type::eof(); byte = bytes.sbumpc()) {
    if (byte == '\n') {
      return true;
    }
    if (line.size() == longest) {
      return false;
    }
    line += static_cast<char>(byte);
  }
  return false;
}

void write_all(const process::Descriptor& file, const std::filesystem::path& path,
               std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(file.number(), text.data(), text.size());
    if (count < 0 && errno != EINTR) {
      process::fail(path);
    }
    text.remove_prefix(count > 0 ? static_cast<std::size_t>(count) : 0);
  }
}

std::string number_text(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return fmt::format("{:x} ", bits);
}

std::string number_text(std::uint64_t value) {
  return fmt::format("{} ", value);
}

std::uint64_t RecordNumbers::whole() {
  constexpr int decimal = 10;
  return next(decimal);
}

double RecordNumbers::real() {
  constexpr int hexadecimal = 16;
  const std::uint64_t bits = next(hexadecimal);
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// Up to the next blank, which goes too.
std::uint64_t RecordNumbers::next(int base) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value, base);
  const auto length = static_cast<std::size_t>(end - rest_.data());
  good_ = good_ && error == std::errc() && length < rest_.size() && rest_[length] == ' ';
  rest_.remove_prefix(good_ ? length + 1 : rest_.size());
  return value;
}

}  // namespace sonoglide::long_work
