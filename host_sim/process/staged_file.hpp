/// A file that is written piece by piece.
#pragma once

#include <filesystem>
#include <ostream>
#include <streambuf>
#include <vector>

#include "host_sim/process/pipe.hpp"

namespace sonoglide::process {

/// Hands over to the system what a stream writes, and throws where it refuses.
class FileBuffer : public std::streambuf {
 public:
  FileBuffer(const std::filesystem::path& file, std::filesystem::path target);
  void close();

 protected:
  int_type overflow(int_type character) override;
  std::streamsize xsputn(const char* text, std::streamsize size) override;
  int sync() override;

 private:
  void hand_over(const char* text, std::streamsize size);

  std::filesystem::path target_;
  Descriptor file_;
  std::vector<char> buffer_;
};

/// A new file as a stream. Where the system refuses to write, the stream throws at once, with the
/// reason.
class StagedFile : public std::ostream {
 public:
  /// @param file    is not there yet
  /// @param target  what errors name: where it will stand
  /// @throws FileError  it cannot be created
  StagedFile(const std::filesystem::path& file, const std::filesystem::path& target);

  /// Everything is handed to the system; may be called again. @throws FileError
  void close() { buffer_.close(); }

 private:
  FileBuffer buffer_;
};

}  // namespace sonoglide::process
