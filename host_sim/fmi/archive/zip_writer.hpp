/// A ZIP archive in memory, file by file.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sonoglide::fmi {

/// Two archives of the same files are the same bytes: no file has a time.
class ZipWriter {
 public:
  ZipWriter();
  ~ZipWriter();
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  /// @param name  with / between folders
  /// @throws std::runtime_error
  void add(const std::string& name, std::string_view content);

  /// The archive; to be called once, last.
  /// @throws std::runtime_error
  std::string close();

  /// What has been written, and where the next byte goes.
  struct Bytes {
    std::string text;
    std::size_t place = 0;
  };

 private:
  Bytes bytes_;
  void* file_;
};

}  // namespace sonoglide::fmi
