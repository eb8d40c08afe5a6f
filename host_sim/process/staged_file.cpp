#include "host_sim/process/staged_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "host_sim/process/file_error.hpp"

namespace sonoglide::process {
namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 16U;

}  // namespace

FileBuffer::FileBuffer(const std::filesystem::path& file, std::filesystem::path target)
    : target_(std::move(target)), buffer_(buffer_bytes) {
  constexpr mode_t mode = 0666;
  file_ = Descriptor(open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
  if (file_.number() < 0) {
    fail(target_, std::generic_category().message(errno));
  }
  setp(buffer_.data(), buffer_.data() + buffer_.size());
}

void FileBuffer::close() {
  sync();
  file_.close();
}

FileBuffer::int_type FileBuffer::overflow(int_type character) {
  sync();
  if (!traits_type::eq_int_type(character, traits_type::eof())) {
    *pptr() = traits_type::to_char_type(character);
    pbump(1);
  }
  return traits_type::not_eof(character);
}

std::streamsize FileBuffer::xsputn(const char* text, std::streamsize size) {
  if (size < epptr() - pptr()) {
    return std::streambuf::xsputn(text, size);
  }
  sync();
  hand_over(text, size);
  return size;
}

int FileBuffer::sync() {
  const char* text = pbase();
  const std::streamsize size = pptr() - pbase();
  setp(buffer_.data(), buffer_.data() + buffer_.size());
  hand_over(text, size);
  return 0;
}

void FileBuffer::hand_over(const char* text, std::streamsize size) {
  while (size > 0) {
    const ssize_t count = ::write(file_.number(), text, static_cast<std::size_t>(size));
    if (count < 0 && errno != EINTR) {
      fail(target_, "could not be written in full: " + std::generic_category().message(errno));
    }
    const ssize_t written = std::max<ssize_t>(0, count);
    text += written;
    size -= written;
  }
}

StagedFile::StagedFile(const std::filesystem::path& file, const std::filesystem::path& target)
    : std::ostream(nullptr), buffer_(file, target) {
  rdbuf(&buffer_);
  exceptions(std::ios::badbit);
}

}  // namespace sonoglide::process
