/// A ZIP archive, file by file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace sonoglide::fmi {

/// Two archives of the same files are the same bytes: no file has a time.
class ZipWriter {
 public:
  /// @throws output::OutputError  it cannot be created
  explicit ZipWriter(const std::filesystem::path& path);
  ~ZipWriter();
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  /// @param name  with / between folders
  /// @throws output::OutputError  it cannot be written
  void add(const std::string& name, std::string_view content);

  /// To be called once, last. @throws output::OutputError
  void close();

 private:
  void require(bool good) const;

  std::filesystem::path path_;
  void* file_;
};

}  // namespace sonoglide::fmi
