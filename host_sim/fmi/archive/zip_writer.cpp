#include "host_sim/fmi/archive/zip_writer.hpp"

#include <minizip/zip.h>

#include "host_sim/output/written_files.hpp"

namespace sonoglide::fmi {

ZipWriter::ZipWriter(const std::filesystem::path& path)
    : path_(path), file_(zipOpen64(path.c_str(), APPEND_STATUS_CREATE)) {
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
                              Z_DEFLATED, Z_DEFAULT_COMPRESSION) == ZIP_OK);
  require(zipWriteInFileInZip(file_, content.data(), static_cast<unsigned>(content.size())) ==
          ZIP_OK);
  require(zipCloseFileInZip(file_) == ZIP_OK);
}

void ZipWriter::close() {
  const bool good = zipClose(file_, nullptr) == ZIP_OK;
  file_ = nullptr;
  require(good);
}

void ZipWriter::require(bool good) const {
  if (!good) {
    output::fail(path_, "cannot be written as an archive");
  }
}

}  // namespace sonoglide::fmi
