#include "host_sim/fmi/archive/zip_writer.hpp"

#include <minizip/zip.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace sonoglide::fmi {
namespace {

void require(bool good) {
  if (!good) {
    throw std::runtime_error("an FMU cannot be packed");
  }
}

ZipWriter::Bytes& bytes_of(void* stream) {
  return *static_cast<ZipWriter::Bytes*>(stream);
}

// What minizip does with a file, done with memory.

void* open_bytes(void* opaque, const void* /*name*/, int /*mode*/) {
  return opaque;
}

uLong read_bytes(void* /*opaque*/, void* stream, void* target, uLong size) {
  ZipWriter::Bytes& bytes = bytes_of(stream);
  const std::size_t count = bytes.text.copy(static_cast<char*>(target), size, bytes.place);
  bytes.place += count;
  return count;
}

uLong write_bytes(void* /*opaque*/, void* stream, const void* source, uLong size) {
  ZipWriter::Bytes& bytes = bytes_of(stream);
  bytes.text.resize(std::max(bytes.text.size(), bytes.place + size));
  bytes.text.replace(bytes.place, size, static_cast<const char*>(source), size);
  bytes.place += size;
  return size;
}

ZPOS64_T tell_bytes(void* /*opaque*/, void* stream) {
  return bytes_of(stream).place;
}

long seek_bytes(void* /*opaque*/, void* stream, ZPOS64_T offset, int origin) {
  ZipWriter::Bytes& bytes = bytes_of(stream);
  const std::size_t from = origin == ZLIB_FILEFUNC_SEEK_SET   ? 0
                           : origin == ZLIB_FILEFUNC_SEEK_CUR ? bytes.place
                                                              : bytes.text.size();
  bytes.place = from + offset;
  return bytes.place <= bytes.text.size() ? 0 : -1;
}

int nothing_of_bytes(void* /*opaque*/, void* /*stream*/) {
  return 0;
}

}  // namespace

ZipWriter::ZipWriter() {
  zlib_filefunc64_def functions{open_bytes, read_bytes,       write_bytes,      tell_bytes,
                                seek_bytes, nothing_of_bytes, nothing_of_bytes, &bytes_};
  file_ = zipOpen2_64("", APPEND_STATUS_CREATE, nullptr, &functions);
  require(file_ != nullptr);
}

ZipWriter::~ZipWriter() {
  if (file_ != nullptr) {
    zipClose(file_, nullptr);
  }
}

void ZipWriter::add(const std::string& name, std::string_view content) {
  zip_fileinfo facts{};
  facts.tmz_date.tm_mday = 1;  // 1980, the first year that the format knows
  facts.tmz_date.tm_year = 1980;
  require(zipOpenNewFileInZip(file_, name.c_str(), &facts, nullptr, 0, nullptr, 0, nullptr,
                              Z_DEFLATED, Z_BEST_SPEED) == ZIP_OK);
  require(zipWriteInFileInZip(file_, content.data(), static_cast<unsigned>(content.size())) ==
          ZIP_OK);
  require(zipCloseFileInZip(file_) == ZIP_OK);
}

std::string ZipWriter::close() {
  const bool good = zipClose(std::exchange(file_, nullptr), nullptr) == ZIP_OK;
  require(good);
  return std::move(bytes_.text);
}

}  // namespace sonoglide::fmi
