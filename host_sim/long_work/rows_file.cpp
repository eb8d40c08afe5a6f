#include "host_sim/long_work/rows_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>

#include "host_sim/long_work/record.hpp"
#include "host_sim/process/file_error.hpp"

namespace sonoglide::long_work {
namespace {

std::string end_text(std::uint64_t records, const process::Checksum& sum) {
  return fmt::format("end {} {:016x}", records, sum.value());
}

}  // namespace

RowsReader::RowsReader(const std::filesystem::path& file) {
  std::error_code unknown;
  if (std::filesystem::is_regular_file(file, unknown)) {
    stream_.open(file, std::ios::binary);
  }
  if (!stream_.is_open()) {
    throw NoRows("is no file that can be read");
  }
  std::optional<std::string_view> text;
  if (next_line(stream_, line_)) {
    text = unsealed(line_);
  }
  const auto header = text ? parse_header(*text) : std::nullopt;
  if (!header) {
    throw NoRows("does not begin as a shard of this format does");
  }
  header_ = *header;
  sum_.add(line_);
}

bool RowsReader::next(std::string& record) {
  const bool whole = next_line(stream_, line_);
  const auto text = whole ? unsealed(line_) : std::nullopt;
  if (!text) {
    throw DamagedRows(fmt::format("is damaged in line {}", records_ + 2));
  }
  if (records_ < range().size()) {
    sum_.add(line_);
    ++records_;
    record = *text;
    return true;
  }
  if (*text != end_text(records_, sum_) || stream_.peek() != std::ifstream::traits_type::eof()) {
    throw DamagedRows("is damaged at its end");
  }
  return false;
}

RowsWriter::RowsWriter(const std::filesystem::path& folder, const ShardHeader& header,
                       const std::string& copy)
    : target_(folder / rows_name(header.shard())),
      staged_(folder / staged_name(header.shard(), copy)) {
  constexpr mode_t mode = 0666;
  file_ =
      process::Descriptor(open(staged_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, mode));
  if (file_.number() < 0) {
    process::fail(staged_);
  }
  put(header_text(header));
}

RowsWriter::~RowsWriter() {
  if (!published_) {
    unlink(staged_.c_str());
  }
}

void RowsWriter::add(const std::string& record) {
  put(record);
  ++records_;
}

void RowsWriter::publish() {
  put(end_text(records_, sum_));
  flush();
  if (fsync(file_.number()) != 0) {
    process::fail(staged_);
  }
  file_.close();
  std::error_code error;
  std::filesystem::rename(staged_, target_, error);
  if (error) {
    process::fail(target_, error);
  }
  published_ = true;
  // The name too survives a power failure; a file system that cannot promise it says so in vain.
  const process::Descriptor folder(
      open(target_.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.number() >= 0) {
    fsync(folder.number());
  }
}

void RowsWriter::put(const std::string& text) {
  constexpr std::size_t worth_a_write = std::size_t{1} << 20U;
  const std::string line = sealed(text);
  sum_.add(line);
  buffer_ += line;
  buffer_ += '\n';
  if (buffer_.size() >= worth_a_write) {
    flush();
  }
}

void RowsWriter::flush() {
  write_all(file_, staged_, buffer_);
  buffer_.clear();
}

}  // namespace sonoglide::long_work
